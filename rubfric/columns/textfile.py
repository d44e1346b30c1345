"""A logger's file as headings, units and numbers: bytes, lines, layout, columns, one after the other."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.columns import labview
from rubfric.columns.clock import clock_times, looks_like_clock
from rubfric.columns.decoding import decode
from rubfric.columns.format import AS_FOUND, DECIMALS, Format
from rubfric.columns.heading_rows import is_number
from rubfric.columns.layout import FEWEST, Layout, find_layout
from rubfric.columns.numerals import decimal_mark, looks_numeric, number, parted
from rubfric.errors import InvalidInput

# Rows with an unreadable field: at most so many with words of one form, and at most this share of all rows.
_ALIKE, _MOST_UNREADABLE = 2, 0.01
# Most lines that a heading in quotation marks may have.
_TALLEST = 40
_FIRST_LINES = 50


@dataclass(frozen=True)
class TextTable:
    """What a logger's file holds.

    Attributes
    ----------
    preamble : tuple of str
        Lines before the numbers.
    headings, units : tuple of str
        Of each column; empty strings where there are none.
    values : numpy.ndarray, shape (rows, columns)
        NaN where a value is missing, infinite where the logger wrote that its input was overloaded.
    unreadable : numpy.ndarray of bool, shape (rows, columns)
        Where there is a word that is no number; the value is NaN.
    rows : list of (int, list of str)
        Number of the line, and its fields.
    notes : tuple of str
        What was guessed or left out.
    clocks : tuple of int
        Columns that held times as a clock shows them; they are in s.
    line : int
        Of the headings, or else of the first numbers, from 1.
    """

    preamble: tuple[str, ...]
    headings: tuple[str, ...]
    units: tuple[str, ...]
    values: Real
    unreadable: Flags
    rows: list[tuple[int, list[str]]]
    notes: tuple[str, ...]
    clocks: tuple[int, ...] = ()
    line: int = 1


def read_text(path: str, form: Format = AS_FOUND, names: Sequence[str] = (), fewest: int = FEWEST) -> TextTable:
    """Read a logger's file.

    Parameters
    ----------
    path : str
    form : Format
        What is not said is found out.
    names : sequence of str
        Headings to be expected, in small letters and without units.
    fewest : int
        Numbers that a row must have.

    Raises
    ------
    InvalidInput
        For a file without rows of numbers, with fields that cannot be read, or with numbers that may be read in two
        ways.
    FileNotFoundError
        For a missing file.
    """
    text, guess = decode(path, form.encoding, names)
    lines = _lines(text)
    form = labview.completed(path, lines, form)
    layout = labview.named(lines, find_layout(path, lines, names, form.separator, form.headings, fewest))
    top = layout.heading_line or layout.rows[0][0]
    above = tuple(lines[: top - 1])
    rows, units = _rows(layout)
    values, unreadable, clocks = _numbers(path, layout, rows, form)
    headings = layout.headings
    notes = [guess] if guess else []
    notes += layout.notes
    words = len(layout.rows) - len(rows)
    notes += [f"{words} lines without numbers left out below the headings"] if words else []
    time = labview.times(lines[:top], len(values))
    if time is not None:
        headings, units, values = (*headings, "time"), (*units, "s"), np.column_stack([values, time])
        unreadable = np.column_stack([unreadable, np.zeros(len(values), dtype=bool)])
    return TextTable(above, headings, units, values, unreadable, rows, tuple(notes), clocks, top)


def _lines(text: str) -> list[str]:
    """Return the lines of a text; one field of the headings in quotation marks may have been written over several."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for place, line in enumerate(lines[:_FIRST_LINES]):
        quotes = line.count('"') * (not _begins_numeric(line))
        end = place + 1
        while quotes % 2 and end < min(place + _TALLEST, len(lines)) and not _begins_numeric(lines[end]):
            quotes += lines[end].count('"')
            end += 1
        if quotes % 2 == 0 and end > place + 1:
            # The number of lines stays, so that messages name the right ones.
            lines[place:end] = [*[""] * (end - place - 1), " ".join(lines[place:end])]
    return lines


def _begins_numeric(line: str) -> bool:
    return looks_numeric(re.split(r"[\t;,|]", line)[0])


def _rows(layout: Layout) -> tuple[list[tuple[int, list[str]]], tuple[str, ...]]:
    """Return all rows with numbers, filled up with empty fields, and the units of the columns.

    A unit that all numbers of a column have behind them becomes that of the column.
    """
    count, units = len(layout.headings), list(layout.units)
    rows = [
        (line, [*row, *[""] * (count - len(row))]) for line, row in layout.rows if any(is_number(word) for word in row)
    ]
    for place in range(count):
        pairs = [parted(row[place]) for _, row in rows] if parted(rows[0][1][place]) else []
        found = {pair[1] for pair in pairs if pair}
        if len(found) == 1:
            units[place] = found.pop()
            for (_, row), pair in zip(rows, pairs, strict=True):
                row[place] = pair[0] if pair else row[place]
    return rows, tuple(units)


def _numbers(
    path: str, layout: Layout, rows: Sequence[tuple[int, list[str]]], form: Format
) -> tuple[Real, Flags, tuple[int, ...]]:
    """Return the values of all rows, which of those are unreadable, and which columns are clocks."""
    count = len(layout.headings)
    mark = DECIMALS[form.decimal] if form.decimal else decimal_mark(path, (word for _, row in rows for word in row))
    special = re.compile(f"({_pattern(form.missing)})|({_pattern(form.overloaded)})")
    values, unreadable = np.full((len(rows), count), np.nan), np.zeros((len(rows), count), dtype=bool)
    clocks = []
    for place, heading in enumerate(layout.headings):
        words = [row[place] for _, row in rows]
        if sum(map(looks_like_clock, words)) > len(words) // 2:
            clocks.append(place)
            values[:, place] = clock_times(f"{path}, column {heading or place + 1!r},", words)
            continue
        numbers = [number(word, mark, special) for word in words]
        # A column without a single number holds words, such as dates or states.
        if any(one is not None and not math.isnan(one) for one in numbers):
            unreadable[:, place] = [one is None for one in numbers]
            values[:, place] = [math.nan if one is None else one for one in numbers]
    unreadable[[len(row) > count for _, row in rows]] = True
    return values, unreadable, tuple(clocks)


def _pattern(words: Sequence[str]) -> str:
    """Return a regular expression for words in which ``*`` is for any characters, unless they hold nothing else."""
    found = [re.escape(word) if word.strip("*") == "" else re.escape(word).replace(r"\*", ".*") for word in words]
    return "|".join(rf"{word}(?:[.,]0*)?" if word[-1:].isdigit() else word for word in found) or "(?!)"


def readable(path: str, table: TextTable, places: Sequence[int]) -> tuple[Flags, list[str]]:
    """Return which rows can be read in some columns, and a note where others are left out.

    What cannot be read may go with the value, as an unknown sign does, so that the rest would be biased. Only a few
    words, each of another form, are accidents.

    Parameters
    ----------
    path : str
        The file, for messages.
    table : TextTable
    places : sequence of int
        The columns.

    Raises
    ------
    InvalidInput
        Where leaving rows out could bias the rest.
    """
    bad: Flags = np.asarray(table.unreadable[:, list(places)].any(axis=1))
    if not bad.any():
        return np.logical_not(bad), []
    count = len(table.headings)
    forms: Counter[str] = Counter()
    first = ""
    for at in np.flatnonzero(bad):
        line, row = table.rows[at]
        column = next(place for place in places if table.unreadable[at, place])
        long = len(row) > count
        forms["long" if long else re.sub(r"\d+", "0", row[column])] += 1
        what = f"{len(row)} fields for {count} headings" if long else repr(row[column].strip()[:40])
        first = first or f"line {line}: {what}" + ("" if long else f" in the column {table.headings[column]!r}")
    if forms.most_common(1)[0][1] > _ALIKE or bad.sum() > _MOST_UNREADABLE * bad.size + 1:
        raise InvalidInput(
            f"{path} has {bad.sum()} unreadable rows of {bad.size}, the first of them {first}; to leave them out could "
            "bias the rest: correct them, or list such words in the YAML file of --columns, under missing if they mean "
            "that there is no value, or under overloaded if an input was beyond its range"
        )
    return np.logical_not(bad), [f"{bad.sum()} unreadable rows left out, the first of them {first}"]
