"""A short log of a run of the workflow, on the terminal and in a file: what is done, what remains, what failed.

Snakemake tells of every job in blocks. This follows the same records, which speak of local jobs, of groups and of jobs
on a cluster alike, and says now and then in one line where the run stands.
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

from rubfric.runner.findings import findings
from rubfric.runner.progress import Failure, Progress, amounts, duration

# Time between two lines: a twentieth of the time so far, within these bounds, s.
_SHORTEST, _LONGEST = 5.0, 60.0
# What Snakemake says for every job or at length, and this says in short.
_CHATTER = ("Select jobs to execute...", "Execute ")
_TOLD_IN_SHORT = ("JOB_FINISHED", "PROGRESS", "RESOURCES_INFO", "RUN_INFO")
_UP_TO_DATE, _INTERRUPTED = "Nothing to be done", "Terminating processes on user request"
_MOST_NAMED, _MOST_FAILURES = 5, 20


class RunLog(logging.Handler):
    """Follows the records of Snakemake's logger.

    Parameters
    ----------
    results : str
        Folder of the results; the log goes to ``logs/run.log`` in it.
    targets : collection of str
        Rules that make nothing, whose jobs do not count.
    tables : iterable of str
        Tables of single scales, for errors and warnings.
    first : iterable of str
        Files to open first, the most telling first; those that are missing are not named.
    dry : callable
        Returns whether nothing is to be run.
    seconds : callable
        Returns how long the job with a log took, s, or None where that is not known.
    stream : text file or None
        Where the lines go beside the file; None for nowhere.
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
    ) -> None:
        super().__init__()
        self._results, self._path = results, Path(results) / "logs" / "run.log"
        self._targets, self._tables, self._first = frozenset(targets), list(tables), list(first)
        self._dry, self._seconds, self._stream = dry, seconds, stream
        self._progress = Progress({})
        self._would: list[tuple[str, str]] = []
        self._interrupted = False
        self._over = threading.Event()
        self._ticker: threading.Thread | None = None

    def emit(self, record: logging.LogRecord) -> None:
        """Take note of one record; none of them may stop the run."""
        event, about = _event(record), record.__dict__
        try:
            if event == "RUN_INFO":
                self._plan(about["stats"])
            elif event == "JOB_INFO":
                self._start(about)
            elif event == "JOB_FINISHED":
                self._finish(about["job_id"])
            elif event == "JOB_ERROR":
                self._fail(about["jobid"], about["log"], about["aux"])
            elif event == "GROUP_ERROR":
                self._tell([_failed(Failure("a group of jobs, or some of them", tuple(about["aux_logs"])))])
            elif not event and isinstance(record.msg, str):
                self._interrupted |= record.msg.startswith(_INTERRUPTED)
                self._say(self._places() if record.msg.startswith(_UP_TO_DATE) else [])
        except Exception:
            self.handleError(record)

    def begin(self) -> None:
        """Begin to tell: from now on a line now and then."""
        self._keep([f"{_now()}  {' '.join(sys.argv)}"])
        self._ticker = threading.Thread(target=self._tick, name="run log", daemon=True)
        self._ticker.start()

    def succeed(self) -> None:
        """Tell what came out, and where it is."""
        self._stop()
        progress = self._progress
        self._tell([f"Done in {duration(progress.elapsed)}: {progress.done()}", *self._came_out(), *self._places()])

    def fail(self) -> None:
        """Tell what failed, where the reasons are, and what to do."""
        self._stop()
        progress = self._progress
        failures = [] if self._interrupted else progress.failures
        what = f"{len(failures)} failed" if failures else "interrupted"
        told = [f"Stopped after {duration(progress.elapsed)}: {what}; done: {progress.done()}"]
        told += [_failed(failure) for failure in failures[:_MOST_FAILURES]]
        if len(failures) > _MOST_FAILURES:
            told.append(f"and {len(failures) - _MOST_FAILURES} more: see {self._path.parent}")
        self._tell([*told, "what is done stays; running again makes the rest"])

    def close(self) -> None:
        """Stop telling."""
        self._stop()
        super().close()

    def _plan(self, stats: Mapping[str, int]) -> None:
        planned = {rule: count for rule, count in stats.items() if rule != "total" and rule not in self._targets}
        if not self._dry():
            self._progress = Progress(planned)
            self._say([f"To do: {amounts(planned)}"])
        elif self._would:  # told a second time at the end of a dry run, after all its jobs
            self._say([f"Would be made: {amounts(planned)}", *_names(self._would)])

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
            self._tell([self._progress.line()])

    def _fail(self, job: int, logs: Collection[str], elsewhere: Mapping[str, Any]) -> None:
        failure = self._progress.fail(job, logs)
        if failure is None:
            return
        self._keep([f"  {_failed(failure)}"])
        if elsewhere:  # of what failed here Snakemake gives the reason at once
            self._say([_failed(failure)])

    def _tick(self) -> None:
        said = ""
        while not self._over.wait(min(max(self._progress.elapsed / 20.0, _SHORTEST), _LONGEST)):
            with self.lock or contextlib.nullcontext():
                line = self._progress.line()
            if line and line != said:
                self._tell([line])
            said = line

    def _stop(self) -> None:
        self._over.set()
        if self._ticker and self._ticker is not threading.current_thread():
            self._ticker.join(1.0)

    def _came_out(self) -> list[str]:
        """Return what was slow, and what the tables say, where they are of this run or still hold."""
        slowest = self._progress.slowest(_MOST_NAMED)
        told = [f"slowest: {', '.join(f'{name} {duration(took)}' for name, took in slowest)}"] if slowest else []
        finished = self._progress.finished
        if "scale_table" in finished or "scene" not in finished:
            told += findings(self._tables)
        return told

    def _places(self) -> list[str]:
        first = [path for path in self._first if os.path.exists(path)]
        opened = [f"open first: {', '.join(first)}"] if first else []
        folder = self._results
        return [*opened, f"tables are in {folder}/tables, figures in {folder}/figures, fields in {folder}/scenes"]

    def _tell(self, lines: Sequence[str]) -> None:
        self._say(lines)
        self._keep([f"  {line}" for line in lines])

    def _say(self, lines: Iterable[str]) -> None:
        if self._stream is not None:
            with contextlib.suppress(OSError, ValueError):  # a terminal that is gone
                self._stream.write("".join(f"  {line}\n" for line in lines))
                self._stream.flush()

    def _keep(self, lines: Iterable[str]) -> None:
        with contextlib.suppress(OSError):  # a full disk is for the jobs to tell
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with self._path.open("a", encoding="utf-8") as stream:
                stream.write("".join(f"{line}\n" for line in lines))


def attach(run: RunLog, logger: logging.Logger, *, silence: bool) -> None:
    """Let ``run`` follow a logger; ``silence`` keeps what it tells in short from the logger's other handlers."""
    if silence:
        for handler in logger.handlers:
            handler.addFilter(_is_news)
    logger.addHandler(run)


def _is_news(record: logging.LogRecord) -> bool:
    chatter = isinstance(record.msg, str) and record.msg.startswith(_CHATTER)
    return not chatter and _event(record) not in _TOLD_IN_SHORT


def _event(record: logging.LogRecord) -> str:
    """Return the name of what a record of Snakemake's tells of; nothing for plain text."""
    return getattr(getattr(record, "event", None), "name", "")


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
