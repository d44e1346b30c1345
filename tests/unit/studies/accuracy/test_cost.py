"""What a computation costs: repeated as often as asked for, its least time and its most memory."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from rubfric.studies.accuracy import cost as measured
from rubfric.studies.accuracy.cost import measure


class Clock:
    """Stands still but for what computations add to it, so that a busy machine changes nothing."""

    def __init__(self) -> None:
        self.now = 0.0

    def perf_counter(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    found = Clock()
    monkeypatch.setattr(measured, "time", found)
    return found


def taking(clock: Clock, durations: list[float]) -> tuple[Callable[[], int], list[int]]:
    """Return a computation that takes so many seconds the first time, the second, and so on; and its calls."""
    waits = iter(durations)
    calls: list[int] = []

    def compute() -> int:
        clock.now += next(waits)
        calls.append(len(calls))
        return len(calls)

    return compute, calls


@pytest.mark.parametrize(
    ("least", "most", "times"),
    [
        (0.0, 1, 1),  # once is enough
        (0.0, 5, 1),  # no time has to be spent
        (60.0, 1, 1),  # no more often than this
        (60.0, 3, 3),
        (3.0, 5, 2),  # until so much time was spent: 2 s each
    ],
)
def test_repeats_until_the_time_is_spent_or_often_enough(clock: Clock, least: float, most: int, times: int) -> None:
    compute, calls = taking(clock, [2.0] * 10)
    found = measure(compute, least, most)
    assert len(calls) == times
    assert found.result == times  # of the last repetition
    assert found.seconds == 2.0


def test_time_is_the_least_of_all_repetitions(clock: Clock) -> None:
    compute, _ = taking(clock, [4.0, 1.0, 3.0])
    assert measure(compute, 60.0, 3).seconds == 1.0


def fresh_memories() -> list[float]:
    """Return the most memory held, MB, with 1, 150 and 1 MB, by a process that has held nothing else."""
    program = (
        "import numpy as np; from rubfric.studies.accuracy.cost import measure\n"
        "for size in (1, 150, 1): print(measure(lambda: float(np.ones(size * 125_000).sum())).memory)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return [float(line) for line in done.stdout.split()]


def test_memory_is_what_the_computation_held_at_most() -> None:
    little, much, _ = fresh_memories()
    assert much - little > 100.0


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="only Linux resets the peak memory")
def test_memory_held_before_is_forgotten() -> None:
    _, much, after = fresh_memories()
    assert much - after > 100.0


def test_system_that_cannot_reset_gives_the_peak_since_it_began(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(measured, "_RESET", tmp_path / "missing" / "clear_refs")
    monkeypatch.setattr(measured, "_STATUS", tmp_path / "missing" / "status")
    first = measure(lambda: None).memory
    assert 10.0 < first < 1e5  # MB: a Python with numpy
    assert measure(lambda: None).memory >= first


def test_errors_of_the_computation_are_not_caught() -> None:
    def compute() -> None:
        raise ValueError("no such scene")

    with pytest.raises(ValueError, match="no such scene"):
        measure(compute, 1.0, 3)
