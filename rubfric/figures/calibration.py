"""Estimated against true error of friction: whether the estimate can be trusted."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.columns import check_columns
from rubfric.figures.scaling import tick_decades

Array = NDArray[np.float64]

# The sets in words; one that is not here goes by its own name.
_WORDS = {
    "ladder": "Ladders",
    "inside": "Inside the paper's grid",
    "outside": "Outside the paper's grid",
    "whole": "Whole roads",
    "finite": "Whole roads in finite strain",
}
_MARKERS = {"small": "o", "finite": "s", "auto": "D"}
_OTHER_MARKER = "X"
# In inches: the height of the panels, of a line of the legend above, and of a line of the note.
_HEIGHT, _LEGEND_LINE, _NOTE_LINE = 2.9, 0.16, 0.11
_NOTE_WIDTH = 150
_MARGIN = 1.5
# The ratios that are shown.
_SMALLEST, _LARGEST = 0.01, 300.0
# Errors below this part of the median one lie at the edge of the panel.
_LOWEST = 1e-3
_POINT: dict[str, Any] = {"linestyle": "none", "markersize": 3.0, "markeredgewidth": 0.5, "alpha": 0.7}
_WHISKER: dict[str, Any] = {"linewidth": 0.4, "alpha": 0.35, "zorder": 1.5}
_EQUAL: dict[str, Any] = {"color": "black", "linewidth": 0.8}
_TENFOLD: dict[str, Any] = {"color": "black", "linewidth": 0.7, "linestyle": (0, (5, 3))}


@style.applied()
def draw(table: pd.DataFrame) -> Figure:
    """Draw estimated against true errors, and how the ratio of the two is distributed.

    Parameters
    ----------
    table : pandas.DataFrame
        A row per run. Columns ``set`` (``ladder``, ``inside``, ``outside``), ``kinematics``; ``error`` and ``estimate``
        (relative, true and estimated), ``reference`` (friction coefficient), ``reference_error`` (its absolute bound),
        ``covered`` (whether the estimate covers the error) and ``ratio`` (estimate over true error). A run without
        error or estimate, which has been refused, is left out and counted in the note.

    Returns
    -------
    matplotlib.figure.Figure
        A colour per set, a marker per kinematics; whiskers show the uncertainty of the true error that the
        reference brings. Points above the full line are covered. The second panel has the share of runs whose ratio is
        no greater than the abscissa. The legend gives the coverage and the median ratio of each set.

    Raises
    ------
    InvalidInput
        For a table without rows, without a column, with a gap in a name or a negative number, or without any run that
        has both errors.
    """
    known = _known(table)
    sets = list(dict.fromkeys([*(name for name in _WORDS if name in set(known["set"])), *known["set"]]))
    colours, dashes = [look["color"] for look in style.kinds(len(sets))], style.dashes(len(sets))
    note = textwrap.wrap(_note(table, known), _NOTE_WIDTH)
    height = _HEIGHT + _LEGEND_LINE * max(len(sets), 3) + _NOTE_LINE * len(note)
    figure = Figure(figsize=(style.DOUBLE_COLUMN, height), layout="constrained")
    scatter, shares = axes = list(figure.subplots(1, 2))
    _scale_errors(scatter, known)
    _scale_ratios(shares, known)
    for name, colour, dash in zip(sets, colours, dashes, strict=True):
        rows = known[known["set"] == name]
        _draw_points(scatter, rows, colour)
        _draw_shares(shares, rows, colour, dash)
    panels.entitle(axes, ["Each run", "All runs of a set"])
    handles = _handles(known, sets, colours, dashes)
    figure.legend(handles=handles, loc="outside upper center", ncols=2)
    panels.write_note(figure, note)
    return figure


def _known(table: pd.DataFrame) -> pd.DataFrame:
    """Return the runs with both errors; the docstring of ``draw`` has what is refused."""
    name = "table of calibration"
    check_columns(table, name, ("set",), ("error", "estimate", "reference_error"), ("reference",))
    known = table[np.isfinite(table["error"]) & np.isfinite(table["estimate"])]
    if known.empty:
        raise InvalidInput(f"the {name} has no run with both a true and an estimated error, but at least one is needed")
    check_columns(known, name, ("kinematics", "covered"), ())
    if not known["covered"].isin([True, False]).all():
        raise InvalidInput(f"the column covered of the {name} must be True or False wherever there is an estimate")
    return known


def _scale_errors(panel: Axes, known: pd.DataFrame) -> None:
    """Give both axes the same limits, and draw the lines of equal and of tenfold estimates."""
    values = 100.0 * known[["error", "estimate"]].to_numpy(dtype=np.float64)
    positive = values[values > 0.0]
    middle = float(np.median(positive)) if positive.size else 1.0
    lowest = max(float(positive.min()), _LOWEST * middle) if positive.size else 0.1
    low, high = lowest / _MARGIN, max(float(values.max()), 10.0 * lowest) * _MARGIN
    panel.set(xscale="log", yscale="log", xlim=(low, high), ylim=(low, high))
    for axis in (panel.xaxis, panel.yaxis):
        tick_decades(axis, low, high)
    ends = np.array([low, high])
    panel.plot(ends, ends, gid="equal", zorder=1.0, **_EQUAL)
    panel.plot(ends, 10.0 * ends, gid="tenfold", zorder=1.0, **_TENFOLD)
    panel.set(xlabel="True error of friction (%)", ylabel="Estimated error (%)")


def _draw_points(panel: Axes, rows: pd.DataFrame, colour: Any) -> None:
    low = panel.get_xlim()[0]
    for kinematics, part in rows.groupby("kinematics", sort=False):
        error, estimate = (np.maximum(100.0 * part[name].to_numpy(), low) for name in ("error", "estimate"))
        own = 100.0 * (part["reference_error"] / part["reference"].abs().where(part["reference"] != 0.0)).to_numpy()
        panel.hlines(estimate, np.maximum(error - own, low), error + own, color=colour, gid="own", **_WHISKER)
        panel.plot(
            error, estimate, color=colour, marker=_marker(kinematics), gid=f"runs {kinematics}", clip_on=False, **_POINT
        )


def _scale_ratios(panel: Axes, known: pd.DataFrame) -> None:
    ratio = _ratio(known)
    shown = ratio[np.isfinite(ratio) & (ratio > 0.0)]
    low, high = (float(shown.min()), float(shown.max())) if shown.size else (1.0, 1.0)
    left, right = max(min(low, 0.5) / _MARGIN, _SMALLEST), min(max(high, 12.0) * _MARGIN, _LARGEST)
    panel.set(xscale="log", xlim=(left, right), ylim=(0.0, 101.0))
    tick_decades(panel.xaxis, *panel.get_xlim())
    panel.axvline(1.0, gid="equal", zorder=1.0, **_EQUAL)
    panel.axvline(10.0, gid="tenfold", zorder=1.0, **_TENFOLD)
    panel.set(xlabel="Estimated over true error", ylabel="Runs with at most this ratio (%)")


def _draw_shares(panel: Axes, rows: pd.DataFrame, colour: Any, dash: Any) -> None:
    """Draw the cumulative distribution of the ratio; a run without true error counts as infinite."""
    left, right = panel.get_xlim()
    # Beyond the panel, but finite: the line leaves the panel at the share that is inside.
    ratio = np.sort(np.clip(_ratio(rows), 0.1 * left, 10.0 * right))
    shares = 100.0 * np.arange(ratio.size + 1) / ratio.size
    ends = np.concatenate(([0.1 * left], ratio, [10.0 * right]))
    panel.stairs(shares, ends, baseline=None, color=colour, linestyle=dash, linewidth=1.2, gid="shares")
    panel.plot(np.median(ratio).clip(left, right), 50.0, marker="o", color=colour, gid="median", markersize=3.5)


def _ratio(rows: pd.DataFrame) -> Array:
    """Return the estimated over the true error; infinite where nothing was to be estimated."""
    error, estimate = (rows[name].to_numpy(dtype=np.float64) for name in ("error", "estimate"))
    return np.divide(estimate, error, out=np.full(error.shape, np.inf), where=error > 0.0)


def _marker(kinematics: Any) -> str:
    return _MARKERS.get(str(kinematics), _OTHER_MARKER)


def _handles(known: pd.DataFrame, sets: Sequence[str], colours: Sequence[Any], dashes: Sequence[Any]) -> list[Artist]:
    """Return the sets with their numbers in a first column of the legend, and what else is drawn in a second."""
    first: list[Artist] = [
        Line2D([], [], color=colour, linestyle=dash, linewidth=1.8, label=_described(known[known["set"] == name], name))
        for name, colour, dash in zip(sets, colours, dashes, strict=True)
    ]
    second: list[Artist] = [
        Line2D([], [], color="0.3", marker=_marker(kinematics), label=panels.sentence(f"{kinematics} strain"), **_POINT)
        for kinematics in dict.fromkeys(known["kinematics"])
    ]
    second.append(Line2D([], [], label="Estimate = true error", **_EQUAL))
    second.append(Line2D([], [], label="Estimate = 10 \N{MULTIPLICATION SIGN} true error", **_TENFOLD))
    blank: list[Artist] = [Line2D([], [], linestyle="none", label=" ")]
    longest = max(len(first), len(second))
    return [*first, *blank * (longest - len(first)), *second, *blank * (longest - len(second))]


def _described(rows: pd.DataFrame, name: str) -> str:
    """Return a set in words, with its coverage and its median ratio."""
    covered, count, ratio = int(rows["covered"].sum()), len(rows), float(np.median(_ratio(rows)))
    # Rounded down: 100 % are all of them.
    share = f"{covered} of {count} covered ({100 * covered // count} %)".replace(" ", "\N{NO-BREAK SPACE}")
    return f"{_WORDS.get(name, name)}: {share}, median ratio {ratio:.2g}"


def _note(table: pd.DataFrame, known: pd.DataFrame) -> str:
    """Return the note below the panels: how to read them, and what is not shown."""
    note = (
        "Covered: the estimate is at least the true error. Whiskers: what the reference's own error does to the true "
        "one. Errors below panel (a) are drawn at its edge. In (b), dots are medians; what lacks to 100 % lies beyond "
        "the panel."
    )
    lost = len(table) - len(known)
    if lost:
        note += f" {lost} of {len(table)} runs have no true or no estimated error and are left out."
    return note
