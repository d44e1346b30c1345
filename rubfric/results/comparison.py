"""Several rubbers on several roads compared: the friction of each pair, and which grips more, with errors."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
import pandas as pd

from rubfric.checks import decimals, written
from rubfric.results.difference import PARTS, Friction, Interval, difference, interval
from rubfric.results.scales import AXES, ONE_ROAD, RUBBER_PART, TOTAL, WORDS
from rubfric.results.temperature import COLUMN

# Columns of the two tables that are text.
NAMES = ("rubber", "road", "way", "note", "not_covered")
RANKED = ("compared", "on", "first", "second", "verdict", "words", "not_covered")
# Verdicts.
FIRST, SECOND, EQUAL, UNKNOWN = "first grips more", "second grips more", "cannot be told apart", "not known"
_PARTS = ("friction_numerical_error", "friction_coupling_error", "friction_road_error", RUBBER_PART)
_HALVES = tuple(f"{part}_ci95" for part in PARTS)
# Of a point at which a pair has no row.
_NOTHING = Friction(np.nan, np.nan, np.nan, np.nan, np.empty(0))
Tables = Mapping[tuple[str, str], pd.DataFrame]


def comparison_table(tables: Tables, not_covered: Mapping[tuple[str, str], Sequence[str]]) -> pd.DataFrame:
    """Return the friction of every pair at every point, with all parts of its error.

    Parameters
    ----------
    tables : mapping of (str, str) to pandas.DataFrame
        By rubber and road, as from ``rubfric.results.pair.road_by_road``.
    not_covered : mapping of (str, str) to sequence of str
        What no error of a pair covers.

    Returns
    -------
    pandas.DataFrame
        ``friction_total_error`` and its parts are those of the table of totals; ``friction_total_ci95`` is the
        half-width of the 95 % interval that they make together, and ``draws`` how many roads with random phases, or
        windows, the total is the mean of.
    """
    found = []
    for (rubber, road), table in tables.items():
        intervals = [interval(_friction(row)) for row in _rows(table)]
        columns = [*_axes(table), *TOTAL, *(name for name in (*_PARTS, *WORDS) if name in table)]
        own = table[columns].assign(friction_total_ci95=[one.half for one in intervals])
        own = own.assign(draws=[one.roads for one in intervals], not_covered="; ".join(not_covered[rubber, road]))
        own.insert(0, "road", road)
        own.insert(0, "rubber", rubber)
        found.append(own)
    together = pd.concat(found, ignore_index=True)
    last = ["friction_total_ci95", "draws", *WORDS, "not_covered"]
    return together[[*(name for name in together.columns if name not in last), *last]]


def ranking_table(tables: Tables, not_covered: Mapping[tuple[str, str], Sequence[str]]) -> pd.DataFrame:
    """Return which of two rubbers grips more on each road, and on which of two roads each rubber does, at every point.

    Parameters
    ----------
    tables, not_covered
        As for ``comparison_table``.

    Returns
    -------
    pandas.DataFrame
        ``difference`` is that of the first from the second, ``difference_ci95`` the half-width of its 95 % interval
        and ``numerical_ci95``, ... the parts of that, whose squares it adds; ``draws`` counts roads with random phases,
        or windows, as ``rubfric.results.difference.difference`` does. ``verdict`` and ``words`` say what that means.
    """
    rows = []
    for compared, on, first, second, one, other in _compared(tables):
        without = "; ".join(dict.fromkeys((*not_covered[one], *not_covered[other])))
        others = {_at(row): _friction(row) for row in _rows(tables[other])}
        for row in _rows(tables[one]):
            at = _at(row)
            pair = _friction(row), others.get(at, _NOTHING)
            found = difference(*pair, same_road=compared == "rubbers")
            verdict = _verdict(found)
            rows.append(
                dict(zip(_axes(tables[one]), at, strict=True))
                | {"compared": compared, "on": on, "first": first, "second": second}
                | {"friction_first": pair[0].value, "friction_second": pair[1].value}
                | {"difference": found.value, "difference_ci95": found.half}
                | dict(zip(_HALVES, (getattr(found, part) for part in PARTS), strict=True))
                | {"draws": found.roads, "verdict": verdict}
                | {"words": _words(compared, on, (first, second), found, verdict, at), "not_covered": without}
            )
    table = pd.DataFrame(rows)
    return table.sort_values([AXES[1], *_axes(table)[2:]], kind="stable", ignore_index=True)


def headlines(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """Return in a sentence each how often which of two rubbers grips more on a road, and likewise of roads.

    Parameters
    ----------
    rows : iterable of mapping
        Those of a ranking.
    """
    counts: dict[tuple[str, str, str, str], Counter[str]] = {}
    for row in rows:
        counts.setdefault((row["compared"], row["on"], row["first"], row["second"]), Counter())[row["verdict"]] += 1
    return [_headline(*pair, count) for pair, count in counts.items()]


def _headline(compared: str, on: str, first: str, second: str, count: Counter[str]) -> str:
    more, less = (first, second) if count[FIRST] >= count[SECOND] else (second, first)
    most, least = sorted((count[FIRST], count[SECOND]), reverse=True)
    where = f"on {on}" if compared == "rubbers" else f"under {on}"
    if not most:
        return f"{more} and {less} cannot be told apart {where} at any of {count.total()} points"
    whom = f"{more} grips more than {less} {where}"
    if compared == "roads":
        whom = f"{on} grips more on {more} than on {less}"
    others = [(least, "less"), (count[EQUAL], "neither for certain"), (count[UNKNOWN], "not known")]
    rest = "".join(f", {what} at {number}" for number, what in others if number)
    return f"{whom} at {most} of {count.total()} points{rest}"


def _compared(tables: Tables) -> Iterator[tuple[str, str, str, str, tuple[str, str], tuple[str, str]]]:
    """Yield what is compared, on or under what, the names of both, and their pairs."""
    rubbers, roads = (list(dict.fromkeys(names)) for names in zip(*tables, strict=True))
    for road in roads:
        for first, second in combinations(rubbers, 2):
            yield "rubbers", road, first, second, (first, road), (second, road)
    for rubber in rubbers:
        for first, second in combinations(roads, 2):
            yield "roads", rubber, first, second, (rubber, first), (rubber, second)


def _axes(table: pd.DataFrame) -> list[str]:
    return [*AXES, *([COLUMN] if COLUMN in table else [])]


def _rows(table: pd.DataFrame) -> list[dict[str, Any]]:
    return table.to_dict("records")


def _at(row: Mapping[str, Any]) -> tuple[float, ...]:
    """Return the point of a row: speed, pressure and, with it, temperature."""
    return tuple(row[axis] for axis in (*AXES, COLUMN) if axis in row)


def _friction(row: Mapping[str, Any]) -> Friction:
    """Return the friction of a row of a table of totals; its roads one by one where the total is their mean."""
    roads = [value for name, value in row.items() if re.fullmatch(rf"{ONE_ROAD}\d+", name) and row["way"] == "direct"]
    value, numerical, coupling = (float(row[name]) for name in (TOTAL[0], *_PARTS[:2]))
    return Friction(value, numerical, coupling, float(row.get(RUBBER_PART, np.nan)), np.array(roads, dtype=np.float64))


def _verdict(found: Interval) -> str:
    if math.isnan(found.value):
        return UNKNOWN
    if math.isnan(found.half) or abs(found.value) <= found.half:
        return EQUAL
    return FIRST if found.value > 0.0 else SECOND


def _words(
    compared: str, on: str, names: tuple[str, str], found: Interval, verdict: str, point: tuple[float, ...]
) -> str:
    """Return a verdict in words."""
    first, second = names
    size, half = _digits(found)
    at, where = _place(point), f"on {on}" if compared == "rubbers" else f"under {on}"
    if verdict == UNKNOWN:
        return f"{first} and {second} are not compared {where} {at}, since a total is missing"
    if verdict == EQUAL:
        error = f"they differ by {size} ± {half}" if half else "the error of the difference is not known"
        return f"{first} and {second} cannot be told apart {where} {at}: {error}"
    more, less = names if verdict == FIRST else (second, first)
    by = f"{at}, by {size} ± {half}"
    if compared == "rubbers":
        return f"{more} grips more than {less} {where} {by}"
    return f"{on} grips more on {more} than on {less} {by}"


def _digits(found: Interval) -> tuple[str, str]:
    """Return the size of a difference and its half-width, two digits of it; that is empty where it is not known."""
    value, half = abs(found.value), found.half
    if math.isnan(half):
        return f"{value:.3g}", ""
    size = half or value
    places = max(0, decimals(size, 2)) if size else 0
    return f"{value:.{places}f}", f"{half:.{places}f}"


def _place(point: tuple[float, ...]) -> str:
    """Return a point in words: ``at 100 mm/s and 0.5 MPa, 20 degC``."""
    speed, pressure, *warm = map(written, point)
    return f"at {speed} mm/s and {pressure} MPa" + "".join(f", {one} degC" for one in warm)
