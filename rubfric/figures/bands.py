"""Estimated errors of friction coefficients, drawn as bands around curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from rubfric.figures.panels import write_note
from rubfric.figures.scaling import NEGLIGIBLE
from rubfric.figures.style import percent

Array = NDArray[np.float64]

_BAND = "error"
_OPACITY = 0.28
# Of the innermost and the outermost of several bands.
_INNER, _OUTER = 0.55, 0.2
# The width of the bar of a point without neighbours, points.
_BAR = 3.0
# Share of the height of a panel below which a band is hidden by its line and marks.
_THIN = 0.03


def draw_band(
    panel: Axes,
    places: Array,
    values: Array,
    errors: Array,
    colour: Any,
    zorder: float = 1.5,
    opacity: float | None = None,
) -> None:
    """Draw a band from ``values - errors`` to ``values + errors``; where a point has no neighbour, a bar.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    places, values, errors : numpy.ndarray, each of shape (points,)
        Abscissa, friction coefficients and their absolute errors; nothing is drawn where either is not finite.
    colour : matplotlib colour
    zorder : float
        Lines have 2.
    opacity : float, optional
        From 0 to 1; that of a single band by default.
    """
    look: dict[str, Any] = {"color": colour, "alpha": opacity or _OPACITY, "gid": _BAND, "zorder": zorder}
    for run in runs(np.isfinite(values) & np.isfinite(errors)):
        x, low, high = places[run], values[run] - errors[run], values[run] + errors[run]
        if x.size > 1:
            panel.fill_between(x, low, high, linewidth=0.0, **look)
        else:
            panel.vlines(x, low, high, linewidth=_BAR, **look)


def bands(panel: Axes) -> list[Any]:
    """Return the bands and bars of a panel."""
    return [area for area in panel.collections if area.get_gid() == _BAND]


def band_handle(label: str, colour: Any = "0.3", opacity: float = _OPACITY) -> Patch:
    """Return a legend's entry for bands.

    Parameters
    ----------
    label : str
    colour : matplotlib colour
    opacity : float, optional
        From 0 to 1; that of a single band by default.
    """
    return Patch(facecolor=colour, alpha=opacity, linewidth=0.0, label=label)


def explain_bands(
    figure: Figure, panel: Axes, values: Array, errors: Array, colour: Any = "0.3", rubber: Array | None = None
) -> list[Patch]:
    """Return the legend's entry for bands, with the largest of the relative errors; a note instead if none is seen.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    panel : matplotlib.axes.Axes
        One of those that show the bands, all of which have one ordinate; its limits are final.
    values, errors : numpy.ndarray, of one shape
        All friction coefficients that a figure shows, and their absolute errors. A coefficient of zero has no relative
        error and is left out.
    colour : matplotlib colour
    rubber : numpy.ndarray of the same shape, optional
        The part of the errors that the data of a measured rubber leave.
    """
    shown = np.abs(values) > NEGLIGIBLE  # False for NaN
    known = shown & np.isfinite(errors)
    facts = []
    if known.any():
        facts.append(f"at most {percent(float(np.max(np.abs(errors[known] / values[known]))))}")
        if rubber is not None:
            most = percent(float(np.nanmax(rubber[known] / values[known])))
            facts.append(f"the rubber's data alone\nat most {most}")
    unknown = int(np.count_nonzero(shown & ~known))
    if unknown:
        facts.append(f"unknown at {unknown} of {np.count_nonzero(shown)} points")
    if _seen(panel, values, errors):
        return [band_handle(",\n".join(["Estimated error", *facts]), colour)]
    if facts:
        write_note(figure, [f"Estimated error {', '.join(facts)}: too small for bands to be seen.".replace("\n", " ")])
    return []


def _seen(panel: Axes, values: Array, errors: Array) -> bool:
    """Return whether any band is thicker than the line inside it."""
    across = panel.transScale + panel.transLimits
    # A logarithmic axis puts what is not positive far below its lower end.
    low, high = (
        across.transform(np.stack((np.ones(values.size), edge.ravel()), axis=1))[:, 1].clip(0.0, 1.0)
        for edge in (values - errors, values + errors)
    )
    return bool(np.any(high - low > _THIN))


def draw_parts(panel: Axes, places: Array, values: Array, parts: Sequence[Array], zorder: float = 1.5) -> None:
    """Draw bands of black for the parts of an error, each outside of those before it and paler than they.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    places, values : numpy.ndarray, each of shape (points,)
        Abscissa and friction coefficients.
    parts : sequence of numpy.ndarray, each of shape (points,)
        Absolute errors that add up to the whole one; as in ``draw_band``, nothing is drawn where one is not finite.
    zorder : float
        Lines have 2.
    """
    if len(parts) == 1:
        draw_band(panel, places, values, parts[0], "black", zorder)
        return
    whole, clear = np.cumsum(parts, axis=0), 1.0
    for error, opacity in zip(whole[::-1], _opacities(len(parts))[::-1], strict=True):
        layer = 1.0 - (1.0 - opacity) / clear  # upon what is drawn already
        draw_band(panel, places, values, np.where(np.isfinite(whole[-1]), error, np.nan), "black", zorder, layer)
        clear = 1.0 - opacity


def explain_parts(figure: Figure, panel: Axes, values: Array, parts: Mapping[str, Array]) -> list[Patch]:
    """Return the legend's entries for the bands of ``draw_parts``, each with the largest of its part alone.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Gets a note instead on parts that are too small to be seen.
    panel : matplotlib.axes.Axes
        As for ``explain_bands``.
    values : numpy.ndarray, shape (points,)
        All friction coefficients that a figure shows.
    parts : mapping of str to numpy.ndarray of that shape
        What each part comes from, in words; one part alone is called the estimated error.
    """
    if len(parts) == 1:
        return explain_bands(figure, panel, values, next(iter(parts.values())), "black")
    shown = np.abs(values) > NEGLIGIBLE
    handles: list[Patch] = []
    for (words, error), opacity in zip(parts.items(), _opacities(len(parts)), strict=True):
        known = shown & np.isfinite(error)
        most = f"at most {percent(float(np.max(np.abs(error[known] / values[known]))))}" if known.any() else "unknown"
        if _seen(panel, values, error):
            handles.append(band_handle(f"{'+' if handles else 'Error:'} {words},\n{most}", "black", opacity))
        else:
            write_note(figure, [f"Error from {words} {most}: too small for its band to be seen."])
    return handles


def _opacities(count: int) -> list[float]:
    """Return how opaque so many bands look, each outside of the one before it."""
    return np.linspace(_INNER, _OUTER, count).tolist()


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
