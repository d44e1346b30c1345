"""Ways to a solution in finite strain: at once, along a growing road, along a growing load; recorded as they are tried.

Newton's method finds most contacts from the block pressed on a flat road. Where it stalls, the road is raised from
flat to its height in steps that adapt, each starting from the last two, and if that stalls as well the load is
raised instead.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from rubfric.arrays import Flags
from rubfric.errors import NotConverged
from rubfric.mechanics.finite.block import Fields
from rubfric.mechanics.finite.contact import Load, SlidingContact
from rubfric.mechanics.finite.newton import Solved, Stalled, newton

# What is solved on the way needs to be near, not exact.
_ON_THE_WAY = 1e-4
_FIRST_SHARE = 0.5
_SMALLEST_SHARE = 1e-4
# A step on the way that took at most so many Newton steps is followed by a longer one.
_EASY, _LONGER = 5, 1.6
# The load from which the way along the load begins, over the load asked for.
_LIGHT = 0.1
# Work after which a scene is given up, in applications of the tangent times cells: some fifteen seconds. A Newton step
# costs as much as so many applications, and each of them as much as the arithmetic of so many cells.
_MOST_WORK, _PER_STEP, _PER_APPLICATION = 3.0e7, 10, 5000

_SPENT = "a scene has only so much work, and this one has had it: most likely it has no solution under so heavy a load"


@dataclass(frozen=True)
class Start:
    """Fields to start from, and a first guess of the contact nodes."""

    fields: Fields
    touching: Flags


class History:
    """What was tried, in order: one line each."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.steps = 0
        self.krylov = 0
        self.work = 0.0

    def _count(self, problem: SlidingContact, steps: int, krylov: int) -> None:
        self.steps += steps
        self.krylov += krylov
        block = problem.finite.block
        applications = krylov + _PER_STEP * (steps + 1)
        self.work += applications * (block.columns * block.rows + _PER_APPLICATION)

    def solved(self, problem: SlidingContact, what: str, solved: Solved) -> None:
        """Record a success."""
        self._count(problem, solved.steps, solved.krylov)
        self.lines.append(f"{what}: converged in {solved.steps} Newton steps, {solved.krylov} Krylov iterations")

    def left(self, problem: SlidingContact, what: str, stalled: Stalled) -> None:
        """Record a failure."""
        self._count(problem, stalled.steps, stalled.krylov)
        self.lines.append(f"{what}: left after {stalled.steps} Newton steps, {stalled.reason}")


def reach(problem: SlidingContact, flat: Start, load: Load, tolerance: float, history: History) -> Solved:
    """Solve the contact from a block pressed on a flat road.

    Parameters
    ----------
    flat : Start
        The solution on a flat road.
    tolerance : float
        As for ``newton``.

    Raises
    ------
    NotConverged
        Where every way stalls.
    """
    columns = problem.finite.block.columns
    try:
        return attempt(problem, flat, load, tolerance, history, f"{columns} columns, at once")
    except Stalled:
        pass
    rise = f"{columns} columns, road at "
    try:
        return _follow(problem, flat, lambda share: replace(load, share=share), tolerance, history, rise)
    except Stalled:
        pass
    light = replace(load, pressure=_LIGHT * load.pressure)
    try:
        first = _follow(problem, flat, lambda share: replace(light, share=share), _ON_THE_WAY, history, rise)
        return _follow(
            problem,
            Start(first.fields, first.correction.contact.touching),
            lambda share: replace(load, pressure=(_LIGHT + share * (1.0 - _LIGHT)) * load.pressure),
            tolerance,
            history,
            f"{columns} columns, load at ",
        )
    except Stalled as stalled:
        raise NotConverged(
            problem.label,
            history.steps,
            stalled.residual,
            "distance from balance and contact, over the road's amplitude,",
            "every way to a solution stalls: the road may be too steep, or the load too heavy, for the rubber",
        ) from stalled


def attempt(problem: SlidingContact, start: Start, load: Load, tolerance: float, history: History, what: str) -> Solved:
    """Run Newton's method once and record how it went.

    Raises
    ------
    Stalled
        Where it does.
    NotConverged
        Where it does, and the scene has had all the work that it may have.
    """
    try:
        solved = newton(problem, start.fields, load, start.touching, tolerance)
    except Stalled as stalled:
        history.left(problem, what, stalled)
        if history.work > _MOST_WORK:
            measure = f"distance from balance and contact, over the road's amplitude, at last ({what})"
            raise NotConverged(problem.label, history.steps, stalled.residual, measure, _SPENT) from stalled
        raise
    history.solved(problem, what, solved)
    return solved


def _follow(
    problem: SlidingContact,
    start: Start,
    loads: Callable[[float], Load],
    tolerance: float,
    history: History,
    what: str,
) -> Solved:
    """Follow loads(share) from share 0, where ``start`` solves it, to 1; Stalled where steps become too short."""
    share, length = 0.0, _FIRST_SHARE
    here, before = start, None
    while True:
        ahead = min(1.0, share + length)
        guess = here.fields if before is None else _extrapolate(before, (share, here.fields), ahead)
        last = ahead == 1.0
        try:
            solved = attempt(
                problem,
                Start(guess, here.touching),
                loads(ahead),
                tolerance if last else _ON_THE_WAY,
                history,
                f"{what}{ahead:.4g}",
            )
        except Stalled:
            length = 0.5 * (ahead - share)
            if length < _SMALLEST_SHARE:
                raise
            continue
        if last:
            return solved
        before = (share, here.fields)
        share, here = ahead, Start(solved.fields, solved.correction.contact.touching)
        if solved.steps <= _EASY:
            length *= _LONGER


def _extrapolate(before: tuple[float, Fields], here: tuple[float, Fields], ahead: float) -> Fields:
    """Return the fields on the line through two solutions."""
    (first, old), (second, new) = before, here
    back = new.moved(old, -1.0)
    return new.moved(back, (ahead - second) / (second - first))
