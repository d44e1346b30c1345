"""Estimated errors of friction coefficients, drawn as bands around curves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from numpy.typing import NDArray

from rubfric.figures.scaling import NEGLIGIBLE
from rubfric.figures.style import percent

Array = NDArray[np.float64]

_BAND = "error"
_OPACITY = 0.28
# The width of the bar of a point without neighbours, points.
_BAR = 3.0


def draw_band(panel: Axes, places: Array, values: Array, errors: Array, colour: Any, zorder: float = 1.5) -> None:
    """Draw a band from ``values - errors`` to ``values + errors``; where a point has no neighbour, a bar.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    places, values, errors : numpy.ndarray, each of shape (points,)
        Abscissa, friction coefficients and their absolute errors; nothing is drawn where either is not finite.
    colour : matplotlib colour
    zorder : float
        Lines have 2.
    """
    look: dict[str, Any] = {"color": colour, "alpha": _OPACITY, "gid": _BAND, "zorder": zorder}
    for run in runs(np.isfinite(values) & np.isfinite(errors)):
        x, low, high = places[run], values[run] - errors[run], values[run] + errors[run]
        if x.size > 1:
            panel.fill_between(x, low, high, linewidth=0.0, **look)
        else:
            panel.vlines(x, low, high, linewidth=_BAR, **look)


def bands(panel: Axes) -> list[Any]:
    """Return the bands and bars of a panel."""
    return [area for area in panel.collections if area.get_gid() == _BAND]


def band_handle(values: Array, errors: Array, colour: Any = "0.3", rubber: Array | None = None) -> Patch:
    """Return the legend's entry for bands with the largest of the relative errors.

    Bands may be thinner than the lines inside them, so the number is needed.

    Parameters
    ----------
    values, errors : numpy.ndarray, of one shape
        All friction coefficients that a figure shows, and their absolute errors. A coefficient of zero has no relative
        error and is left out.
    colour : matplotlib colour
    rubber : numpy.ndarray of the same shape, optional
        The part of the errors that the data of a measured rubber leave.
    """
    shown = np.abs(values) > NEGLIGIBLE  # False for NaN
    known = shown & np.isfinite(errors)
    words = "estimated error"
    if known.any():
        words += f",\nat most {percent(float(np.max(np.abs(errors[known] / values[known]))))}"
        if rubber is not None:
            words += f",\nthe rubber's data alone\nat most {percent(float(np.nanmax(rubber[known] / values[known])))}"
    unknown = int(np.count_nonzero(shown & ~known))
    if unknown:
        words += f",\nunknown at {unknown} of {np.count_nonzero(shown)} points"
    return Patch(facecolor=colour, alpha=_OPACITY, linewidth=0.0, label=words)


def upper(values: Array, errors: Array) -> Array:
    """Return the upper edges of bands, for the limits of the ordinate.

    Parameters
    ----------
    values, errors : numpy.ndarray, of one shape
        Friction coefficients and their absolute errors, which count as 0 where unknown.
    """
    return values + np.where(np.isfinite(errors), errors, 0.0)


def runs(known: NDArray[np.bool_]) -> Iterator[slice]:
    """Yield the stretches of neighbouring places that are known."""
    steps = np.flatnonzero(np.diff(np.concatenate(([False], known, [False])).astype(np.int8)))
    for start, stop in zip(steps[::2], steps[1::2], strict=True):
        yield slice(int(start), int(stop))
