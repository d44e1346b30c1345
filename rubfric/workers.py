"""Worker processes, forked from a server that has imported what they need, and a function run in them side by side.

Nothing of the caller's main module is imported again: it works from a script without a guard and from a notebook.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
import traceback
import types
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from multiprocessing import forkserver, resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, NamedTuple, TypeVar

from rubfric.errors import RubfricError

Task = TypeVar("Task")
Result = TypeVar("Result")

# One thread each: the systems are small, and workers run side by side.
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_LOCK = threading.Lock()
# How long to wait for the exit status of a process that has ended, s.
_PATIENCE = 5.0


class WorkerDied(RubfricError, RuntimeError):
    """A process that ended without its answer."""


class Worker(NamedTuple):
    """A process that calls functions one by one, and the connection to it."""

    connection: Connection
    process: BaseProcess

    def begin(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Have a function called; its result is the next that arrives on the connection.

        Parameters
        ----------
        function : callable
            Of a module, so that it can be pickled.
        *arguments
            That can be pickled.

        Raises
        ------
        EOFError, OSError
            Where the process is dead.
        """
        self.connection.send((function, arguments))
        self.connection.recv()

    def last_words(self) -> str:
        """Return how the process ended that has not said why."""
        self.process.join(_PATIENCE)
        status = self.process.exitcode
        if status == -signal.SIGINT:
            return "the job was interrupted: run again, and it begins anew"
        if status is not None and status >= 0:
            return (
                f"the job's process ended with exit status {status} before it could say why; this is an error of the "
                "program: report it, with the log"
            )
        return (
            "the job's process died before it could say why; most likely it was killed, perhaps for lack of memory: "
            "run again, with fewer jobs at a time (-j1) if it happens again"
        )


def cores() -> int:
    """Return on how many cores this process may run; one in a worker of multiprocessing, which may have no workers."""
    if multiprocessing.current_process().daemon:
        return 1
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def start_server(*preload: str) -> None:
    """Start the server that workers are forked from; returns at once, while it imports modules, given by name."""
    _open_standard_files()
    with _LOCK:
        before = {name: os.environ.get(name) for name in _ONE_THREAD}
        os.environ.update(_ONE_THREAD)
        try:
            multiprocessing.set_forkserver_preload(list(preload))
            resource_tracker.ensure_running()  # lets interrupts through again, which is too early within the block
            with _interrupts_held():
                forkserver.ensure_running()
        finally:
            for name, value in before.items():
                if value is None:
                    del os.environ[name]
                else:
                    os.environ[name] = value


def hire(*preload: str) -> Worker:
    """Return a new worker, of a server that has imported modules, given by name, unless one runs already."""
    start_server(*preload)
    context = multiprocessing.get_context("forkserver")
    ours, theirs = context.Pipe()
    with _hidden_main():
        process = context.Process(target=_serve, args=(theirs,), daemon=True)
        process.start()
    theirs.close()
    return Worker(ours, process)


def as_completed(
    function: Callable[[Task], Result],
    tasks: Sequence[Task],
    jobs: int | None = None,
    preload: Sequence[str] = (),
    names: Sequence[str] | None = None,
    begun: Callable[[int], object] = lambda place: None,
) -> Iterator[tuple[int, Result]]:
    """Yield the place of every task and its result, in the order in which they are done.

    However it ends, by an error, an interrupt, or since the caller wants no more, no worker is left. An error in a
    worker is raised here, with a note of where it came from.

    Parameters
    ----------
    function : callable
        Of a module, so that it can be pickled; takes a task.
    tasks : sequence
        That can be pickled; begun in their order.
    jobs : int, optional
        How many at a time; as many as there are cores by default.
    preload : sequence of str
        Modules to import once for all workers.
    names : sequence of str, optional
        Of the tasks, for errors; by default their numbers.
    begun : callable, optional
        Takes the place of a task that begins.

    Raises
    ------
    WorkerDied
        With the name of the task.
    """
    waiting = deque(range(len(tasks)))
    known = names or [f"task {place + 1}" for place in waiting]
    idle: list[Worker] = []
    busy: dict[Any, tuple[Worker, int]] = {}
    try:
        while waiting or busy:
            while waiting and len(busy) < (jobs or cores()):
                worker = idle.pop() if idle else hire(*preload)
                place = waiting.popleft()
                busy[worker.connection] = worker, place
                with _lost(worker, known[place]):
                    worker.begin(_answer, function, tasks[place])
                begun(place)
            for connection in wait(list(busy)):
                worker, place = busy[connection]
                with _lost(worker, known[place]):
                    result, error = worker.connection.recv()
                if error is not None:
                    raise error
                idle.append(busy.pop(connection)[0])
                yield place, result
    finally:
        for worker in [*idle, *(worker for worker, _ in busy.values())]:
            worker.process.terminate()
            worker.connection.close()


@contextlib.contextmanager
def _lost(worker: Worker, name: str) -> Iterator[None]:
    """Raise WorkerDied where the connection to a worker breaks within the block."""
    try:
        yield
    except (EOFError, OSError) as error:
        raise WorkerDied(f"{name}: {worker.last_words()}") from error


def _answer(function: Callable[[Task], Result], task: Task) -> tuple[Result | None, Exception | None]:
    """Return the result of a function, or its error."""
    try:
        return function(task), None
    except Exception as error:
        error.add_note(f"in a worker process:\n{traceback.format_exc()}")
        return None, error


def _serve(connection: Connection) -> None:
    """Call the functions that arrive, one by one, until the caller closes the connection."""
    os.environ.update(_ONE_THREAD)  # for libraries that the server has not loaded yet
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # which the server holds back
    with contextlib.suppress(EOFError):
        while True:
            function, arguments = connection.recv()
            connection.send("begun")
            connection.send(function(*arguments))


@contextlib.contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold interrupts back within the block, and for ever in a process that begins in it.

    Ctrl-C reaches all processes of a terminal: a server that still imports modules would end with a traceback.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _open_standard_files() -> None:
    """Open what the caller has closed of standard input, output and error, lest other files take their numbers."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # takes the lowest number that is free


@contextlib.contextmanager
def _hidden_main() -> Iterator[None]:
    """Hide the main module, all of Snakemake for one: a new process would import it again without need."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main
