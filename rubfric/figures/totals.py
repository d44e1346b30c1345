"""The friction of the whole road at one pressure, out of the table of totals, and how its ways are drawn."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures.bands import draw_band, draw_parts
from rubfric.figures.columns import check_columns
from rubfric.results.scales import AXES, RUBBER_PART, TOTAL
from rubfric.results.selection import WINDOWS, written

Array = NDArray[np.float64]

# The ways to a total in words, as legends have them.
WAYS = {
    "direct": "all scales at once",
    "sum": "sum of the scales",
    "corrected": "sum, corrected for the coupling",
    "cascade": "cascade from scale to scale",
    "persson": "Persson's theory",
}
# The direct one of a road that is a measured profile.
PROFILE = "the profile itself"
# The columns of the parts of its error that are not of mesh and solver.
_PIECES = ("friction_coupling_error", "friction_road_error", RUBBER_PART)
_HALO = "white"
# Letters of a line in the legend.
_LETTERS = 28


@dataclass(frozen=True)
class Totals:
    """Totals at one pressure, over speed; NaN where they are not known.

    Attributes
    ----------
    speeds : numpy.ndarray, shape (speeds,)
        mm/s, ascending.
    total, error : numpy.ndarray, shape (speeds,)
        The friction coefficient that counts, and its whole absolute error.
    ways : numpy.ndarray of str, shape (speeds,)
        How each total was obtained.
    friction, errors : dict of numpy.ndarray
        The friction coefficient by each way, and its whole absolute error.
    warnings : numpy.ndarray, shape (speeds,)
        How many warnings the scenes behind each total carry; 0 where that is not known.
    pieces : dict of numpy.ndarray
        The parts of ``error`` besides that of mesh and solver, by column.
    drawn : bool
        Whether totals are means over roads with random phases, or windows of one, not those of one road.
    windows : bool
        Whether they are over windows of a measured profile.
    count : int
        Over how many roads at most; 0 where that is not known.
    """

    speeds: Array
    total: Array
    error: Array
    ways: NDArray[np.str_]
    friction: dict[str, Array]
    errors: dict[str, Array]
    warnings: Array
    pieces: dict[str, Array]
    drawn: bool
    windows: bool
    count: int

    @property
    def way(self) -> str:
        """The way of most totals; ``direct`` where there is any."""
        known = [str(way) for way in self.ways[np.isfinite(self.total)]]
        return "direct" if "direct" in known or not known else max(sorted(set(known)), key=known.count)

    @property
    def other(self) -> NDArray[np.bool_]:
        """Where the total was obtained in another way, since this one was refused or not needed."""
        return (self.ways != self.way) & np.isfinite(self.total)

    @property
    def main(self) -> Array:
        """The totals that were obtained in the way of most; NaN at the others."""
        return np.where(self.other, np.nan, self.total)

    @property
    def missing(self) -> NDArray[np.bool_]:
        """Where all scales at once have no friction, though they have elsewhere at this pressure."""
        missing = np.isnan(self.friction["direct"])
        return missing & (not missing.all())

    @property
    def road(self) -> str:
        """Of which road the totals are, in words."""
        if not self.drawn:
            return "one road, these phases"
        many = f"{self.count} " if self.count else ""
        return f"mean of {many}windows" if self.windows else f"mean of {many}random phases"

    @property
    def parts(self) -> dict[str, Array]:
        """The parts of the error of ``main`` that there are, by what they come from, in words."""
        few = "so few windows" if self.windows else "so few random phases"
        pieces = {name: np.where(np.isnan(self.main), 0.0, np.nan_to_num(of)) for name, of in self.pieces.items()}
        named = dict(zip(_PIECES, ("the coupling of the scales", few, "the rubber's data"), strict=True))
        others = {named[name]: part for name, part in pieces.items() if part.any()}
        return {"mesh and solver": self.error - sum(others.values())} | others

    def words(self, way: str) -> str:
        """Return a way in words: the windows of a profile are no sum of scales."""
        return {"direct": PROFILE, "sum": "sum of its sines"}.get(way, WAYS[way]) if self.windows else WAYS[way]


def totals(table: pd.DataFrame, pressure: float) -> Totals:
    """Return the totals at one pressure.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.tables.total_table``.
    pressure : float
        Nominal, MPa.

    Raises
    ------
    InvalidInput
        For a table without a column or without the pressure.
    """
    friction = {way: f"friction_{way}" for way in WAYS}
    errors = {way: f"friction_{way}_error" for way in WAYS}
    check_columns(
        table,
        "table of totals",
        ("way",),
        (*AXES, *TOTAL, "friction_road_error", *errors.values()),
        list(friction.values()),
    )
    rows = table[np.isclose(table["pressure_MPa"], pressure, rtol=1e-5)].sort_values("velocity_mm_per_s")
    if rows.empty:
        listed = ", ".join(written(one) for one in sorted(set(table["pressure_MPa"])))
        raise InvalidInput(f"the table of totals has no pressure {written(pressure)} MPa, but {listed} MPa")

    def column(name: str) -> Array:
        return rows[name].to_numpy(dtype=np.float64)

    notes = rows["note"].astype(str) if "note" in rows else pd.Series("", index=rows.index)
    windows = bool(notes.str.contains(WINDOWS).any())
    means = notes.str.extract(r"^mean of (\d+) ", expand=False).dropna().astype(int)
    return Totals(
        speeds=column("velocity_mm_per_s"),
        total=column("friction_total"),
        error=column("friction_total_error"),
        ways=rows["way"].to_numpy(dtype=np.str_),
        friction={way: column(name) for way, name in friction.items()},
        errors={way: column(name) for way, name in errors.items()},
        warnings=np.nan_to_num(column("warnings")) if "warnings" in rows else np.zeros(len(rows)),
        pieces={name: column(name) for name in _PIECES if name in rows},
        drawn=bool(rows["friction_road_error"].notna().any()),
        windows=windows,
        count=int(means.max()) if len(means) else 0,
    )


def draw_total(panel: Axes, found: Totals) -> Line2D:
    """Draw the total that counts with the band of its error; open, with bars, where it was obtained in another way.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
    found : Totals

    Returns
    -------
    matplotlib.lines.Line2D
        The line, for the legend.
    """
    other = found.other
    halo: dict[str, Any] = {"color": _HALO, "linewidth": 3.2, "marker": "o", "markersize": 6.0, "clip_on": False}
    panel.plot(found.speeds, found.main, gid="halo", zorder=2.4, **halo)
    draw_band(panel, found.speeds, found.main, found.error, _HALO, zorder=2.5, opacity=1.0)
    draw_parts(panel, found.speeds, found.main, list(found.parts.values()), zorder=2.5)
    look: dict[str, Any] = {"color": "black", "linewidth": 1.7, "marker": "o", "zorder": 3.0, "clip_on": False}
    (line,) = panel.plot(found.speeds, found.main, label=f"Total: {found.words(found.way)},\n{found.road}", **look)
    if other.any():
        place, value, error = (values[other] for values in (found.speeds, found.total, found.error))
        panel.errorbar(
            place,
            value,
            yerr=np.nan_to_num(error, nan=0.0),
            **look | {"linestyle": "none", "markerfacecolor": "white", "zorder": 2.9},
            elinewidth=0.8,
            capsize=2.0,
        )
    return line


def other_handles(found: Sequence[Totals]) -> list[Line2D]:
    """Return the legend's entry for totals obtained in another way, or none."""
    ways = sorted({WAYS.get(str(way), str(way)) for one in found for way in one.ways[one.other]})
    if not ways:
        return []
    words = textwrap.fill(f"Not solved: {', '.join(ways)}, with all of its error", _LETTERS)
    return [Line2D([], [], color="black", linestyle="none", marker="o", markerfacecolor="white", label=words)]
