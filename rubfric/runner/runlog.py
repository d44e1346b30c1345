"""A short log of a run of the workflow, on the terminal and in a file: what is done, what remains, what failed.

Snakemake logs every job in blocks. ``RunLog`` is a handler of the same logger and reads its events (``LogEvent``),
which are the same for local jobs, for groups and for jobs on a cluster, and now and then writes one line on the state
of the run.
"""

from __future__ import annotations

import contextlib
import datetime
import logging
import sys
import threading
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake.logging import get_event
from snakemake_interface_logger_plugins.common import LogEvent

from rubfric.errors import NotWritten
from rubfric.progress import Failure, Progress, amounts, coarse, duration
from rubfric.runner.findings import findings
from rubfric.runner.lines import Lines
from rubfric.runner.made import Made
from rubfric.runner.times import record, shares
from rubfric.streams import pause

# Snakemake's events that the short log covers. "Select jobs" has no event: with other words it would be seen again.
_COVERED = {
    LogEvent.JOB_STARTED,
    LogEvent.JOB_FINISHED,
    LogEvent.PROGRESS,
    LogEvent.RESOURCES_INFO,
    LogEvent.RUN_INFO,
}
_SELECTING = "Select jobs to execute..."
# Without the profile of the workflow, as within a module.
_SLOW = "each job starts a Snakemake of its own, which takes seconds: --force-use-threads does without"
_MOST_NAMED, _MOST_FAILURES = 5, 20
# Kinds of jobs with a smaller share of the CPU time are not named.
_LEAST_SHARE = 0.02


class RunLog(logging.Handler):
    """Follows the events of Snakemake's logger.

    Parameters
    ----------
    results : str
        Folder of the results; the log goes to ``logs/run.log`` in it.
    targets : collection of str
        Rules without output, whose jobs do not count.
    rules : mapping of str to str, optional
        The names of the workflow's own rules by those they have in the run, where it is a module of another one; jobs
        of other rules do not count. By default every rule has its own name.
    tables : iterable of str
        Tables of single scales and of totals, for errors, warnings and refusals.
    first : iterable of str
        Files to open first, the most important first; those that are missing are not named.
    dry, touch, threads : callable
        Return whether this is a dry run, whether files are only marked as up to date, and whether jobs run as threads.
    seconds : callable
        Takes the path of a job's log; returns how long the job took, s, or None where that is not known.
    stream : text file or None
        Where the lines go beside the file; None for nowhere.
    opening : callable
        Returns the lines that come first: what is understood of the config.
    expected : callable, optional
        Takes a rule; returns how long one of its jobs takes, s.
    at_once : callable
        Returns how many jobs may run at a time.
    leftovers : callable
        Removes what an earlier config made and this one does not, once tables are made; returns what to say of it.
    """

    def __init__(
        self,
        results: str,
        *,
        targets: Collection[str] = (),
        rules: Mapping[str, str] | None = None,
        tables: Iterable[str] = (),
        first: Iterable[str] = (),
        dry: Callable[[], bool] = lambda: False,
        touch: Callable[[], bool] = lambda: False,
        threads: Callable[[], bool] = lambda: True,
        seconds: Callable[[str], float | None] = lambda log: None,
        stream: TextIO | None = sys.stderr,
        opening: Callable[[], list[str]] = list,
        expected: Callable[[str], float] | None = None,
        at_once: Callable[[], int] = lambda: 1,
        leftovers: Callable[[], list[str]] = list,
    ) -> None:
        super().__init__()
        path = Path(results) / "logs" / "run.log"
        self._folder, self._targets, self._rules, self._seconds = path.parent, frozenset(targets), rules, seconds
        self._dry, self._touch, self._threads = dry, touch, threads
        self._opening, self._expected, self._at_once, self._leftovers = opening, expected, at_once, leftovers
        self._progress = Progress({})
        self._to_do = "To do: nothing"
        self._would: list[tuple[str, str]] = []
        self._lines, self._made = Lines(path, stream), Made(results, tables, first)
        self._interrupted = self._begun = self._reported = False
        self._over = threading.Event()
        self._ticker: threading.Thread | None = None

    def emit(self, record: logging.LogRecord) -> None:
        """Take note of one record; no error in here stops the run."""
        about = record.__dict__
        try:
            match get_event(record):
                case LogEvent.RUN_INFO:
                    self._plan(about["stats"])
                case LogEvent.JOB_INFO:
                    self._start(about)
                case LogEvent.JOB_FINISHED:
                    self._finish(about["job_id"])
                case LogEvent.JOB_ERROR:
                    self._fail(about["jobid"], about["log"], about["aux"])
                case LogEvent.GROUP_ERROR:
                    self._lines.report([_failed(Failure("a group of jobs, or some of them", tuple(about["aux_logs"])))])
                case None if record.msg == NOTHING_TO_BE_DONE_MSG:
                    self._lines.show(self._made.places())
            # Snakemake logs an interruption while it handles it, and the jobs' failures only after that.
            self._interrupted |= isinstance(sys.exception(), KeyboardInterrupt | SystemExit)
        except Exception:
            self.handleError(record)

    def begin(self) -> None:
        """Begin the log, if it has not begun; from now on it gets a line now and then."""
        if self._begun:
            return
        self._begun = True
        self._lines.append(
            [f"{_now()}  {' '.join(sys.argv)}", *(f"  {line}" for line in [*self._opening(), self._to_do])]
        )
        self._ticker = threading.Thread(target=self._tick, name="run log", daemon=True)
        self._ticker.start()

    def succeed(self) -> None:
        """Report the outcome, and where it is, if that was not reported yet."""
        if not self._end():
            return
        progress = self._progress
        if self._touch():
            self._lines.report(
                [
                    f"Nothing was computed: {progress.done()} marked as up to date (--touch), whatever config and code "
                    "they were made with"
                ]
            )
            return
        self._lines.report(
            [f"Done in {duration(progress.elapsed)}: {progress.done()}", *self._outcome(), *self._made.places()]
        )

    def fail(self) -> None:
        """Report what failed, where the reasons are, and what to do, if no outcome was reported yet."""
        if not self._end():
            return
        progress = self._progress
        failures = [] if self._interrupted else progress.failures
        what = "interrupted" if self._interrupted else "Snakemake gives the reason"
        what = f"{len(failures)} failed" if failures else what
        lines = [f"Stopped after {duration(progress.elapsed)}: {what}; done: {progress.done()}"]
        lines += [_failed(failure) for failure in failures[:_MOST_FAILURES]]
        if len(failures) > _MOST_FAILURES:
            lines.append(f"and {len(failures) - _MOST_FAILURES} more: see {self._folder}")
        self._lines.report([*lines, "what is done stays; running again makes the rest"])

    def close(self) -> None:
        """End the log; a run that has begun and reported no outcome, as within a module, has failed."""
        if self._begun:
            self.fail()
        self._stop()
        super().close()

    def _plan(self, stats: Mapping[str, int]) -> None:
        own = {name: count for rule, count in stats.items() if rule != "total" and (name := self._own(rule))}
        planned = {rule: count for rule, count in own.items() if rule not in self._targets}
        self._made.everything = "all" in own
        if not own:
            return
        if not self._dry():
            self._progress = Progress(planned, expected=self._expected, at_once=self._at_once())
            left = None if self._touch() else self._progress.remaining()
            do = "To mark" if self._touch() else "To do"
            self._to_do = f"{do}: {amounts(planned)}" + (f"; about {coarse(left)}" if left else "")
            slow = not (self._threads() or self._touch())
            self._lines.show([*self._opening(), self._to_do, *([_SLOW] if slow else [])])
        elif self._would:  # the second time, at the end of a dry run, after all its jobs
            left = Progress(planned, expected=self._expected, at_once=self._at_once()).remaining()
            about = f"; in about {coarse(left)}" if left else ""
            self._lines.show([*self._opening(), f"Would be made: {amounts(planned)}{about}", *_names(self._would)])

    def _start(self, about: Mapping[str, Any]) -> None:
        rule = self._own(about["rule_name"])
        if not rule or rule in self._targets:
            return
        name = (about["rule_msg"] or rule).partition(": ")[0]
        if self._dry():
            self._would.append((rule, name))
        else:
            self.begin()
            self._made.start(about["jobid"], about["output"])
            self._progress.start(about["jobid"], rule, name, about["log"])

    def _finish(self, job: int) -> None:
        logs = self._progress.logs.get(job, ())
        self._made.finish(job)
        last_of_kind = self._progress.finish(job, self._seconds(logs[0]) if logs else None)
        if last_of_kind and not self._touch():
            self._lines.report([self._progress.line()])
        if self._progress.complete:
            self.succeed()

    def _fail(self, job: int, logs: Collection[str], elsewhere: Mapping[str, Any]) -> None:
        failure = self._progress.fail(job, logs)
        if failure is None:
            return
        self._lines.append([f"  {_failed(failure)}"])
        if elsewhere:  # of what failed here Snakemake gives the reason at once
            self._lines.show([_failed(failure)])

    def _tick(self) -> None:
        last = ""
        while not self._over.wait(pause(self._progress.elapsed)):
            with self.lock or contextlib.nullcontext():
                line = self._progress.line()
            if line and line != last and not self._touch():
                self._lines.report([line])
            last = line

    def _stop(self) -> None:
        self._over.set()
        if self._ticker and self._ticker is not threading.current_thread():
            self._ticker.join(1.0)

    def _end(self) -> bool:
        """Stop; return whether the outcome is still to be reported."""
        self._stop()
        first, self._reported = not self._reported, True
        return first

    def _own(self, rule: str) -> str | None:
        """Return the name of one of the workflow's own rules, or None for another one."""
        return rule if self._rules is None else self._rules.get(rule)

    def _outcome(self) -> list[str]:
        """Return the slowest jobs, and findings of the tables."""
        slowest = self._progress.slowest(_MOST_NAMED)
        lines = [f"slowest: {', '.join(f'{name} {duration(took)}' for name, took in slowest)}"] if slowest else []
        with contextlib.suppress(NotWritten):  # on a full disk
            cost = shares(record(self._folder))
            total = sum(seconds for _, seconds, _ in cost.values())
            lines += [f"CPU time behind these results {duration(total)}: {_parts(cost)}"] if total else []
        lines += findings(self._made.tables())
        return [
            *lines,
            *(
                self._leftovers()
                if {"scale_table", "total_table", "curve_table"} & set(self._progress.finished)
                else []
            ),
        ]


def attach(run: RunLog, logger: logging.Logger, *, silence: bool) -> None:
    """Let a run log follow a logger.

    Parameters
    ----------
    run : RunLog
        The new handler of the logger.
    logger : logging.Logger
        Snakemake's.
    silence : bool
        Whether the logger's other handlers leave out the events that the short log covers.
    """
    if silence:
        for handler in logger.handlers:
            handler.addFilter(lambda record: get_event(record) not in _COVERED and record.msg != _SELECTING)
    logger.addHandler(run)


def _failed(failure: Failure) -> str:
    logs = f" (log: {', '.join(failure.logs)})" if failure.logs else ""
    return f"failed: {failure.name}{logs}"


def _names(would: Sequence[tuple[str, str]]) -> list[str]:
    """Return the first jobs of each rule by name, a line for each rule."""
    lines = []
    for rule in dict.fromkeys(rule for rule, _ in would):
        names = [name for other, name in would if other == rule]
        more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
        lines.append(f"  {rule}: {', '.join(names[:_MOST_NAMED])}{more}")
    return lines


def _parts(cost: Mapping[str, tuple[int, float, float]]) -> str:
    """Return what shares of the CPU time went into the kinds of jobs that took most of it."""
    named = [f"{kind} {share:.0%}" for kind, (_, _, share) in cost.items() if share >= _LEAST_SHARE]
    return f"{', '.join(named)} (of each job: logs/times.csv)"


def _now() -> str:
    return datetime.datetime.now().astimezone().isoformat(" ", "seconds")
