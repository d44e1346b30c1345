"""Figure 7: the friction of the whole road at one pressure, upon the sum of what each scale adds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import marks, panels, style
from rubfric.figures.bands import explain_parts, runs, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.refined import found_handles, mark_found
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.figures.totals import draw_total, other_handles, totals
from rubfric.results.curve import Curve
from rubfric.results.scales import total_friction
from rubfric.results.selection import described, friction

_HEIGHT, _PART = 3.7, 0.27
_SUM: dict[str, Any] = {"color": "0.15", "linewidth": 1.0, "linestyle": (0, (4, 2)), "zorder": 2.2}
# A speed without a neighbour is drawn this far to either side, as a factor.
_ALONE = 1.25


@style.applied()
def draw(campaign: xr.Dataset, table: pd.DataFrame, aspect: float, pressure: float, refined: bool = False) -> Figure:
    """Draw the total against speed, upon the sum of the scales' friction coefficients with an area for each scale.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; a speed at which any scale is missing is a gap of the sum.
    table : pandas.DataFrame
        As from ``rubfric.results.tables.total_table``.
    aspect : float
        Height over width of the blocks.
    pressure : float
        Nominal pressure, MPa.
    refined : bool
        Whether the table has added speeds: the peak is marked with its error then.

    Returns
    -------
    matplotlib.figure.Figure
        The coarsest scale lies at the bottom, the paper's sum is the dashed line on top. The total is the full line,
        with the band of its whole error, of which the legend, or a note where none is seen, gives the largest. Where it
        was obtained in another way, since the whole road was refused or not needed, its points are open, with bars. A
        ring marks the largest of the rest, if it lies between others, and an exclamation mark what carries a warning.

    Raises
    ------
    InvalidInput
        Where the campaign lacks the ratio or the pressure, or has no speed at which all scales were run; for a table
        that lacks a column or the pressure.
    """
    shares = friction(campaign, aspect=aspect, pressure=pressure).transpose("scale", "velocity")
    summed = total_friction(shares).values
    if not bool(np.isfinite(summed).any()):
        place = described(pressure=pressure, aspect=aspect)
        raise InvalidInput(
            f"the campaign has no speed at which all scales were run at {place}, so there is no total to draw"
        )
    found, speeds = totals(table, pressure), shares["velocity"].values
    figure = Figure(figsize=(style.COLUMN, _HEIGHT + _PART * (len(found.parts) - 1)), layout="constrained")
    axes = figure.subplots()
    patches = _stack(axes, speeds, shares, campaign)
    (edge,) = axes.plot(speeds, summed, label=panels.sentence(found.words("sum")), gid="sum", **_SUM)
    line = draw_total(axes, found)
    if refined:
        mark_found(axes, Curve.known(found.speeds, found.total, found.error), "black")
    else:
        mark_peak(axes, found.speeds, found.main, "black")
    scale_speeds(axes, np.concatenate([speeds, found.speeds]))
    scale_friction(axes, np.concatenate([summed, upper(found.total, found.error)]))
    marks.WARNED.put(axes, found.speeds, found.total, found.warnings > 0.0)
    axes.set_xlabel("Sliding speed (mm/s)")
    axes.set_ylabel("Friction coefficient")
    points = [*peak_handles(axes), *found_handles(axes), *other_handles([found]), *marks.WARNED.handles([axes])]
    lines = [line, *explain_parts(figure, axes, found.main, found.parts), *points, edge]
    handles = [*_padded(lines, len(patches)), *_padded(patches, len(lines))]
    panels.legend_above(figure, handles, panels.place_words(pressure=pressure, aspect=aspect), 2)
    return figure


def _padded(handles: Sequence[Any], count: int) -> list[Any]:
    """Return entries of a legend filled up with empty ones, so that they make a column."""
    return [*handles, *(Line2D([], [], linestyle="none", label=" ") for _ in range(count - len(handles)))]


def _stack(axes: Axes, speeds: NDArray[np.float64], shares: xr.DataArray, campaign: xr.Dataset) -> list[Patch]:
    """Draw the areas one upon the other, and return their entries in the legend."""
    edges = np.cumsum(np.vstack((np.zeros_like(speeds), shares.values)), axis=0)
    known = np.isfinite(edges[-1])
    patches = []
    for place, scale in enumerate(shares["scale"].values.tolist()):
        look = style.scale_area(scale)
        for run in runs(known):
            x, low, high = speeds[run], edges[place][run], edges[place + 1][run]
            if x.size == 1:
                x, low, high = x * np.array([1.0 / _ALONE, _ALONE]), low.repeat(2), high.repeat(2)
            axes.fill_between(x, low, high, gid=f"scale {scale}", **look)
        patches.append(Patch(label=panels.scale_words(campaign, scale), **look))
    return patches
