"""Figure 4: the deformed block on the road, coloured by strain-energy density."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator
from matplotlib.tri import Triangulation

from rubfric.figures import style
from rubfric.figures.deformation import deform, wavelength
from rubfric.figures.panels import letter
from rubfric.figures.scaling import tick_decades
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed

_VARIABLES = (
    "mesh_node_x",
    "mesh_node_y",
    "mesh_face_nodes",
    "displacement_y",
    "strain_energy_density",
    "surface_x",
    "road_height",
    "contact_fraction",
    "nominal_compression",
)
_MAP = "viridis"
_PLATE = {"boxstyle": "square,pad=0.1", "facecolor": "0.93", "linewidth": 0.0}
# The window in wavelengths: its width, its room below the road, and its height above the road's mean plane.
_WIDTH, _BELOW, _ABOVE = 1.25, 0.11, 0.5
# Margins, gaps and the largest panel, in inches.
_LEFT, _RIGHT, _TOP, _BOTTOM, _GAP, _WIDEST = 0.78, 0.72, 0.22, 0.62, 0.09, 2.4


@dataclass(frozen=True)
class _Window:
    """What every panel shows, mm."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def proportion(self) -> float:
        """Height over width."""
        return (self.top - self.bottom) / (self.right - self.left)

    @property
    def inscription(self) -> tuple[float, float]:
        """Middle of the solid below the troughs of the road, mm."""
        solid = _BELOW * (self.right - self.left) / _WIDTH
        return 0.5 * (self.left + self.right), self.bottom + 0.45 * solid


@style.applied()
def draw(results: Sequence[xr.Dataset]) -> Figure:
    """Draw the lower part of the block and the road below it, a row per pressure and a column per speed.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        As built by ``rubfric.dataset.build``, of one scale and height-to-width ratio, at every pressure and speed.

    Returns
    -------
    matplotlib.figure.Figure
        The block repeats along the road and slides to the right. It is shown to half a wavelength above the road,
        with its vertical displacements to scale but without its mean compression, which is told below the panels.

    Raises
    ------
    InvalidInput
        Where the results do not fill a grid of pressures and speeds, or lack something.
    """
    grid = by_pressure_and_speed(results, _VARIABLES)
    window = _window(results)
    norm = _colour_scale(results)
    figure, axes = _arrange(len(grid.pressures), len(grid.speeds), window)
    for place, (panel, (pressure, speed)) in enumerate(zip(axes, product(grid.pressures, grid.speeds), strict=True)):
        _draw_scene(panel, grid.results[pressure, speed], window, norm)
        contact = 100.0 * float(grid.results[pressure, speed]["contact_fraction"])
        text = f"{letter(place)} contact {contact:.0f} %"
        panel.text(*window.inscription, text, fontsize=6.0, ha="center", va="center", bbox=_PLATE)
    _label(figure, axes, grid)
    _colour_bar(figure, norm)
    return figure


def _window(results: Sequence[xr.Dataset]) -> _Window:
    """Return one and a quarter wavelengths about a crest."""
    road = results[0]["road_height"].values
    width = wavelength(results[0])
    crest = float(results[0]["surface_x"].values[np.argmax(road)])
    return _Window(
        left=crest - 0.5 * _WIDTH * width,
        right=crest + 0.5 * _WIDTH * width,
        bottom=float(road.min()) - _BELOW * width,
        top=_ABOVE * width,
    )


def _colour_scale(results: Sequence[xr.Dataset]) -> LogNorm:
    """Return a scale from a low percentile, below which colour tells nothing, to the largest density."""
    density = np.concatenate([result["strain_energy_density"].values for result in results])
    positive = density[density > 0.0]
    if positive.size == 0:
        return LogNorm(1e-3, 1.0, clip=True)
    low, high = float(np.percentile(positive, 3.0)), float(positive.max())
    return LogNorm(min(low, 0.5 * high), high, clip=True)


def _arrange(rows: int, columns: int, window: _Window) -> tuple[Figure, list[Axes]]:
    """Return panels row by row, of the window's proportions, so that none is surrounded by empty paper."""
    room = style.DOUBLE_COLUMN - _LEFT - _RIGHT - (columns - 1) * _GAP
    panel = min(room / columns, _WIDEST)
    high = panel * window.proportion
    width = _LEFT + _RIGHT + columns * panel + (columns - 1) * _GAP
    height = _TOP + _BOTTOM + rows * high + (rows - 1) * _GAP
    figure = Figure(figsize=(width, height))
    grid = figure.subplots(
        rows,
        columns,
        sharex=True,
        sharey=True,
        squeeze=False,
        gridspec_kw={
            "left": _LEFT / width,
            "right": 1.0 - _RIGHT / width,
            "bottom": _BOTTOM / height,
            "top": 1.0 - _TOP / height,
            "wspace": _GAP / panel,
            "hspace": _GAP / high,
        },
    )
    first = grid[0, 0]
    first.set_xlim(window.left, window.right)
    first.set_ylim(window.bottom, window.top)
    for axis in (first.xaxis, first.yaxis):
        axis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
        axis.set_major_formatter(FuncFormatter(lambda value, _: style.written(value)))
    return figure, list(grid.flat)


def _label(figure: Figure, axes: Sequence[Axes], grid: SceneGrid) -> None:
    """Write speeds above the columns, pressures beside the rows, the axes' names, and what is shown."""
    columns = len(grid.speeds)
    for panel, speed in zip(axes, grid.speeds, strict=False):
        panel.set_title(f"{style.written(speed)} mm/s")
    for panel, pressure in zip(axes[::columns], grid.pressures, strict=True):
        panel.set_ylabel("height (mm)", fontsize=6.5)
        place = panel.get_position()
        figure.text(
            0.03 / figure.get_figwidth(), 0.5 * (place.y0 + place.y1), f"{style.written(pressure)}\nMPa", va="center"
        )
    for panel in axes[-columns:]:
        panel.set_xlabel("along the road (mm)", fontsize=6.5)
    width, height = figure.get_size_inches()
    figure.text(_LEFT / width, 0.04 / height, _note(grid, int(18.0 * width)), fontsize=6.0, va="bottom")


def _draw_scene(panel: Axes, result: xr.Dataset, window: _Window, norm: LogNorm) -> None:
    block = deform(result, window.left, window.right, window.top)
    # Without a strain there is no colour on a logarithmic scale.
    energy = np.maximum(block.energy, np.finfo(np.float64).tiny)
    mesh = Triangulation(block.x, block.y, block.triangles)
    panel.tripcolor(mesh, energy, shading="gouraud", cmap=_MAP, norm=norm, rasterized=True)
    panel.plot(block.lower_x, block.lower_y, color="black", linewidth=0.6)
    x = np.linspace(window.left, window.right, 400)
    road = np.interp(x, result["surface_x"].values, result["road_height"].values, period=wavelength(result))
    panel.fill_between(x, window.bottom, road, facecolor="0.93", edgecolor="0.6", hatch="//////", linewidth=0.0)
    panel.plot(x, road, color="black", linewidth=0.4)


def _colour_bar(figure: Figure, norm: LogNorm) -> None:
    width, height = figure.get_size_inches()
    place = (1.0 - (_RIGHT - 0.08) / width, _BOTTOM / height, 0.09 / width, 1.0 - (_BOTTOM + _TOP) / height)
    bar = figure.colorbar(ScalarMappable(norm, _MAP), cax=figure.add_axes(place), extend="min")
    bar.set_label("strain-energy density (MPa)")
    tick_decades(bar.ax.yaxis, *bar.ax.get_ylim())


def _note(grid: SceneGrid, characters: int) -> str:
    """Return what a reader has to know about the picture of the block."""
    strains = [float(grid.results[pressure, grid.speeds[0]]["nominal_compression"]) for pressure in grid.pressures]
    listed = ", ".join(
        f"{100.0 * strain:.2g} % at {style.written(pressure)} MPa"
        for strain, pressure in zip(strains, grid.pressures, strict=True)
    )
    return textwrap.fill(
        "Lower part of the block, which slides to the right. Its vertical displacements are to scale, but without the mean "
        f"compression of the block ({listed}).",
        characters,
    )
