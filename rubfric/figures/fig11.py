"""Figure 11: the block on the whole road, slow to fast and light to heavy, each with a magnified spot of contact."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch, Rectangle

from rubfric.figures import deformation, style
from rubfric.figures.blocks import PLATE, colour_bar, colour_scale, contacts, draw_block, draw_road
from rubfric.figures.deformation import DeformedBlock, deform, is_finite, profile, spot_width
from rubfric.figures.panels import letter
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed, check_results
from rubfric.figures.temperature import temperature_words
from rubfric.results.selection import NOT_NEEDED, REFUSAL, written
from rubfric.road.waves import WaveRoad

_VARIABLES = (
    *deformation.VARIABLES,
    *("surface_position", "contact_pressure", "contact_fraction", "friction_coefficient", "friction_coefficient_error"),
)
_AXES = ("pressure", "velocity", "scale", "aspect")
_TOUCH: dict[str, Any] = {"color": "#e8601c", "solid_capstyle": "round", "gid": "contact", "zorder": 3.0}
_FRAME: dict[str, Any] = {"edgecolor": "black", "linewidth": 0.5, "zorder": 3.2}
# Points of the road in a panel, and among which its highest crest is found.
_POINTS, _FINE = 1200, 16384
# The margins of the spot above the crest and below the lowest road, in its widths.
_ABOVE, _UNDER = 0.24, 0.2
# The margins of the strip above the block and below the road, in coarsest wavelengths, or in heights of a block flatter
# than a share of that: the coarsest wave of a window of a measured road is as long as the window.
_SKY, _SOLID, _FLAT = 0.06, 0.12, 0.4
# Lines of the net to the width of a spot.
_LINES = 12
# In inches: margins, the gaps beside and below a panel and between its strip and its spot, and the widest panel.
_LEFT, _RIGHT, _TOP, _BOTTOM, _NOTE_LINE = 0.5, 0.72, 0.24, 0.1, 0.105
_BESIDE, _BELOW, _BETWEEN, _WIDEST, _LONGEST = 0.1, 0.16, 0.1, 2.4, 3.0
_SMALL = 6.0
# Letters of small type to an inch, and the most lines of the reason of a refusal.
_LETTERS, _LINES_OF_REASON = 24, 4


@dataclass(frozen=True)
class _View:
    """A part of the road and the block, mm."""

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
    """Sizes of the figure, of a strip and of a spot, in inches, and the note below the panels."""

    width: float
    height: float
    panel: float
    strip: float
    spot: float
    bottom: float
    note: str


@style.applied()
def draw(results: Sequence[xr.Dataset], draws: int = 0, windows: bool = False) -> Figure:
    """Draw the block on one period of the road, and a spot of its contact magnified, by pressure and speed.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        Of the whole road, as built by ``results.dataset.build``, of one height-to-width ratio, at every pressure and
        speed; a scene that was refused or not needed has the attribute ``refusal``, which its panel says instead.
    draws : int
        How many roads with random phases were simulated, of which this is the first; 0 where the phases are given.
    windows : bool
        Whether they are windows of a measured profile instead.

    Returns
    -------
    matplotlib.figure.Figure
        The block slides to the right. The frame in the strip is the part that is magnified below it, the same in all
        panels: about the highest crest of the road. Orange is where rubber and road touch. Displacements are drawn as
        in figure 4; each panel gives the friction coefficient, its estimated error, and the share of the nominal area
        in contact.

    Raises
    ------
    InvalidInput
        Where the results do not fill a grid of pressures and speeds, or lack something.
    """
    check_results("result", results, (*_AXES, "scene_parameters"), (), ("scale", "aspect"))
    solved = [result for result in results if REFUSAL not in result.attrs]
    if solved:
        check_results("result", solved, (), _VARIABLES, ())
    grid = by_pressure_and_speed(results, ())
    road = profile(results[0])
    wide = spot_width(road, windows)
    blocks = {
        place: deform(result, 0.0, road.period, wide / _LINES)
        for place, result in grid.results.items()
        if REFUSAL not in result.attrs
    }
    strip, spot = _views(road, float(results[0].attrs["aspect"]), list(blocks.values()), wide)
    norm = colour_scale(solved)
    sheet = _sheet(grid, strip, spot, draws, windows)
    figure = Figure(figsize=(sheet.width, sheet.height))
    for number, place in enumerate(product(grid.pressures, grid.speeds)):
        upper, lower = (_panel(figure, sheet, grid, number, view) for view in (strip, spot))
        result, block = grid.results[place], blocks.get(place)
        for panel in (upper, lower):
            _draw_view(panel, road, norm, result, block)
        _scale_bar(lower)
        _mark(figure, upper, lower, spot)
        _inscribe(lower, result, letter(number) + " " if len(grid.results) > 1 else "", sheet)
    _label(figure, grid, sheet)
    colour_bar(figure, norm, sheet.width - _RIGHT + 0.07, sheet.bottom, sheet.height - _TOP)
    return figure


def _views(road: WaveRoad, aspect: float, blocks: Sequence[DeformedBlock], wide: float) -> tuple[_View, _View]:
    """Return what strips and spots show: a period of the road, and the surroundings of its highest crest, mm."""
    coarse, period = road.wavelength, road.period
    x = np.linspace(0.0, period, _FINE)
    heights = road.height(x)
    highest = max((float(block.y.max()) for block in blocks), default=aspect * coarse)
    high = highest - float(heights.min())
    margin = high if high < _FLAT * coarse else coarse
    strip = _View(0.0, period, float(heights.min()) - _SOLID * margin, highest + _SKY * margin)
    left = min(max(float(x[np.argmax(heights)]) - 0.5 * wide, 0.0), period - wide)
    seen = heights[(x >= left) & (x <= left + wide)]
    return strip, _View(left, left + wide, float(seen.min()) - _UNDER * wide, float(seen.max()) + _ABOVE * wide)


def _sheet(grid: SceneGrid, strip: _View, spot: _View, draws: int, windows: bool) -> _Sheet:
    rows, columns = len(grid.pressures), len(grid.speeds)
    room = (style.DOUBLE_COLUMN - _LEFT - _RIGHT - (columns - 1) * _BESIDE) / columns
    panel = min(room, _LONGEST if windows else _WIDEST)
    width = _LEFT + _RIGHT + columns * panel + (columns - 1) * _BESIDE
    note = textwrap.wrap(_note(grid, strip, spot, draws, windows), int(19.0 * (width - 0.1)))
    bottom = _BOTTOM + _NOTE_LINE * len(note)
    row = panel * (strip.proportion + spot.proportion) + _BETWEEN
    height = _TOP + bottom + rows * row + (rows - 1) * _BELOW
    return _Sheet(width, height, panel, panel * strip.proportion, panel * spot.proportion, bottom, "\n".join(note))


def _note(grid: SceneGrid, strip: _View, spot: _View, draws: int, windows: bool) -> str:
    wide, narrow = strip.right - strip.left, spot.right - spot.left
    solved = [result for result in grid.results.values() if REFUSAL not in result.attrs]
    framed = f"the framed spot, {narrow:.2g} mm, {wide / narrow:.2g} times larger"
    if windows:
        high = float(next(iter(grid.results.values())).attrs["aspect"]) * wide
        note = [f"The first of {draws} windows of the measured road, {wide:.3g} mm of it, made periodic, under a block"]
        note += [f"{high:.3g} mm high; friction is that on this window alone. Below each, {framed}."]
    else:
        note = [f"A period of the road, {wide:.3g} mm, and {framed}."]
    if draws and not windows:
        note += [f"The road is the first of {draws} with random phases, and friction that on this road alone."]
    note.append("The block slides to the right; orange: contact.")
    if any(map(is_finite, solved)):
        note.append("Displacements are to scale; the white lines made squares before deformation.")
    if not all(map(is_finite, solved)):
        which = "In small strain (no white lines) only" if any(map(is_finite, solved)) else "Only"
        note.append(f"{which} vertical displacements are shown, to scale, without the mean compression.")
    return " ".join([*note, *temperature_words(next(iter(grid.results.values())).attrs.get("temperature"))])


def _panel(figure: Figure, sheet: _Sheet, grid: SceneGrid, number: int, view: _View) -> Axes:
    """Return the axes of a strip, which is flatter, or of a spot below it."""
    row, column = divmod(number, len(grid.speeds))
    high = sheet.panel * view.proportion
    top = _TOP + row * (sheet.strip + _BETWEEN + sheet.spot + _BELOW)
    if high != sheet.strip:
        top += sheet.strip + _BETWEEN
    left, bottom = _LEFT + column * (sheet.panel + _BESIDE), sheet.height - top - high
    panel = figure.add_axes(
        (left / sheet.width, bottom / sheet.height, sheet.panel / sheet.width, high / sheet.height),
        xlim=(view.left, view.right),
        ylim=(view.bottom, view.top),
        xticks=[],
        yticks=[],
    )
    panel.autoscale(False)
    for side in panel.spines.values():
        side.set(visible=True, color="0.6", linewidth=0.4)
    return panel


def _draw_view(panel: Axes, road: WaveRoad, norm: LogNorm, result: xr.Dataset, block: DeformedBlock | None) -> None:
    """Draw what a panel shows: strips are too flat for a net and a hatch, and their contact is a thinner line."""
    left, right = panel.get_xlim()
    near = right - left < 0.999 * road.period
    x = np.linspace(left, right, _POINTS)
    if block is not None:
        draw_block(panel, block, norm, net=near)
    draw_road(panel, x, road.height(x), hatched=near)
    if block is not None:
        for start, stop in contacts(result):
            stretch = np.linspace(start, stop, max(2, int(_POINTS * (stop - start) / (right - left))))
            for ahead in (-road.period, 0.0, road.period):
                panel.plot(stretch + ahead, road.height(stretch), linewidth=2.2 if near else 1.2, **_TOUCH)


def _scale_bar(panel: Axes) -> None:
    """Draw a round length above the words in the lower right corner."""
    (left, right), (bottom, _) = panel.get_xlim(), panel.get_ylim()
    wide = right - left
    length = 10.0 ** np.floor(np.log10(0.4 * wide))
    length *= 2.0 if length < 0.2 * wide else 1.0
    end, level = right - 0.03 * wide, bottom + 0.15 * wide
    panel.plot([end - length, end], [level, level], color="black", linewidth=1.0, solid_capstyle="butt", zorder=3.1)
    words = f"{written(float(length))} mm"
    panel.text(end - length - 0.025 * wide, level, words, fontsize=_SMALL, ha="right", va="center", bbox=PLATE)


def _mark(figure: Figure, upper: Axes, lower: Axes, spot: _View) -> None:
    """Frame the spot in the strip, and join the frame to the magnified picture."""
    low, high = upper.get_ylim()
    bottom, top = max(spot.bottom, low), min(spot.top, high)
    frame = Rectangle((spot.left, bottom), spot.right - spot.left, top - bottom, fill=False, gid="spot", **_FRAME)
    upper.add_patch(frame)
    for x, corner in ((spot.left, 0.0), (spot.right, 1.0)):
        line = ConnectionPatch((x, bottom), (corner, 1.0), upper.transData, lower.transAxes, **_FRAME)
        figure.add_artist(line)


def _inscribe(panel: Axes, result: xr.Dataset, mark: str, sheet: _Sheet) -> None:
    """Write letter, friction and contact into the solid, or why there is nothing to see."""
    look: dict[str, Any] = {"transform": panel.transAxes, "zorder": 3.1}
    corner: dict[str, Any] = {"x": 0.025, "y": 0.05, "va": "bottom", "fontsize": _SMALL, "bbox": PLATE} | look
    if REFUSAL in result.attrs:
        reason = str(result.attrs[REFUSAL]).removeprefix(f"{result.attrs['scene']}: ")
        panel.text(s=mark + ("Not solved" if reason.startswith(NOT_NEEDED) else "Refused"), **corner)
        words = "\n".join(textwrap.wrap(reason, int(_LETTERS * sheet.panel), max_lines=_LINES_OF_REASON))
        panel.text(0.5, 0.96, words, fontsize=_SMALL, ha="center", va="top", **look)
        return
    friction, error = (float(result[f"friction_coefficient{part}"]) for part in ("", "_error"))
    contact = 100.0 * float(result["contact_fraction"])
    share = f"{contact:.0f}" if contact >= 1.95 else f"{contact:.1f}"
    measured = _measured(friction, error).replace("-", "\N{MINUS SIGN}")
    words = f"{mark}\N{GREEK SMALL LETTER MU} = {measured}, contact {share} %"
    panel.text(s=words, **corner)


def _measured(friction: float, error: float) -> str:
    """Return a friction coefficient and its error, rounded up to one digit."""
    if not np.isfinite(error) or error <= 0.0:
        return f"{friction:.3g}"
    digits = max(0, -int(np.floor(np.log10(error))))
    return f"{friction:.{digits}f} \N{PLUS-MINUS SIGN} {np.ceil(error * 10.0**digits - 1e-9) / 10.0**digits:.{digits}f}"


def _label(figure: Figure, grid: SceneGrid, sheet: _Sheet) -> None:
    """Write speeds above the columns, pressures beside the rows, and the note."""
    panels = figure.axes
    columns = len(grid.speeds)
    for panel, speed in zip(panels[::2], grid.speeds, strict=False):
        panel.set_title(f"{written(speed)} mm/s")
    for row, pressure in enumerate(grid.pressures):
        first = 2 * row * columns
        middle = 0.5 * (panels[first].get_position().y1 + panels[first + 1].get_position().y0)
        figure.text(0.03 / sheet.width, middle, f"{written(pressure)}\nMPa", va="center")
    figure.text(0.03 / sheet.width, 0.04 / sheet.height, sheet.note, fontsize=_SMALL, va="bottom")
