"""Figure 10: five ways from the scales of a road to its friction, over speed, at a light and a heavy load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.bands import draw_parts, explain_parts, upper
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.figures.totals import Totals, totals
from rubfric.results.selection import written

Array = NDArray[np.float64]

_HEIGHT, _PART = 2.5, 0.14
_ESTIMATES = ("sum", "corrected", "cascade", "persson")
_DIRECT: dict[str, Any] = {"color": "black", "linewidth": 1.7, "marker": "o", "zorder": 3.0, "clip_on": False}
_REFUSED: dict[str, Any] = {"color": "black", "linestyle": "none", "marker": "x", "markersize": 5.0, "clip_on": False}
_NOT = "Whole road not solved"


@style.applied()
def draw(table: pd.DataFrame, pressures: Sequence[float]) -> Figure:
    """Draw friction against speed by each way to the whole road, a panel per pressure.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.tables.total_table``.
    pressures : sequence of float
        Nominal, MPa.

    Returns
    -------
    matplotlib.figure.Figure
        The paper's sum over the scales, the cascade and Persson's theory as lines; all scales at once with its
        estimated error as a band (the errors of the models, which cover what they neglect, are in the table). Crosses
        at the bottom are speeds at which the whole road was refused or not needed.

    Raises
    ------
    InvalidInput
        For a table without a column, a pressure that it lacks, or pressures without any friction.
    """
    chosen = list(dict.fromkeys(pressures))
    found = [totals(table, pressure) for pressure in chosen]
    shown = np.concatenate([values for one in found for values in one.friction.values()])
    if not np.isfinite(shown).any():
        raise InvalidInput("the table of totals has no friction at these pressures, so there is nothing to draw")
    figure, axes = panels.arrange(len(found), _HEIGHT + _PART * (max(len(one.parts) for one in found) - 1))
    for panel, one in zip(axes, found, strict=True):
        for way, look in zip(_ESTIMATES, _looks(), strict=True):
            panel.plot(one.speeds, one.friction[way], label=panels.sentence(one.words(way)), **look)
        _draw_direct(panel, one)
    scale_speeds(axes[0], np.concatenate([one.speeds for one in found]))
    direct = np.concatenate([one.friction["direct"] for one in found])
    error = np.concatenate([one.errors["direct"] for one in found])
    scale_friction(axes[0], np.concatenate([shown, upper(direct, error)]))
    panels.entitle(axes, [f"{written(pressure)} MPa" for pressure in chosen])
    panels.label(axes, "Sliding speed (mm/s)", "Friction coefficient")
    panels.legend_above(figure, _handles(figure, axes, found, direct), None, 3 if len(axes) > 1 else 2)
    return figure


def _looks() -> list[dict[str, Any]]:
    """Return how the estimates are drawn: colours without an order, and dashes, since they may lie on each other."""
    looks = style.kinds(len(_ESTIMATES))
    return [
        look | {"linestyle": dash, "linewidth": 1.0, "markersize": 3.5, "clip_on": False}
        for look, dash in zip(looks, style.dashes(5)[1:], strict=True)
    ]


def _draw_direct(panel: Axes, found: Totals) -> None:
    direct = found.friction["direct"]
    if np.isfinite(direct).any():
        draw_parts(panel, found.speeds, direct, list(found.parts.values()))
        panel.plot(found.speeds, direct, label=panels.sentence(found.words("direct")), **_DIRECT)
    if found.missing.any():
        place = found.speeds[found.missing]
        across = panel.get_xaxis_transform()
        panel.plot(place, np.full(place.size, 0.03), transform=across, label=_NOT, gid="missing", **_REFUSED)


def _handles(figure: Figure, axes: Sequence[Axes], found: Sequence[Totals], direct: Array) -> list[Artist]:
    """Return the legend's entries: each line once, direct first, and its bands."""
    lines = {str(line.get_label()): line for panel in axes for line in panel.get_lines()}
    whole = panels.sentence(found[0].words("direct"))
    handles: list[Artist] = [lines.pop(words) for words in (whole, _NOT) if words in lines]
    if np.isfinite(direct).any():
        handles[0].set_label(f"{whole}:\n{found[0].road}")
        names = dict.fromkeys(words for one in found for words in one.parts)
        parts = {words: np.concatenate([_part(one, words) for one in found]) for words in names}
        handles[1:1] = explain_parts(figure, axes[0], direct, parts)
    return [*handles, *lines.values()]


def _part(found: Totals, words: str) -> Array:
    """Return a part of the error of the direct total; NaN where another way counts."""
    return np.where(np.isfinite(found.friction["direct"]), found.parts.get(words, np.zeros(found.speeds.size)), np.nan)
