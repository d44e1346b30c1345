"""Walls of a profile: places where heights jump, at gaps between stones or by errors of the instrument."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rubfric.arrays import Flags, Real

# Slope between neighbouring heights from which on a place is a wall, 79 degrees; and how many times the median step its
# jump is at least, lest noise of closely spaced heights counts.
STEEP = 5.0
_TYPICAL = 20.0


@dataclass(frozen=True)
class Walls:
    """What walls a profile has.

    Attributes
    ----------
    count : int
    highest : float
        Largest jump, mm.
    share : float
        Of the mean square slope between neighbouring heights that is theirs.
    """

    count: int
    highest: float
    share: float


def walls(heights: Real, spacing: float, bridged: Flags) -> Walls:
    """Return the walls of a clean profile; what was bridged counts as none.

    Parameters
    ----------
    heights : ndarray, shape (points,)
        mm.
    spacing : float
        mm.
    bridged : ndarray of bool, shape (points,)
        Where straight lines stand for missing heights.
    """
    steps = np.where(bridged[1:] | bridged[:-1], 0.0, np.diff(heights))
    least = _TYPICAL * float(np.median(np.abs(steps)))
    steep = np.where(np.abs(steps) > STEEP * spacing, np.sign(steps), 0.0).astype(int)
    edges = np.flatnonzero(np.diff(steep, prepend=0, append=0))
    jumps, square = [], 0.0
    for begin, end in pairwise(edges.tolist()):
        jump = abs(float(steps[begin:end].sum()))
        if steep[begin] and jump > least:
            jumps.append(jump)
            square += float((steps[begin:end] ** 2).sum())
    return Walls(len(jumps), max(jumps, default=0.0), square / max(float((steps**2).sum()), 1e-300))
