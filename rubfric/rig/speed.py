"""Sliding speed from displacement, piece by piece.

A difference of neighbouring readings would multiply their noise and their steps by the sampling rate, and a filter in
time would need one width for 0.1 and for 1000 mm/s. So the record is cut into cells of equal travel, and in each a
straight line is fitted to the displacement by least squares: a local polynomial whose width follows the speed, that
needs no even sampling, and whose error is known. It is robust because a running median (``rubfric.rig.record``) removes
single wrong readings before, to which least squares alone would be sensitive.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real, Whole
from rubfric.rig.record import Record

# Samples in a cell, least travel over the resolution of the displacement, and cells in the least travel of a window.
_FEWEST, _STEPS, _CELLS = 10, 80.0, 5.0
# A cell at rest may be this part of the record.
_LONGEST = 20


@dataclass(frozen=True)
class Cells:
    """Pieces of a record with their speeds.

    Attributes
    ----------
    start, end : numpy.ndarray of int, shape (cells,)
        Samples ``start`` to ``end - 1``.
    speed : numpy.ndarray, shape (cells,)
        mm/s, positive where displacement grows.
    error : numpy.ndarray, shape (cells,)
        Standard errors of the speeds, from the resolution of the displacement, mm/s.
    moving : numpy.ndarray of bool, shape (cells,)
        Whether the travel in the cell exceeds what noise may be.
    """

    start: Whole
    end: Whole
    speed: Real
    error: Real
    moving: Flags


def resolution(displacement: Real) -> float:
    """Return the noise of a displacement or half its smallest step, whichever is larger, mm."""
    bends = np.abs(np.diff(displacement, 2))
    noise = 1.4826 * float(np.median(bends)) / np.sqrt(6.0)
    steps = np.abs(np.diff(displacement))
    steps = steps[steps > 1e-9 * max(1.0, float(np.abs(displacement).max()))]
    return max(noise, 0.5 * float(steps.min()) if steps.size else 0.0)


def cells(record: Record, least_travel: float) -> Cells:
    """Cut a record into cells of equal travel, or of a part of the record where it rests; gaps are not spanned.

    Parameters
    ----------
    record : Record
    least_travel : float
        Of a window, mm; a cell is a fifth of it.
    """
    fine = resolution(record.displacement)
    travel = max(least_travel / _CELLS, _STEPS * fine)
    longest = max(record.time.size // _LONGEST, 2 * _FEWEST)
    bounds = [pair for part in record.stretches() for pair in _cut(record.displacement, part, travel, longest)]
    speeds, errors, moving = [], [], []
    for start, end in bounds:
        time, place = record.time[start:end], record.displacement[start:end]
        away = time - time.mean()
        speeds.append(float(away @ (place - place.mean()) / (away @ away)))
        errors.append(fine / float(np.sqrt(away @ away)))
        moving.append(abs(speeds[-1]) * (time[-1] - time[0]) > max(0.25 * travel, 5.0 * fine))
    edges = np.array(bounds, dtype=np.int64).reshape(-1, 2)
    return Cells(edges[:, 0], edges[:, 1], np.array(speeds), np.array(errors), np.array(moving, dtype=bool))


def _cut(displacement: Real, part: slice, travel: float, longest: int) -> list[tuple[int, int]]:
    """Return where the cells of a stretch begin and end."""
    found = []
    start = part.start
    while part.stop - start >= 2 * _FEWEST:
        reach = displacement[start : min(start + longest, part.stop - _FEWEST)]
        far = np.flatnonzero(np.abs(reach - reach[0]) >= travel)
        count = max(int(far[0]) + 1, _FEWEST) if far.size else reach.size
        found.append((start, start + max(count, _FEWEST)))
        start += max(count, _FEWEST)
    if part.stop - start >= _FEWEST:
        found.append((start, part.stop))
    return found
