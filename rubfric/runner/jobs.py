"""Workflow jobs in worker processes, forked from a server that has imported everything they need.

Importing the scientific stack takes longer than a scene. A fork server imports it once, when the workflow starts;
workers are forks of it, as many as there are jobs at a time. A crash, a kill or an exception fails its own job and
costs one worker; the next job gets a new one.
"""

from __future__ import annotations

import contextlib
import io
import multiprocessing
import os
import runpy
import signal
import sys
import threading
import time
import traceback
import types
from collections.abc import Callable, Iterator
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any, NamedTuple

from rubfric.errors import RubfricError
from rubfric.files import why_not
from rubfric.runner import times

# One thread each: the systems are small, and jobs run side by side.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_LOCK = threading.Lock()
_IDLE: list[Worker] = []
_SECONDS: dict[str, float] = {}
# How long to wait for the exit status of a process that has ended, s.
_PATIENCE = 5.0


class Worker(NamedTuple):
    """A process that runs jobs one by one, and the connection to it."""

    connection: Connection
    process: BaseProcess

    def last_words(self) -> str:
        """Return how the process ended that has not said why."""
        self.process.join(_PATIENCE)
        status = self.process.exitcode
        if status is not None and status >= 0:
            return (
                f"the job's process ended with exit status {status} before it could say why; this is an error of the "
                "program: report it, with the log"
            )
        return (
            "the job's process died before it could say why; most likely it was killed, perhaps for lack of memory: "
            "run again, with fewer jobs at a time (-j1) if it happens again"
        )


class JobFailed(RubfricError, RuntimeError):
    """A job that ended without its result; the message gives the reason and the path of the log."""


def warm_up() -> None:
    """Start the server; returns at once, while it imports."""
    _open_standard_files()
    for name in _ONE_THREAD:
        os.environ[name] = "1"
    os.environ.setdefault("MPLBACKEND", "Agg")
    multiprocessing.set_forkserver_preload(["rubfric.runner.warm"])
    forkserver.ensure_running()


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
            worker.connection.send(job)
            worker.connection.recv()
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
        if _IDLE:
            return _IDLE.pop(), False
        context = multiprocessing.get_context("forkserver")
        ours, theirs = context.Pipe()
        with _hidden_main():
            process = context.Process(target=_serve, args=(theirs,), daemon=True)
            process.start()
    theirs.close()
    return Worker(ours, process), True


def _open_standard_files() -> None:
    """Open what the caller has closed of standard input, output and error, lest other files take their numbers."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # takes the lowest number that is free


@contextlib.contextmanager
def _hidden_main() -> Iterator[None]:
    """Hide the main module, here all of Snakemake: a new process would import it again without need."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def _serve(connection: Connection) -> None:
    """Run the jobs that arrive, one by one, until the caller closes the connection."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    with contextlib.suppress(EOFError):
        while True:
            script, log, arguments = connection.recv()
            connection.send("begun")
            connection.send(_work(script, log, arguments))


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
