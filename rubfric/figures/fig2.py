"""Figure 2: strain-energy density of the nodes over the height in the block."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from rubfric.figures import panels, style
from rubfric.figures.scaling import plain, scale_decades
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed

Array = NDArray[np.float64]

_FRICTION = "friction_coefficient"
_VARIABLES = (
    "mesh_node_y",
    "strain_energy_density",
    "depth",
    "strain_energy_density_profile",
    "pressed_energy_density",
    _FRICTION,
)
# Speeds that are drawn at most, and which they are of more.
_MOST = 3
_CHOSEN = "The slowest, the fastest and, between them, the speed of most friction"
_STEADY: dict[str, Any] = {"color": "black", "linewidth": 0.7, "linestyle": (0, (7, 3))}
# The ordinate begins at this fraction of the steady value: single nodes are all but unstrained.
_LOWEST = 0.1


@style.applied()
def draw(results: Sequence[xr.Dataset]) -> Figure:
    """Draw the strain-energy density against the height in the block, a panel per pressure and three speeds at most.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        As built by ``results.dataset.build``, of one scale and height-to-width ratio, at every pressure and speed.

    Returns
    -------
    matplotlib.figure.Figure
        Thick lines are means over a wavelength; bands run from the smallest to the largest value of the nodes at a
        height, down to a tenth of the steady value at most. A long-dashed line marks that value: the density of the
        relaxed block on a flat road under the load, which small and finite strain put a little apart. Far from the road
        means come to lie on it in small strain, and above it in finite strain by the mean shear that friction causes.
        Heights are those above the lower face of the undeformed block.

    Raises
    ------
    InvalidInput
        Where the results do not fill a grid of pressures and speeds, or lack something.
    """
    grid = by_pressure_and_speed(results, _VARIABLES)
    speeds = _shown(grid)
    looks = style.lines(len(speeds))
    figure, axes = panels.arrange(len(grid.pressures), height=2.7, share_ordinate=False)
    for panel, pressure in zip(axes, grid.pressures, strict=True):
        scenes = [grid.results[pressure, speed] for speed in speeds]
        for result, look in zip(scenes, looks, strict=True):
            _draw_scene(panel, result, look)
        levels = sorted({float(result["pressed_energy_density"]) for result in scenes})
        for level in levels:
            panel.axhline(level, gid="steady", zorder=2.5, **_STEADY)
        _scale_density(panel, scenes, levels)
    _scale_height(axes[0], results)
    panels.entitle(axes, [panels.place_words(pressure=pressure) for pressure in grid.pressures])
    panels.label(axes, "Height in the undeformed block (mm)", "Strain-energy density (MPa)")
    handles = panels.line_handles([f"Mean at {plain(speed)} mm/s" for speed in speeds], looks)
    handles += [Patch(facecolor="0.85", edgecolor="0.4", linewidth=0.5, label="Range of the nodes")]
    handles += [Line2D([], [], label="Steady value on a flat road", **_STEADY)]
    panels.legend_above(figure, handles, None, 2 if len(axes) == 1 else 3)
    hidden = [plain(speed) for speed in grid.speeds if speed not in speeds]
    if hidden:
        panels.write_note(figure, [f"{_CHOSEN} are drawn, but not {', '.join(hidden)} mm/s."])
    return figure


def _shown(grid: SceneGrid) -> tuple[float, ...]:
    """Return the speeds that are drawn: all of three, else the slowest, the fastest, and the best grip between them."""
    if len(grid.speeds) <= _MOST:
        return grid.speeds
    slowest, *between, fastest = grid.speeds
    grip = {speed: sum(float(grid.results[one, speed][_FRICTION]) for one in grid.pressures) for speed in between}
    return slowest, max(between, key=lambda speed: grip[speed]), fastest


def _draw_scene(panel: Axes, result: xr.Dataset, look: dict[str, Any]) -> None:
    height, low, high = _extremes(result)
    thin = {"color": look["color"], "linestyle": look["linestyle"], "linewidth": 0.5}
    panel.fill_between(height, low, high, facecolor=look["color"], alpha=0.08, linewidth=0.0, gid="range")
    for edge in (low, high):
        panel.plot(height, edge, gid="edge", **thin)
    panel.plot(
        result["depth"].values, result["strain_energy_density_profile"].values, gid="mean", markevery=0.13, **look
    )


def _extremes(result: xr.Dataset) -> tuple[Array, Array, Array]:
    """Return the heights of the rows of nodes, and the smallest and largest density in each."""
    height, row = np.unique(result["mesh_node_y"].values, return_inverse=True)
    density = result["strain_energy_density"].values
    low, high = np.full(height.size, np.inf), np.full(height.size, -np.inf)
    np.minimum.at(low, row, density)
    np.maximum.at(high, row, density)
    return height, low, high


def _scale_density(panel: Axes, scenes: Sequence[xr.Dataset], steady: Sequence[float]) -> None:
    density = np.concatenate([result["strain_energy_density"].values for result in scenes])
    positive = density[density > 0.0]
    if positive.size == 0 or steady[0] <= 0.0:
        panel.set_ylim(0.0, 1.0)
        return
    low, high = max(float(positive.min()) / 1.3, _LOWEST * steady[0]), max(float(positive.max()), steady[-1])
    scale_decades(panel, low, 1.3 * high)


def _scale_height(panel: Axes, results: Sequence[xr.Dataset]) -> None:
    panel.set_xlim(0.0, max(float(result["depth"].values.max()) for result in results))
    panel.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
