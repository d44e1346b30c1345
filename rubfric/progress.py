"""Progress of many jobs: what is done, what remains, how long that may take, what was slow or failed."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

# Kinds of jobs as the log names them, singular and plural, in the order of the log.
_WORDS = {
    "scene": ("scene", "scenes"),
    "whole_scene": ("scene of the whole road", "scenes of the whole road"),
    "areal_scene": ("scene on an areal road", "scenes on areal roads"),
    "march": ("march", "marches"),
    "refined_curve": ("refined curve", "refined curves"),
    "reading": ("batch of other readings", "batches of other readings"),
    "table": ("table", "tables"),
    "figure": ("figure", "figures"),
    "other": ("other job", "other jobs"),
}
# Kinds whose slow jobs are named, and whose last job gets a line in the log.
_LONG = ("scene", "whole_scene", "areal_scene", "march")
# The time left is estimated from so many finished jobs, and of each rule with more than this share of all jobs.
_FEWEST, _SHARE = 3, 0.1


@dataclass(frozen=True)
class Failure:
    """A job without its result: its name, and the logs with the reason."""

    name: str
    logs: tuple[str, ...]


@dataclass(frozen=True)
class _Job:
    rule: str
    name: str
    logs: tuple[str, ...]
    began: float


def kind(rule: str) -> str:
    """Return what a rule makes: scene, march, reading, table, figure or other."""
    if rule in _WORDS:
        return rule
    return next((word for word in ("table", "figure") if word in rule.split("_")), "other")


class Progress:
    """The jobs of one run.

    Parameters
    ----------
    planned : mapping of str to int
        Number of jobs of each rule that this run has to do.
    clock : callable, optional
        Returns the time, s.
    expected : callable, optional
        Takes a rule; returns how long one of its jobs takes, s, as measured before, so that the time left is known from
        the first line on.
    at_once : int
        How many jobs may run at a time; where nothing is expected the most that did.
    """

    def __init__(
        self,
        planned: Mapping[str, int],
        clock: Callable[[], float] = time.monotonic,
        expected: Callable[[str], float] | None = None,
        at_once: int = 1,
    ) -> None:
        self._planned = Counter(planned)
        self._expected, self._cores = expected, at_once
        self._clock = clock
        self._began = clock()
        self._running: dict[int, _Job] = {}
        self._most_at_once = 1
        self._seconds: dict[str, list[float]] = {}
        self._named: list[tuple[float, str]] = []
        self._failures: dict[int, Failure] = {}

    def start(self, job: int, rule: str, name: str, logs: Collection[str] = ()) -> None:
        """Note that a job has begun, for the first time or again.

        Parameters
        ----------
        job : int
            Its number in this run.
        rule, name : str
            The rule, and what the log calls the job.
        logs : collection of str
            Paths of its logs.
        """
        self._failures.pop(job, None)
        self._running[job] = _Job(rule, name, tuple(logs), self._clock())
        self._most_at_once = max(self._most_at_once, len(self._running))

    def finish(self, job: int, seconds: float | None = None) -> bool:
        """Note that a job has its result; return whether it was the last of the scenes, or of the marches.

        Parameters
        ----------
        job : int
            Its number in this run.
        seconds : float, optional
            How long it took, s; by default the time since its start was noted.
        """
        done = self._running.pop(job, None)
        if done is None:
            return False
        self._failures.pop(job, None)
        took = self._clock() - done.began if seconds is None else seconds
        self._seconds.setdefault(done.rule, []).append(took)
        what = kind(done.rule)
        if what not in _LONG:
            return False
        self._named.append((took, done.name))
        return self._count(what) == self._count(what, self._planned)

    def fail(self, job: int, logs: Collection[str] = ()) -> Failure | None:
        """Note that a job has failed, and return the failure; None where it is known already.

        Parameters
        ----------
        job : int
            Its number in this run.
        logs : collection of str
            Paths of further logs.
        """
        failed = self._running.pop(job, None)
        if failed is None:
            return None
        self._failures[job] = Failure(failed.name, tuple(dict.fromkeys([*failed.logs, *logs])))
        return self._failures[job]

    @property
    def failures(self) -> Sequence[Failure]:
        """Failures that no later attempt has made up for."""
        return list(self._failures.values())

    @property
    def logs(self) -> Mapping[int, tuple[str, ...]]:
        """The logs of the jobs that run, by number of job."""
        return {number: job.logs for number, job in self._running.items()}

    @property
    def complete(self) -> bool:
        """Whether every job that was planned has its result."""
        return sum(self.finished.values()) >= self._planned.total() > 0

    @property
    def elapsed(self) -> float:
        """Time since the run began, s."""
        return self._clock() - self._began

    @property
    def finished(self) -> Mapping[str, int]:
        """Number of finished jobs of each rule."""
        return {rule: len(seconds) for rule, seconds in self._seconds.items()}

    def slowest(self, number: int) -> list[tuple[str, float]]:
        """Return the scenes and marches that took longest, and their times in s."""
        return [(name, took) for took, name in sorted(self._named, reverse=True)[:number]]

    def remaining(self) -> float | None:
        """Return how long the rest may take, s; None as long as too few jobs are done for an estimate.

        Every job that remains is assumed to last as long as those of its rule did on average, with as many jobs at a
        time as there were so far.
        """
        if self._expected:
            return self._foreseen(self._expected)
        done = [took for seconds in self._seconds.values() for took in seconds]
        for rule, planned in self._planned.items():
            many = planned >= max(_SHARE * self._planned.total(), _FEWEST)
            if len(done) < _FEWEST or (many and len(self._seconds.get(rule, [])) < _FEWEST):
                return None
        now, work, longest = self._clock(), 0.0, 0.0
        for rule, planned in self._planned.items():
            seconds = self._seconds.get(rule, [])
            ages = [now - job.began for job in self._running.values() if job.rule == rule]
            mean = sum(seconds) / len(seconds) if seconds else max([sum(done) / len(done), *ages])
            waiting = planned - len(seconds) - len(ages)
            left = [max(mean - age, 0.0) for age in ages]
            work += max(waiting, 0) * mean + sum(left)
            longest = max([longest, *left])
        return max(work / self._most_at_once, longest)

    def _foreseen(self, expected: Callable[[str], float]) -> float:
        """Return how long the rest may take: expected times, scaled by those of the jobs that are done.

        The first jobs of a rule count little against what was expected of it; the jobs of all rules together say how
        fast this machine is.
        """
        before = sum(expected(rule) * len(seconds) for rule, seconds in self._seconds.items())
        speed = (_FEWEST + sum(map(sum, self._seconds.values()))) / (_FEWEST + before)
        now, work, longest = self._clock(), 0.0, 0.0
        for rule, planned in self._planned.items():
            seconds = self._seconds.get(rule, [])
            mean = (_FEWEST * expected(rule) * speed + sum(seconds)) / (_FEWEST + len(seconds))
            ages = [now - job.began for job in self._running.values() if job.rule == rule]
            left = [max(mean - age, 0.0) for age in ages]
            work += max(planned - len(seconds) - len(ages), 0) * mean + sum(left)
            longest = max([longest, *left])
        return max(work / max(self._most_at_once, self._cores), longest)

    def line(self) -> str:
        """Return in one line what is done, how long the rest may take, and what was slowest; empty before any job."""
        begun = {kind(rule) for rule in (*self.finished, *(job.rule for job in self._running.values()))}
        parts = [
            f"{self._count(what)} of {_amount(self._count(what, self._planned), what)}"
            for what in _WORDS
            if what in begun
        ]
        line = [", ".join(parts)] if parts else []
        left = self.remaining()
        if left is not None and sum(self.finished.values()) < self._planned.total():
            line.append(f"about {coarse(left)} left")
        if slowest := self.slowest(1):
            line.append(f"slowest {slowest[0][0]} {duration(slowest[0][1])}")
        if self._failures:
            line.append(f"{len(self._failures)} failed")
        return "; ".join(line)

    def done(self) -> str:
        """Return in words what was done: ``18 scenes, 1 march``; ``nothing`` where there is nothing."""
        return amounts(self.finished)

    def _count(self, what: str, counts: Mapping[str, int] | None = None) -> int:
        return sum(number for rule, number in (counts or self.finished).items() if kind(rule) == what)


def amounts(counts: Mapping[str, int]) -> str:
    """Return numbers of jobs by rule in words: ``18 scenes, 1 march``; ``nothing`` where there is nothing."""
    numbers = {what: sum(number for rule, number in counts.items() if kind(rule) == what) for what in _WORDS}
    return ", ".join(_amount(number, what) for what, number in numbers.items() if number) or "nothing"


def duration(seconds: float) -> str:
    """Return a time in words: 0.27 s, 16.2 s, 2 min 5 s, 3 h 20 min."""
    if seconds < 59.95:
        return f"{seconds:.1f} s" if seconds >= 0.95 else f"{seconds:.2f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    return f"{minutes // 60} h {minutes % 60} min"


def _amount(number: int, what: str) -> str:
    return f"{number} {_WORDS[what][number != 1]}"


def coarse(seconds: float) -> str:
    """Return a time as roughly as it is known."""
    if seconds < 90.0:
        return f"{max(5, 5 * round(seconds / 5.0))} s"
    minutes = math.ceil(seconds / 60.0)
    return f"{minutes} min" if minutes < 100 else f"{seconds / 3600.0:.1f} h"
