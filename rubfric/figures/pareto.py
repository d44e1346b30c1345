"""Error of friction against its cost: what each knob of the numerics buys."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from rubfric.figures import panels, style
from rubfric.figures.beside import write_beside
from rubfric.figures.ladders import Ladder, by_knob, known_runs, own_error
from rubfric.figures.scaling import tick_decades

Array = NDArray[np.float64]

_PRESET = "preset"
# First meshes among which presets are chosen: many, and all near the presets.
_LEFT_OUT = "start"
# The knob of scenes of the whole road, whose costs are over that of the direct way.
_TOTAL = "multiscale"
# The knobs in words; one that is not here goes by its own name.
_WORDS = {
    "mesh": "whole mesh",
    "surface": "contact nodes",
    "rows": "growth of the rows",
    "first_row": "first row",
    "element": "element",
    "kinematics": "kinematics",
    "folding": "folded branches",
    "tolerance": "tolerance",
    "steps": "march: time steps",
    "wavelengths": "march: distance slid",
    _TOTAL: "way to the total",
}
_ACROSS = 6
# In inches: the height of the large panel, of a row of small ones, and of a line of the note.
_HEIGHT, _SMALL_HEIGHT, _NOTE_LINE = 2.9, 1.75, 0.11
_SMALL_TYPE, _NOTE_WIDTH, _RUNGS_WIDTH = 6.0, 150, 22
# The ordinate begins at this part of the smallest median, but shows no more of the reference's own error than this.
_LOWEST, _OWN = 0.3, 0.1
_MARGIN = 1.6
_BOUND: dict[str, Any] = {"facecolor": "0.9", "linewidth": 0.0, "zorder": 0.1}
_POINT: dict[str, Any] = {"linestyle": "none", "marker": ".", "markersize": 2.6, "markeredgewidth": 0.0, "alpha": 0.45}
_CHOICE: dict[str, Any] = {
    "linestyle": "none",
    "color": "black",
    "marker": "D",
    "markersize": 6.0,
    "markerfacecolor": "gold",
    "zorder": 4.0,
}
_WHISKER: dict[str, Any] = {"color": "black", "linewidth": 0.9, "marker": "_", "markersize": 5.0}
_THIN: dict[str, Any] = {"linewidth": 0.9, "markersize": 3.2}
_RING: dict[str, Any] = {
    "linestyle": "none",
    "marker": "o",
    "markersize": 6.6,
    "markerfacecolor": "none",
    "markeredgewidth": 0.7,
}
_BACKDROP: dict[str, Any] = {"color": "0.6", "linewidth": 0.6, "marker": "D", "markersize": 2.4, "zorder": 1.2}
_HALO = [withStroke(linewidth=2.0, foreground="white")]


@style.applied()
def draw(table: pd.DataFrame) -> Figure:
    """Draw the error of friction against cost, all knobs in one panel and each in its own panel.

    Parameters
    ----------
    table : pandas.DataFrame
        A row per scene, knob and rung, the rungs of a knob from coarse to fine. Columns ``scene``, ``knob``, ``rung``;
        ``error`` (relative, against the reference), ``cost`` (seconds over those of the preset ``standard`` of the
        same scene; for the knob ``multiscale`` over those of its last rung), ``reference`` (friction coefficient) and
        ``reference_error`` (its absolute bound). A run without error or cost is left out, and counted in the note; the
        knob ``start`` is not drawn.

    Returns
    -------
    matplotlib.figure.Figure
        Lines join the medians over the scenes, from the coarsest rung (ringed) to the finest; small points are single
        scenes. Large markers are the presets, with a whisker to the worst scene. In the shaded range an error is
        smaller than the median bound on the reference's own; what lies below the panel is drawn at its lower edge.

    Raises
    ------
    InvalidInput
        For a table without rows, without a column, with a gap in a name or a negative number, or without any run that
        has both error and cost.
    """
    table = table[table["knob"] != _LEFT_OUT] if "knob" in table else table
    known = known_runs(table)
    ladders = by_knob(table)
    presets = ladders.pop(_PRESET, None)
    bound = own_error(known)
    looks = style.kinds(len(ladders))
    note = textwrap.wrap(_note(table, known), _NOTE_WIDTH)
    figure, upper, large, small = _arrange(len(ladders), len(note))
    _scale([large, *small], [*ladders.values(), *([presets] if presets else [])], bound)
    for ladder, look, panel in zip(ladders.values(), looks, small, strict=True):
        _draw_line(large, ladder, look)
        _draw_points(panel, ladder, look["color"])
        if presets:
            panel.plot(presets.cost, _shown(panel, presets.error), gid="presets", **_BACKDROP)
        _draw_line(panel, ladder, look)
    _entitle(large, small, ladders)
    _label(large, small)
    upper.legend(handles=_handles(list(ladders), looks, presets is not None), loc="outside right upper")
    panels.write_note(figure, note)
    if presets:
        _draw_presets(large, presets)
        style.lay_out(figure)
        _name_presets(large, presets, list(ladders.values()))
    return figure


def _arrange(count: int, lines: int) -> tuple[Figure, SubFigure | Figure, Axes, list[Axes]]:
    """Return a figure, its upper part with one large panel, that panel, and rows of small panels below it."""
    rows = -(-count // _ACROSS)
    height = _HEIGHT + _SMALL_HEIGHT * rows + _NOTE_LINE * lines
    figure = Figure(figsize=(style.DOUBLE_COLUMN, height), layout="constrained")
    if not rows:
        return figure, figure, figure.subplots(), []
    parts = figure.subfigures(2, 1, squeeze=False, height_ratios=(_HEIGHT, _SMALL_HEIGHT * rows))
    upper, lower = parts.flat
    large = upper.subplots()
    small: list[Axes] = list(lower.subplots(rows, _ACROSS, squeeze=False).flat)
    for spare in small[count:]:
        spare.remove()
    return figure, upper, large, small[:count]


def _scale(axes: Sequence[Axes], ladders: Sequence[Ladder], bound: float) -> None:
    """Give all panels the same limits and ticks, and shade the reference's own error."""
    costs, errors = (np.concatenate([getattr(one, name) for one in ladders]) for name in ("costs", "errors"))
    medians = np.concatenate([[bound], *[one.error for one in ladders]])
    low = max(_LOWEST * float(np.min(medians[medians > 0.0], initial=max(1.0, errors.max()))), _OWN * bound)
    high = max(float(errors.max()), 10.0 * low) * _MARGIN
    left, right = float(costs.min()) / _MARGIN, float(costs.max()) * _MARGIN
    for panel in axes:
        panel.set(xscale="log", yscale="log", xlim=(left, right), ylim=(low, high))
        tick_decades(panel.xaxis, left, max(right, 1e5 * left) if panel is not axes[0] else right)
        tick_decades(panel.yaxis, low, max(high, 1e5 * low) if panel is not axes[0] else high)
        if bound > low:
            panel.axhspan(low, bound, gid="bound", **_BOUND)


def _shown(panel: Axes, errors: Array) -> Array:
    """Return errors, those below the panel moved to its lower edge."""
    return np.maximum(errors, panel.get_ylim()[0])


def _draw_points(panel: Axes, ladder: Ladder, colour: Any) -> None:
    panel.plot(ladder.costs, _shown(panel, ladder.errors), color=colour, gid="scenes", clip_on=False, **_POINT)


def _draw_line(panel: Axes, ladder: Ladder, look: dict[str, Any]) -> None:
    error = _shown(panel, ladder.error)
    panel.plot(ladder.cost, error, gid="medians", clip_on=False, **_THIN | look)
    panel.plot(ladder.cost[0], error[0], gid="coarsest", clip_on=False, **_RING | {"color": look["color"]})


def _draw_presets(panel: Axes, presets: Ladder) -> None:
    _draw_points(panel, presets, "0.35")
    for whisker in _whiskers(panel, presets):
        panel.plot(*whisker.T, zorder=3.5, gid="worst", **_WHISKER)
    panel.plot(presets.cost, _shown(panel, presets.error), gid="presets", clip_on=False, **_CHOICE)


def _name_presets(panel: Axes, presets: Ladder, ladders: Sequence[Ladder]) -> None:
    drawn = [np.stack((ladder.cost, _shown(panel, ladder.error)), axis=1) for ladder in ladders]
    drawn += _whiskers(panel, presets)
    places = [
        (float(cost), float(error)) for cost, error in zip(presets.cost, _shown(panel, presets.error), strict=True)
    ]
    for rung, place in zip(presets.rungs, places, strict=True):
        write_beside(panel, place, rung, drawn, 6.0).set_path_effects(_HALO)


def _whiskers(panel: Axes, presets: Ladder) -> list[Array]:
    """Return the lines from the median of each preset to its worst scene."""
    edges = zip(presets.cost, _shown(panel, presets.error), _shown(panel, presets.worst), strict=True)
    return [np.array([[cost, error], [cost, worst]]) for cost, error, worst in edges]


def _entitle(large: Axes, small: Sequence[Axes], ladders: Mapping[str, Ladder]) -> None:
    if small:
        large.set_title(f"{panels.letter(0)} All knobs", loc="left")
    for place, (panel, (knob, ladder)) in enumerate(zip(small, ladders.items(), strict=True), start=1):
        rungs = ", ".join(ladder.rungs).replace("e-", "e\N{MINUS SIGN}")
        heading = [f"{panels.letter(place)} {_words(knob)}", *textwrap.wrap(rungs, _RUNGS_WIDTH)]
        panel.set_title("\n".join(heading), fontsize=_SMALL_TYPE, loc="left", linespacing=1.15)


def _words(knob: str) -> str:
    return panels.sentence(_WORDS.get(knob, knob))


def _label(large: Axes, small: Sequence[Axes]) -> None:
    large.set(xlabel="Cost relative to the preset standard", ylabel="Relative error of friction (%)")
    for place, panel in enumerate(small):
        panel.tick_params(
            labelleft=place % _ACROSS == 0, labelbottom=place + _ACROSS >= len(small), labelsize=_SMALL_TYPE
        )
        if place % _ACROSS == 0:
            panel.set_ylabel("Error (%)", fontsize=_SMALL_TYPE)
        if place + _ACROSS >= len(small):
            panel.set_xlabel("Cost", fontsize=_SMALL_TYPE)


def _handles(knobs: Sequence[str], looks: Sequence[dict[str, Any]], presets: bool) -> list[Artist]:
    handles = panels.line_handles([_words(knob) for knob in knobs], looks)
    handles.append(Line2D([], [], label="Coarsest rung", **_RING | {"color": "0.3"}))
    handles.append(Line2D([], [], label="One scene", **_POINT | {"color": "0.3", "markersize": 4.0}))
    if presets:
        handles.append(Line2D([], [], label="Preset", **_CHOICE))
        handles.append(Line2D([], [], label="To the worst scene", **_WHISKER))
    handles.append(Patch(label="Reference's own error", **_BOUND))
    return handles


def _note(table: pd.DataFrame, known: pd.DataFrame) -> str:
    """Return the note below the panels: how many scenes, and what is not shown."""
    scenes = known["scene"].nunique()
    note = (
        f"Lines: medians over {scenes} scene{'s' if scenes > 1 else ''}, rungs from coarse to fine in the order above "
        "each panel; small grey diamonds: the presets. Errors below the panel are drawn at its lower edge."
    )
    if (known["knob"] == _TOTAL).any():
        note += " The way to the total is compared with all waves at once on the whole road, and so is its cost."
    lost = len(table) - len(known)
    if lost:
        note += f" {lost} of {len(table)} runs gave no error or cost and are left out."
    return note
