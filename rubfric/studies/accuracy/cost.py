"""What a computation costs: wall time, and the most memory that its process held."""

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

# Linux forgets the most memory held when a 5 is written to the first of these, and tells it in the second.
_FORGET, _STATUS = Path("/proc/self/clear_refs"), Path("/proc/self/status")


@dataclass(frozen=True)
class Measured(Generic[Result]):
    """A result and what it cost.

    Attributes
    ----------
    result : Result
    seconds : float
        Wall time, the least of all repetitions.
    memory : float
        Most memory that the process held meanwhile, MB (where the system cannot forget: since it began).
    """

    result: Result
    seconds: float
    memory: float


def measure(compute: Callable[[], Result], least: float = 0.0, most: int = 1) -> Measured[Result]:
    """Compute, again and again until ``least`` seconds have passed or ``most`` times, and measure."""
    _forget()
    spent: list[float] = []
    while not spent or (len(spent) < most and sum(spent) < least):
        started = time.perf_counter()
        result = compute()
        spent.append(time.perf_counter() - started)
    return Measured(result, min(spent), _peak())


def _forget() -> None:
    try:
        _FORGET.write_text("5", encoding="ascii")
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
