"""Reference friction: three meshes of one family, each finer than the default, and their extrapolation.

The bound on its error counts the change on the finest mesh, what extrapolation adds, and the difference between the
routes to friction on the finest mesh. No branch is left out, and finite strain is solved to round-off.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from rubfric.mechanics.finite.steady import FiniteSolver
from rubfric.mechanics.small.steady import SmallSolver
from rubfric.mechanics.steady.refinement import steps_to
from rubfric.mechanics.steady.resolution import Resolution, count_spots, most_columns, needed
from rubfric.mechanics.steady.solution import Friction
from rubfric.mechanics.theory.kinematics import decide
from rubfric.road.road import finest_waves
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene

# Fineness of the three meshes (``scene.numerics``); on roads of many waves, where contact has more nodes, that of both.
_FINENESS = {"small": (2.0, 3.0, 4.5), "finite": (1.4, 2.0, 2.8)}
# Order of the extrapolation of three meshes that converge monotonically: the lowest that is observed.
_ORDER = 2.0
_BASE = Numerics(**fineness(1.0), refinements=0, folding=0.0, tolerance=1e-9, columns_max=65536)


@dataclass(frozen=True)
class Converged:
    """The friction coefficient of a scene, and a bound on its error.

    Attributes
    ----------
    friction : float
        Dimensionless.
    error : float
        Bound on its error, absolute.
    columns, rows : int
        The finest mesh.
    kinematics : {"small", "finite"}
    """

    friction: float
    error: float
    columns: int
    rows: int
    kinematics: str


def converge(scene: Scene) -> Converged:
    """Return the reference friction of a scene: in finite strain, unless it asks for small strain.

    Raises
    ------
    NotConverged
        From the solver.
    """
    kinematics = "small" if scene.kinematics == "small" else "finite"
    scene = dataclasses.replace(scene, kinematics=kinematics, numerics=_numerics(scene))
    solver = SmallSolver(scene, decide(scene)) if kinematics == "small" else FiniteSolver(scene, decide(scene))
    solution = steps_to(scene, solver, [])
    found: list[Friction] = []
    many = finest_waves(scene.road) > 1
    for finer in _FINENESS["finite" if many else kinematics]:
        spots = count_spots(scene, solution.contact.touching)
        target = needed(scene, solution.contact_fraction, solver.finite, spots)
        growth = 1.0 + (target.growth - 1.0) / finer
        columns = target.finer(scene, finer, solver.finite).columns
        solution = solver.solve(Resolution(columns, growth))
        found.append(solution.friction)
    friction, error = _limit(found)
    capped = solution.block.columns == most_columns(scene, solver.finite)
    return Converged(
        friction, (2.0 if capped else 1.0) * error, solution.block.columns, solution.block.rows, kinematics
    )


def _numerics(scene: Scene) -> Numerics:
    return dataclasses.replace(_BASE, dilatation=scene.numerics.dilatation, first_row=scene.numerics.first_row)


def _limit(found: list[Friction]) -> tuple[float, float]:
    """Return the limit of three meshes, each finer by about 1.45, and a bound on its error."""
    first, second, third = ((route.stress_power + route.contact) / 2.0 for route in found)
    routes = abs(found[-1].stress_power - found[-1].contact)
    before, last = second - first, third - second
    limit = third
    if 0.0 < last * before < before * before:  # converges monotonically
        limit += last / (1.45**_ORDER - 1.0)
    return limit, max(abs(last), abs(limit - third), 0.5 * routes) + found[-1].resolution
