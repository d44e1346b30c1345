"""Stretches of a record over which the speed is steady, or changes little."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.rig.record import Record
from rubfric.rig.settings import Windows
from rubfric.rig.speed import Cells

STEADY, SWEEP = "steady", "sweep"
# Least share of the run's travel or time in a plateau; anything shorter is part of a sweep.
_PLATEAU = 0.15
# Robust standard deviations within which a speed is noise.
_NOISE = 2.5
# Standard errors by which the largest and the smallest of some hundred noisy speeds differ.
_SCATTER = 5.0


@dataclass(frozen=True)
class Window:
    """Samples ``start`` to ``end - 1`` of a record.

    Attributes
    ----------
    start, end : int
    kind : {"steady", "sweep"}
        Whether the speed is steady, or part of a sweep.
    """

    start: int
    end: int
    kind: str


def find_windows(record: Record, cells: Cells, limits: Windows) -> list[Window]:
    """Return windows in the order of time.

    First the longest stretches whose speed stays within ``steady_range``, as long as they are a good part of the run.
    What is left, where the sled gains or loses speed, is cut into pieces within ``sweep_range``.

    Parameters
    ----------
    record : Record
    cells : Cells
        Of the record, with their speeds.
    limits : Windows
    """
    found: list[Window] = []
    for first, last in _slides(cells, record):
        travel = abs(record.displacement[cells.end[last - 1] - 1] - record.displacement[cells.start[first]])
        time = record.time[cells.end[last - 1] - 1] - record.time[cells.start[first]]
        found += _plateaus(record, cells, (first, last), limits, (_PLATEAU * travel, _PLATEAU * time))
    return sorted(found, key=lambda window: window.start)


def _slides(cells: Cells, record: Record) -> list[tuple[int, int]]:
    """Return runs of cells that slide one way without a gap in time, less the first and the last cell.

    Those two may hold the start and the stop.
    """
    way = np.where(cells.moving, np.sign(cells.speed), 0.0)
    after_gap = {part.start for part in record.stretches()[1:]}
    runs = []
    begin = 0
    for place in range(1, way.size + 1):
        if place < way.size and way[place] == way[begin] and int(cells.start[place]) not in after_gap:
            continue
        if way[begin] != 0.0 and place - begin > 2:
            runs.append((begin + 1, place - 1))
        begin = place
    return runs


def _plateaus(
    record: Record, cells: Cells, run: tuple[int, int], limits: Windows, least: tuple[float, float]
) -> list[Window]:
    """Return the longest plateau of a run of cells and the windows on both sides of it, or the pieces of a sweep."""
    first, last = run
    if last <= first:
        return []
    speeds = np.abs(cells.speed)
    reaches = [_reach(speeds, cells.error, start, last, limits.steady_range) for start in range(first, last)]
    best = max(reaches, key=lambda pair: int(cells.end[pair[1] - 1] - cells.start[pair[0]]))
    start, end = int(cells.start[best[0]]), int(cells.end[best[1] - 1])
    travel = abs(record.displacement[end - 1] - record.displacement[start])
    time = record.time[end - 1] - record.time[start]
    if travel < least[0] and time < least[1]:
        return _sweep(cells, run, limits.sweep_range)
    sides = [(first, best[0]), (best[1], last)]
    settled = _settled(speeds, best)
    start, end = int(cells.start[settled[0]]), int(cells.end[settled[1] - 1])
    return [Window(start, end, STEADY)] + [
        window for side in sides for window in _plateaus(record, cells, side, limits, least)
    ]


def _settled(speeds: Real, pair: tuple[int, int]) -> tuple[int, int]:
    """Return a plateau without its ends where speeds exceed the noise: where the sled still accelerates."""
    part = speeds[pair[0] : pair[1]]
    away = np.abs(part - np.median(part))
    near = np.flatnonzero(away <= _NOISE * 1.4826 * np.median(away))
    return pair[0] + int(near[0]), pair[0] + int(near[-1]) + 1


def _sweep(cells: Cells, run: tuple[int, int], most: float) -> list[Window]:
    """Return pieces of a run of cells, from left to right, each as long as its change of speed allows."""
    speeds = np.abs(cells.speed)
    found = []
    start = run[0]
    while start < run[1]:
        _, end = _reach(speeds, cells.error, start, run[1], most)
        found.append(Window(int(cells.start[start]), int(cells.end[end - 1]), SWEEP))
        start = end
    return found


def _reach(speeds: Real, errors: Real, start: int, last: int, most: float) -> tuple[int, int]:
    """Return the cells from ``start`` on whose speeds differ by no more than ``most`` of them, and their noise."""
    part = speeds[start:last]
    spread = np.maximum.accumulate(part) - np.minimum.accumulate(part)
    allowed = np.cumsum(most * part + _SCATTER * errors[start:last]) / np.arange(1, part.size + 1)
    beyond = np.flatnonzero(spread > allowed)
    return start, start + (int(beyond[0]) if beyond.size else part.size)
