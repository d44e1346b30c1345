"""Peaks of friction over speed, and the rings that mark them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

_RING = "peak"
_LOOK: dict[str, Any] = {
    "linestyle": "none",
    "marker": "o",
    "markersize": 8.0,
    "markerfacecolor": "none",
    "markeredgewidth": 0.9,
    "clip_on": False,
}


def peak(values: NDArray[np.float64]) -> int | None:
    """Return where the values are largest, or None where that is no peak: at an end, or on a flat line.

    Parameters
    ----------
    values : numpy.ndarray
        In the order of the speeds; NaN is skipped.
    """
    known = np.flatnonzero(np.isfinite(values))
    if known.size < 3:
        return None
    highest = int(known[np.argmax(values[known])])
    return highest if values[highest] > max(values[known[0]], values[known[-1]]) else None


def mark_peak(axes: Axes, speeds: NDArray[np.float64], values: NDArray[np.float64], colour: Any) -> None:
    """Draw a ring around the largest of the sampled points, if it is a peak."""
    place = peak(values)
    if place is not None:
        axes.plot(speeds[place], values[place], color=colour, gid=_RING, zorder=4, **_LOOK)


def rings(axes: Axes) -> list[Line2D]:
    """Return the rings of a panel."""
    return [line for line in axes.get_lines() if line.get_gid() == _RING]


def peak_handles(*panels: Axes) -> list[Line2D]:
    """Return the legend's entry for the rings, or none where the panels have no ring."""
    if not any(rings(panel) for panel in panels):
        return []
    return [Line2D([], [], color="black", label="sampled peak", **_LOOK)]
