"""Figure 9: friction over speed and over pressure, simulated and measured on the rig."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.arrays import Flags
from rubfric.figures import panels, style
from rubfric.figures.bands import draw_band, upper
from rubfric.figures.columns import check_columns
from rubfric.figures.scaling import plain, scale_friction, scale_speeds, tick_decades
from rubfric.results.friction_map import FrictionMap
from rubfric.results.scales import RUBBER_PART

Array = NDArray[np.float64]

_HEIGHT = 2.9
# Points are drawn with the line whose pressure, or speed, is this close to theirs, as a factor.
_NEAR = 1.1
# Points of a curve.
_POINTS = 241
_WORDS = {"measured": "Measured", "simulated": "Virtual rig (simulated)"}
_SPEED, _PRESSURE, _FRICTION = "speed_mm_per_s", "pressure_MPa", "friction_coefficient"
_INTERVALS = {_SPEED: "speed_ci95_mm_per_s", _PRESSURE: "pressure_ci95_MPa", _FRICTION: "friction_coefficient_ci95"}


@style.applied()
def draw(totals: pd.DataFrame, points: pd.DataFrame, pressures: Sequence[float], speeds: Sequence[float]) -> Figure:
    """Draw simulated friction as lines, interpolated between the scenes, and measured friction as points.

    Parameters
    ----------
    totals : pandas.DataFrame
        Friction of the whole road, as from ``rubfric.results.totals.total_table``.
    points : pandas.DataFrame
        As ``rubfric.rig.reduction.point_table`` returns it; may have no rows.
    pressures, speeds : sequence of float
        Of the lines over speed (MPa) and over pressure (mm/s). Outside what was simulated there are points alone.

    Returns
    -------
    matplotlib.figure.Figure
        Bars are 95 % confidence intervals, bands the estimated errors of the simulation. Points at other pressures
        and speeds than those of the lines are left out; the note below counts them.

    Raises
    ------
    InvalidInput
        Where totals are missing, or the table lacks a column.
    """
    if len(points):
        check_columns(points, "table of the rig", ("source",), tuple(_INTERVALS) + tuple(_INTERVALS.values()))
    friction = FrictionMap.from_totals(totals)
    figure = Figure(figsize=(style.DOUBLE_COLUMN, _HEIGHT), layout="constrained")
    axes = list(figure.subplots(1, 2, sharey=True))
    over_speed = [(value, *_over_speed(friction, value)) for value in pressures]
    over_pressure = [(value, *_over_pressure(friction, value)) for value in speeds]
    shown = np.zeros(len(points), dtype=bool)
    tallest = []
    for panel, lines, along, across in (
        (axes[0], over_speed, _SPEED, _PRESSURE),
        (axes[1], over_pressure, _PRESSURE, _SPEED),
    ):
        for (value, places, values, errors), look in zip(lines, style.lines(len(lines)), strict=True):
            if places.size:
                draw_band(panel, places, values, errors, look["color"])
                panel.plot(places, values, color=look["color"], linestyle=look["linestyle"])
                tallest.append(upper(values, errors))
            near = _nearest(points, across, value, [line[0] for line in lines])
            shown |= near
            tallest.append(_draw_points(panel, points[near], along, look))
    _finish(axes, friction, points, np.concatenate([np.zeros(1), *tallest]))
    for panel, lines, title in ((axes[0], over_speed, "MPa"), (axes[1], over_pressure, "mm/s")):
        _legend(panel, [line[0] for line in lines], title)
    figure.legend(handles=_kinds(points, _covers(totals)), loc="outside upper center", ncols=3)
    _note(figure, points, shown)
    return figure


def _over_speed(friction: FrictionMap, pressure: float) -> tuple[Array, Array, Array]:
    """Return speeds, friction coefficients and their errors; nothing at a pressure that was not simulated."""
    if not friction.holds(pressure):
        return (np.empty(0),) * 3
    speeds = np.geomspace(friction.speeds[0], friction.speeds[-1], _POINTS)
    curve = friction.at(pressure)
    return speeds, curve(speeds), curve.error_at(speeds)


def _over_pressure(friction: FrictionMap, speed: float) -> tuple[Array, Array, Array]:
    """Return pressures, friction coefficients and their errors; nothing at a speed that was not simulated."""
    if not friction.speeds[0] <= speed <= friction.speeds[-1]:
        return (np.empty(0),) * 3
    pressures = np.geomspace(friction.pressures[0], friction.pressures[-1], _POINTS // 4)
    curves = [friction.at(float(pressure)) for pressure in pressures]
    return pressures, np.array([float(c(speed)) for c in curves]), np.array([float(c.error_at(speed)) for c in curves])


def _nearest(points: pd.DataFrame, column: str, value: float, others: Sequence[float]) -> Flags:
    """Return which points belong to a line: near its value, and nearer than to that of any other line."""
    if not len(points):
        return np.zeros(0, dtype=bool)
    distances = np.abs(np.log(points[column].to_numpy(dtype=float)[:, None] / np.array(others)))
    own = list(others).index(value)
    return (distances[:, own] <= np.log(_NEAR)) & (distances.argmin(axis=1) == own)


def _draw_points(panel: Axes, points: pd.DataFrame, along: str, look: dict[str, Any]) -> Array:
    """Draw points with their intervals, and return the upper ends of those of friction."""
    upto = points[_FRICTION].to_numpy(dtype=float) + points[_INTERVALS[_FRICTION]].to_numpy(dtype=float)
    for source, marked in points.groupby("source"):
        panel.errorbar(
            marked[along],
            marked[_FRICTION],
            xerr=np.minimum(marked[_INTERVALS[along]], 0.9 * marked[along]),
            yerr=marked[_INTERVALS[_FRICTION]],
            color=look["color"],
            linestyle="none",
            marker=look["marker"],
            markersize=2.8,
            markerfacecolor=look["color"] if source == "measured" else "white",
            markeredgewidth=0.6,
            elinewidth=0.6,
            capsize=1.2,
            capthick=0.5,
            gid=str(source),
            zorder=3,
        )
    return upto


def _finish(axes: Sequence[Axes], friction: FrictionMap, points: pd.DataFrame, tallest: Array) -> None:
    """Set limits, ticks, titles and labels."""
    measured = {column: points[column].to_numpy(dtype=np.float64) for column in (_SPEED, _PRESSURE)}
    scale_speeds(axes[0], np.concatenate((friction.speeds, measured[_SPEED])))
    pressures = np.concatenate((friction.pressures, measured[_PRESSURE]))
    low, high = float(pressures.min()), float(pressures.max())
    margin = (high / low) ** 0.04 if high > low else 2.0
    axes[1].set_xscale("log")
    axes[1].set_xlim(low / margin, high * margin)
    tick_decades(axes[1].xaxis, low, high)
    scale_friction(axes[0], tallest)
    panels.entitle(axes, ["Over speed", "Over pressure"])
    axes[0].set_xlabel("Sliding speed (mm/s)")
    axes[1].set_xlabel("Nominal pressure (MPa)")
    axes[0].set_ylabel("Friction coefficient")


def _legend(panel: Axes, values: Sequence[float], unit: str) -> None:
    handles = [
        Line2D(
            [],
            [],
            color=look["color"],
            linestyle=look["linestyle"],
            marker=look["marker"],
            markersize=3.0,
            markerfacecolor="white",
            markeredgewidth=0.6,
            label=f"{plain(value)} {unit}",
        )
        for value, look in zip(values, style.lines(len(values)), strict=True)
    ]
    panel.legend(handles=handles, loc="upper left", frameon=True, framealpha=0.8, edgecolor="none", borderpad=0.2)


def _covers(totals: pd.DataFrame) -> str:
    """Return what the error of totals covers besides that of mesh, solver and models."""
    parts = {"friction_road_error": "the road", RUBBER_PART: "the rubber's data"}
    known = [words for name, words in parts.items() if name in totals and totals[name].notna().any()]
    return f", that from {' and '.join(known)} included" if known else ""


def _kinds(points: pd.DataFrame, covers: str) -> list[Line2D]:
    """Return what lines and points are."""
    grey: dict[str, Any] = {"color": "0.25"}
    handles: list[Any] = [Line2D([], [], label=f"Simulated, with the band of its estimated error{covers}", **grey)]
    for source in sorted(set(points["source"])):
        face = "0.25" if source == "measured" else "white"
        words = f"{_WORDS[source]}, 95\N{NO-BREAK SPACE}% confidence"
        handles.append(
            Line2D([], [], linestyle="none", marker="o", markersize=3.0, markerfacecolor=face, label=words, **grey)
        )
    return handles


def _note(figure: Figure, points: pd.DataFrame, shown: Flags) -> None:
    """Write below the panels what is drawn, and how much is not."""
    percent = 100.0 * (_NEAR - 1.0)
    note = f"Points within {percent:.0f} % of the pressure, or speed, of a line"
    hidden = int(np.count_nonzero(~shown))
    note += f"; {hidden} of {len(points)} lie at others and are not drawn." if hidden else "."
    panels.write_note(figure, [note if len(points) else "No point could be measured."])
