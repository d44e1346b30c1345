"""Curves of friction to which speeds were added: drawn as they are known between points, their peaks with errors."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.container import ErrorbarContainer
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.figures.bands import draw_band
from rubfric.results.curve import Curve
from rubfric.results.curves import CURVE, GRID, POINT, curve_of, scale_name
from rubfric.results.peaks import find_curve_peak
from rubfric.results.scales import AXES

_FOUND = "found peak"


def curve_points(curves: pd.DataFrame | None, scale: int, pressure: float) -> pd.DataFrame | None:
    """Return the points of a scale at a pressure; None where no speeds were added to any curve, or it has none.

    Parameters
    ----------
    curves : pandas.DataFrame or None
        As from ``rubfric.results.curves.curve_table``, of one temperature.
    scale : int
    pressure : float
        MPa.
    """
    if curves is None:
        return None
    rows = curves[(curves[CURVE] == scale_name(scale)) & np.isclose(curves[AXES[1]], pressure, rtol=1e-5)]
    return rows if curve_of(rows) else None


def draw_curve(panel: Axes, points: pd.DataFrame, look: dict[str, Any]) -> NDArray[np.float64]:
    """Draw a curve through its points with the band of its error, marks at the grid's speeds, and its peak.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    points : pandas.DataFrame
        Of one curve.
    look : dict
        How its line and marks look.

    Returns
    -------
    numpy.ndarray
        The upper edge of the band, for the limits of the ordinate.
    """
    curve = curve_of(points)
    assert curve is not None
    places, friction, error = (np.asarray(one, dtype=np.float64) for one in (curve.places, *curve.at(curve.places)))
    draw_band(panel, 10.0**places, friction, error, look["color"])
    at = np.searchsorted(places, np.log10(points.loc[points[POINT] == GRID, AXES[0]].to_numpy()) - 1e-9)
    panel.plot(10.0**places, friction, markevery=at.tolist(), **look)
    mark_found(panel, curve, look["color"])
    return friction + error


def mark_found(panel: Axes, curve: Curve | None, colour: Any) -> None:
    """Draw the peak of a curve with bars from the slowest to the fastest speed and friction that it may be at.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    curve : Curve or None
        Nothing is drawn where its highest friction is at an end of the speeds, or may be by its error.
    colour : matplotlib colour
    """
    peak = find_curve_peak(curve) if curve else None
    if peak is None or peak.kind != "peak":
        return
    at = peak.speed
    bars = panel.errorbar(
        at.speed,
        peak.friction,
        xerr=[[at.speed - at.low], [at.high - at.speed]],
        yerr=peak.error,
        **_bars(colour),
    )
    bars.set_label(_FOUND)


def _bars(colour: Any) -> dict[str, Any]:
    return {"color": colour, "marker": "D", "markersize": 3.0, "markerfacecolor": "white", "markeredgewidth": 0.8} | {
        "elinewidth": 0.7,
        "capsize": 1.5,
        "zorder": 4.0,
    }


def found_handles(*panels: Axes) -> list[Line2D]:
    """Return the legend's entry for peaks with bars, or none where the panels have none."""
    bars = [one for panel in panels for one in panel.containers if isinstance(one, ErrorbarContainer)]
    if not any(one.get_label() == _FOUND for one in bars):
        return []
    look = {name: value for name, value in _bars("black").items() if name not in ("elinewidth", "capsize")}
    return [Line2D([], [], linestyle="none", label="Peak, with its error", **look)]
