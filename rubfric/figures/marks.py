"""Marks on points: those that carry a warning, and those beyond the frequencies at which the rubber was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation

from rubfric.arrays import Flags, Real


@dataclass(frozen=True)
class Mark:
    """A mark of one meaning.

    Attributes
    ----------
    gid : str
        What its lines are called in a panel.
    label : str
        Its entry in a legend.
    look : dict
        Keywords of ``Axes.plot``.
    shift : float
        How far to the right of the point it is, points of type.
    apart : float
        Least distance of two of them at one place, in heights of the panel: in a crowd one counts for its neighbours.
    """

    gid: str
    label: str
    look: dict[str, Any]
    shift: float = 0.0
    apart: float = 0.0

    def put(self, panel: Axes, places: Real, values: Real, chosen: Flags) -> None:
        """Mark chosen points; those that are not known, or too near to another mark at their place, are left out.

        Parameters
        ----------
        panel : matplotlib.axes.Axes
            Its limits are final.
        places, values : numpy.ndarray, each of shape (points,)
            In the units of the axes.
        chosen : numpy.ndarray of bool, shape (points,)
        """
        shown = chosen & np.isfinite(values)
        heights = (panel.transScale + panel.transLimits).transform(np.stack((places, values), axis=1))[:, 1]
        last: dict[float, float] = {}
        for point in np.argsort(np.where(shown, -heights, np.inf))[: np.count_nonzero(shown)]:
            place = float(places[point])
            shown[point] = last.get(place, np.inf) - heights[point] >= self.apart
            last[place] = heights[point] if shown[point] else last[place]
        if shown.any():
            beside = ScaledTranslation(self.shift / 72.0, 0.0, panel.figure.dpi_scale_trans)
            look = _SHARED | self.look | {"transform": panel.transData + beside}
            panel.plot(places[shown], values[shown], gid=self.gid, label=self.label, **look)

    def handles(self, panels: Sequence[Axes]) -> list[Line2D]:
        """Return the entry of a legend, or none where no panel has the mark."""
        if not any(line.get_gid() == self.gid for panel in panels for line in panel.get_lines()):
            return []
        return [Line2D([], [], label=self.label, **_SHARED | self.look)]


_SHARED: dict[str, Any] = {"linestyle": "none", "color": "black", "zorder": 4.0, "clip_on": False}
BEYOND = Mark("beyond", "Beyond the measured\nfrequencies", {"marker": "x", "markersize": 4.5})
WARNED = Mark(
    "warned", "Carries a warning", {"marker": "$!$", "markersize": 5.0, "markeredgewidth": 0.3}, shift=5.0, apart=0.06
)
