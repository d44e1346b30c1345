"""Spikes: a few points that stick out of the profile on both sides, which no road does."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Flags, Real

# Most points of a spike, and by how many robust standard deviations of how far points lie off the middle of their two
# sides it sticks out on both.
_WIDEST, _BEYOND = 3, 8.0
# Points beside it whose median it is compared with, and passes, since a spike hides smaller ones beside it.
_BESIDE, _PASSES = 3, 4
# Points beyond which what is beyond a gap is no neighbour.
_FAR = 20


def spikes(heights: Real) -> Flags:
    """Return where there are spikes.

    A point is one if it lies above, or below, both the points to its left and those to its right by more than
    eight robust standard deviations of how far the points of this profile lie off the middle of the two sides, which is
    its roughness or curvature at that distance. A step sticks out on one side only.

    Parameters
    ----------
    heights : ndarray, shape (points,)
        mm; NaN in gaps, across the short ones of which points are neighbours.
    """
    found = np.zeros(len(heights), dtype=bool)
    reach = _WIDEST + _BESIDE - 1
    for _ in range(_PASSES):
        known = np.flatnonzero(np.isfinite(heights) & ~found)
        if len(known) < 4 * reach:
            break
        # Mirrored about the end points, which may be spikes themselves, not the line to them.
        level = np.pad(heights[known], reach, mode="reflect")
        beside = np.stack([level[at : at + len(level) - _BESIDE + 1] for at in range(_BESIDE)])
        median = np.median(beside, axis=0)
        left, right = median[: len(known)], median[reach + _WIDEST : reach + _WIDEST + len(known)]
        here = heights[known]
        low, high = here - left, here - right
        limit = _BEYOND * 1.4826 * 0.5 * float(np.median(np.abs(low + high)))
        out = (low * high > 0.0) & (np.minimum(np.abs(low), np.abs(high)) > limit)
        places = np.pad(known, reach, mode="edge")
        out &= (known - places[: len(known)] <= _FAR) & (places[2 * reach :] - known <= _FAR)
        if limit <= 0.0 or not out.any():
            break
        found[known[out]] = True
    # What several passes have worn away is a ledge of the road.
    edges = np.flatnonzero(np.diff(np.concatenate(([0], found.astype(np.int8), [0]))))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        found[begin:end] = end - begin <= 2 * _WIDEST
    return found
