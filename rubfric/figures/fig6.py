"""Figure 6: friction over speed and pressure at each scale of the road."""

from __future__ import annotations

from itertools import product

import xarray as xr
from matplotlib.figure import Figure

from rubfric.figures import panels, style
from rubfric.figures.bands import band_handle, draw_band, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.results.selection import friction, friction_error, rubber_error, written


@style.applied()
def draw(campaign: xr.Dataset, aspect: float, micro: bool = True) -> Figure:
    """Draw the friction coefficient against speed, a line per pressure and a panel per scale, the finest first.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``results.campaign.collect``; pressures at which no block of this ratio was run are left out.
    aspect : float
        Height over width of the blocks.
    micro : bool
        Whether the finest of several scales is the paper's micro-scale.

    Returns
    -------
    matplotlib.figure.Figure
        Rings mark the largest of the sampled points of a line, where it lies between others. Bands around the lines
        are the estimated errors, those from the data of a measured rubber included; the legend gives the largest.

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
    drawn = zip(axes, scales, fields, strict=True)
    for (panel, scale, field), (pressure, look) in product(drawn, zip(pressures, looks, strict=True)):
        line, error = field.sel(pressure=pressure), errors.sel(scale=scale, pressure=pressure)
        if line.notnull().any():
            draw_band(panel, speeds, line.values, error.values, look["color"])
            panel.plot(speeds, line.values, **look)
            mark_peak(panel, speeds, line.values, look["color"])
    scale_speeds(axes[0], speeds)
    scale_friction(axes[0], upper(grid.values, errors.values))
    panels.entitle(axes, _titles(scales, micro))
    panels.label(axes, "sliding speed (mm/s)", "friction coefficient (-)")
    handles = panels.line_handles([written(pressure) for pressure in pressures], looks)
    marks = [
        *peak_handles(*axes),
        band_handle(grid.values, errors.values, rubber=data if data is None else data.values),
    ]
    panels.legend_beside(figure, [*handles, *marks], "nominal pressure\n(MPa)")
    return figure


def _titles(scales: list[int], micro: bool) -> list[str]:
    """Return the names of scales from fine to coarse."""
    titles = [f"scale {scale}" for scale in scales]
    if micro and len(scales) > 1:
        titles[0] = f"micro-scale ({titles[0]})"
    return titles
