"""Derivatives of friction by central differences, on meshes that move with the block, with their errors.

A scene is solved as accurately as it asks for. Every changed scene is then solved in the same kinematics, with all
Maxwell elements, on that mesh, moved along, and on one of cells 1.5 times as large: with L = ln mu,

    D(h) = (L(h) - L(-h)) / 2h,

h the largest step on both meshes and half of it too on the coarse one; mu is that of the contact forces, which nodes
that come and go at the edges of a contact change ten times less than the stress power. The error of D(h) on the fine
mesh is the sum of

- truncation, 3/2 |D(h/2) - D(h)| on the coarse mesh, with the noise of contact nodes that come and go: of a smooth
  function 4/3 of it to leading order;
- mesh: the change from mesh to mesh, extrapolated as that of friction is; but no smaller than its share of that of all
  parameters together, by how far they move the contact (the change of the mean square of pressure), since two meshes
  may agree by chance; and no smaller than one node at the edge of a contact makes of it, since a small change may
  move none;
- the tolerance of the solver and the digits of the input, over h;
- where small strain was chosen for its accuracy, the estimated share of finite strain.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.steady.error import ORDER, friction_error
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.steady.same_mesh import SameMesh
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.road.road import finest_waves
from rubfric.scene.scene import Scene
from rubfric.simulation import decide_solvable, solve, solve_near
from rubfric.studies.sensitivity.parameters import Parameter

# How many times as fine the fine mesh is as one that suffices for friction, where that costs little, and the coarse one
# as coarse as the fine one.
FINER, COARSER = 2.0, 1.5
# How many times the extrapolated change from mesh to mesh the error may be, and what part of a derivative is not known
# where the contact has edges: this over the nodes of a spot of it and the root of their number.
_CHANGE, _EDGES = 1.5, 2.0
# How many times the difference between a step and half of it its truncation may be.
_TRUNCATED = 1.5
# Digits to which numbers of the input are kept: relative.
_DIGITS = 1e-12
# Friction must be so many times its error for its logarithm to have a derivative.
_CLEAR = 2.0


@dataclass(frozen=True)
class Base:
    """A solved scene, on two meshes.

    Attributes
    ----------
    scene : Scene
        With all Maxwell elements.
    error : float
        Of friction, absolute, dimensionless.
    fine, coarse : SteadySolution
    """

    scene: Scene
    error: float
    fine: SteadySolution
    coarse: SteadySolution

    @property
    def friction(self) -> float:
        """On the fine mesh, dimensionless."""
        return self.fine.friction.stress_power

    @property
    def cells(self) -> tuple[int, int]:
        """Cells of the fine and of the coarse mesh."""
        fine, coarse = (one.block.columns * one.block.rows for one in (self.fine, self.coarse))
        return fine, coarse

    def near(self, scene: Scene, fine: bool, start: SteadySolution | None = None) -> SteadySolution:
        """Return the solution of a scene nearly the same on either mesh.

        Parameters
        ----------
        scene : Scene
        fine : bool
            On the fine mesh, or on the coarse one.
        start : SteadySolution, optional
            To start from, on that mesh; the base's by default.
        """
        like = self.fine if fine else self.coarse
        return solve_near(scene, start or like, SameMesh.of(like.block, like.meshes[-1].growth))


@dataclass(frozen=True)
class Difference:
    """How the logarithm of friction changes along the coordinate of a parameter.

    Attributes
    ----------
    name : str
        Of the parameter.
    step : float
        h.
    derivative : float
        D(h) on the fine mesh.
    coarse : float
        D(h) on the coarse mesh.
    truncation, noise : float
        Parts of its error that are known from this parameter alone.
    moved : float
        The same difference of ln <pressure^2> on the fine mesh.
    raised : float
        ln mu(h) - ln mu(0), on the fine mesh.
    """

    name: str
    step: float
    derivative: float
    coarse: float
    truncation: float
    noise: float
    moved: float
    raised: float


def solved(scene: Scene) -> Base:
    """Solve a scene as accurately as it asks for, and on a coarser mesh.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    InvalidInput
        Where friction is zero within its error.
    NotConverged
        From the solver.
    """
    scene = replace(scene, numerics=replace(scene.numerics, folding=0.0), measured=None)
    decide_solvable(scene)
    fine = solve(scene)
    friction, error = fine.friction.stress_power, friction_error(fine)
    if friction <= _CLEAR * error:
        raise InvalidInput(
            f"friction of {scene.name} is {friction:.2g} with an error of {error:.1g}, but must be clear of zero for "
            "sensitivities: choose another speed or pressure, or a smaller numerics.accuracy"
        )
    mesh, finite = fine.meshes[-1], fine.decision.kinematics == "finite"
    chosen = Resolution(mesh.columns, mesh.growth)
    if not finite or finest_waves(scene.road) == 1:
        finer = chosen.finer(scene, FINER, finite)
        if finer.affordable(scene, finite):
            chosen, fine = finer, solve_near(scene, fine, finer)
    return Base(scene, error, fine, solve_near(scene, fine, chosen.finer(scene, 1.0 / COARSER, finite)))


def difference(base: Base, parameter: Parameter, step: float) -> Difference:
    """Return the central difference of ln mu along a parameter, by six solves.

    Parameters
    ----------
    base : Base
    parameter : Parameter
    step : float
        h > 0, in the parameter's coordinate.

    Raises
    ------
    InvalidInput
        Where a changed scene is none, or its friction not above zero.
    NotConverged
        Where one has no solution.
    """
    fine, coarse, half, squares = {}, {}, {}, {}
    for side in (-1.0, 1.0):
        near, far = (parameter.change(base.scene, part * side * step) for part in (0.5, 1.0))
        start = base.near(near, fine=False)
        half[side] = logarithm(start)
        coarse[side] = logarithm(base.near(far, fine=False, start=start))
        reached = _reached(base, near, far)
        fine[side] = logarithm(reached)
        squares[side] = math.log(float((reached.contact.pressure**2).mean()))
    on_coarse = (coarse[1.0] - coarse[-1.0]) / (2.0 * step)
    friction = base.fine.friction
    rounding = _DIGITS / base.scene.material.long_term_fraction
    return Difference(
        name=parameter.name,
        step=step,
        derivative=(fine[1.0] - fine[-1.0]) / (2.0 * step),
        coarse=on_coarse,
        truncation=_TRUNCATED * abs((half[1.0] - half[-1.0]) / step - on_coarse),
        noise=(friction.resolution / friction.contact + rounding) / step,
        moved=(squares[1.0] - squares[-1.0]) / (2.0 * step),
        raised=fine[1.0] - logarithm(base.fine),
    )


def _reached(base: Base, near: Scene, far: Scene) -> SteadySolution:
    """Return the solution of a scene on the fine mesh, by way of a nearer one if need be."""
    try:
        return base.near(far, fine=True)
    except NotConverged:
        return base.near(far, fine=True, start=base.near(near, fine=True))


def logarithm(solution: SteadySolution) -> float:
    """Return ln mu of the contact forces; InvalidInput where friction is not above zero."""
    friction = solution.friction.contact
    if friction <= 0.0:
        raise InvalidInput(f"friction of {solution.scene.name} is {friction:.2g}, but its logarithm needs more than 0")
    return math.log(friction)


def errors(base: Base, found: Sequence[Difference]) -> list[float]:
    """Return the errors of derivatives, dimensionless, each from its own parts and from what meshes change in all.

    Parameters
    ----------
    base : Base
    found : sequence of Difference
        Of one base.
    """
    fine, coarse = base.fine.meshes[-1], base.coarse.meshes[-1]
    ratio = max(math.sqrt(fine.columns / coarse.columns * (coarse.growth - 1.0) / (fine.growth - 1.0)), 1.1)
    extrapolated = _CHANGE / (ratio**ORDER - 1.0)
    moved = math.hypot(*(one.moved for one in found))
    share = math.hypot(*(one.derivative - one.coarse for one in found)) / moved if moved else 0.0
    decision = base.fine.decision
    small = decision.correction if base.scene.kinematics == "auto" and decision.kinematics == "small" else 0.0
    edges = _EDGES * math.sqrt(fine.spots) / fine.contact_nodes if fine.contact_nodes < fine.columns else 0.0
    answer = []
    for one in found:
        size = abs(one.derivative)
        change = max(abs(one.derivative - one.coarse), share * abs(one.moved))
        mesh = max(extrapolated * change, edges * size)
        answer.append(one.truncation + mesh + one.noise + small * max(1.0, size))
    return answer
