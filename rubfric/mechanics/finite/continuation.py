"""Ways to a solution in finite strain: at once, along a growing road, along a growing load; recorded as they are tried.

Newton's method finds most contacts on one wave from the block pressed on a flat road. Where it stalls, the road is
raised from flat to its height in steps that adapt, each starting from the last two. If that stalls as well, the road is
raised under a light load, and then the load. On many waves that is the way at once: under a heavy load the finest of
them cannot be raised. A step is made so short that the fields that it starts from are near to a solution.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from rubfric.arrays import Flags
from rubfric.errors import NotConverged
from rubfric.mechanics.finite.block import Fields
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Load, SlidingContact
from rubfric.mechanics.finite.newton import Solved, Stalled, newton, starting_distance
from rubfric.road.road import finest_waves

# What is solved on the way needs to be near, not exact: to this residual, and to this share of that of its start, lest
# the line through two solutions near each other be one through their errors.
ON_THE_WAY, _GAIN, _NEAR_ENOUGH = 3e-3, 0.05, 1e-4
_FIRST_SHARE = 0.5
# Shorter steps are not tried: on many waves, where each costs seconds, fewer of them.
_SMALLEST_SHARE, _SMALLEST_SHARE_MANY = 1e-3, 1e-2
# Newton's method starts no farther from a solution on the way, if a step of this share of the one wished for does it.
_NEAR, _SHORTEST = 0.2, 0.05
# A step on the way that took at most so many Newton steps is followed by a longer one.
_EASY, _LONGER = 5, 1.6
# The load from which the way along the load begins, over the load asked for.
_LIGHT = 0.1
# Work after which a scene is given up, in applications of the tangent times cells, in layers those that are worked out:
# some fifteen seconds on one wave. A Newton step costs as much as so many applications, and each of them as much as the
# arithmetic of so many cells.
_MOST_WORK, _MOST_WORK_MANY, _PER_STEP, _PER_APPLICATION = 3.0e7, 1.5e8, 10, 5000

_SPENT = "a scene has only so much work, and this one has had it"
_HELPS = "a lighter load or a less steep road is easier; other meshes may do"


@dataclass(frozen=True)
class Start:
    """Fields to start from, and a first guess of the contact nodes."""

    fields: Fields
    touching: Flags


# A solution on the way, and the share at which it is one.
_Point = tuple[float, Fields]


class AttemptLog:
    """What was tried, in order: one line each."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.steps = 0
        self.krylov = 0
        self.work = 0.0
        self._last = "no solution was found on the way"

    @property
    def measured(self) -> str:
        """What the last solution on the way was, and what may help: the advice of a refusal."""
        return f"{self._last}; {_HELPS}"

    def _count(self, problem: SlidingContact, steps: int, krylov: int) -> None:
        self.steps += steps
        self.krylov += krylov
        rows, columns = problem.finite.shape
        applications = krylov + _PER_STEP * (steps + 1)
        self.work += applications * (rows * columns + _PER_APPLICATION)

    def solved(self, problem: SlidingContact, what: str, solved: Solved) -> None:
        """Record a success.

        Parameters
        ----------
        problem : SlidingContact
        what : str
            Name of the attempt in the log.
        solved : Solved
        """
        self._count(problem, solved.steps, solved.krylov)
        self.lines.append(f"{what}: converged in {solved.steps} Newton steps, {solved.krylov} Krylov iterations")
        smallest = float(solved.fields.volume.min())
        self._last = f"the last solution on the way was at {what}, its smallest volume ratio {smallest:.2g}"

    def left(self, problem: SlidingContact, what: str, stalled: Stalled) -> None:
        """Record a failure.

        Parameters
        ----------
        problem : SlidingContact
        what : str
            Name of the attempt in the log.
        stalled : Stalled
        """
        self._count(problem, stalled.steps, stalled.krylov)
        self.lines.append(f"{what}: left after {stalled.steps} Newton steps, {stalled.reason}")

    def require_work_left(self, problem: SlidingContact, load: Load, residual: float, what: str) -> None:
        """Refuse to go on where a scene has had all the work that it may have.

        Parameters
        ----------
        problem : SlidingContact
        load : Load
        residual : float
            Of the last attempt.
        what : str
            Name of that attempt in the log.

        Raises
        ------
        NotConverged
        """
        if self.work > (_MOST_WORK if finest_waves(load.road) == 1 else _MOST_WORK_MANY):
            measure = f"distance from balance and contact, over the road's amplitude, at last ({what})"
            raise NotConverged(problem.label, self.steps, residual, measure, f"{_SPENT}: {self.measured}")


def reach(problem: SlidingContact, flat: Start, load: Load, tolerance: float, log: AttemptLog) -> Solved:
    """Solve the contact from a block pressed on a flat road.

    Parameters
    ----------
    problem : SlidingContact
    flat : Start
        The solution on a flat road.
    load : Load
    tolerance : float
        As for ``newton``.
    log : AttemptLog
        Gets a line for every attempt.

    Raises
    ------
    NotConverged
        Where every way stalls.
    """
    columns = problem.finite.block.columns
    way = Way(problem, tolerance, log)
    rise = f"{columns} columns, road at "
    if finest_waves(load.road) == 1:
        try:
            return attempt(problem, flat, load, tolerance, log, f"{columns} columns, at once")
        except Stalled:
            pass
        try:
            return way.follow(flat, lambda share: replace(load, share=share), rise)
        except Stalled:
            pass
    light = replace(load, pressure=_LIGHT * load.pressure)
    try:
        start = Start(problem.finite.pressed(light.pressure), flat.touching)
        first = way.follow(start, lambda share: replace(light, share=share), rise, last=ON_THE_WAY)
        return way.follow(
            Start(first.fields, first.correction.contact.touching),
            lambda share: replace(load, pressure=_LIGHT ** (1.0 - share) * load.pressure),
            f"{columns} columns, load at ",
        )
    except Stalled as stalled:
        raise NotConverged(
            problem.label,
            log.steps,
            stalled.residual,
            "distance from balance and contact, over the road's amplitude,",
            f"every way to a solution stalls: {log.measured}",
        ) from stalled


def attempt(problem: SlidingContact, start: Start, load: Load, tolerance: float, log: AttemptLog, what: str) -> Solved:
    """Run Newton's method once and record how it went.

    Parameters
    ----------
    problem : SlidingContact
    start : Start
    load : Load
    tolerance : float
        As for ``newton``.
    log : AttemptLog
        Gets a line for every attempt.
    what : str
        Name of the attempt in the log.

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
        log.left(problem, what, stalled)
        log.require_work_left(problem, load, stalled.residual, what)
        raise
    log.solved(problem, what, solved)
    return solved


class Way:
    """A way from one solution to another.

    Parameters
    ----------
    problem : SlidingContact
    tolerance : float
        As for ``newton``, at the end of the way.
    log : AttemptLog
        Gets a line for every attempt.
    """

    def __init__(self, problem: SlidingContact, tolerance: float, log: AttemptLog) -> None:
        self._problem, self._tolerance, self._log = problem, tolerance, log

    def follow(self, start: Start, loads: Callable[[float], Load], what: str, last: float | None = None) -> Solved:
        """Follow loads(share) from share 0 to 1.

        Parameters
        ----------
        start : Start
            Near the solution at share 0.
        loads : callable
            Takes a share to a load.
        what : str
            Name of the attempts in the log, to which the share is added.
        last : float, optional
            Tolerance at the end, instead of that of the way.

        Raises
        ------
        Stalled
            Where steps become too short.
        """
        share, length = 0.0, _FIRST_SHARE
        smallest = _SMALLEST_SHARE if finest_waves(loads(1.0).road) == 1 else _SMALLEST_SHARE_MANY
        here, before = start, None
        while True:
            ahead, distance = self._near(before, (share, here), min(1.0, share + length), loads)
            guess = _extrapolate(before, (share, here.fields), ahead)
            tolerance = max(min(ON_THE_WAY, _GAIN * distance), _NEAR_ENOUGH)
            if ahead == 1.0:
                tolerance = self._tolerance if last is None else last
            try:
                begun = Start(guess, here.touching)
                solved = attempt(self._problem, begun, loads(ahead), tolerance, self._log, f"{what}{ahead:.4g}")
            except Stalled:
                length = 0.5 * (ahead - share)
                if length < smallest:
                    raise
                continue
            if ahead == 1.0:
                return solved
            self._log.require_work_left(self._problem, loads(ahead), solved.residuals[-1], f"{what}{ahead:.4g}")
            before, length = (share, here.fields), ahead - share
            share, here = ahead, Start(solved.fields, solved.correction.contact.touching)
            if solved.steps <= _EASY:
                length *= _LONGER

    def _near(
        self, before: _Point | None, here: tuple[float, Start], ahead: float, loads: Callable[[float], Load]
    ) -> tuple[float, float]:
        """Return a share up to ``ahead`` at which extrapolated fields are near a solution, and how far from T of it."""
        share, (fields, touching) = here[0], (here[1].fields, here[1].touching)
        shortest = share + max(_SHORTEST * (ahead - share), _SMALLEST_SHARE)
        circulant: Circulant | None = None
        while True:
            guess = _extrapolate(before, (share, fields), ahead)
            distance, circulant = starting_distance(self._problem, guess, loads(ahead), touching, circulant)
            if distance <= _NEAR or ahead <= shortest:
                return ahead, distance
            ahead = share + (ahead - share) * min(max(_NEAR / distance, 0.4), 0.8)


def _extrapolate(before: _Point | None, here: _Point, ahead: float) -> Fields:
    """Return the fields on the line through two solutions; the last one where there is no other."""
    if before is None:
        return here[1]
    (first, old), (second, new) = before, here
    back = new.moved(old, -1.0)
    return new.moved(back, (ahead - second) / (second - first))
