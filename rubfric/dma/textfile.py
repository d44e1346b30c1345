"""The text of a laboratory's file as headings, units and numbers, whatever its separators and decimal marks."""

from __future__ import annotations

import codecs
import csv
import importlib
import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.units import is_unit
from rubfric.errors import InvalidInput

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "space": None}
DECIMALS = {"point": ".", "comma": ","}
# Fewest columns, most lines above the headings, and the share of rows that may be unreadable.
_FEWEST, _PREAMBLE, _UNREADABLE = 3, 300, 0.05
_NUMBER = re.compile(r"^[+-]?(\d+([.,]\d*)*|[.,]\d+)([eE][+-]?\d+)?$")
_WORKBOOK, _ARCHIVE = b"\xd0\xcf\x11\xe0", b"PK\x03\x04"


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
    lines = _decoded(path).replace("\N{MINUS SIGN}", "-").splitlines()
    for kind in [separator] if separator else SEPARATORS:
        rows = _split(lines, SEPARATORS[kind])
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
    return TextTable(headings, units, values, notes)


def _decoded(path: str) -> str:
    if os.path.isdir(path):
        raise InvalidInput(f"{path} is a folder, but must be a file of measured moduli")
    with open(path, "rb") as stream:
        content = stream.read()
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return content.decode("utf-16", errors="replace")
    if content.startswith(_WORKBOOK):
        return _workbook(path, content)
    if content.startswith(_ARCHIVE) or b"\0" in content:
        what = "an Excel file (.xlsx) or an archive" if content.startswith(_ARCHIVE) else "no text file"
        raise InvalidInput(f"{path} is {what}: export the table as text (CSV)")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _workbook(path: str, content: bytes) -> str:
    """Return the longest sheet of an Excel file (.xls), as analysers write it, as text with tabs."""
    try:
        xlrd = importlib.import_module("xlrd")
    except ImportError:
        raise InvalidInput(
            f"{path} is an Excel file (.xls): install rubfric[xls], which reads it, or export the table as text (CSV)"
        ) from None
    try:
        sheets = xlrd.open_workbook(file_contents=content).sheets()
    except Exception as error:  # xlrd raises whatever a damaged file leads it to
        raise InvalidInput(f"{path} is no Excel file that xlrd can read ({error}): export the table as text") from None
    sheet = max(sheets, key=lambda one: one.nrows)
    rows = (sheet.row_values(row) for row in range(sheet.nrows))
    return "\n".join("\t".join(" ".join(str(value).split()) for value in row) for row in rows)


def _split(lines: Sequence[str], separator: str | None) -> list[list[str]]:
    """Return the fields of each line, without empty ones at its end."""
    if separator is None:
        rows = [line.split() for line in lines]
    else:
        rows = list(csv.reader(lines, delimiter=separator, skipinitialspace=True))
        if len(rows) != len(lines):  # a quotation mark, that of E" for one, would swallow lines
            rows = [line.split(separator) for line in lines]
    for row in rows:
        while row and not row[-1].strip():
            row.pop()
    return rows


def _is_heading(rows: Sequence[Sequence[str]], place: int) -> bool:
    """Return whether a line has words only, and the next one, or the one below units, as many columns of numbers."""
    row = rows[place]
    if len(row) < _FEWEST or any(_NUMBER.match(word.strip()) for word in row) or _is_units(row):
        return False
    first = rows[place + 1 : place + 3]
    if first and _is_units(first[0]):
        first = first[1:]
    return bool(first) and len(first[0]) <= len(row) and sum(map(_is_number, first[0])) >= _FEWEST


def _is_number(word: str) -> bool:
    return bool(_NUMBER.match(word.strip()))


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
    known = [(line, row) for line, row in enumerate(rows[below:], below + 1) if any(_is_number(word) for word in row)]
    mark = DECIMALS[decimal] if decimal else _decimal(path, [word for _, row in known for word in row])
    values, bad = [], []
    for line, row in known:
        numbers = [_number(word, mark) for word in _filled(row, len(headings))]
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


def _decimal(path: str, words: Sequence[str]) -> str:
    """Return the decimal mark: a comma where numbers have commas, unless those may separate thousands."""
    commas = [word.strip() for word in words if "," in word and _is_number(word)]
    if not commas:
        return "."
    points = any("." in word and _is_number(word) for word in words)
    if (
        points
        or any(word.count(",") > 1 for word in commas)
        or all(re.match(r"^[+-]?[1-9]\d{0,2},\d{3}$", word) for word in commas)
    ):
        raise InvalidInput(
            f"{path} has numbers such as {commas[0]!r}, whose comma may separate decimals or thousands: write decimal: "
            "comma or decimal: point in the YAML file of --columns"
        )
    return ","


def _number(word: str, mark: str) -> float:
    """Return a number, or NaN for anything else."""
    plain = word.strip()
    if not _is_number(plain):
        return math.nan
    try:
        return float(plain.replace("," if mark == "." else ".", "").replace(mark, "."))
    except ValueError:  # a mark that occurs twice
        return math.nan
