"""What moves friction most: a bar for each number of rubber, road, block and load, the longest on top."""

from __future__ import annotations

import re
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import style
from rubfric.figures.scaling import plain

# In inches: the height of a bar, and of what is around them.
_BAR, _AROUND = 0.155, 0.75
# What rubber, road, block and load, and their bars, are told apart by.
_KINDS = ("Rubber", "Road", "Block and load")
_ROAD, _LOAD = re.compile(r"a(_\d+)?|lambda"), re.compile(r"aspect|p|v|T")
_GREEK = {"nu": r"\nu", "lambda": r"\lambda", "tau": r"\tau"}
_ERROR: dict[str, Any] = {"ecolor": "black", "elinewidth": 0.7, "capsize": 1.4, "capthick": 0.7}
# What is smaller than this part of the largest change is counted, not drawn.
_LEAST = 0.002


@style.applied()
def draw(table: pd.DataFrame, change: float, title: str = "") -> Figure:
    """Draw the change of friction by each number, with its error.

    Parameters
    ----------
    table : pandas.DataFrame
        Columns ``parameter``, ``unit``, ``value``, ``changed_to``, ``friction_change`` and ``friction_change_error``
        (relative), the largest change first; rows without a number are left out.
    change : float
        By how much each number was changed, relative.
    title : str

    Raises
    ------
    InvalidInput
        For a table without any change.
    """
    known = table[table["friction_change"].notna()]
    if known.empty:
        raise InvalidInput("there is no sensitivity to draw: no change of friction is known")
    size = known["friction_change"].abs()
    shown = known[(size >= _LEAST * size.max()) & (size > 0.0)]
    figure = Figure(figsize=(style.COLUMN, _AROUND + _BAR * max(len(shown), 2)), layout="constrained")
    axes = figure.add_subplot()
    looks = dict(zip(_KINDS, style.kinds(len(_KINDS)), strict=True))
    kinds = shown["parameter"].map(_kind)
    for kind, look in looks.items():
        rows = [place for place, one in enumerate(kinds) if one == kind]
        if not rows:
            continue
        own = shown.iloc[rows]
        errors = 100.0 * own["friction_change_error"]
        axes.barh(
            rows, 100.0 * own["friction_change"], 0.72, xerr=errors, color=look["color"], label=kind, error_kw=_ERROR
        )
    axes.set_yticks(range(len(shown)), [_label(row) for row in shown.to_dict("records")])
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.tick_params(axis="y", length=0.0)
    axes.spines["left"].set_visible(False)
    left_out = len(known) - len(shown)
    note = f"\n{left_out} with less than {_LEAST:.1%} of the longest bar are left out" if left_out else ""
    axes.set_xlabel(f"Change of friction (%) where each is {100.0 * change:g} % larger{note}")
    # Centred on all of the figure, not to be cut off.
    figure.suptitle(title, fontsize=style.RC_PARAMS["axes.titlesize"])
    axes.xaxis.set_major_formatter(lambda value, _: plain(value))
    axes.legend(loc="best")
    return figure


def _kind(name: str) -> str:
    return _KINDS[1] if _ROAD.fullmatch(name) else _KINDS[2] if _LOAD.fullmatch(name) else _KINDS[0]


def _label(row: dict[str, Any]) -> str:
    """Return the symbol of a number and its value; where it goes to, if not to a share more."""
    name, unit = row["parameter"], f" {row['unit']}" if row["unit"] else ""
    base, _, index = name.partition("_")
    symbol = _GREEK.get(base, base) + (f"_{{{index}}}" if index else "")
    if name != "aspect":
        symbol = f"${symbol}$"
    value = f"{plain(row['value'], 3)}{unit.replace('degC', '°C')}"
    return f"{symbol} = {value}" if name not in ("nu", "T") else f"{symbol} = {value} to {plain(row['changed_to'], 3)}"
