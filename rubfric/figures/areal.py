"""Areal roads: where rubber touches the road, slow and fast, light and heavy; friction and contact over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import style

_MAPS_HEIGHT, _CURVES_HEIGHT = 2.1, 2.2
_ROAD, _PRESSURE = "Greys_r", "plasma"
_LINES = (
    ("friction_coefficient", "persson_friction", "persson_friction_reduced", "friction coefficient (-)"),
    ("contact_fraction", "persson_contact_fraction", "", "contact area over nominal (-)"),
)


@style.applied()
def draw(maps: Sequence[xr.Dataset], curves: Sequence[Sequence[xr.Dataset]]) -> Figure:
    """Draw contact maps in a row, and below them friction and contact over speed with Persson's theory.

    Parameters
    ----------
    maps : sequence of xarray.Dataset
        Results as from ``rubfric.results.areal.build``, one a map, one at least.
    curves : sequence of sequence of xarray.Dataset
        Results of one pressure and several speeds, a sequence for each pressure.

    Returns
    -------
    matplotlib.figure.Figure
        Heights of the road are grey, the higher the lighter; contact pressures are coloured, on one logarithmic scale.
        Bars are estimated errors, full lines Persson 2001 and dotted ones Persson 2006.

    Raises
    ------
    InvalidInput
        Where there is no map, or no curve.
    """
    if not maps or not any(curves):
        raise InvalidInput("a figure of an areal road needs at least one result for a map and one for a curve")
    figure = Figure(figsize=(style.DOUBLE_COLUMN, _MAPS_HEIGHT + _CURVES_HEIGHT), layout="constrained")
    upper, lower = np.array(figure.subfigures(2, 1, height_ratios=(_MAPS_HEIGHT, _CURVES_HEIGHT)), dtype=object)
    _draw_maps(upper, maps)
    looks = style.lines(len(curves))
    for axes, names in zip(lower.subplots(1, 2), _LINES, strict=True):
        for look, results in zip(looks, curves, strict=True):
            _draw_curve(axes, sorted(results, key=lambda one: float(one.attrs["velocity"])), names, look)
        axes.set_xscale("log")
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("sliding speed (mm/s)")
        axes.set_ylabel(names[-1])
    axes.legend(title="pressure", loc="best")
    return figure


def _draw_maps(figure: Any, maps: Sequence[xr.Dataset]) -> None:
    panels = np.atleast_1d(figure.subplots(1, len(maps)))
    largest = max(
        float(np.quantile(one.contact_pressure.values[one.contact_pressure.values > 0.0], 0.98)) for one in maps
    )
    norm = LogNorm(min(float(one.attrs["pressure"]) for one in maps), largest)
    for axes, result in zip(panels, maps, strict=True):
        spacing = [float(result[name][1] - result[name][0]) for name in ("x", "y")]
        extent = (0.0, spacing[0] * result.sizes["x"], 0.0, spacing[1] * result.sizes["y"])
        axes.imshow(result.road_height, origin="lower", extent=extent, cmap=_ROAD, alpha=0.6)
        pressure = np.ma.masked_equal(result.contact_pressure.values, 0.0)
        image = axes.imshow(pressure, origin="lower", extent=extent, cmap=_PRESSURE, norm=norm)
        velocity, load = float(result.attrs["velocity"]), float(result.attrs["pressure"])
        share = style.percent(float(result.contact_fraction))
        axes.set_title(f"{velocity:g} mm/s, {load:g} MPa\n{share} in contact")
        axes.locator_params(nbins=3)
        axes.set_xlabel("x (mm)")
        axes.label_outer()
    panels[0].set_ylabel("y (mm)")
    figure.colorbar(image, ax=list(panels), label="contact pressure (MPa)", extend="both", shrink=0.7)


def _draw_curve(axes: Axes, results: Sequence[xr.Dataset], names: tuple[str, ...], look: dict[str, Any]) -> None:
    main, theory, reduced, _ = names
    speeds = [float(one.attrs["velocity"]) for one in results]

    def values(name: str) -> list[float]:
        return [float(one[name]) for one in results]

    errors = values("friction_error") if main == "friction_coefficient" else None
    points = {name: look[name] for name in ("color", "marker", "markerfacecolor")}
    label = f"{float(results[0].attrs['pressure']):g} MPa"
    axes.errorbar(speeds, values(main), errors, linestyle="none", capsize=1.5, label=label, **points)
    axes.plot(speeds, values(theory), color=look["color"], gid="persson")
    if reduced:
        axes.plot(speeds, values(reduced), color=look["color"], linestyle=":", gid="persson reduced")
