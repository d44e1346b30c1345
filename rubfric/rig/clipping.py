"""Readings of a force that are clipped at the limit of its sensor or logger, where they pile up at one value."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Flags, Real

# Fewest readings at one extreme that make a pile, and readings in a row in it.
_PILE, _ROW = 8, 4
# A pile has more readings than this number of neighbouring levels together; noise has few readings at its extremes.
_LEVELS = 3
# A force with no more values than these is no sensor's: a known load, and none.
_NOMINAL = 2


def clipped(readings: Real, limit: float | None = None) -> Flags:
    """Return which readings of a sensor are clipped.

    Where the limit of the sensor is known, those at it or beyond. Otherwise those at the largest or the smallest
    reading, where that is far more frequent than the readings next to it: such a sensor is clipped, or too coarse to
    resolve the force. A force of one or two values is not measured but known.

    Parameters
    ----------
    readings : numpy.ndarray, shape (samples,)
        N, with the offset of the sensor.
    limit : float, optional
        N, of either sign.
    """
    if limit:
        return np.asarray(np.abs(readings) >= limit * (1.0 - 1e-9))
    found = np.zeros(readings.size, dtype=bool)
    levels, counts = np.unique(readings, return_counts=True)
    if levels.size <= _NOMINAL:
        return found
    for extreme, count, beside in (
        (levels[0], counts[0], counts[1 : 1 + _LEVELS]),
        (levels[-1], counts[-1], counts[-1 - _LEVELS : -1]),
    ):
        at_it = readings == extreme
        if count >= _PILE and count > beside.sum() and _longest_row(at_it) >= _ROW:
            found |= at_it
    return found


def _longest_row(flags: Flags) -> int:
    steps = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return int((steps[1::2] - steps[::2]).max(initial=0))
