"""Workflow jobs in worker processes, forked from a server that has imported everything they need.

Importing the scientific stack takes longer than a scene. A fork server imports it once, when the workflow starts;
workers are forks of it, as many as there are jobs at a time. A crash, a kill or an exception fails its own job and
costs one worker; the next job gets a new one.
"""

from __future__ import annotations

import contextlib
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
from pathlib import Path
from typing import IO, Any

from rubfric.errors import RubfricError
from rubfric.files import why_not
from rubfric.streams import occupy_standard_descriptors

# One thread each: the systems are small, and jobs run side by side.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_LOCK = threading.Lock()
_IDLE: list[Connection] = []
_SECONDS: dict[str, float] = {}


class JobFailed(RubfricError, RuntimeError):
    """A job that ended without its result; the message gives the reason and the path of the log."""


def warm_up() -> None:
    """Start the server; returns at once, while it imports."""
    occupy_standard_descriptors()
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
        failure = worker.recv()
    except (EOFError, OSError):
        failure = (
            "the job's process died before it could say why; most likely it was killed, perhaps for lack of memory: "
            "run again, with fewer jobs at a time (-j1) if it happens again"
        )
    if failure:
        worker.close()
        raise JobFailed(f"{failure} (log: {log})")
    with _LOCK:
        _IDLE.append(worker)
        _SECONDS[log] = time.monotonic() - began


def seconds(log: str) -> float | None:
    """Return how long the job with this log took, s, without the wait for its process; None for an unknown job."""
    return _SECONDS.get(log)


def _begin(job: tuple[str, str, dict[str, Any]]) -> Connection:
    """Send a job to a worker and return the connection to it once the job has begun; skip workers that died idle."""
    while True:
        worker, fresh = _hire()
        try:
            worker.send(job)
            worker.recv()
        except (EOFError, OSError) as error:
            worker.close()
            if fresh:
                raise JobFailed(f"no process could be started for the job (log: {job[1]})") from error
        else:
            return worker


def _hire() -> tuple[Connection, bool]:
    """Return the connection to an idle worker or to a new one, and whether it is new."""
    warm_up()
    with _LOCK:
        if _IDLE:
            return _IDLE.pop(), False
        context = multiprocessing.get_context("forkserver")
        ours, theirs = context.Pipe()
        with _hidden_main():
            context.Process(target=_serve, args=(theirs,), daemon=True).start()
    theirs.close()
    return ours, True


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
    sys.stdout, sys.stderr = _lines_to(1), _lines_to(2)
    with contextlib.suppress(EOFError):
        while True:
            script, log, arguments = connection.recv()
            connection.send("begun")
            connection.send(_work(script, log, arguments))


def _lines_to(descriptor: int) -> IO[str]:
    """Return a stream to a descriptor that is there even where the workflow's own output is closed.

    Whole lines keep the order of the log, and the output of a job that is killed.
    """
    return open(descriptor, "w", encoding="utf-8", errors="backslashreplace", buffering=1, closefd=False)


def _work(script: str, log: str, arguments: dict[str, Any]) -> str | None:
    """Run one job with all output in its log; return the reason why it failed, or None."""
    try:
        _redirect(log)
        main: Callable[..., None] = runpy.run_path(script)["main"]
        main(**arguments)
        sys.stdout.flush()
    except (Exception, SystemExit) as error:
        with contextlib.suppress(OSError):  # on a full disk
            traceback.print_exc()
        place = getattr(error, "filename", None) or log
        known = why_not(place, error) if isinstance(error, OSError) else error
        return f"{type(known).__name__}: {known}"
    finally:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
            sys.stderr.flush()
    return None


def _redirect(log: str) -> None:
    """Send all output of this process to a file."""
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    with open(log, "w", encoding="utf-8") as stream:
        for descriptor in (1, 2):
            os.dup2(stream.fileno(), descriptor)
