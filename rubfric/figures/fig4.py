"""Figure 4: the deformed block on the road, coloured by strain-energy density."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rubfric.figures import style
from rubfric.figures.deformation import deform, wavelength
from rubfric.figures.panels import letter
from rubfric.figures.scaling import tick_decades
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed

_VARIABLES = (
    "mesh_node_x",
    "mesh_node_y",
    "displacement_y",
    "strain_energy_density",
    "surface_x",
    "road_height",
    "contact_fraction",
    "nominal_compression",
)
_MAP = "viridis"
_ROAD: dict[str, Any] = {"facecolor": "0.93", "edgecolor": "0.6", "hatch": "//////", "linewidth": 0.0}
_PLATE: dict[str, Any] = {"boxstyle": "square,pad=0.1", "facecolor": "0.93", "linewidth": 0.0}
# The window in wavelengths: its width, its room below the road, and its height above the road's mean plane.
_WIDTH, _BELOW, _ABOVE = 1.25, 0.11, 0.5
# Heights at which the field is sampled: as fine as print shows.
_SAMPLES = 320
# In inches: the margins without the note, a line of the note, the gaps, the widest panel, and the narrowest for words.
_LEFT, _RIGHT, _TOP, _BOTTOM, _NOTE_LINE = 0.78, 0.72, 0.22, 0.42, 0.105
_GAP, _WIDEST, _NARROW = 0.09, 2.4, 1.2
# Sizes of type, in points.
_SMALL, _SMALLEST = 6.0, 5.0


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


@dataclass(frozen=True)
class _Sheet:
    """Sizes of the figure and of a panel, in inches, and the note below the panels."""

    width: float
    height: float
    panel_width: float
    panel_height: float
    bottom: float
    note: str


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
        Each panel tells the share of the nominal area in contact.

    Raises
    ------
    InvalidInput
        Where the results do not fill a grid of pressures and speeds, or lack something.
    """
    grid = by_pressure_and_speed(results, _VARIABLES)
    window = _window(results[0])
    norm = _colour_scale(results)
    sheet = _sheet(grid, window)
    figure, axes = _arrange(grid, window, sheet)
    for place, (panel, (pressure, speed)) in enumerate(zip(axes, product(grid.pressures, grid.speeds), strict=True)):
        result = grid.results[pressure, speed]
        _draw_scene(panel, result, window, norm)
        _inscribe(panel, place, float(result["contact_fraction"]), window, sheet)
    _label(figure, axes, grid, sheet)
    _colour_bar(figure, norm, sheet)
    return figure


def _window(result: xr.Dataset) -> _Window:
    """Return one and a quarter wavelengths about a crest."""
    road = result["road_height"].values
    width = wavelength(result)
    crest = float(result["surface_x"].values[np.argmax(road)])
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


def _sheet(grid: SceneGrid, window: _Window) -> _Sheet:
    """Give panels the window's proportions, so that no paper is left empty around them."""
    rows, columns = len(grid.pressures), len(grid.speeds)
    panel_width = min((style.DOUBLE_COLUMN - _LEFT - _RIGHT - (columns - 1) * _GAP) / columns, _WIDEST)
    panel_height = panel_width * window.proportion
    width = _LEFT + _RIGHT + columns * panel_width + (columns - 1) * _GAP
    note = textwrap.wrap(_note(grid, panel_width < _NARROW), int(19.0 * (width - _LEFT)))
    bottom = _BOTTOM + _NOTE_LINE * len(note)
    height = _TOP + bottom + rows * panel_height + (rows - 1) * _GAP
    return _Sheet(width, height, panel_width, panel_height, bottom, "\n".join(note))


def _arrange(grid: SceneGrid, window: _Window, sheet: _Sheet) -> tuple[Figure, list[Axes]]:
    """Return the panels row by row."""
    figure = Figure(figsize=(sheet.width, sheet.height))
    figure.subplots_adjust(
        left=_LEFT / sheet.width,
        right=1.0 - _RIGHT / sheet.width,
        bottom=sheet.bottom / sheet.height,
        top=1.0 - _TOP / sheet.height,
        wspace=_GAP / sheet.panel_width,
        hspace=_GAP / sheet.panel_height,
    )
    panels = figure.subplots(len(grid.pressures), len(grid.speeds), squeeze=False)
    for panel in panels.flat:
        # Limits set at once spare the panels, images and all, from following each other's.
        panel.autoscale(False)
        panel.set(xlim=(window.left, window.right), ylim=(window.bottom, window.top))
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
            axis.set_major_formatter(FuncFormatter(lambda value, _: style.written(value)))
        panel.label_outer()
    return figure, list(panels.flat)


def _draw_scene(panel: Axes, result: xr.Dataset, window: _Window, norm: LogNorm) -> None:
    block = deform(result, window.left, window.right, np.linspace(window.bottom, window.top, _SAMPLES))
    # Without a strain there is no colour on a logarithmic scale.
    density = np.maximum(block.density, np.finfo(np.float64).tiny)
    image = panel.imshow(
        density, cmap=_MAP, norm=norm, origin="lower", extent=block.extent, aspect="auto", interpolation="bilinear"
    )
    image.set_clip_path(Path(block.outline), panel.transData)
    panel.plot(*block.lower_face, color="black", linewidth=0.6)
    x = np.linspace(window.left, window.right, 400)
    road = np.interp(x, result["surface_x"].values, result["road_height"].values, period=wavelength(result))
    panel.fill_between(x, window.bottom, road, **_ROAD)
    panel.plot(x, road, color="black", linewidth=0.4)


def _inscribe(panel: Axes, place: int, contact: float, window: _Window, sheet: _Sheet) -> None:
    """Write the panel's letter and the share in contact into the solid below the road."""
    word = "" if sheet.panel_width < _NARROW else "contact "
    solid = _BELOW / _WIDTH
    size = min(_SMALL, max(_SMALLEST, 50.0 * solid * sheet.panel_width))
    middle = window.bottom + 0.45 * solid * (window.right - window.left)
    text = f"{letter(place)} {word}{100.0 * contact:.0f} %"
    panel.text(0.5 * (window.left + window.right), middle, text, fontsize=size, ha="center", va="center", bbox=_PLATE)


def _label(figure: Figure, axes: Sequence[Axes], grid: SceneGrid, sheet: _Sheet) -> None:
    """Write speeds above the columns, pressures beside the rows, the names of the axes, and the note."""
    columns = len(grid.speeds)
    for panel, speed in zip(axes, grid.speeds, strict=False):
        panel.set_title(f"{style.written(speed)} mm/s")
    for panel, pressure in zip(axes[::columns], grid.pressures, strict=True):
        place = panel.get_position()
        text = f"{style.written(pressure)}\nMPa"
        figure.text(0.03 / sheet.width, 0.5 * (place.y0 + place.y1), text, va="center")
    middle = 0.5 * (_LEFT + sheet.width - _RIGHT) / sheet.width
    figure.text(middle, (sheet.bottom - 0.32) / sheet.height, "distance along the road (mm)", ha="center")
    middle = 0.5 * (sheet.bottom + sheet.height - _TOP) / sheet.height
    figure.text(0.36 / sheet.width, middle, "height (mm)", rotation="vertical", va="center")
    figure.text(_LEFT / sheet.width, 0.04 / sheet.height, sheet.note, fontsize=_SMALL, va="bottom")


def _colour_bar(figure: Figure, norm: LogNorm, sheet: _Sheet) -> None:
    left, high = sheet.width - _RIGHT + 0.08, sheet.height - sheet.bottom - _TOP
    place = (left / sheet.width, sheet.bottom / sheet.height, 0.09 / sheet.width, high / sheet.height)
    bar = figure.colorbar(ScalarMappable(norm, _MAP), cax=figure.add_axes(place), extend="min")
    bar.set_label("strain-energy density (MPa)")
    tick_decades(bar.ax.yaxis, *bar.ax.get_ylim())


def _note(grid: SceneGrid, narrow: bool) -> str:
    """Return what a reader has to know about the picture of the block."""
    strains = [float(grid.results[pressure, grid.speeds[0]]["nominal_compression"]) for pressure in grid.pressures]
    listed = ", ".join(
        f"{100.0 * strain:.2g} % at {style.written(pressure)} MPa"
        for strain, pressure in zip(strains, grid.pressures, strict=True)
    )
    shares = " Percentages: share of the nominal area in contact." if narrow else ""
    return (
        "Lower part of the block, which slides to the right. Its vertical displacements are to scale, "
        f"but without the mean compression of the block ({listed}).{shares}"
    )
