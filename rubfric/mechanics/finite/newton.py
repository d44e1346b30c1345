"""Newton's method for a sliding contact in finite strain, at one amplitude of the road and one load.

It seeks the zero of u - T(u), T being one exact linearised contact solve (``finite.contact``). GMRES finds
each direction with the full tangent, at the contact nodes of T; a step is shortened until u - T(u) falls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags
from rubfric.errors import NotConverged
from rubfric.mechanics.finite.block import Fields
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact
from rubfric.mechanics.finite.direction import MOST_KRYLOV, Direction, newton_direction
from rubfric.mechanics.finite.law import Inverted
from rubfric.road.road import finest_waves

_MOST_STEPS = 16
# A direction that took more Krylov iterations is worth a new average of the tangent, by default.
_WORTH = 6
_SHORTEST_STEP = 1.0 / 16.0
# Share of the decrease of a full linear step that a step must bring.
_DECREASE = 0.1
# So many steps must bring the residual below this share of what it was.
_WATCHED, _SLOWEST = 3, 0.5
# After a direction of more Krylov iterations, and far off on many waves, local stiffness scales the preconditioner.
_HARD = 10
# Far from a solution, where GMRES does not get as far as it should, its step must bring the residual below this share.
_EXHAUSTED = 0.5
# A step may end above the last residual, as long as it ends below the larger of so many of them.
_MEMORY = 2
# GMRES solves to a share of the residual: the loosest where residuals fall slowly, in proportion where they fall fast.
# Above some residual an exact direction leads astray: along soft modes of the tangent there, not of the contact.
_LOOSEST, _TIGHTEST, _IN_PROPORTION = 0.03, 0.01, 0.5
_FAR, _LOOSEST_FAR = 0.05, 0.1


class Stalled(RuntimeError):
    """Newton's method came to an end without a solution: why, after how much work, and how far off."""

    def __init__(self, reason: str, steps: int, krylov: int, residual: float) -> None:
        super().__init__(reason, steps, krylov, residual)
        self.reason = reason
        self.steps = steps
        self.krylov = krylov
        self.residual = residual


@dataclass(frozen=True)
class Solved:
    """A converged contact.

    Attributes
    ----------
    fields : Fields
    correction : Correction
        What T makes of them.
    residuals : tuple of float
        Size of u - T(u) before each Newton step, and at the end.
    krylov : int
        Applications of the tangent.
    circulant : Circulant
        The averaged tangent last used.
    """

    fields: Fields
    correction: Correction
    residuals: tuple[float, ...]
    krylov: int
    circulant: Circulant

    @property
    def steps(self) -> int:
        """Newton steps taken."""
        return len(self.residuals) - 1


def newton(
    problem: SlidingContact,
    start: Fields,
    load: Load,
    touching: Flags,
    tolerance: float,
    circulant: Circulant | None = None,
    worth: int = _WORTH,
) -> Solved:
    """Solve the contact from some fields and a first guess of the contact nodes.

    Parameters
    ----------
    problem : SlidingContact
    start : Fields
    load : Load
    touching : ndarray of bool, shape (columns,)
        First guess of the contact nodes.
    tolerance : float
        Size of u - T(u), as ``SlidingContact.size`` measures it, at which to stop.
    circulant : Circulant, optional
        An averaged tangent to begin with.
    worth : int
        A direction that took more Krylov iterations is followed by a new average of the tangent.

    Raises
    ------
    Stalled
        Where the residual no longer falls, a point is turned inside out, numbers overflow, or the linearised contact
        has no solution.
    """
    residuals: list[float] = []
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise", under="ignore"):
            return _iterate(problem, start, load, touching, tolerance, circulant, worth, residuals)
    except FloatingPointError as error:  # fields too far off for arithmetic
        raise Stalled(str(error), len(residuals), 0, residuals[-1] if residuals else np.inf) from error


def starting_distance(
    problem: SlidingContact, fields: Fields, load: Load, touching: Flags, circulant: Circulant | None = None
) -> tuple[float, Circulant | None]:
    """Return the size of u - T(u) of fields, infinite where there is no T(u), and the averaged tangent used.

    Parameters
    ----------
    problem : SlidingContact
    fields : Fields
    load : Load
    touching : ndarray of bool, shape (columns,)
        First guess of the contact nodes.
    circulant : Circulant, optional
        An averaged tangent, instead of that of these fields.
    """
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise", under="ignore"):
            if circulant is None:
                circulant = _averaged(problem, fields, load)
            return problem.size(problem.correct(circulant, fields, load, touching).step), circulant
    except (Inverted, NotConverged, np.linalg.LinAlgError, FloatingPointError):
        return np.inf, circulant


def _iterate(
    problem: SlidingContact,
    start: Fields,
    load: Load,
    touching: Flags,
    tolerance: float,
    circulant: Circulant | None,
    worth: int,
    residuals: list[float],
) -> Solved:
    """Do what ``newton`` does, and keep the sizes of u - T(u) in ``residuals``."""
    fields, correction, krylov, hard = start, None, 0, False
    while True:
        steps = max(0, len(residuals) - 1)
        try:
            if circulant is None:
                circulant, correction = _averaged(problem, fields, load), None
            if correction is None:
                correction = problem.correct(circulant, fields, load, touching)
        except (Inverted, NotConverged, np.linalg.LinAlgError) as error:
            raise Stalled(str(error), steps, krylov, residuals[-1] if residuals else np.inf) from error
        size = problem.size(correction.step)
        residuals.append(size)
        if size <= tolerance:
            return Solved(fields, correction, tuple(residuals), krylov, circulant)
        if len(residuals) > _MOST_STEPS:
            raise Stalled("too many steps", len(residuals) - 1, krylov, size)
        if len(residuals) > _WATCHED and size > _SLOWEST * residuals[-1 - _WATCHED]:
            raise Stalled("the residual falls too slowly", len(residuals) - 1, krylov, size)
        stiffness = problem.finite.stiffness(fields, correction.state)
        hard = hard or (size > _FAR and finest_waves(load.road) > 1)
        found = newton_direction(
            problem, circulant, stiffness, correction, load, correction.contact.touching, _forcing(residuals), hard
        )
        del stiffness  # much memory
        hard = hard or found.most > _HARD
        krylov += found.krylov
        ahead = _advance(problem, circulant, fields, found, load, max(residuals[-_MEMORY:]))
        if ahead is None:
            raise Stalled("no step brings the residual down", len(residuals) - 1, krylov, size)
        fields, correction = ahead
        touching = correction.contact.touching
        ahead_size = problem.size(correction.step)
        if found.most >= MOST_KRYLOV and ahead_size > max(_FAR, _EXHAUSTED * size):
            raise Stalled("GMRES finds no direction that brings the residual down", len(residuals), krylov, ahead_size)
        if found.most > worth and ahead_size > tolerance:
            circulant = None


def _averaged(problem: SlidingContact, fields: Fields, load: Load) -> Circulant:
    """Return the averaged tangent of fields; their state is not kept."""
    finite = problem.finite
    return Circulant(finite, finite.stiffness(fields, finite.stressed(fields)), load.pressure)


def _forcing(residuals: list[float]) -> float:
    """Return the share of the residual to which GMRES should solve."""
    loosest = _LOOSEST_FAR if residuals[-1] > _FAR else _LOOSEST
    if len(residuals) < 2:
        return loosest
    return min(loosest, max(_TIGHTEST, _IN_PROPORTION * residuals[-1] / residuals[-2]))


def _advance(
    problem: SlidingContact, circulant: Circulant, fields: Fields, direction: Direction, load: Load, size: float
) -> tuple[Fields, Correction] | None:
    """Return the fields after a step along a direction, as long as brings u - T(u) below ``size``.

    With them, what T makes of them; None where no step does. Where the contact nodes are not settled, the step at
    their first guess may be the better one.
    """
    step, touching = direction.step, direction.touching
    ahead = _moved(problem, circulant, fields.moved(step), load, touching)
    if direction.plain is not None:
        other = _moved(problem, circulant, fields.moved(direction.plain[0]), load, direction.plain[1])
        if other is not None and (ahead is None or problem.size(other[1].step) < problem.size(ahead[1].step)):
            ahead, (step, touching) = other, direction.plain
    share = 1.0
    while ahead is None or problem.size(ahead[1].step) >= (1.0 - _DECREASE * share) * size:
        share *= 0.5
        if share < _SHORTEST_STEP:
            return None
        ahead = _moved(problem, circulant, fields.moved(step, share), load, touching)
    return ahead


def _moved(
    problem: SlidingContact, circulant: Circulant, fields: Fields, load: Load, touching: Flags
) -> tuple[Fields, Correction] | None:
    """Return fields and what T makes of them, or None where there is no T of them."""
    try:
        return fields, problem.correct(circulant, fields, load, touching)
    except (Inverted, NotConverged, np.linalg.LinAlgError, FloatingPointError):
        return None
