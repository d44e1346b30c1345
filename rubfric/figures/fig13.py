"""Figure 13: the friction of several rubbers on several roads over speed, and which of two grips more."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogFormatterMathtext, LogLocator
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.bands import band_handle, draw_band, upper
from rubfric.figures.columns import check_columns
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.results.comparison import EQUAL, FIRST, SECOND
from rubfric.results.selection import written

Array = NDArray[np.float64]

# Heights of a panel, of its strip and of each line of that, in inches; panels in a row, and letters of a name.
_PANEL, _STRIP, _LINE = 1.55, 0.16, 0.13
_MOST_COLUMNS, _MOST_LETTERS = 4, 14
# Panels in a row beyond which speeds are written as powers of ten, and titles are short.
_MOST_NUMBERED = 2
# Bands are cut off where they would more than double the ordinate.
_HIGHEST = 2.0
_APART: dict[str, Any] = {"color": "0.55", "linestyle": "none", "marker": "_", "markersize": 5.0, "clip_on": False}
_AT, _PRESSURE = "velocity_mm_per_s", "pressure_MPa"
_VALUES = ("friction_total", "friction_total_ci95")


@style.applied()
def draw(comparison: pd.DataFrame, ranking: pd.DataFrame, pressures: Sequence[float]) -> Figure:
    """Draw friction against speed, a line per rubber and a panel per road and pressure, above a strip of verdicts.

    Parameters
    ----------
    comparison, ranking : pandas.DataFrame
        As from ``comparison_table`` and ``ranking_table`` of ``rubfric.results.comparison``, at one temperature.
    pressures : sequence of float
        Nominal, MPa.

    Returns
    -------
    matplotlib.figure.Figure
        Bands are 95 % intervals. A strip has a line for every two rubbers, and at each speed the mark of the one that
        grips more, or a dash where they cannot be told apart. Of one rubber on several roads, roads take the part of
        rubbers.

    Raises
    ------
    InvalidInput
        For a table without a column, a pressure that it lacks, or pressures without any friction.
    """
    check_columns(comparison, "comparison", ("rubber", "road"), (_AT, _PRESSURE, "friction_total_ci95"))
    check_columns(ranking, "ranking", ("compared", "on", "first", "second", "verdict"), (_AT, _PRESSURE))
    of, on = ("rubber", "road") if comparison["rubber"].nunique() > 1 else ("road", "rubber")
    names, places = ([*dict.fromkeys(comparison[column])] for column in (of, on))
    chosen = list(dict.fromkeys(pressures))
    shown = comparison[_near(comparison, chosen)]
    if not np.isfinite(shown["friction_total"]).any():
        raise InvalidInput("the comparison has no friction at these pressures, so there is nothing to draw")
    looks = dict(zip(names, _looks(len(names)), strict=True))
    verdicts = ranking[ranking["compared"] == f"{of}s"]
    pairs = list(dict.fromkeys(zip(verdicts["first"], verdicts["second"], strict=True)))
    cells = list(product(chosen, places))
    figure, axes, strips = _arrange(len(cells), len(places) if len(places) > 1 else len(chosen), len(pairs))
    for panel, strip, (pressure, place) in zip(axes, strips, cells, strict=True):
        own = shown[_near(shown, [pressure]) & (shown[on] == place)]
        for name, look in looks.items():
            _draw_friction(panel, own[own[of] == name], look)
        _draw_verdicts(strip, verdicts[_near(verdicts, [pressure]) & (verdicts["on"] == place)], pairs, looks)
    speeds = shown[_AT].to_numpy(dtype=np.float64)
    scale_speeds(axes[0], speeds)
    if len(places) > _MOST_NUMBERED and speeds.max() > 100.0 * speeds.min():
        axes[0].xaxis.set_major_locator(LogLocator(10.0, numticks=6))
        axes[0].xaxis.set_major_formatter(LogFormatterMathtext())
    total, half = (shown[name].to_numpy(dtype=np.float64) for name in _VALUES)
    scale_friction(axes[0], np.minimum(upper(total, half), _HIGHEST * np.nanmax(total)))
    what = f"{on.capitalize()} " if len(places) <= _MOST_NUMBERED else ""
    panels.entitle(axes, [f"{what}{_short(place)}, {written(pressure)} MPa" for pressure, place in cells])
    _label(axes, strips, pairs)
    handles = panels.line_handles([_short(name) for name in names], [*looks.values()])
    marks = [
        band_handle("95 % interval"),
        Line2D([], [], label="Cannot be told apart", **_APART),
    ]
    panels.legend_above(figure, [*handles, *marks], None, 6 if figure.get_figwidth() > style.COLUMN else 3)
    others = " Roads are compared in the table of the ranking." if of == "rubber" and len(places) > 1 else ""
    note = f"Strips: the mark of the {of} that grips more of two, with 95 % confidence.{others}"
    panels.write_note(figure, [note])
    return figure


def _near(table: pd.DataFrame, pressures: Sequence[float]) -> NDArray[np.bool_]:
    """Return which rows are at one of some pressures, MPa; a table has six digits of them."""
    held = table[_PRESSURE].to_numpy(dtype=np.float64)[:, None]
    return np.isclose(held, np.array(pressures), rtol=1e-5).any(axis=1)


def _looks(count: int) -> list[dict[str, Any]]:
    """Return how lines without an order are drawn; dashes too, since they may lie on each other."""
    return [
        look | {"linestyle": dash, "linewidth": 1.1, "markersize": 3.5, "clip_on": False}
        for look, dash in zip(style.kinds(count), style.dashes(count), strict=True)
    ]


def _arrange(count: int, across: int, lines: int) -> tuple[Figure, list[Axes], list[Axes]]:
    """Return a figure of so many panels, each above a strip of so many lines; all have one abscissa."""
    columns = min(across, _MOST_COLUMNS)
    rows = -(-count // columns)
    strip = _STRIP + _LINE * lines
    size = (style.COLUMN if columns == 1 else style.DOUBLE_COLUMN, 0.7 + rows * (_PANEL + strip + 0.3))
    figure = Figure(figsize=size, layout="constrained")
    grid = figure.add_gridspec(2 * rows, columns, height_ratios=[_PANEL, strip] * rows)
    axes: list[Axes] = []
    strips: list[Axes] = []
    for place in range(count):
        row, column = divmod(place, columns)
        first = axes[0] if axes else None
        axes.append(figure.add_subplot(grid[2 * row, column], sharex=first, sharey=first))
        strips.append(figure.add_subplot(grid[2 * row + 1, column], sharex=axes[0]))
    return figure, axes, strips


def _draw_friction(panel: Axes, rows: pd.DataFrame, look: dict[str, Any]) -> None:
    ordered = rows.sort_values(_AT)
    speeds, total, half = (ordered[name].to_numpy(dtype=np.float64) for name in (_AT, *_VALUES))
    draw_band(panel, speeds, total, half, look["color"])
    panel.plot(speeds, total, **look)


def _draw_verdicts(
    strip: Axes, rows: pd.DataFrame, pairs: Sequence[tuple[str, str]], looks: dict[str, dict[str, Any]]
) -> None:
    """Draw at each speed the mark of the one that grips more, in a line for every two."""
    for row in rows.to_dict("records"):
        line = -pairs.index((row["first"], row["second"]))
        winner = {FIRST: row["first"], SECOND: row["second"]}.get(row["verdict"])
        if winner is not None:
            strip.plot(row[_AT], line, gid="more", **looks[winner])
        elif row["verdict"] == EQUAL:
            strip.plot(row[_AT], line, gid="equal", **_APART)
    strip.set_ylim(0.6 - max(len(pairs), 1), 0.6)
    strip.set_yticks([-place for place in range(len(pairs))])
    strip.spines["left"].set_visible(False)
    strip.tick_params(axis="y", length=0.0)


def _label(axes: Sequence[Axes], strips: Sequence[Axes], pairs: Sequence[tuple[str, str]]) -> None:
    """Label the left panels with friction and the pairs of the strips, the lowest with speed."""
    for panel, strip in zip(axes, strips, strict=True):
        place, last = strip.get_subplotspec(), panel is axes[-1]
        left = bool(place and place.is_first_col())
        panel.tick_params(labelbottom=False, labelleft=left)
        strip.set_yticklabels([f"{_short(one)} : {_short(other)}" for one, other in pairs])
        strip.tick_params(axis="y", labelsize=6.0, labelleft=left)
        lowest = last or bool(place and place.is_last_row())
        strip.tick_params(labelbottom=lowest)
        if left:
            panel.set_ylabel("Friction coefficient")
        if lowest:
            strip.set_xlabel("Sliding speed (mm/s)")


def _short(name: str) -> str:
    """Return a name of which no more is left than there is room for."""
    return name if len(name) <= _MOST_LETTERS else f"{name[: _MOST_LETTERS - 1]}…"
