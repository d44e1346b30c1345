"""Figure 3: friction over the height-to-width ratio of the block, at every speed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.figures import panels, style
from rubfric.figures.bands import draw_band, explain_bands, upper
from rubfric.figures.scaling import NEGLIGIBLE, plain, scale_decades, scale_friction, tick_at
from rubfric.results.selection import friction, friction_error

Array = NDArray[np.float64]

# The ratio above which the paper calls the friction stable, and which it takes for its typical block.
TYPICAL_RATIO = 0.75
_MARK: dict[str, Any] = {"color": "black", "linewidth": 0.7, "linestyle": (0, (7, 3))}


@style.applied()
def draw(campaign: xr.Dataset, scales: Sequence[int], pressures: Sequence[float], aspects: Sequence[float]) -> Figure:
    """Draw the friction coefficient against the height-to-width ratio, a line per speed; dashes mark the ratio 0.75.

    The ordinate is logarithmic, so that the lines of all speeds show how much they still change; it is linear where a
    friction coefficient is zero. Bands around the lines are the estimated errors; the legend, or a note
    where none is seen, gives the largest.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    scales : sequence of int
        Scales of the road, 1 being the coarsest; a panel for each and each pressure.
    pressures : sequence of float
        Nominal pressures, MPa.
    aspects : sequence of float
        Heights over widths of the blocks.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InvalidInput
        Where the campaign lacks what is asked for.
    BrokenResult
        For a campaign without estimated errors.
    """
    places = list(product(scales, pressures))
    ratios = np.sort(np.asarray(aspects, dtype=np.float64))
    speeds = np.sort(campaign["velocity"].values)
    tables, errors = (
        [_table(pick, campaign, scale, pressure, ratios) for scale, pressure in places]
        for pick in (friction, friction_error)
    )
    looks = style.lines(speeds.size)
    figure, axes = panels.arrange(len(places), height=2.7)
    for panel, table, bounds in zip(axes, tables, errors, strict=True):
        for values, error, look in zip(table.T, bounds.T, looks, strict=True):
            draw_band(panel, ratios, values, error, look["color"])
            panel.plot(ratios, values, **look)
        panel.axvline(TYPICAL_RATIO, zorder=0.5, gid="typical", **_MARK)
    _scale_ratios(axes[0], ratios)
    _scale_ordinate(axes[0], np.concatenate(tables), np.concatenate(errors))
    panels.entitle(axes, [panels.place_words(scale=scale, pressure=pressure) for scale, pressure in places])
    panels.label(axes, "Height-to-width ratio", "Friction coefficient")
    handles = panels.line_handles([plain(float(speed)) for speed in speeds], looks)
    handles += [Line2D([], [], label=f"{TYPICAL_RATIO}: stable above,\naccording to the paper", **_MARK)]
    handles += explain_bands(figure, axes[0], np.concatenate(tables), np.concatenate(errors))
    panels.legend_beside(figure, handles, "Sliding speed\n(mm/s)")
    return figure


def _table(
    pick: Callable[..., xr.DataArray], campaign: xr.Dataset, scale: int, pressure: float, ratios: Array
) -> Array:
    """Return friction, or its error, over ratio and speed."""
    rows = [pick(campaign, scale=scale, pressure=pressure, aspect=float(ratio)).values for ratio in ratios]
    return np.stack(rows)


def _scale_ratios(panel: Axes, ratios: Array) -> None:
    low, high = min(ratios[0], TYPICAL_RATIO), max(ratios[-1], TYPICAL_RATIO)
    margin = 0.06 * (high - low) if high > low else 0.25
    panel.set_xlim(low - margin, high + margin)
    tick_at(panel.xaxis, sorted({*ratios.tolist(), TYPICAL_RATIO}))


def _scale_ordinate(panel: Axes, values: Array, errors: Array) -> None:
    edges = upper(values, errors)
    low, high = float(np.nanmin(values)), float(np.nanmax(edges))
    if low > NEGLIGIBLE:
        scale_decades(panel, low / 1.3, high * 1.3)
    else:
        scale_friction(panel, edges)
