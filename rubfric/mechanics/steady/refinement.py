"""From a coarse mesh to one that is fine enough: what every way of solving a scene has in common.

A scene is solved on a mesh with cells twice as large as the contact seems to need, then on the one that it needs, and
then on finer ones, until the estimated error of friction is within the accuracy asked for. All of them, and the
routes to friction on the last, say how large the error is (``rubfric.mechanics.steady.error``).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Protocol, TypeVar

import numpy as np

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.steady.error import ORDER, allowance, discretisation_error
from rubfric.mechanics.steady.resolution import MOST_SMALL_CELLS, Resolution, count_spots, most_columns
from rubfric.mechanics.steady.solution import OnMesh, SteadySolution
from rubfric.road.road import finest_waves
from rubfric.scene.scene import Scene

# Share of the contact nodes asked for that a mesh may miss, since their number is known only afterwards.
SHORTFALL = 0.1
# A mesh has at most this many times the columns of the one before, on the way to the contact.
_STRIDE = 6.0
# A mesh of nearly the columns of the coarse one stands in for it.
_NEAR = 1.5
# Smallest and largest refinement that an error asks for, and how much more than its estimate says.
_LEAST, _MOST, _MARGIN = 1.5, 2.0, 1.1
# Where so fine a mesh may not be solved, one finer by this factor is worth while.
LEAST_WORTH = 1.2

Solution = TypeVar("Solution", bound=SteadySolution, covariant=True)


class Solver(Protocol[Solution]):
    """Solves one scene on one mesh after the other, each from what the one before has found."""

    finite: bool

    def first(self) -> Resolution:
        """Return the mesh to begin with."""

    def solve(self, resolution: Resolution) -> Solution:
        """Return the solution on a mesh."""


def refined(scene: Scene, solver: Solver[Solution]) -> Solution:
    """Solve a scene on meshes that follow from one another; return the solution on the last.

    Parameters
    ----------
    scene : Scene
    solver : Solver
        Of that scene.

    Raises
    ------
    InvalidInput
        Where rows grow so slowly that a mesh in small strain would have too many cells.
    NotConverged
        From ``solver``, on a road of one wave, or on a mesh that the contact needs. On many waves, where a finer one
        has no solution, that on the last counts.
    """
    meshes: list[OnMesh] = []
    solution = steps_to(scene, solver, meshes)
    resolution = solution.needed(solver.finite)
    most = most_columns(scene, solver.finite)
    while True:
        solution = solve_on(scene, solver, resolution, meshes)
        if solution.resolved or resolution.columns >= most:
            break
        resolution = solution.needed(solver.finite, 1.0 - 0.5 * SHORTFALL)
    for _ in range(scene.numerics.refinements):
        friction, error, allowed = solution.friction, discretisation_error(meshes), allowance(solution)
        helps = abs(friction.stress_power) > friction.resolution and resolution.columns < most
        if not (helps and 0.0 < allowed < error):
            break
        factor = min(max(_MARGIN * (error / allowed) ** (1.0 / ORDER), _LEAST), _MOST)
        finer = next(_choices(scene, resolution, factor, solver.finite), None)
        if finer is None:
            break
        try:
            resolution, solution = finer, solve_on(scene, solver, finer, meshes)
        except NotConverged:
            if finest_waves(scene.road) == 1:
                raise
            # Of a profile, the friction that there is counts, with its error.
            solution = dataclasses.replace(solution, unsolved=finer.columns)
            break
    return dataclasses.replace(solution, meshes=tuple(meshes))


def _choices(scene: Scene, resolution: Resolution, factor: float, finite: bool) -> Iterator[Resolution]:
    """Yield finer meshes that may be solved, that of ``factor`` first; none that would be hardly finer."""
    while factor >= LEAST_WORTH:
        finer = resolution.finer(scene, factor, finite)
        if finer.affordable(scene, finite):
            yield finer
        factor -= 0.1


def steps_to(scene: Scene, solver: Solver[Solution], meshes: list[OnMesh]) -> Solution:
    """Return the solution on a mesh about half as fine as the contact needs; ``meshes`` gets what was solved.

    Parameters
    ----------
    scene : Scene
    solver : Solver
        Of that scene.
    meshes : list of OnMesh
        Gets what was solved.
    """
    resolution = solver.first()
    solution = solve_on(scene, solver, resolution, meshes)
    while True:
        coarse = solution.needed(solver.finite).coarser(scene, solver.finite)
        if coarse.columns <= _NEAR * resolution.columns:
            return solution
        stride = resolution.finer(scene, _STRIDE, solver.finite)
        resolution = coarse if coarse.columns <= stride.columns else Resolution(stride.columns, coarse.growth)
        solution = solve_on(scene, solver, resolution, meshes)


def solve_on(scene: Scene, solver: Solver[Solution], resolution: Resolution, meshes: list[OnMesh]) -> Solution:
    """Return the solution on one mesh.

    Parameters
    ----------
    scene : Scene
    solver : Solver
        Of that scene.
    resolution : Resolution
        The mesh.
    meshes : list of OnMesh
        Gets what was solved.

    Raises
    ------
    InvalidInput
        Where a mesh in small strain would have too many cells.
    NotConverged
        From ``solver``.
    """
    if not (solver.finite or resolution.affordable(scene, False)):
        raise InvalidInput(
            f"numerics.row_growth of {scene.name} is {scene.numerics.row_growth:g}, but must be larger: with "
            f"{resolution.columns} columns a mesh has more than {MOST_SMALL_CELLS:,} cells"
        )
    solution = solver.solve(resolution)
    touching = solution.contact.touching
    count, waves, spots = int(np.count_nonzero(touching)), finest_waves(scene.road), count_spots(scene, touching)
    block = solution.block
    first_row = float(block.row_positions[1] / block.column_width)
    about = (block.columns, block.rows, resolution.growth, count, solution.friction, first_row, waves, spots)
    meshes.append(OnMesh(*about))
    return solution
