"""Figure 4: the deformed block on the road, coloured by strain-energy density."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rubfric.figures import deformation, style
from rubfric.figures.blocks import PLATE, colour_bar, colour_scale, draw_block, draw_road
from rubfric.figures.deformation import DeformedBlock, deform, is_finite, wavelength
from rubfric.figures.note import note_below
from rubfric.figures.panels import letter
from rubfric.figures.scaling import plain
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed
from rubfric.results.selection import written

_VARIABLES = (*deformation.VARIABLES, "surface_x", "road_height", "contact_fraction", "nominal_compression")
# The window in wavelengths: its width, its room below the road and above the block, and its greatest height above the
# road's mean plane, where all results are in small strain and where some are in finite strain.
_WIDTH, _BELOW, _SKY, _LOW, _HIGH = 1.25, 0.11, 0.04, 0.5, 1.0
# In inches: the margins without the note, a line of the note, the gaps, the widest panel, and the narrowest for words.
_LEFT, _RIGHT, _TOP, _BOTTOM, _NOTE_LINE = 0.78, 0.76, 0.22, 0.42, 0.105
_GAP, _WIDEST, _NARROW = 0.09, 2.4, 1.2
# Size of type, in points.
_SMALL = 6.0


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
    """Draw the block and the road below it, a row per pressure and a column per speed.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        As built by ``results.dataset.build``, of one scale and height-to-width ratio, at every pressure and speed.

    Returns
    -------
    matplotlib.figure.Figure
        The block repeats along the road and slides to the right. In finite strain it is drawn as it is deformed, with a
        net of lines that were squares before, up to its upper face or to a wavelength above the road. In small strain
        its vertical displacements are to scale, but without its mean compression, which the note below gives; half a
        wavelength above the road is shown then. Each panel gives the share of the nominal area in contact.

    Raises
    ------
    InvalidInput
        Where the results do not fill a grid of pressures and speeds, or lack something.
    """
    grid = by_pressure_and_speed(results, _VARIABLES)
    places = list(product(grid.pressures, grid.speeds))
    left, right = _stretch(results[0])
    blocks = [deform(grid.results[place], left, right) for place in places]
    window = _window(results, blocks)
    norm = colour_scale(results)
    sheet = _sheet(grid, window, whole=_highest(blocks) < window.top)
    figure, axes = _arrange(grid, window, sheet)
    letters = [letter(number) + " " for number in range(len(places))] if len(places) > 1 else [""]
    for panel, place, block, mark in zip(axes, places, blocks, letters, strict=True):
        draw_block(panel, block, norm)
        _draw_road(panel, grid.results[place], window)
        _inscribe(panel, mark, float(grid.results[place]["contact_fraction"]), window, sheet)
    _label(figure, axes, grid, sheet)
    colour_bar(figure, norm, sheet.width - _RIGHT + 0.07, sheet.bottom, sheet.height - _TOP)
    return figure


def _stretch(result: xr.Dataset) -> tuple[float, float]:
    """Return the ends of one and a quarter wavelengths about a crest, mm."""
    crest = float(result["surface_x"].values[np.argmax(result["road_height"].values)])
    half = 0.5 * _WIDTH * wavelength(result)
    return crest - half, crest + half


def _highest(blocks: Sequence[DeformedBlock]) -> float:
    return max(float(block.y.max()) for block in blocks)


def _window(results: Sequence[xr.Dataset], blocks: Sequence[DeformedBlock]) -> _Window:
    """Return the part of the road and the block that is seen."""
    left, right = _stretch(results[0])
    width = wavelength(results[0])
    ceiling = _HIGH if any(map(is_finite, results)) else _LOW
    return _Window(
        left=left,
        right=right,
        bottom=float(results[0]["road_height"].values.min()) - _BELOW * width,
        top=min(ceiling * width, _highest(blocks) + _SKY * width),
    )


def _sheet(grid: SceneGrid, window: _Window, whole: bool) -> _Sheet:
    """Give panels the window's proportions, so that no paper is left empty around them."""
    rows, columns = len(grid.pressures), len(grid.speeds)
    panel_width = min((style.DOUBLE_COLUMN - _LEFT - _RIGHT - (columns - 1) * _GAP) / columns, _WIDEST)
    panel_height = panel_width * window.proportion
    width = _LEFT + _RIGHT + columns * panel_width + (columns - 1) * _GAP
    words = note_below(grid, whole, shares=panel_width < _NARROW)
    note = textwrap.wrap(words, int(19.0 * (width - _LEFT)))
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
            axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
        panel.label_outer()
    return figure, list(panels.flat)


def _draw_road(panel: Axes, result: xr.Dataset, window: _Window) -> None:
    x = np.linspace(window.left, window.right, 400)
    draw_road(
        panel, x, np.interp(x, result["surface_x"].values, result["road_height"].values, period=wavelength(result))
    )


def _inscribe(panel: Axes, mark: str, contact: float, window: _Window, sheet: _Sheet) -> None:
    """Write the panel's letter and the share in contact into the solid below the road."""
    word = "" if sheet.panel_width < _NARROW else "contact "
    solid = _BELOW / _WIDTH
    middle = window.bottom + 0.45 * solid * (window.right - window.left)
    text = f"{mark}{word}{100.0 * contact:.0f} %"
    centre = 0.5 * (window.left + window.right)
    # Below the frame, which the plate would break in small panels.
    panel.text(centre, middle, text, fontsize=_SMALL, ha="center", va="center", bbox=PLATE, zorder=2.2)


def _label(figure: Figure, axes: Sequence[Axes], grid: SceneGrid, sheet: _Sheet) -> None:
    """Write speeds above the columns, pressures beside the rows, the names of the axes, and the note."""
    columns = len(grid.speeds)
    for panel, speed in zip(axes, grid.speeds, strict=False):
        panel.set_title(f"{written(speed)} mm/s")
    for panel, pressure in zip(axes[::columns], grid.pressures, strict=True):
        place = panel.get_position()
        text = f"{written(pressure)}\nMPa"
        figure.text(0.03 / sheet.width, 0.5 * (place.y0 + place.y1), text, va="center")
    middle = 0.5 * (_LEFT + sheet.width - _RIGHT) / sheet.width
    figure.text(middle, (sheet.bottom - 0.32) / sheet.height, "Distance along the road (mm)", ha="center")
    middle = 0.5 * (sheet.bottom + sheet.height - _TOP) / sheet.height
    figure.text(0.36 / sheet.width, middle, "Height (mm)", rotation="vertical", va="center")
    figure.text(_LEFT / sheet.width, 0.04 / sheet.height, sheet.note, fontsize=_SMALL, va="bottom")
