"""The numbers that decide on a claim beside their limit: where marks, errors and words are in a small plot."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import pandas as pd

from rubfric.checks import decimals

# Size of a plot and of its margins, in its own units, which are pixels on a phone.
WIDTH, HEIGHT = 340.0, 92.0
_SIDE, _TOP, _BOTTOM = 14.0, 34.0, 20.0
# Rows over which marks are spread, so that they do not hide one another.
_ROWS = 4
# Half the width of the longest words at a mark, and how far they reach beyond it where the plot ends.
_WORDS, _INSIDE = 60.0, 6.0


class Mark(NamedTuple):
    """A number: where it is, where its error begins and ends, what it says of the claim, and itself in words."""

    x: float
    y: float
    low: float
    high: float
    kind: str
    words: str


def strip(found: pd.DataFrame, value: float | None = None) -> dict[str, Any]:
    """Return what a template draws of one criterion.

    Parameters
    ----------
    found : pandas.DataFrame
        The rows of ``evidence_table`` on one part of a claim, in one reading.
    value : float, optional
        The number that decides on the claim, where it is one of these.

    Returns
    -------
    dict
        ``marks``; ``limit``, where the threshold is, ``limit_words`` and their place, ``from`` and ``to`` of the side
        that supports the claim; ``ticks``, numbers below the axis with their places; and ``decides``, the deciding mark
        and the place of its words, or None. Empty where no number is known.
    """
    known = found[found["value"].abs() < math.inf]
    if known.empty:
        return {}
    limit, above = float(known["limit"].iloc[0]), known["sense"].iloc[0] == "above"
    low, high = min(limit, float(known["value"].min())), max(limit, float(known["value"].max()))
    spare = 0.06 * (high - low) or 0.05 * abs(high) or 1.0
    low, high = low - spare, high + spare

    def place(at: float) -> float:
        inside = min(max(at, low), high)
        return round(_SIDE + (WIDTH - 2.0 * _SIDE) * (inside - low) / (high - low), 1)

    marks = [_mark(row, number, place) for number, (_, row) in enumerate(known.iterrows())]
    decides = None
    if value is not None:
        distance = (known["value"] - value).abs().to_numpy()
        decides = marks[int(distance.argmin())]
    at = place(limit)
    return {
        "marks": marks,
        "limit": at,
        "from": at if above else _SIDE,
        "to": WIDTH - _SIDE if above else at,
        "limit_words": (_anchor(at), f"{known['sense'].iloc[0]} {percent(limit)}"),
        "ticks": [(_anchor(place(one)), percent(one)) for one in _ends(known, place)],
        "decides": decides and (_anchor(decides.x), decides),
    }


def _mark(row: pd.Series, number: int, place: Callable[[float], float]) -> Mark:
    value, error = float(row["value"]), float(row["error"])
    known = error if math.isfinite(error) else 0.0
    step = (HEIGHT - _TOP - _BOTTOM) / (_ROWS + 1)
    y = round(_TOP + step * (1 + number % _ROWS), 1)
    shown = percent(value, error)
    return Mark(place(value), y, place(value - known), place(value + known), str(row["outcome"]), shown)


def _ends(known: pd.DataFrame, place: Callable[[float], float]) -> list[float]:
    """Return the least and the largest number; the latter alone where their words would touch."""
    ends = sorted({float(known["value"].min()), float(known["value"].max())})
    if len(ends) == 2 and place(ends[1]) - place(ends[0]) < 2.0 * _WORDS:
        ends = ends[1:]
    return ends


def _anchor(x: float) -> tuple[float, str]:
    """Return where words about a place begin, end or have their middle, so that they stay inside."""
    if x < _WORDS:
        return max(x - _INSIDE, 0.0), "start"
    if x > WIDTH - _WORDS:
        return min(x + _INSIDE, WIDTH), "end"
    return x, "middle"


def percent(value: float, error: float = math.nan) -> str:
    """Return a share in per cent, with its error where there is one, as far as two digits of that go."""
    if not math.isfinite(error) or error <= 0.0:
        text = f"{100.0 * value + 0.0:.3g}"
    else:
        places = decimals(100.0 * error, 2)
        text = " ± ".join(f"{round(100.0 * one, places):.{max(places, 0)}f}" for one in (value, error))
    return f"{text} %".replace("-", "\N{MINUS SIGN}")
