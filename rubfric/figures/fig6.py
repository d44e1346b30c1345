"""Figure 6: friction over speed and pressure at each scale of the road."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.figures import panels, style
from rubfric.figures.bands import band_handle, draw_band, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.refined import curve_points, draw_curve, found_handles
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.results.selection import BEYOND, WORTH_A_WORD, friction, friction_error, pick, rubber_error, written

Array = NDArray[np.float64]
# Points at which friction is an extrapolation of the rubber's data.
_CROSS = "beyond"


@style.applied()
def draw(campaign: xr.Dataset, aspect: float, micro: bool = True, curves: pd.DataFrame | None = None) -> Figure:
    """Draw the friction coefficient against speed, a line per pressure and a panel per scale, the finest first.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``results.campaign.collect``; pressures at which no block of this ratio was run are left out.
    aspect : float
        Height over width of the blocks.
    micro : bool
        Whether the finest of several scales is the paper's micro-scale.
    curves : pandas.DataFrame, optional
        As from ``rubfric.results.curves.curve_table``, of one temperature, where speeds were added: lines are drawn as
        they are known between points, with their peaks.

    Returns
    -------
    matplotlib.figure.Figure
        Rings mark the largest of the sampled points of a line, where it lies between others. Bands around the lines
        are the estimated errors, those from the data of a measured rubber included; the legend gives the largest.
        Crosses mark points of which more than 1 % comes from frequencies at which the rubber was not measured.

    Raises
    ------
    InvalidInput
        Where the campaign lacks the ratio, or has nothing at one of the scales.
    BrokenResult
        For a campaign without estimated errors.
    """
    grid = friction(campaign, aspect=aspect).dropna("pressure", how="all")
    errors = friction_error(campaign, aspect=aspect).sel(pressure=grid["pressure"]).transpose(*grid.dims)
    data = rubber_error(campaign, aspect=aspect)
    if data is not None:
        data = data.sel(pressure=grid["pressure"]).transpose(*grid.dims)
        errors = errors + data
    scales = [int(scale) for scale in grid["scale"].values[::-1]]
    pressures = [float(pressure) for pressure in grid["pressure"].values]
    speeds = grid["velocity"].values
    fields = [friction(campaign, aspect=aspect, scale=scale) for scale in scales]
    looks = style.lines(len(pressures))
    figure, axes = panels.arrange(len(scales), height=2.1)
    drawn, tallest = zip(axes, scales, fields, strict=True), [upper(grid.values, errors.values).ravel()]
    for (panel, scale, field), (pressure, look) in product(drawn, zip(pressures, looks, strict=True)):
        line, error = field.sel(pressure=pressure), errors.sel(scale=scale, pressure=pressure)
        if line.notnull().any():
            points = curve_points(curves, scale, pressure)
            if points is None:
                draw_band(panel, speeds, line.values, error.values, look["color"])
                panel.plot(speeds, line.values, **look)
                mark_peak(panel, speeds, line.values, look["color"])
            else:
                tallest.append(draw_curve(panel, points, look))
            if BEYOND in campaign:
                share = pick(campaign, BEYOND, aspect=aspect, scale=scale, pressure=pressure)
                _cross(panel, speeds, line.where(share > WORTH_A_WORD).values)
    scale_speeds(axes[0], speeds)
    scale_friction(axes[0], np.concatenate(tallest))
    panels.entitle(axes, _titles(scales, micro))
    panels.label(axes, "sliding speed (mm/s)", "friction coefficient (-)")
    handles = panels.line_handles([written(pressure) for pressure in pressures], looks)
    marks = [
        *peak_handles(*axes),
        *found_handles(*axes),
        *_crosses(axes)[:1],
        band_handle(grid.values, errors.values, rubber=data if data is None else data.values),
    ]
    panels.legend_beside(figure, [*handles, *marks], "nominal pressure\n(MPa)")
    return figure


def _cross(panel: Axes, speeds: Array, values: Array) -> None:
    """Mark points at which friction is an extrapolation of the rubber's data; NaN for the others."""
    known = np.isfinite(values)
    if known.any():
        look: dict[str, Any] = {"linestyle": "none", "marker": "x", "color": "black", "markersize": 4.5, "zorder": 4.0}
        panel.plot(speeds[known], values[known], gid=_CROSS, label="beyond the measured\nfrequencies", **look)


def _crosses(axes: Sequence[Axes]) -> list[Line2D]:
    return [line for panel in axes for line in panel.get_lines() if line.get_gid() == _CROSS]


def _titles(scales: list[int], micro: bool) -> list[str]:
    """Return the names of scales from fine to coarse."""
    titles = [f"scale {scale}" for scale in scales]
    if micro and len(scales) > 1:
        titles[0] = f"micro-scale ({titles[0]})"
    return titles
