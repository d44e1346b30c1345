"""The text of a logger's file as headings and numbers, whatever its separators, decimal marks and preamble."""

from __future__ import annotations

import codecs
import csv
import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.rig.clock import clock_times, looks_like_clock
from rubfric.rig.units import is_unit

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "space": None}
DECIMALS = {"point": ".", "comma": ","}
# Most lines before the headings, and rows below them that must look like numbers.
_LONGEST_PREAMBLE, _ROWS_TO_LOOK_AT = 300, 3
_FEWEST_COLUMNS = 4
# Lines below the headings by which they are recognised: a line of units, and rows of numbers with empty ones.
_LOOKED_AT = 2 + 2 * _ROWS_TO_LOOK_AT
# Share of rows that may be unreadable.
_MOST_UNREADABLE = 0.05
_MISSING = {"", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?", "inf", "-inf", "+inf"}
_OVERLOADED = {"ol", "ovl", "over", "overload", "ovr", "overflow", "#over", "ovf"}
_NUMBER = re.compile(r"^[+-]?(\d+([.,]\d*)*|[.,]\d+)([eE][+-]?\d+)?$")


@dataclass(frozen=True)
class TextTable:
    """What a logger's file holds.

    Attributes
    ----------
    preamble : tuple of str
        Lines before the headings.
    headings, units : tuple of str
        Of each column; units are empty strings where no line below the headings holds them.
    values : numpy.ndarray, shape (rows, columns)
        NaN where a value is missing, infinite where the logger wrote that its input was overloaded.
    notes : tuple of str
        What was left out.
    clocks : tuple of int
        Columns that held times as a clock shows them; they are in s.
    """

    preamble: tuple[str, ...]
    headings: tuple[str, ...]
    units: tuple[str, ...]
    values: Real
    notes: tuple[str, ...]
    clocks: tuple[int, ...] = ()


def read_text(path: str, separator: str | None = None, decimal: str | None = None) -> TextTable:
    """Read a logger's file.

    Parameters
    ----------
    path : str
    separator : {"tab", "semicolon", "comma", "space"}, optional
        Found out by default.
    decimal : {"point", "comma"}, optional
        Found out by default.

    Raises
    ------
    InvalidInput
        For a file without headings above numbers, or with numbers that may be read in two ways.
    FileNotFoundError
        For a missing file.
    """
    lines = _decoded(path).replace("\N{MINUS SIGN}", "-").splitlines()
    kinds = [separator] if separator else list(SEPARATORS)
    for kind in kinds:
        start = _headings(_split(lines[: _LONGEST_PREAMBLE + _LOOKED_AT], SEPARATORS[kind]))
        if start is not None:
            rows = _split(lines, SEPARATORS[kind])
            break
    else:
        raise InvalidInput(
            f"{path} has no line of headings above rows of at least {_FEWEST_COLUMNS} numbers, parted by "
            "tabs, semicolons, commas or spaces"
        )
    headings = tuple(rows[start])
    below = start + 1
    units = tuple("" for _ in headings)
    if _is_units(rows[below], len(headings)):
        units, below = tuple(word.strip().strip("[](){} ") for word in rows[below]), below + 1
    values, notes, clocks = _numbers(path, rows[below:], headings, decimal, below)
    return TextTable(tuple(lines[:start]), headings, units, values, notes, clocks)


def _decoded(path: str) -> str:
    """Return a file's text, whatever its encoding."""
    if os.path.isdir(path):
        raise InvalidInput(f"{path} is a folder, but must be a file of measured values")
    with open(path, "rb") as stream:
        content = stream.read()
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content:
        raise InvalidInput(f"{path} is no text file: export the record as text (CSV)")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _split(lines: Sequence[str], separator: str | None) -> list[list[str]]:
    """Return the fields of each line."""
    if separator is None:
        return [line.split() for line in lines]
    rows = list(csv.reader(lines, delimiter=separator, skipinitialspace=True))
    # A quotation mark that is never closed would swallow lines: then they are split as they are.
    return rows if len(rows) == len(lines) else [line.split(separator) for line in lines]


def _headings(rows: Sequence[Sequence[str]]) -> int | None:
    """Return the line of the headings: no number in it, and as many numbers in each of the rows below."""
    for place in range(min(len(rows) - 1, _LONGEST_PREAMBLE)):
        count = len(rows[place])
        if count < _FEWEST_COLUMNS or any(_looks_numeric(word) for word in rows[place]):
            continue
        below = place + 2 if _is_units(rows[place + 1], count) else place + 1
        first = [row for row in rows[below : below + 2 * _ROWS_TO_LOOK_AT] if any(word.strip() for word in row)]
        good = [row for row in first if len(row) == count and any(_looks_numeric(word) for word in row)]
        if good and good[0] is first[0] and len(good) >= min(_ROWS_TO_LOOK_AT, len(first)):
            return place
    return None


def _is_units(row: Sequence[str], count: int) -> bool:
    """Return whether a line holds units: nothing else, and at least one that is known."""
    words = [word.strip() for word in row]
    return len(row) == count and any(map(is_unit, words)) and not any(map(_looks_numeric, words))


def _looks_numeric(word: str) -> bool:
    return bool(_NUMBER.match(word.strip()))


def _numbers(
    path: str, rows: Sequence[Sequence[str]], headings: Sequence[str], decimal: str | None, before: int
) -> tuple[Real, tuple[str, ...], tuple[int, ...]]:
    """Return the values of all rows, notes on rows that were left out, and which columns are clocks."""
    filled = [(line, row) for line, row in enumerate(rows, before + 1) if any(word.strip() for word in row)]
    mark = DECIMALS[decimal] if decimal else _decimal(path, [word for _, row in filled for word in row])
    count = len(headings)
    whole = [(line, row) for line, row in filled if len(row) == count]
    columns, clocks = [], []
    for place, heading in enumerate(headings):
        numbers, is_clock = _column(f"{path}, column {heading!r},", [row[place] for _, row in whole], mark)
        columns.append(numbers)
        clocks += [place] if is_clock else []
    read = {line: numbers for (line, _), *numbers in zip(whole, *columns, strict=True) if None not in numbers}
    bad = [(line, row) for line, row in filled if line not in read]
    if len(bad) > _MOST_UNREADABLE * len(filled) + 1:
        line, row = bad[0]
        shown = "; ".join(row)[:60]
        raise InvalidInput(
            f"{path} has {len(bad)} unreadable rows of {len(filled)}, the first of them line {line}: {shown!r}"
        )
    notes = (f"{len(bad)} unreadable rows left out, the first of them line {bad[0][0]}",) if bad else ()
    return np.array(list(read.values()), dtype=np.float64).reshape(-1, count), notes, tuple(clocks)


def _column(where: str, words: Sequence[str], mark: str) -> tuple[list[float | None], bool]:
    """Return the numbers of a column, None where a word is none, and whether they are the times of a clock, in s.

    A column without a single number holds words, such as dates or states, which count as missing.
    """
    numbers = [_number(word, mark) for word in words]
    if any(number is not None for number in numbers):
        return numbers, False
    if sum(map(looks_like_clock, words)) > len(words) // 2:
        return list(clock_times(where, words)), True
    return [math.nan] * len(words), False


def _decimal(path: str, words: Sequence[str]) -> str:
    """Return the decimal mark: a comma where numbers have commas, unless those may part thousands."""
    commas = [word.strip() for word in words if "," in word and _looks_numeric(word)]
    if not commas:
        return "."
    points = any("." in word and _looks_numeric(word) for word in words)
    if points or any(word.count(",") > 1 for word in commas):
        raise InvalidInput(
            f"{path} has commas and points in its numbers, such as {commas[0]!r}: export it without marks of "
            "thousands, or say in the YAML file of --columns which one is the decimal mark"
        )
    if all(re.match(r"^[+-]?[1-9]\d{0,2},\d{3}$", word) for word in commas):
        raise InvalidInput(
            f"{path} has numbers such as {commas[0]!r}, whose comma may part decimals or thousands: write decimal: "
            "comma or decimal: point in the YAML file of --columns"
        )
    return ","


def _number(word: str, mark: str) -> float | None:
    """Return a number, NaN for a missing one, infinity for an overloaded input, or None for anything else."""
    plain = word.strip()
    if not _NUMBER.match(plain):
        folded = plain.casefold()
        return math.nan if folded in _MISSING else math.inf if folded in _OVERLOADED else None
    # The other mark parts thousands, where the user has said so.
    other = "." if mark == "," else ","
    if other in plain:
        plain = plain.replace(other, "")
    try:
        return float(plain.replace(mark, "."))
    except ValueError:  # a mark that occurs twice
        return None
