"""What a computation costs: wall time, and the peak memory of its process."""

from __future__ import annotations

import re
import resource
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

Result = TypeVar("Result")

# Linux resets the peak of the resident memory when a 5 is written to the first of these; the second holds it.
_RESET, _STATUS = Path("/proc/self/clear_refs"), Path("/proc/self/status")


@dataclass(frozen=True)
class Measured(Generic[Result]):
    """A result and what it cost.

    Attributes
    ----------
    result : Result
    seconds : float
        Wall time, the least of all repetitions.
    memory : float
        Peak resident memory meanwhile, MB (since the process began, where the system cannot reset it).
    """

    result: Result
    seconds: float
    memory: float


def measure(compute: Callable[[], Result], least: float = 0.0, most: int = 1) -> Measured[Result]:
    """Repeat a computation and measure it.

    Parameters
    ----------
    compute : callable
        Without arguments.
    least : float
        Time to spend on repetitions at least, s, unless ``most`` is reached.
    most : int
        Largest number of repetitions.
    """
    _reset_peak()
    spent: list[float] = []
    while not spent or (len(spent) < most and sum(spent) < least):
        started = time.perf_counter()
        result = compute()
        spent.append(time.perf_counter() - started)
    return Measured(result, min(spent), _peak())


def _reset_peak() -> None:
    try:
        _RESET.write_text("5", encoding="ascii")
    except OSError:
        return


def _peak() -> float:
    try:
        found = re.search(r"VmHWM:\s*(\d+) kB", _STATUS.read_text(encoding="ascii"))
    except OSError:
        found = None
    if found:
        return int(found.group(1)) / 1e3
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / (1e6 if sys.platform == "darwin" else 1e3)
