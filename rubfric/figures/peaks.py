"""Peaks of friction over speed, and the rings that mark them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.figures import style
from rubfric.results.selection import find_peak

_RING = "peak"


def mark_peak(axes: Axes, speeds: NDArray[np.float64], values: NDArray[np.float64], colour: Any) -> None:
    """Draw a ring around the largest of the sampled points, if it is a peak.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    speeds, values : numpy.ndarray, shape (points,)
        mm/s, and friction coefficients; NaN is skipped.
    colour : matplotlib colour
    """
    found = find_peak(values)
    if found.kind == "peak":
        axes.plot(speeds[found.at], values[found.at], color=colour, gid=_RING, zorder=4, **style.RING)


def rings(axes: Axes) -> list[Line2D]:
    """Return the rings of a panel."""
    return [line for line in axes.get_lines() if line.get_gid() == _RING]


def peak_handles(*panels: Axes) -> list[Line2D]:
    """Return the legend's entry for the rings, or none where the panels have no ring."""
    if not any(rings(panel) for panel in panels):
        return []
    return [Line2D([], [], color="black", label="Sampled peak", **style.RING)]
