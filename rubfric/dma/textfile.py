"""The text of a laboratory's file as headings, units and numbers, whatever its separators and decimal marks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.columns.decoding import decode
from rubfric.columns.format import DECIMALS
from rubfric.columns.layout import split
from rubfric.columns.numerals import decimal_mark, looks_numeric, number
from rubfric.dma.units import is_unit
from rubfric.errors import InvalidInput

SEPARATORS = ("tab", "semicolon", "comma", "space")
# Fewest columns, most lines above the headings, and the share of rows that may be unreadable.
_FEWEST, _PREAMBLE, _UNREADABLE = 3, 300, 0.05


@dataclass(frozen=True)
class TextTable:
    """What a file holds.

    Attributes
    ----------
    headings, units : tuple of str
        Of each column; units are empty strings where no line below the headings has them.
    values : ndarray, shape (rows, columns)
        NaN where there is no number.
    notes : tuple of str
        What was left out.
    """

    headings: tuple[str, ...]
    units: tuple[str, ...]
    values: Real
    notes: tuple[str, ...]


def read_text(path: str, separator: str | None = None, decimal: str | None = None) -> TextTable:
    """Read a table of text with one or two rows of headings.

    Lines above the headings are passed over, and so are headings that return, one block for each isotherm.

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
        For a file that is no text and no workbook (.xls, with the extra ``xls``), has no headings above numbers, or
        numbers that may be read in two ways.
    FileNotFoundError
        For a missing file.
    """
    text, guess = decode(path, None, ())
    lines = text.splitlines()
    for kind in [separator] if separator else SEPARATORS:
        rows = split(lines, kind)
        start = next((i for i in range(min(len(rows), _PREAMBLE)) if _is_heading(rows, i)), None)
        if start is not None:
            break
    else:
        raise InvalidInput(
            f"{path} has no line of headings above rows of at least {_FEWEST} numbers, separated by tabs, semicolons, "
            "commas or spaces"
        )
    headings, below = tuple(rows[start]), start + 1
    units = tuple("" for _ in headings)
    if _is_units(rows[below]):
        units, below = tuple(_bare(word) for word in _filled(rows[below], len(headings))), below + 1
    values, notes = _numbers(path, rows, below, headings, decimal)
    return TextTable(headings, units, values, (guess, *notes) if guess else notes)


def _is_heading(rows: Sequence[Sequence[str]], place: int) -> bool:
    """Return whether a line has words only, and the next one, or the one below units, as many columns of numbers."""
    row = rows[place]
    if len(row) < _FEWEST or any(map(looks_numeric, row)) or _is_units(row):
        return False
    first = rows[place + 1 : place + 3]
    if first and _is_units(first[0]):
        first = first[1:]
    return bool(first) and len(first[0]) <= len(row) and sum(map(looks_numeric, first[0])) >= _FEWEST


def _is_units(row: Sequence[str]) -> bool:
    words = [_bare(word) for word in row]
    return sum(map(is_unit, words)) >= 2 and all(is_unit(word) or len(word) < 3 or "/" in word for word in words)


def _bare(word: str) -> str:
    return word.strip().strip("[](){} ").strip("-")


def _filled(row: Sequence[str], count: int) -> list[str]:
    return [*row, *[""] * (count - len(row))]


def _numbers(
    path: str, rows: Sequence[Sequence[str]], below: int, headings: tuple[str, ...], decimal: str | None
) -> tuple[Real, tuple[str, ...]]:
    """Return the values of all rows, and a note on those that were left out."""
    known = [(line, row) for line, row in enumerate(rows[below:], below + 1) if any(map(looks_numeric, row))]
    mark = DECIMALS[decimal] if decimal else decimal_mark(path, [word for _, row in known for word in row])
    values, bad = [], []
    for line, row in known:
        found = (number(word, mark) for word in _filled(row, len(headings)))
        numbers = [math.nan if one is None else one for one in found]
        if len(row) > len(headings) or sum(map(math.isfinite, numbers)) < _FEWEST:
            bad.append((line, row))
        else:
            values.append(numbers)
    if len(bad) > _UNREADABLE * len(known) + 1 or not values:
        line, row = bad[0] if bad else (below, [])
        raise InvalidInput(
            f"{path} has {len(bad)} unreadable rows of {len(known)}, the first of them line {line}: "
            f"{'; '.join(row)[:60]!r}"
        )
    notes = (f"{len(bad)} unreadable rows left out, the first of them line {bad[0][0]}",) if bad else ()
    return np.array(values, dtype=np.float64), notes
