"""A short log of a run of the workflow, on the terminal and in a file: what is done, what remains, what failed.

Snakemake logs every job in blocks. ``RunLog`` is a handler of the same logger and reads its events (``LogEvent``),
which are the same for local jobs, for groups and for jobs on a cluster, and now and then writes one line on the state
of the run.
"""

from __future__ import annotations

import contextlib
import datetime
import logging
import os
import sys
import threading
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake.logging import get_event
from snakemake_interface_logger_plugins.common import LogEvent

from rubfric.runner.findings import findings
from rubfric.runner.progress import Failure, Progress, amounts, coarse, duration

# Time between two lines: a twentieth of the time so far, within these bounds, s.
_SHORTEST, _LONGEST = 5.0, 60.0
# Snakemake's events that the short log covers. "Select jobs" has no event: with other words it would be seen again.
_COVERED = {
    LogEvent.JOB_STARTED,
    LogEvent.JOB_FINISHED,
    LogEvent.PROGRESS,
    LogEvent.RESOURCES_INFO,
    LogEvent.RUN_INFO,
}
_SELECTING = "Select jobs to execute..."
_MOST_NAMED, _MOST_FAILURES = 5, 20


class RunLog(logging.Handler):
    """Follows the events of Snakemake's logger.

    Parameters
    ----------
    results : str
        Folder of the results; the log goes to ``logs/run.log`` in it.
    targets : collection of str
        Rules without output, whose jobs do not count.
    tables : iterable of str
        Tables of single scales and of totals, for errors, warnings and refusals.
    first : iterable of str
        Files to open first, the most important first; those that are missing are not named.
    dry : callable
        Returns whether this is a dry run.
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
        tables: Iterable[str] = (),
        first: Iterable[str] = (),
        dry: Callable[[], bool] = lambda: False,
        seconds: Callable[[str], float | None] = lambda log: None,
        stream: TextIO | None = sys.stderr,
        opening: Callable[[], list[str]] = list,
        expected: Callable[[str], float] | None = None,
        at_once: Callable[[], int] = lambda: 1,
        leftovers: Callable[[], list[str]] = list,
    ) -> None:
        super().__init__()
        self._results, self._path = results, Path(results) / "logs" / "run.log"
        self._targets, self._tables, self._first = frozenset(targets), list(tables), list(first)
        self._dry, self._seconds, self._stream = dry, seconds, stream
        self._opening, self._expected, self._at_once, self._leftovers = opening, expected, at_once, leftovers
        self._progress = Progress({})
        self._to_do = "To do: nothing"
        self._would: list[tuple[str, str]] = []
        self._interrupted = False
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
                    self._report([_failed(Failure("a group of jobs, or some of them", tuple(about["aux_logs"])))])
                case None if record.msg == NOTHING_TO_BE_DONE_MSG:
                    self._show(self._places())
            # Snakemake logs an interruption while it handles it, and the jobs' failures only after that.
            self._interrupted |= isinstance(sys.exception(), KeyboardInterrupt | SystemExit)
        except Exception:
            self.handleError(record)

    def begin(self) -> None:
        """Begin the log; from now on it gets a line now and then."""
        self._append([f"{_now()}  {' '.join(sys.argv)}", *(f"  {line}" for line in [*self._opening(), self._to_do])])
        self._ticker = threading.Thread(target=self._tick, name="run log", daemon=True)
        self._ticker.start()

    def succeed(self) -> None:
        """Report the outcome, and where it is."""
        self._stop()
        progress = self._progress
        self._report([f"Done in {duration(progress.elapsed)}: {progress.done()}", *self._outcome(), *self._places()])

    def fail(self) -> None:
        """Report what failed, where the reasons are, and what to do."""
        self._stop()
        progress = self._progress
        failures = [] if self._interrupted else progress.failures
        what = f"{len(failures)} failed" if failures else "interrupted"
        lines = [f"Stopped after {duration(progress.elapsed)}: {what}; done: {progress.done()}"]
        lines += [_failed(failure) for failure in failures[:_MOST_FAILURES]]
        if len(failures) > _MOST_FAILURES:
            lines.append(f"and {len(failures) - _MOST_FAILURES} more: see {self._path.parent}")
        self._report([*lines, "what is done stays; running again makes the rest"])

    def close(self) -> None:
        """End the log."""
        self._stop()
        super().close()

    def _plan(self, stats: Mapping[str, int]) -> None:
        planned = {rule: count for rule, count in stats.items() if rule != "total" and rule not in self._targets}
        if not self._dry():
            self._progress = Progress(planned, expected=self._expected, at_once=self._at_once())
            left = self._progress.remaining()
            self._to_do = f"To do: {amounts(planned)}" + (f"; about {coarse(left)}" if left else "")
            self._show([*self._opening(), self._to_do])
        elif self._would:  # the second time, at the end of a dry run, after all its jobs
            left = Progress(planned, expected=self._expected, at_once=self._at_once()).remaining()
            about = f"; in about {coarse(left)}" if left else ""
            self._show([*self._opening(), f"Would be made: {amounts(planned)}{about}", *_names(self._would)])

    def _start(self, about: Mapping[str, Any]) -> None:
        rule = about["rule_name"]
        if rule in self._targets:
            return
        name = (about["rule_msg"] or rule).partition(": ")[0]
        if self._dry():
            self._would.append((rule, name))
        else:
            self._progress.start(about["jobid"], rule, name, about["log"])

    def _finish(self, job: int) -> None:
        logs = self._progress.logs.get(job, ())
        if self._progress.finish(job, self._seconds(logs[0]) if logs else None):
            self._report([self._progress.line()])

    def _fail(self, job: int, logs: Collection[str], elsewhere: Mapping[str, Any]) -> None:
        failure = self._progress.fail(job, logs)
        if failure is None:
            return
        self._append([f"  {_failed(failure)}"])
        if elsewhere:  # of what failed here Snakemake gives the reason at once
            self._show([_failed(failure)])

    def _tick(self) -> None:
        last = ""
        while not self._over.wait(min(max(self._progress.elapsed / 20.0, _SHORTEST), _LONGEST)):
            with self.lock or contextlib.nullcontext():
                line = self._progress.line()
            if line and line != last:
                self._report([line])
            last = line

    def _stop(self) -> None:
        self._over.set()
        if self._ticker and self._ticker is not threading.current_thread():
            self._ticker.join(1.0)

    def _outcome(self) -> list[str]:
        """Return the slowest jobs, and findings of the tables where those are of this run or still valid."""
        slowest = self._progress.slowest(_MOST_NAMED)
        lines = [f"slowest: {', '.join(f'{name} {duration(took)}' for name, took in slowest)}"] if slowest else []
        finished = self._progress.finished
        made = {"scale_table", "total_table"} & set(finished)
        if made or "scene" not in finished:
            lines += findings(self._tables)
        return [*lines, *(self._leftovers() if made else [])]

    def _places(self) -> list[str]:
        first = [path for path in self._first if os.path.exists(path)]
        opened = [f"open first: {', '.join(first)}"] if first else []
        folder = self._results
        return [*opened, f"tables are in {folder}/tables, figures in {folder}/figures, fields in {folder}/scenes"]

    def _report(self, lines: Sequence[str]) -> None:
        self._show(lines)
        self._append([f"  {line}" for line in lines])

    def _show(self, lines: Iterable[str]) -> None:
        if self._stream is not None:
            with contextlib.suppress(OSError, ValueError):  # a terminal that is gone
                self._stream.write("".join(f"  {line}\n" for line in lines))
                self._stream.flush()

    def _append(self, lines: Iterable[str]) -> None:
        with contextlib.suppress(OSError):  # the jobs report a full disk
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with self._path.open("a", encoding="utf-8") as stream:
                stream.write("".join(f"{line}\n" for line in lines))


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


def _now() -> str:
    return datetime.datetime.now().astimezone().isoformat(" ", "seconds")
