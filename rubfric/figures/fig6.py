"""Figure 6: friction over speed and pressure at each scale of the road."""

from __future__ import annotations

from itertools import product

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from rubfric.figures import marks, panels, style
from rubfric.figures.bands import draw_band, explain_bands, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.refined import curve_points, draw_curve, found_handles
from rubfric.figures.scaling import plain, scale_friction, scale_speeds
from rubfric.results.selection import BEYOND, WORTH_A_WORD, friction, friction_error, pick, rubber_error

# What points are marked for: a variable of the campaign, and the number above which.
_MARKS = ((BEYOND, WORTH_A_WORD, marks.BEYOND), ("warnings", 0.0, marks.WARNED))


@style.applied()
def draw(campaign: xr.Dataset, aspect: float, micro: bool = True, curves: pd.DataFrame | None = None) -> Figure:
    """Draw the friction coefficient against speed, a line per pressure and a panel per scale, the coarsest first.

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
        are the estimated errors, those from the data of a measured rubber included; the legend,
        or a note where none is seen, gives the largest. Crosses mark points of which more than 1 % comes from
        frequencies at which the rubber was not measured, exclamation marks those that carry a warning.

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
    scales = [int(scale) for scale in grid["scale"].values]
    pressures = [float(pressure) for pressure in grid["pressure"].values]
    speeds = grid["velocity"].values
    fields = [friction(campaign, aspect=aspect, scale=scale) for scale in scales]
    looks = style.lines(len(pressures))
    figure, axes = panels.arrange(len(scales), height=2.1)
    drawn, tallest = zip(axes, scales, fields, strict=True), [upper(grid.values, errors.values).ravel()]
    for (panel, scale, field), (pressure, look) in product(drawn, zip(pressures, looks, strict=True)):
        line, error = field.sel(pressure=pressure), errors.sel(scale=scale, pressure=pressure)
        if line.notnull().any():
            known = curve_points(curves, scale, pressure)
            if known is None:
                draw_band(panel, speeds, line.values, error.values, look["color"])
                panel.plot(speeds, line.values, **look)
                mark_peak(panel, speeds, line.values, look["color"])
            else:
                tallest.append(draw_curve(panel, known, look))
    scale_speeds(axes[0], speeds)
    scale_friction(axes[0], np.concatenate(tallest))
    for (panel, scale, field), (name, least, mark) in product(zip(axes, scales, fields, strict=True), _MARKS):
        if name in campaign:
            found = pick(campaign, name, aspect=aspect, scale=scale).transpose("velocity", "pressure")
            values = field.transpose("velocity", "pressure").values
            mark.put(panel, speeds.repeat(values.shape[1]), values.ravel(), (found.values > least).ravel())
    panels.entitle(axes, _titles(campaign, scales, micro))
    panels.label(axes, "Sliding speed (mm/s)", "Friction coefficient")
    handles = panels.line_handles([plain(pressure) for pressure in pressures], looks)
    points = [
        *peak_handles(*axes),
        *found_handles(*axes),
        *(handle for _, _, mark in _MARKS for handle in mark.handles(axes)),
    ]
    of_rubber = data if data is None else data.values
    bands = explain_bands(figure, axes[0], grid.values, errors.values, rubber=of_rubber)
    panels.legend_beside(figure, [*handles, *points, *bands], "Nominal pressure\n(MPa)")
    return figure


def _titles(campaign: xr.Dataset, scales: list[int], micro: bool) -> list[str]:
    """Return the names of scales from coarse to fine, with their wavelengths."""
    titles = [panels.scale_words(campaign, scale) for scale in scales]
    if micro and len(scales) > 1:
        titles[-1] += " (micro-scale)"
    return titles
