"""The lines of words above a table of numbers: headings, units, types and settings."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rubfric.columns.clock import looks_like_clock
from rubfric.columns.numerals import is_mark, looks_numeric, parted, plain
from rubfric.columns.units import heading_words, is_unit, split_heading, unit_of
from rubfric.errors import InvalidInput

# Lines of headings at most.
MOST_HEADINGS = 6
# Letters that a unit has at most, with brackets.
_SHORT = 5
_COMMENT = re.compile(r"^\s*(?:[#%]+|//)\s*")
_WIDE_BLANKS, _BRACKETS = re.compile(r" {2,}|\t+"), re.compile(r"\S.*?[\])}](?=\s|$)")
_LABEL = re.compile(r"(y_?)?(unit|einheit|unité|unidad|単位|单位)", re.IGNORECASE)

Row = list[str]


def is_number(word: str) -> bool:
    """Return whether a field holds a number, also with its unit, or the time of a clock."""
    return looks_numeric(word) or looks_like_clock(word) or parted(word) is not None


def block(rows: Sequence[Row], first: int, below: int, least: int = 2) -> list[int]:
    """Return the lines of words right above the first row of numbers, from the nearest one on.

    Parameters
    ----------
    rows : sequence of list of str
        Fields of all lines.
    first, below : int
        Where the numbers begin, and the line above which headings cannot be.
    least : int
        Fewest fields of a line of headings.
    """
    found: list[int] = []
    for place in range(first - 1, max(below, first - MOST_HEADINGS) - 1, -1):
        if not rows[place]:
            continue
        if len(rows[place]) < least or any(map(is_number, rows[place])):
            break
        found.append(place)
    return found


def heading_row(rows: Sequence[Row], block: Sequence[int], names: Sequence[str]) -> int | None:
    """Return the line of the headings: with most of the names expected, with most different words, and highest up.

    Parameters
    ----------
    rows : sequence of list of str
        Fields of all lines.
    block : sequence of int
        Lines to choose from.
    names : sequence of str
        Headings to be expected.
    """
    worded = [place for place in block if not _holds_units(rows[place])] or block
    known = set(names)

    def rank(place: int) -> tuple[int, int, int]:
        cells = [heading_words(word) for word in rows[place]]
        names = sum(not known.isdisjoint([cell, *cell.split()]) for cell in cells)
        return names + sum(bool(split_heading(word)[1]) for word in rows[place]), len(set(cells)), -place

    return max(worded, key=rank, default=None)


def _holds_units(row: Row) -> bool:
    """Return whether the words of a line are units, at least half of them, or all of them short ones."""
    words = [word for word in map(plain, row) if not is_mark(word)]
    count = sum(map(is_unit, words))
    return count > 0 and (2 * count >= len(words) or max(map(len, words)) <= _SHORT)


def units(rows: Sequence[Row], others: Sequence[int], top: int, count: int) -> list[str]:
    """Return the unit of each column: from a line of units beside the headings, or one further up that is labelled.

    Parameters
    ----------
    rows : sequence of list of str
        Fields of all lines.
    others : sequence of int
        Lines of words beside that of the headings.
    top, count : int
        Line of the headings, and number of columns.
    """
    lines = [rows[place] for place in others if _holds_units(rows[place])]
    lines += [row for row in rows[:top] if row and _LABEL.match(plain(row[0])) and row not in lines]
    found = [""] * count
    for line in reversed(lines):
        for place, word in enumerate(line[:count]):
            found[place] = unit_of(word) if not _LABEL.match(plain(word)) and unit_of(word) else found[place]
    return found


def fitting(path: str, kind: str, line: str, row: Row, place: tuple[int, int, int]) -> list[str]:
    """Return the headings of all columns.

    Parameters
    ----------
    path : str
        The file, for messages.
    kind : str
        Name of the separator.
    line : str
    row : list of str
        The fields of that line.
    place : tuple of int
        Number of that line, number of the first row's, and how many fields rows have.

    Raises
    ------
    InvalidInput
        Where there are fewer headings than fields in the rows.
    """
    top, first, width = place
    row = [_COMMENT.sub("", row[0]), *row[1:]] if row else [""]
    if kind == "space":
        row = row if row[0] else row[1:]
        text = _COMMENT.sub("", line).strip()
        # Blanks within headings: those are two or more blanks apart, or each ends with its unit in brackets.
        for others in (_WIDE_BLANKS.split(text), _BRACKETS.findall(text)):
            row = others if len(row) != width == len(others) else row
    if len(row) < width or (kind == "space" and len(row) > width):
        why = {
            "comma": "; where commas separate fields, decimals need points: export with semicolons",
            "space": "; blanks within headings need quotation marks around them",
        }.get(kind, "")
        raise InvalidInput(
            f"{path} has {len(row)} headings in line {top}, but {width} fields in the rows below it, from line "
            f"{first} on: each column needs one heading{why}"
        )
    return [word.strip() for word in row]
