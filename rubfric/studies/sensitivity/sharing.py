"""Scenes solved in this process while that is quick, and side by side in workers where it takes long."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from rubfric.workers import as_completed

Task = TypeVar("Task")
Result = TypeVar("Result")

# So much work, s, this process does by itself: workers need as long to begin.
_PATIENCE = 8.0


def shared(
    function: Callable[[Task], Result], tasks: Sequence[Task], jobs: int | None, names: Sequence[str]
) -> Iterator[tuple[int, Result]]:
    """Yield the place of every task and its result, as they are done; the first few in order, and by this process.

    Parameters
    ----------
    function : callable
        Of a module, so that it can be pickled; takes a task.
    tasks : sequence
    jobs : int or None
        Most processes at a time; None for as many as there are cores.
    names : sequence of str
        Of the tasks, for errors.
    """
    began, done, left = time.monotonic(), 0, 0.0
    while done < len(tasks) and (left < _PATIENCE or jobs == 1):
        yield done, function(tasks[done])
        done += 1
        left = (time.monotonic() - began) / done * (len(tasks) - done)
    home = function.__module__
    for place, result in as_completed(function, tasks[done:], jobs, preload=[home], names=names[done:]):
        yield done + place, result
