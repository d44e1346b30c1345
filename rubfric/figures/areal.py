"""Areal roads: where rubber touches, slow and fast, light and heavy; friction, contact and pressures beside theory."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.special import erfinv

from rubfric.errors import InvalidInput
from rubfric.figures import style
from rubfric.figures.scaling import plain, scale_speeds, tick_decades

_HEIGHTS = (2.1, 2.2, 2.2)
# Bins of pressure in a factor of ten.
_BINS = 8
# What lines in the middle are.
_THEORIES: dict[str, dict[str, Any]] = {
    "persson": {"linestyle": "-", "label": "Persson 2001"},
    "persson reduced": {"linestyle": ":", "label": "Persson 2006"},
    "plane": {"linestyle": "--", "label": "Profiles, plane model"},
}
_ROAD, _PRESSURE = "Greys_r", "plasma"
_LINES = (
    (
        "friction_coefficient",
        "persson_friction",
        "persson_friction_reduced",
        "friction_plane",
        "Friction coefficient",
    ),
    ("contact_fraction", "persson_contact_fraction", "", "contact_plane", "Contact area over nominal"),
)


@style.applied()
def draw(
    maps: Sequence[xr.Dataset], curves: Sequence[Sequence[xr.Dataset]], table: pd.DataFrame | None = None
) -> Figure:
    """Draw contact maps in a row, and below them curves beside Persson's theory.

    They are friction and contact over speed, and for each map, from which wavelengths friction comes and how pressures
    are distributed.

    Parameters
    ----------
    maps : sequence of xarray.Dataset
        Results as from ``rubfric.results.areal.build``, one a map, one at least.
    curves : sequence of sequence of xarray.Dataset
        Results of one pressure and several speeds, a sequence for each pressure.
    table : pandas.DataFrame, optional
        As from ``rubfric.results.areal_table.areal_table`` of these results: what their profiles came to.

    Returns
    -------
    matplotlib.figure.Figure
        Heights of the road are grey, the higher the lighter; contact pressures are coloured, on one logarithmic scale.
        Bars are estimated errors; in the middle full lines are Persson 2001 and dotted ones Persson 2006, dashed ones
        the plane model on profiles; at the bottom full lines the simulation and dashed ones Persson 2001.

    Raises
    ------
    InvalidInput
        Where there is no map, or no curve.
    """
    if not maps or not any(curves):
        raise InvalidInput("a figure of an areal road needs at least one result for a map and one for a curve")
    figure = Figure(figsize=(style.DOUBLE_COLUMN, sum(_HEIGHTS)), layout="constrained")
    upper, lower, lowest = np.array(figure.subfigures(3, 1, height_ratios=_HEIGHTS), dtype=object)
    _draw_maps(upper, maps)
    looks = style.lines(len(curves))
    for axes, names in zip(lower.subplots(1, 2), _LINES, strict=True):
        for look, results in zip(looks, curves, strict=True):
            _draw_curve(axes, sorted(results, key=lambda one: float(one.attrs["velocity"])), names, look)
            if table is not None and names[3] in table:
                rows = table[table["pressure_MPa"] == float(results[0].attrs["pressure"])]
                axes.plot(rows["velocity_mm_per_s"], rows[names[3]], "--", color=look["color"], gid="plane")
        scale_speeds(axes, np.array([float(one.attrs["velocity"]) for results in curves for one in results]))
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("Sliding speed (mm/s)")
        axes.set_ylabel(names[-1])
    axes.legend(handles=[*axes.get_legend_handles_labels()[0], *_line_handles(lower)], loc="best")
    cut_off, pressures = lowest.subplots(1, 2)
    for look, result in zip(style.lines(len(maps)), maps, strict=True):
        _draw_wavelengths(cut_off, result, look["color"])
        _draw_pressures(pressures, result, look["color"])
    cut_off.set_xscale("log")
    tick_decades(cut_off.xaxis, *cut_off.get_xlim())
    cut_off.invert_xaxis()
    cut_off.set_xlabel("Shortest wavelength counted (mm)")
    cut_off.set_ylim(bottom=0.0)
    cut_off.set_ylabel("Friction over that of all waves")
    pressures.set_xscale("log")
    tick_decades(pressures.xaxis, *pressures.get_xlim())
    pressures.set_ylim(bottom=0.0)
    pressures.set_xlabel("Contact pressure (MPa)")
    pressures.set_ylabel("Share of contact area\nper unit of its logarithm")
    cut_off.legend(loc="best")
    return figure


def _line_handles(figure: Any) -> list[Line2D]:
    """Return the legend's entries for the lines that are there."""
    drawn = {str(line.get_gid()) for axes in figure.axes for line in axes.get_lines()}
    return [Line2D([], [], color="0.3", **look) for gid, look in _THEORIES.items() if gid in drawn]


def _draw_wavelengths(axes: Axes, result: xr.Dataset, colour: str) -> None:
    """Draw friction of all wavelengths down to each, over that of all by simulation."""
    label = f"{plain(float(result.attrs['velocity']))} mm/s, {plain(float(result.attrs['pressure']))} MPa"
    for name, line, known in (("friction_by_wavelength", "-", label), ("persson_friction_by_wavelength", "--", None)):
        share = np.cumsum(result[name].values) / float(result.friction_coefficient or np.nan)
        axes.plot(result.wavelength, share, line, color=colour, label=known)


def _draw_pressures(axes: Axes, result: xr.Dataset, colour: str) -> None:
    """Draw how pressures are distributed, by Persson's theory as the difference of two normal distributions."""
    pressure, nominal = result.contact_pressure.values, float(result.attrs["pressure"])
    share = float(result.persson_contact_fraction)
    largest = float(pressure.max())
    edges = np.geomspace(0.1 * nominal, 1.001 * largest, max(2, round(_BINS * np.log10(10.0 * largest / nominal))) + 1)
    touching = np.count_nonzero(pressure)
    count = np.histogram(pressure, edges)[0] / touching / np.diff(np.log(edges))
    axes.stairs(count, edges, color=colour)
    if not 0.0 < share < 1.0:
        return
    # P(p) = erf(p / sqrt(2 V)), V being the variance of pressure in full contact.
    width = nominal / erfinv(share)
    where = np.geomspace(edges[0], max(edges[-1], nominal + 3.0 * width), 200)
    normal = np.exp(-(((where - nominal) / width) ** 2)) - np.exp(-(((where + nominal) / width) ** 2))
    density = where * normal / (np.sqrt(np.pi) * width) * pressure.size / touching
    axes.plot(where, density, "--", color=colour, gid="persson")


def _draw_maps(figure: Any, maps: Sequence[xr.Dataset]) -> None:
    panels = np.atleast_1d(figure.subplots(1, len(maps)))
    largest = max(
        float(np.quantile(one.contact_pressure.values[one.contact_pressure.values > 0.0], 0.98)) for one in maps
    )
    interval = min(float(one.attrs["pressure"]) for one in maps), largest
    norm = LogNorm(*interval)
    for axes, result in zip(panels, maps, strict=True):
        spacing = [float(result[name][1] - result[name][0]) for name in ("x", "y")]
        extent = (0.0, spacing[0] * result.sizes["x"], 0.0, spacing[1] * result.sizes["y"])
        axes.imshow(result.road_height, origin="lower", extent=extent, cmap=_ROAD, alpha=0.6)
        pressure = np.ma.masked_equal(result.contact_pressure.values, 0.0)
        image = axes.imshow(pressure, origin="lower", extent=extent, cmap=_PRESSURE, norm=norm)
        velocity, load = float(result.attrs["velocity"]), float(result.attrs["pressure"])
        share = style.percent(float(result.contact_fraction))
        axes.set_title(f"{plain(velocity)} mm/s, {plain(load)} MPa\n{share} in contact")
        axes.locator_params(nbins=3)
        axes.set_xlabel("$x$ (mm)")
        axes.label_outer()
    panels[0].set_ylabel("$y$ (mm)")
    bar = figure.colorbar(image, ax=list(panels), label="Contact pressure (MPa)", extend="both", shrink=0.7)
    tick_decades(bar.ax.yaxis, *interval)


def _draw_curve(axes: Axes, results: Sequence[xr.Dataset], names: tuple[str, ...], look: dict[str, Any]) -> None:
    main, theory, reduced, *_ = names
    speeds = [float(one.attrs["velocity"]) for one in results]

    def values(name: str) -> list[float]:
        return [float(one[name]) for one in results]

    errors = values("friction_error") if main == "friction_coefficient" else None
    points = {name: look[name] for name in ("color", "marker", "markerfacecolor")}
    label = f"{plain(float(results[0].attrs['pressure']))} MPa"
    axes.errorbar(speeds, values(main), errors, linestyle="none", capsize=1.5, label=label, **points)
    axes.plot(speeds, values(theory), color=look["color"], gid="persson")
    if reduced:
        axes.plot(speeds, values(reduced), color=look["color"], linestyle=":", gid="persson reduced")
