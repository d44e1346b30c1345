"""Where the headings, the units and the numbers are in the text of a logger's file, and what separates its fields."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rubfric.errors import InvalidInput
from rubfric.rig.clock import looks_like_clock
from rubfric.rig.format import SEPARATORS
from rubfric.rig.numerals import is_mark, looks_numeric, plain
from rubfric.rig.units import heading_words, is_unit, unit_of

# Lines by which the layout is recognised, lines of headings at most, and numbers that a row must have.
_LOOKED_AT, _MOST_HEADINGS, _FEWEST = 1000, 6, 3
_COMMENT = re.compile(r"^\s*(?:[#%]+|//)\s*")
_BLANKS, _WIDE_BLANKS = re.compile(r"[ \t]+"), re.compile(r" {2,}|\t+")
_BRACKETS = re.compile(r"\S.*?[\])}](?=\s|$)")
_LABEL = re.compile(r"(y_?)?(unit|einheit|unité|unidad|単位|单位)", re.IGNORECASE)

Row = list[str]


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
    repeated : int
        How often the headings are repeated among the rows; those lines are left out.
    """

    separator: str
    headings: tuple[str, ...]
    units: tuple[str, ...]
    heading_line: int
    rows: list[tuple[int, Row]]
    repeated: int = 0


def find_layout(
    path: str, lines: Sequence[str], names: Sequence[str], separator: str | None = None, heading_line: int | None = None
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

    Raises
    ------
    InvalidInput
        Where there are no rows of numbers, or headings and rows do not fit one another.
    """
    head = lines[: (heading_line or 0) + _LOOKED_AT]
    below = heading_line or 0
    kinds = [separator] if separator else list(SEPARATORS)
    counts = {kind: _body(split(head[below:], kind)) for kind in kinds}
    kind = max(counts, key=lambda one: len(counts[one][0]) * counts[one][1])
    places, many = counts[kind]
    if not many:
        parted = f"{kind}s" if separator else "tabs, semicolons, commas, pipes or blanks"
        after = f" below line {heading_line}" if heading_line else ""
        raise InvalidInput(f"{path} has no rows of at least {_FEWEST} numbers{after}, parted by {parted}")
    rows = split(lines, kind)
    first, width = _first(rows, below, places)
    block = _block(rows, first, below)
    top = heading_line - 1 if heading_line else _names(rows, block, names)
    body = [(place + 1, row) for place, row in enumerate(rows[first:], first) if row]
    if top is None:
        return Layout(kind, ("",) * width, ("",) * width, 0, body)
    headings = _fitting(path, kind, lines[top], rows[top], top, first, width)
    units = _units(rows, [place for place in block if place != top], top, len(headings))
    body, repeated = _without_repeats(body, rows[top], places, whole=heading_line is None)
    return Layout(kind, tuple(headings), tuple(units), top + 1, body, repeated)


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


def _is_number(word: str) -> bool:
    return looks_numeric(word) or looks_like_clock(word)


def _body(rows: Sequence[Row]) -> tuple[tuple[int, ...], int]:
    """Return the columns in which most rows of numbers have numbers, and how many rows are like that."""
    kinds = Counter(tuple(place for place, word in enumerate(row) if _is_number(word)) for row in rows)
    likely = Counter({places: count for places, count in kinds.items() if len(places) >= _FEWEST})
    return likely.most_common(1)[0] if likely else ((), 0)


def _first(rows: Sequence[Row], below: int, places: Sequence[int]) -> tuple[int, int]:
    """Return the first row that is like most, with words where those have words, and how many fields rows have."""
    first = next(place for place in range(below, len(rows)) if _is_like(rows[place], places))
    widths = Counter(len(row) for row in rows[first : first + _LOOKED_AT] if _is_like(row, places))
    # Rows of words and numbers right above it belong to the table: they are not to be passed over in silence.
    while first - 1 >= below and sum(map(looks_numeric, rows[first - 1])) > 1:
        first -= 1
    return first, widths.most_common(1)[0][0]


def _is_like(row: Row, places: Sequence[int]) -> bool:
    """Return whether a row has numbers, or marks for missing ones, in some columns, and numbers in most of them."""
    if len(row) <= places[-1]:
        return False
    numbers = sum(_is_number(row[place]) for place in places)
    return 2 * numbers > len(places) and all(_is_number(row[place]) or is_mark(row[place]) for place in places)


def _block(rows: Sequence[Row], first: int, below: int) -> list[int]:
    """Return the lines of words right above the first row of numbers, from the nearest one on."""
    found: list[int] = []
    for place in range(first - 1, max(below, first - _MOST_HEADINGS) - 1, -1):
        if not rows[place]:
            continue
        if len(rows[place]) < 2 or any(map(_is_number, rows[place])):
            break
        found.append(place)
    return found


def _names(rows: Sequence[Row], block: Sequence[int], names: Sequence[str]) -> int | None:
    """Return the line of the headings: with most of the names expected, with most different words, and highest up."""
    worded = [place for place in block if not _holds_units(rows[place])] or block
    known = set(names)

    def rank(place: int) -> tuple[int, int, int]:
        cells = [heading_words(word) for word in rows[place]]
        return sum(not known.isdisjoint([cell, *cell.split()]) for cell in cells), len(set(cells)), -place

    return max(worded, key=rank, default=None)


def _holds_units(row: Row) -> bool:
    """Return whether at least half of the words of a line are units."""
    words = [word for word in map(plain, row) if not is_mark(word)]
    return bool(words) and 2 * sum(map(is_unit, words)) >= len(words)


def _units(rows: Sequence[Row], others: Sequence[int], top: int, count: int) -> list[str]:
    """Return the unit of each column: from a line of units beside the headings, or one further up that is labelled."""
    lines = [rows[place] for place in others if _holds_units(rows[place])]
    lines += [row for row in rows[:top] if row and _LABEL.match(plain(row[0])) and row not in lines]
    found = [""] * count
    for line in reversed(lines):
        for place, word in enumerate(line[:count]):
            found[place] = unit_of(word) if not _LABEL.match(plain(word)) and unit_of(word) else found[place]
    return found


def _fitting(path: str, kind: str, line: str, row: Row, top: int, first: int, width: int) -> list[str]:
    """Return the headings of all columns, or raise InvalidInput where there are fewer than fields in the rows."""
    row = [_COMMENT.sub("", row[0]), *row[1:]] if row else [""]
    if kind == "space":
        row = row if row[0] else row[1:]
        text = _COMMENT.sub("", line).strip()
        # Blanks within headings: those are two or more blanks apart, or each ends with its unit in brackets.
        for others in (_WIDE_BLANKS.split(text), _BRACKETS.findall(text)):
            row = others if len(row) != width == len(others) else row
    if len(row) < width or (kind == "space" and len(row) > width):
        why = (
            "; a comma that separates fields cannot mark decimals too: export with semicolons"
            if kind == "comma"
            else ""
        )
        why = "; blanks within headings need quotation marks around them" if kind == "space" else why
        raise InvalidInput(
            f"{path} has {len(row)} headings in line {top + 1}, but {width} fields in the rows below it, from line "
            f"{first + 1} on: each column needs one heading{why}"
        )
    return [word.strip() for word in row]


def _without_repeats(
    body: list[tuple[int, Row]], headings: Row, places: Sequence[int], whole: bool
) -> tuple[list[tuple[int, Row]], int]:
    """Return the rows without repeated headings and the lines on top of those; or only those before them."""
    kept: list[tuple[int, Row]] = []
    repeated = 0
    for line, row in body:
        if row != headings:
            kept.append((line, row))
            continue
        while kept and not _is_like(kept[-1][1], places):
            kept.pop()
        if not whole:
            break
        repeated += 1
    return kept, repeated
