"""The deformed block and the road below it, drawn in a panel, and the colours of its strain-energy density."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from rubfric.arrays import Real
from rubfric.figures.deformation import DeformedBlock, wavelength
from rubfric.figures.scaling import tick_decades

_MAP = "viridis"
_ROAD: dict[str, Any] = {"facecolor": "0.93", "edgecolor": "0.6", "hatch": "//////", "linewidth": 0.0}
_NET: dict[str, Any] = {"color": "white", "linewidth": 0.3, "alpha": 0.6}
# Words in the solid below the road stand on this.
PLATE: dict[str, Any] = {"boxstyle": "square,pad=0.1", "facecolor": "0.93", "linewidth": 0.0}
# The width of the colour bar, the length of its label on one line, and the least distance of its ticks, in inches.
_WIDE, _LABEL, _APART = 0.09, 1.5, 0.11
_SMALL = 6.0


def colour_scale(results: Sequence[xr.Dataset]) -> LogNorm:
    """Return a scale from a low percentile, below which the colour is constant, to the largest density."""
    density = np.concatenate([np.zeros(0), *(result["strain_energy_density"].values for result in results)])
    positive = density[density > 0.0]
    if positive.size == 0:
        return LogNorm(1e-3, 1.0, clip=True)
    low, high = float(np.percentile(positive, 3.0)), float(positive.max())
    return LogNorm(min(low, 0.5 * high), high, clip=True)


def draw_block(panel: Axes, block: DeformedBlock, norm: LogNorm, net: bool = True) -> None:
    """Draw a block, its net and its two faces.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    block : DeformedBlock
    norm : matplotlib.colors.LogNorm
        Of the strain-energy density, MPa.
    net : bool
        Whether there is room for the net.
    """
    # Without a strain there is no colour on a logarithmic scale. A PDF with every cell in it would be large.
    density = np.maximum(block.density, np.finfo(np.float64).tiny)
    panel.pcolormesh(block.x, block.y, density, cmap=_MAP, norm=norm, shading="gouraud", rasterized=True, zorder=0.5)
    if net:
        seen = [line.T for line in block.net if _meets(line, panel)]
        panel.add_collection(LineCollection(seen, zorder=0.6, **_NET), autolim=False)
    for face, name in ((block.lower_face, "lower face"), (block.upper_face, "upper face")):
        panel.plot(*face, color="black", linewidth=0.6, gid=name)


def _meets(line: Real, panel: Axes) -> bool:
    """Return whether the box around a line, shape (2, points), meets the limits of a panel."""
    limits = (panel.get_xlim(), panel.get_ylim())
    return all(part.max() >= low and part.min() <= high for part, (low, high) in zip(line, limits, strict=True))


def draw_road(panel: Axes, x: Real, height: Real, hatched: bool = True) -> None:
    """Draw the road down to the lower edge of a panel.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    x, height : numpy.ndarray, shape (points,)
        mm.
    hatched : bool
        Whether there is room for a hatch.
    """
    look = _ROAD if hatched else _ROAD | {"hatch": None}
    panel.fill_between(x, panel.get_ylim()[0], height, **look)
    panel.plot(x, height, color="black", linewidth=0.4, gid="road")


def contacts(result: xr.Dataset) -> list[tuple[float, float]]:
    """Return the ends, mm, of every stretch of the road that rubber touches; one node is as wide as a column."""
    order = np.argsort(result["surface_position"].values)
    place, pressure = (result[name].values[order] for name in ("surface_position", "contact_pressure"))
    half = 0.5 * wavelength(result) / place.size
    touching = np.flatnonzero(pressure > 0.0)
    runs = np.split(touching, np.flatnonzero(np.diff(touching) > 1) + 1)
    return [(float(place[run[0]] - half), float(place[run[-1]] + half)) for run in runs if run.size]


def colour_bar(figure: Figure, norm: LogNorm, left: float, bottom: float, top: float) -> None:
    """Draw the colours of the strain-energy density beside the panels.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    norm : matplotlib.colors.LogNorm
    left, bottom, top : float
        Its edges, in inches from the lower left corner of the figure.
    """
    width, height = figure.get_size_inches()
    high = top - bottom
    place = (left / width, bottom / height, _WIDE / width, high / height)
    bar = figure.colorbar(ScalarMappable(norm, _MAP), cax=figure.add_axes(place), extend="min")
    if high > _LABEL:
        bar.set_label("Strain-energy density (MPa)")
    else:
        bar.set_label("Strain-energy\ndensity (MPa)", fontsize=_SMALL, labelpad=1.0)
    lowest, highest = bar.ax.get_ylim()
    tick_decades(bar.ax.yaxis, lowest, highest)
    if high < _LABEL:
        bar.ax.yaxis.set_major_locator(LogLocator(10.0, subs=_ticks_in_decade(high / np.log10(highest / lowest))))


def _ticks_in_decade(room: float) -> tuple[float, ...]:
    """Return as many multiples of a power of ten as find room on a decade, inches."""
    choices = ((1.0, 2.0, 3.0, 4.0, 6.0), (1.0, 2.0, 5.0))
    roomy = (choice for choice in choices if np.diff(np.log10([*choice, 10.0])).min() * room > _APART)
    return next(roomy, (1.0,))
