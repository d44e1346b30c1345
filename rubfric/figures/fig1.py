"""Figure 1: friction over speed for blocks of several height-to-width ratios."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from rubfric.figures import panels, style
from rubfric.figures.bands import draw_band, explain_bands, upper
from rubfric.figures.scaling import plain, scale_friction, scale_speeds
from rubfric.results.selection import friction, friction_error


@style.applied()
def draw(campaign: xr.Dataset, scales: Sequence[int], pressures: Sequence[float], aspects: Sequence[float]) -> Figure:
    """Draw the friction coefficient against speed, a line per ratio and a panel per scale and pressure.

    Bands around the lines are the estimated errors; the legend, or a note where none is seen, gives the largest.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    scales : sequence of int
        Scales of the road, 1 being the coarsest.
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
    blocks = list(product(places, aspects))
    lines, errors = (
        {(place, aspect): pick(campaign, scale=place[0], pressure=place[1], aspect=aspect) for place, aspect in blocks}
        for pick in (friction, friction_error)
    )
    figure, axes = panels.arrange(len(places), height=2.3)
    for panel, place in zip(axes, places, strict=True):
        for aspect, look in zip(aspects, style.lines(len(aspects)), strict=True):
            line, error = lines[place, aspect], errors[place, aspect]
            draw_band(panel, line["velocity"].values, line.values, error.values, look["color"])
            panel.plot(line["velocity"].values, line.values, label=plain(aspect), **look)
    scale_speeds(axes[0], campaign["velocity"].values)
    shown, bounds = (np.concatenate([one.values for one in found.values()]) for found in (lines, errors))
    scale_friction(axes[0], upper(shown, bounds))
    panels.entitle(axes, [panels.place_words(scale=scale, pressure=pressure) for scale, pressure in places])
    panels.label(axes, "Sliding speed (mm/s)", "Friction coefficient")
    handles = [*axes[0].get_lines(), *explain_bands(figure, axes[0], shown, bounds)]
    panels.legend_beside(figure, handles, "Height-to-width\nratio")
    return figure
