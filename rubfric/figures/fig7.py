"""Figure 7: the friction of the whole road at one pressure, and what each scale adds to it."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.bands import band_handle, draw_band, runs, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.results.scales import total_error, total_friction
from rubfric.results.selection import described, friction, friction_error

_HEIGHT = 2.9
# A speed without a neighbour is drawn this far to either side, as a factor.
_ALONE = 1.25


@style.applied()
def draw(campaign: xr.Dataset, aspect: float, pressure: float) -> Figure:
    """Draw the sum of the scales' friction coefficients against speed, and each scale's share as an area.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; a speed at which any scale is missing is a gap.
    aspect : float
        Height over width of the blocks.
    pressure : float
        Nominal pressure, MPa.

    Returns
    -------
    matplotlib.figure.Figure
        The finest scale lies at the bottom. A ring marks the largest of the sampled totals, where it lies
        between others. The band around the total is a bound on its estimated error; the legend gives the
        largest.

    Raises
    ------
    InvalidInput
        Where the campaign lacks the ratio or the pressure, or has no speed at which all scales were run.
    BrokenResult
        For a campaign without estimated errors.
    """
    shares = (
        friction(campaign, aspect=aspect, pressure=pressure)
        .transpose("scale", "velocity")
        .sortby("scale", ascending=False)
    )
    total = total_friction(shares).values
    if not bool(np.isfinite(total).any()):
        place = described(pressure=pressure, aspect=aspect)
        raise InvalidInput(
            f"the campaign has no speed at which all scales were run at {place}, so there is no total to draw"
        )
    speeds = shares["velocity"].values
    figure = Figure(figsize=(style.COLUMN, _HEIGHT), layout="constrained")
    axes = figure.subplots()
    error = total_error(friction_error(campaign, aspect=aspect, pressure=pressure)).values
    patches = _stack(axes, speeds, shares)
    draw_band(axes, speeds, total, error, "black", zorder=2.5)
    (line,) = axes.plot(speeds, total, color="black", linewidth=1.7, marker="o", label="total", zorder=3, clip_on=False)
    mark_peak(axes, speeds, total, "black")
    scale_speeds(axes, speeds)
    scale_friction(axes, upper(total, error))
    axes.set_xlabel("sliding speed (mm/s)")
    axes.set_ylabel("friction coefficient (-)")
    handles = [line, *peak_handles(axes), band_handle(total, error, "black"), *patches[::-1]]
    panels.legend_above(figure, handles, described(pressure=pressure, aspect=aspect), 3)
    return figure


def _stack(axes: Axes, speeds: NDArray[np.float64], shares: xr.DataArray) -> list[Patch]:
    """Draw the areas one upon the other, and return their entries in the legend."""
    edges = np.cumsum(np.vstack((np.zeros_like(speeds), shares.values)), axis=0)
    known = np.isfinite(edges[-1])
    patches = []
    for place, (scale, colour) in enumerate(zip(shares["scale"].values, _tints(shares.sizes["scale"]), strict=True)):
        look: dict[str, Any] = {
            "facecolor": colour,
            "edgecolor": "0.15",
            "hatch": style.HATCHES[place % len(style.HATCHES)],
            "linewidth": 0.5,
        }
        for run in runs(known):
            x, low, high = speeds[run], edges[place][run], edges[place + 1][run]
            if x.size == 1:
                x, low, high = x * np.array([1.0 / _ALONE, _ALONE]), low.repeat(2), high.repeat(2)
            axes.fill_between(x, low, high, gid=f"scale {scale}", **look)
        patches.append(Patch(label=f"scale {scale}", **look))
    return patches


def _tints(count: int) -> list[tuple[float, ...]]:
    """Return the shared colours mixed with white, so that hatches and lines show on them."""
    return [tuple(0.45 * np.asarray(colour[:3]) + 0.55) for colour in style.colours(count)]
