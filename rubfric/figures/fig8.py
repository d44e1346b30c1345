"""Figure 8: the test rig, drawn as a scheme with the symbols used."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Polygon, Rectangle

from rubfric.figures import style

_HEIGHT = 2.75
_STEEL, _RUBBER, _ROAD, _SENSOR, _DARK = "0.86", "0.35", "#d9c8a9", "#e8601c", "0.15"
_LINE: dict[str, Any] = {"edgecolor": _DARK, "linewidth": 0.7}


@style.applied()
def draw() -> Figure:
    """Draw the rig from the side, in no scale: what holds the rubber, what moves below it, and what is read.

    Returns
    -------
    matplotlib.figure.Figure
        Sensors are in one colour, forces and motions are arrows with their symbols.
    """
    figure = Figure(figsize=(style.DOUBLE_COLUMN, _HEIGHT), layout="constrained")
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.set_xlim(-0.2, 18.6)
    axes.set_ylim(-1.6, 6.9)
    axes.set_axis_off()
    _frame(axes)
    _sled(axes)
    _rope(axes)
    _column(axes)
    _symbols(axes)
    return figure


def _box(axes: Axes, x: float, y: float, width: float, height: float, colour: str, **more: Any) -> None:
    axes.add_patch(Rectangle((x, y), width, height, facecolor=colour, **(_LINE | more)))


def _frame(axes: Axes) -> None:
    """Draw the bed with its rail, and the portal that holds the hand wheel."""
    _box(axes, 0.0, -0.8, 13.2, 0.6, _STEEL)
    _box(axes, 0.0, -0.2, 13.2, 0.2, "0.6")
    for x in (5.0, 8.7):
        _box(axes, x, 0.0, 0.3, 5.6, "0.93", zorder=0.5)
    _box(axes, 5.0, 5.3, 4.0, 0.4, _STEEL)
    _write(axes, 9.9, -0.5, "Bed with the rail")


def _sled(axes: Axes) -> None:
    """Draw the sled on its bearings, with the road in its trough."""
    for x in (4.1, 6.8, 9.5):
        axes.add_patch(Circle((x, 0.22), 0.22, facecolor="white", **_LINE))
    _box(axes, 3.5, 0.44, 6.6, 0.36, _STEEL)
    for x in (3.5, 9.9):
        _box(axes, x, 0.8, 0.2, 0.6, _STEEL)
    along = np.linspace(3.7, 9.9, 400)
    top = 1.22 + 0.1 * np.sin(2.0 * np.pi * (along - 3.7) / 0.62)
    outline = np.vstack((np.column_stack((along, top)), [(9.9, 0.8), (3.7, 0.8)]))
    axes.add_patch(Polygon(outline, facecolor=_ROAD, **_LINE))


def _rope(axes: Axes) -> None:
    """Draw rope, sheave and weight, the sensor in the rope, and that of displacement at the rear."""
    centre, radius = (13.8, 0.42), 0.55
    axes.add_patch(Polygon([(13.2, -0.8), (13.2, 0.0), (13.8, 0.52)], facecolor="0.75", **_LINE))
    axes.add_patch(Circle(centre, radius, facecolor=_STEEL, **_LINE))
    axes.add_patch(Circle(centre, 0.08, facecolor=_DARK, linewidth=0.0))
    high, right = centre[1] + radius, centre[0] + radius
    axes.plot([10.1, centre[0]], [high, high], color=_DARK, linewidth=1.0)
    axes.plot([right, right], [centre[1], -0.45], color=_DARK, linewidth=1.0)
    _box(axes, right - 0.5, -1.45, 1.0, 1.0, "0.55")
    _box(axes, 12.0, high - 0.17, 0.9, 0.34, _SENSOR, zorder=2.5)
    _box(axes, 0.0, 0.0, 0.25, 1.5, _STEEL)
    _box(axes, 0.25, 0.82, 0.8, 0.4, _SENSOR)
    axes.plot([1.05, 3.5], [1.02, 1.02], color=_SENSOR, linewidth=1.0, linestyle=(0, (3, 1.5)))


def _column(axes: Axes) -> None:
    """Draw hand wheel, spindle, flange sensor and rubber, from above to below."""
    _box(axes, 6.9, 2.75, 0.2, 3.3, "0.7", zorder=0.8)
    _box(axes, 6.55, 5.2, 0.9, 0.6, "0.7")
    _box(axes, 5.9, 6.05, 2.2, 0.28, "0.7")
    _box(axes, 6.2, 2.75, 1.6, 0.3, _STEEL)
    _box(axes, 6.3, 2.1, 1.4, 0.65, _SENSOR)
    _box(axes, 6.35, 1.9, 1.3, 0.2, _STEEL)
    _box(axes, 6.45, 1.3, 1.1, 0.6, _RUBBER)


def _symbols(axes: Axes) -> None:
    """Write the names of the parts, and the symbols beside their arrows."""
    _point(axes, "Hand wheel", (8.1, 6.19), (9.6, 6.19))
    _point(
        axes,
        "Flange sensor of the normal force $F_N$\nand the friction force $F_T$ at the rubber",
        (7.7, 2.45),
        (9.6, 3.7),
        _SENSOR,
    )
    _point(axes, "Rubber, nominal area $A$", (7.55, 1.65), (9.6, 2.35))
    _point(axes, "Road in the sled, mass $m$", (9.0, 1.15), (9.6, 1.62))
    _point(axes, "Six ball bearings, drag $F_b$", (4.0, 0.04), (3.6, -0.5), align="right")
    _point(axes, "Sensor of displacement $x$", (0.45, 1.22), (0.15, 2.2), _SENSOR)
    _point(axes, "Or sensor of the\nforce $F_T$ in the rope", (12.85, 1.14), (14.0, 2.7), _SENSOR)
    _point(axes, "Sheave", (14.25, 0.7), (15.1, 1.2))
    _write(axes, 15.1, -0.95, "Weight")
    _arrow(axes, (6.1, 4.7), (6.1, 3.3), "$F_N$", (5.68, 4.0))
    _arrow(axes, (3.7, 1.75), (4.8, 1.75), "$v$", (4.3, 2.1))
    formulae = (
        "At the rubber:   $\\mu = F_T \\,/\\, F_N$\n"
        "In the rope:   $\\mu = (F_T - m \\, a - F_b) \\,/\\, F_N$\n"
        "Pressure:   $p = F_N \\,/\\, A$"
    )
    axes.text(15.8, 5.2, formulae, ha="center", va="center", linespacing=1.7, fontsize=6.5)


def _write(axes: Axes, x: float, y: float, words: str, **more: Any) -> None:
    axes.text(x, y, words, va="center", fontsize=6.3, **({"ha": "left", "color": _DARK} | more))


def _point(
    axes: Axes,
    words: str,
    at: tuple[float, float],
    place: tuple[float, float],
    colour: str = _DARK,
    align: str = "left",
) -> None:
    """Write words and draw a thin line from them to what they name."""
    axes.annotate(
        words,
        at,
        xytext=place,
        ha=align,
        va="center",
        fontsize=6.3,
        color=colour,
        arrowprops={
            "arrowstyle": "-",
            "linewidth": 0.5,
            "color": colour,
            "shrinkA": 1.0,
            "shrinkB": 0.0,
            "relpos": (0.0 if align == "left" else 1.0, 0.5),
        },
    )


def _arrow(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], words: str, place: tuple[float, float]
) -> None:
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=7.0, linewidth=1.0, color=_DARK))
    axes.text(*place, words, ha="center", va="center", fontsize=7.5)
