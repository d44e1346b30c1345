"""Calibration plates at the ends of a profile: stretches far flatter than the road between them."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real

# A profile is looked at in so many pieces; a plate has two of them at least, and at most this share of the profile.
_PIECES, _LARGEST = 50, 0.25
# Roughness of a plate over the median of equally long stretches of the profile.
_FLAT = 0.1
# Fewest heights in a piece, and fewest crossings of the mean by which a profile is one of a rough road.
_FEWEST, _CROSSINGS = 16, 12


def plates(heights: Real) -> tuple[int, int]:
    """Return how many points at the begin and at the end are a plate's, with its edge.

    Parameters
    ----------
    heights : ndarray, shape (points,)
        mm; NaN in gaps.
    """
    size = len(heights) // _PIECES
    if size < _FEWEST:
        return 0, 0
    there = np.isfinite(heights)
    level = heights[there] - np.median(heights[there])
    if np.count_nonzero(np.diff(np.signbit(level))) < _CROSSINGS:
        return 0, 0
    stretches = [_roughness(heights[at : at + 2 * size]) for at in range(0, len(heights) - 2 * size + 1, size)]
    limit = _FLAT * float(np.median([one for one in stretches if one == one] or [0.0]))
    return _plate(heights, size, limit), _plate(heights[::-1], size, limit)


def _plate(heights: Real, size: int, limit: float) -> int:
    """Return the points of a plate at the begin of a profile: as far as it stays level, and the ramp behind it."""
    if not _roughness(heights[: 2 * size]) < limit:
        return 0
    end = 2 * size
    most = int(_LARGEST * len(heights))
    while end < most and _roughness(heights[: end + size]) < limit:
        end += size
    if end >= most:  # so long a stretch is no plate, but a flat road
        return 0
    plate = heights[:end]
    known = np.isfinite(plate)
    place = np.arange(len(heights))
    line = np.polyfit(place[:end][known], plate[known], 1)
    away = np.abs(heights[: end + 2 * size] - np.polyval(line, place[: end + 2 * size]))
    # The plate ends where its line is left by more than its own scatter, for good.
    near = np.flatnonzero(away <= max(5.0 * _roughness(plate), 1e-12))
    return int(near[-1]) + 1


def _roughness(heights: Real) -> float:
    """Return a robust scatter about a line, NaN where half is missing."""
    known = np.flatnonzero(np.isfinite(heights))
    if 2 * len(known) < len(heights):
        return float("nan")
    line = np.polyfit(known, heights[known], 1)
    return float(1.4826 * np.median(np.abs(heights[known] - np.polyval(line, known))))
