"""Workflow jobs in processes of their own, forked from a server that has everything imported already.

Importing the scientific stack takes longer than a scene. A fork server imports it once, when the workflow starts, and
every job is a fresh fork of it: warm, yet alone. A crash, a kill or an exception fails that job and no other.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import runpy
import sys
import threading
import traceback
import types
from collections.abc import Callable, Iterator
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from rubfric.errors import RubfricError

# One thread each: the systems are small, and jobs run side by side.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_STARTING = threading.Lock()


class JobFailed(RubfricError, RuntimeError):
    """A job that ended without its result; the message holds its reason and its log."""


def warm_up() -> None:
    """Start the server; returns at once, while it imports."""
    for name in _ONE_THREAD:
        os.environ[name] = "1"
    os.environ.setdefault("MPLBACKEND", "Agg")
    multiprocessing.set_forkserver_preload(["rubfric.warm"])
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
    warm_up()
    context = multiprocessing.get_context("forkserver")
    # The job's own word, not its exit code, tells how it ended: multiprocessing may lose the codes of
    # processes that several threads wait for.
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(sender, script, log, arguments))
    with _STARTING, _nameless_main():
        process.start()
    sender.close()
    try:
        failure = receiver.recv()
    except EOFError:
        failure = "the job's process died before it could say why; most likely it was killed"
    receiver.close()
    process.join()
    if failure:
        raise JobFailed(f"{failure} (log: {log})")


@contextlib.contextmanager
def _nameless_main() -> Iterator[None]:
    """Hide the main module: a new process would import it again, here all of Snakemake, and needs none of it."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def _work(sender: Connection, script: str, log: str, arguments: dict[str, Any]) -> None:
    """Run the script's ``main`` and send the reason why it failed, or None."""
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    with open(log, "w", encoding="utf-8", buffering=1) as stream:
        for descriptor in (1, 2):
            os.dup2(stream.fileno(), descriptor)
        try:
            main: Callable[..., None] = runpy.run_path(script)["main"]
            main(**arguments)
        except BaseException as error:
            traceback.print_exc()
            sender.send(f"{type(error).__name__}: {error}")
        else:
            sender.send(None)
        sys.stdout.flush()
