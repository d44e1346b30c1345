"""Where the headings, the units and the numbers are in the text of a logger's file, and what separates its fields."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rubfric.columns.format import SEPARATORS
from rubfric.columns.heading_rows import MOST_HEADINGS, Row, block, fitting, heading_row, is_number, units
from rubfric.columns.numerals import is_mark, looks_numeric
from rubfric.errors import InvalidInput

# Lines by which the layout is recognised, and numbers that a row must have by default.
_LOOKED_AT, FEWEST = 1000, 3
# Part of all rows that the one table to read has, unless the user names it.
_MAIN = 0.9

_BLANKS = re.compile(r"[ \t]+")


@dataclass(frozen=True)
class Layout:
    """A table within a text.

    Attributes
    ----------
    separator : str
        A key of ``SEPARATORS``.
    headings, units : tuple of str
        Of each column; empty where there is none.
    heading_line : int
        From 1; 0 where there are no headings.
    rows : list of (int, list of str)
        Number of the line, and its fields without empty ones at the end; blank lines are left out.
    notes : tuple of str
        On repeated headings and other tables.
    """

    separator: str
    headings: tuple[str, ...]
    units: tuple[str, ...]
    heading_line: int
    rows: list[tuple[int, Row]]
    notes: tuple[str, ...] = ()


def find_layout(
    path: str,
    lines: Sequence[str],
    names: Sequence[str],
    separator: str | None = None,
    heading_line: int | None = None,
    fewest: int = FEWEST,
) -> Layout:
    """Return where the table is.

    Rows of numbers have numbers in the columns in which most rows have them; the headings are among the lines of words
    right above the first of them.

    Parameters
    ----------
    path : str
        The file, for messages.
    lines : sequence of str
    names : sequence of str
        Headings to be expected, by which they are told from lines of units and other words.
    separator : str, optional
        A key of ``SEPARATORS``; the one that gives most numbers by default.
    heading_line : int, optional
        Line of the headings, from 1; found by default.
    fewest : int
        Numbers that a row must have.

    Raises
    ------
    InvalidInput
        Where there are no rows of numbers, or headings and rows do not fit one another.
    """
    head = lines[: (heading_line or 0) + _LOOKED_AT]
    below = heading_line or 0
    kinds = [separator] if separator else list(SEPARATORS)
    counts = {kind: _body(split(head[below:], kind), fewest) for kind in kinds}
    kind = max(counts, key=lambda one: len(counts[one][0]) * counts[one][1])
    places, many = counts[kind]
    if not many:
        parted = f"{kind}s" if separator else "tabs, semicolons, commas, pipes or blanks"
        numbers = "numbers" if fewest == 1 else f"at least {fewest} numbers"
        after = f" below line {heading_line}" if heading_line else ""
        raise InvalidInput(f"{path} has no rows of {numbers}{after}, parted by {parted}")
    rows = split(lines, kind)
    tables = _tables(rows, below, places)
    tops = [heading_row(rows, block(rows, first, below, min(2, len(places))), names) for first, _ in tables]
    if heading_line:  # the table ends with the next headings, also where those are repeated
        tables, tops = tables[:1], [heading_line - 1]
    parts, top, notes = _chosen(path, rows, tables, tops)
    body = [(place + 1, rows[place]) for first, end in parts for place in range(first, end) if rows[place]]
    width = Counter(len(row) for _, row in body[:_LOOKED_AT] if _is_like(row, places)).most_common(1)[0][0]
    if top is None:
        return Layout(kind, ("",) * width, ("",) * width, 0, body)
    headings = fitting(path, kind, lines[top], rows[top], (top + 1, body[0][0], width))
    others = [place for place in block(rows, parts[0][0], below, min(2, len(places))) if place != top]
    return Layout(kind, tuple(headings), tuple(units(rows, others, top, len(headings))), top + 1, body, tuple(notes))


def split(lines: Sequence[str], kind: str) -> list[Row]:
    """Return the fields of each line, without those at the end that are empty.

    Parameters
    ----------
    lines : sequence of str
    kind : str
        A key of ``SEPARATORS``; in quotation marks it separates nothing.
    """
    mark = SEPARATORS[kind]
    quoted = re.compile(
        rf'\s*"((?:[^"]|"")*)"\s*(?:{re.escape(mark)}|$)|([^{re.escape(mark)}]*)(?:{re.escape(mark)}|$)'
    )
    rows = []
    for line in lines:
        text = _BLANKS.sub(" ", line.strip(" \t")) if kind == "space" else line
        if '"' in text:
            row = [one[1].replace('""', '"') if one[2] is None else one[2] for one in quoted.finditer(text)]
        else:
            row = text.split(mark)
        while row and not row[-1].strip():
            row.pop()
        rows.append(row)
    return rows


def _body(rows: Sequence[Row], fewest: int) -> tuple[tuple[int, ...], int]:
    """Return the columns in which most rows of numbers have numbers, and how many rows are like that."""
    kinds = Counter(tuple(place for place, word in enumerate(row) if is_number(word)) for row in rows)
    likely = Counter({places: count for places, count in kinds.items() if len(places) >= fewest})
    return likely.most_common(1)[0] if likely else ((), 0)


def _tables(rows: Sequence[Row], below: int, places: Sequence[int]) -> list[tuple[int, int]]:
    """Return the first row of each table, with words where it has words, and the line after its last.

    A new one begins below a line with a word for each column.
    """
    begin = next(place for place in range(below, len(rows)) if _is_like(rows[place], places))
    # Rows of words and numbers right above it belong to the table: they are not to be passed over in silence.
    while begin - 1 >= below and sum(map(looks_numeric, rows[begin - 1])) > 1:
        begin -= 1
    found = []
    place = begin + 1
    while place < len(rows):
        words = (
            len(rows[place]) >= len(places)
            and all(rows[place])
            and not any(is_number(one) or is_mark(one) for one in rows[place])
        )
        after = range(place + 1, min(place + 1 + MOST_HEADINGS, len(rows))) if words else ()
        follow = next((line for line in after if _is_like(rows[line], places)), None)
        if follow is not None:
            end = place
            while not _is_like(rows[end - 1], places):
                end -= 1
            found.append((begin, end))
            begin = place = follow
        place += 1
    return [*found, (begin, len(rows))]


def _chosen(
    path: str, rows: Sequence[Row], tables: Sequence[tuple[int, int]], tops: Sequence[int | None]
) -> tuple[list[tuple[int, int]], int | None, list[str]]:
    """Return the table that has most of the rows, in parts where its headings are repeated, with their first line.

    Raises InvalidInput where other tables have a good part of the rows.
    """
    titles = [None if top is None else rows[top] for top in tops]
    sizes: Counter[str] = Counter()
    for (first, end), title in zip(tables, titles, strict=True):
        sizes[str(title)] += end - first
    name, most = sizes.most_common(1)[0]
    mine = [str(title) == name for title in titles]
    others = [str(first + 1) for (first, _), own in zip(tables, mine, strict=True) if not own]
    if others and most < _MAIN * sizes.total():
        known = [str(top + 1) for top in tops if top is not None]
        lines = f"{', '.join(known[:8])}{', ...' if len(known) > 8 else ''}"
        what = "numbers above its headings, in line" if None in tops else "several tables, with headings in lines"
        raise InvalidInput(
            f"{path} has {what} {lines}: write the line of the headings to read under headings in the YAML file of "
            "--columns"
        )
    parts = [table for table, own in zip(tables, mine, strict=True) if own]
    notes = [f"{len(parts) - 1} repeated lines of headings left out"] if len(parts) > 1 else []
    notes += [f"not read: other tables of numbers, which begin in lines {', '.join(others)}"] if others else []
    return parts, tops[mine.index(True)], notes


def _is_like(row: Row, places: Sequence[int]) -> bool:
    """Return whether a row has numbers, or marks for missing ones, in some columns, and numbers in most of them."""
    if len(row) <= places[-1]:
        return False
    numbers = sum(is_number(row[place]) for place in places)
    return 2 * numbers > len(places) and all(is_number(row[place]) or is_mark(row[place]) for place in places)
