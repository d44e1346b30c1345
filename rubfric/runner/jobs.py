"""Workflow jobs in worker processes, forked from a server that has imported everything they need.

Importing the scientific stack takes longer than a scene. A fork server imports it once, when the workflow starts;
workers are forks of it, as many as there are jobs at a time. A crash, a kill or an exception fails its own job and
costs one worker; the next job gets a new one.
"""

from __future__ import annotations

import contextlib
import io
import os
import runpy
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rubfric.errors import RubfricError
from rubfric.files import why_not
from rubfric.runner import times
from rubfric.workers import Worker, hire, start_server

_WARM = "rubfric.runner.warm"
_LOCK = threading.Lock()
_IDLE: list[Worker] = []
_SECONDS: dict[str, float] = {}


class JobFailed(RubfricError, RuntimeError):
    """A job that ended without its result; the message gives the reason and the path of the log."""


def warm_up() -> None:
    """Start the server; returns at once, while it imports."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    start_server(_WARM)


def run(script: str, log: str, **arguments: Any) -> None:
    """Run ``main(**arguments)`` of a script in a fork of the server and wait for it.

    Parameters
    ----------
    script : str
        Path of a Python file that defines ``main``.
    log : str
        File that receives what the job prints, and its traceback.
    **arguments
        Keyword arguments of ``main``; plain values that can be pickled.

    Raises
    ------
    JobFailed
        Where ``main`` raised or its process died.
    """
    worker = _begin((script, log, arguments))
    began = time.monotonic()
    try:
        failure = worker.connection.recv()
    except (EOFError, OSError):
        failure = worker.last_words()
    if failure:
        worker.connection.close()
        raise JobFailed(f"{failure} (log: {log})")
    with _LOCK:
        _IDLE.append(worker)
        _SECONDS[log] = time.monotonic() - began


def seconds(log: str) -> float | None:
    """Return how long the job with this log took, s, without the wait for its process; None for an unknown job."""
    return _SECONDS.get(log)


def _begin(job: tuple[str, str, dict[str, Any]]) -> Worker:
    """Send a job to a worker and return it once the job has begun; skip workers that died idle."""
    while True:
        worker, fresh = _hire()
        try:
            worker.begin(_work, *job)
        except (EOFError, OSError) as error:
            worker.connection.close()
            if fresh:
                raise JobFailed(f"no process could be started for the job (log: {job[1]})") from error
        else:
            return worker


def _hire() -> tuple[Worker, bool]:
    """Return an idle worker or a new one, and whether it is new."""
    warm_up()
    with _LOCK:
        return (_IDLE.pop(), False) if _IDLE else (hire(_WARM), True)


def _work(script: str, log: str, arguments: dict[str, Any]) -> str | None:
    """Run one job with all output in its log; return the reason why it failed, or None."""
    try:
        _redirect(log)
        with times.clock():
            main: Callable[..., None] = runpy.run_path(script)["main"]
            main(**arguments)
        sys.stdout.flush()
    except Exception as error:
        with contextlib.suppress(OSError):  # on a full disk
            traceback.print_exc()
        place = getattr(error, "filename", None) or log
        known = why_not(place, error) if isinstance(error, OSError) else error
        return f"{type(known).__name__}: {known}"
    finally:
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError):
                stream.flush()
    return None


def _redirect(log: str) -> None:
    """Send all output of this process to a file, line by line: the output of a job that is killed is kept."""
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    with open(log, "w", encoding="utf-8") as stream:
        for descriptor in (1, 2):
            os.dup2(stream.fileno(), descriptor)
    files = (io.BufferedWriter(io.FileIO(number, "w", closefd=False)) for number in (1, 2))
    sys.stdout, sys.stderr = (io.TextIOWrapper(each, encoding="utf-8", line_buffering=True) for each in files)
