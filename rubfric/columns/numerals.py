"""Numbers as loggers and spreadsheets write them."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable

from rubfric.columns.units import is_unit
from rubfric.errors import InvalidInput

_MISSING = {"", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?", "inf", "-inf", "+inf"}
_OVERLOADED = {"ol", "ovl", "over", "overload", "ovr", "overflow", "#over", "ovf"}
# What looks like a minus, and like an apostrophe; compatible forms (wide digits, no-break blanks) are unified before.
_SIGNS = str.maketrans(dict.fromkeys("‐‑‒–—−﹣－", "-") | dict.fromkeys("’‘ʼ´`", "'"))
_QUOTES = "\"'"
_NUMBER = re.compile(r"[+-]?(\d[\d.,' ]*|[.,]\d+)([eEdD][+-]?\d+)?")
_WITH_UNIT = re.compile(r"(.*\d[.,]?)\s*([^\d\s.,:'+-][^\d\s]*)")
# Parts of a number with marks of thousands, for each decimal mark.
_READINGS = {
    mark: re.compile(
        rf"([+-]?)(\d*|[1-9]\d{{0,2}}(?:(?P<part>[{other}' ])\d{{3}})(?:(?P=part)\d{{3}})*)"
        rf"(?:\{mark}(\d*))?(?:[eEdD]([+-]?\d+))?"
    )
    for mark, other in ((".", ","), (",", "."))
}


def plain(word: str) -> str:
    """Return a word with plain signs and blanks, and without quotation marks around it."""
    if not word.isascii():
        word = unicodedata.normalize("NFKC", word).translate(_SIGNS)
    return word.strip().strip(_QUOTES).strip()


def looks_numeric(word: str) -> bool:
    """Return whether a word is a number under any decimal mark."""
    return bool(_NUMBER.fullmatch(plain(word)))


def parted(word: str) -> tuple[str, str] | None:
    """Return number and unit of a field such as ``0.52 N``; None for any other."""
    found = _WITH_UNIT.fullmatch(plain(word))
    return (found[1], found[2]) if found and looks_numeric(found[1]) and is_unit(found[2]) else None


def is_mark(word: str) -> bool:
    """Return whether a word stands where a logger has no number: it is missing, or its input was overloaded."""
    return plain(word).casefold() in _MISSING | _OVERLOADED


def number(word: str, mark: str, special: re.Pattern[str] | None = None) -> float | None:
    """Return a number, NaN for a missing one, infinity for an overloaded input, or None for anything else.

    Parameters
    ----------
    word : str
    mark : {".", ","}
        Before decimals; the other mark, apostrophes and blanks may part thousands.
    special : re.Pattern, optional
        Of more words: for a missing value in its first group, for an overloaded input in its second.
    """
    text = plain(word)
    if special and (found := special.fullmatch(text)):
        return math.inf if found[1] is None else math.nan
    try:
        return float(text) if mark == "." and text[-1:].isdigit() and "_" not in text else _number(text, mark)
    except ValueError:
        return _number(text, mark)


def _number(text: str, mark: str) -> float | None:
    folded = text.casefold()
    if folded in _MISSING | _OVERLOADED:
        return math.nan if folded in _MISSING else math.inf
    found = _READINGS[mark].fullmatch(text)
    if found is None or not (found[2] or found[4]):
        return None
    digits = re.sub(r"\D", "", found[2])
    return float(f"{found[1]}{digits or 0}.{found[4] or 0}e{found[5] or 0}")


def decimal_mark(path: str, words: Iterable[str]) -> str:
    """Return the decimal mark by which most numbers can be read: a point where none has a comma.

    Parameters
    ----------
    path : str
        The file, for messages.
    words : iterable of str
        All fields below the headings.

    Raises
    ------
    InvalidInput
        Where both marks do equally well.
    """
    marked = [word for word in words if "," in word or "." in word]
    if not any("," in word and looks_numeric(word) for word in marked):
        return "."
    read = {mark: sum(number(word, mark) is not None for word in marked) for mark in _READINGS}
    if read["."] != read[","]:
        return max(read, key=lambda mark: read[mark])
    shown = next(word for word in marked if "," in word and looks_numeric(word))
    raise InvalidInput(
        f"{path} has numbers such as {plain(shown)[:40]!r}, whose comma may separate decimals or thousands: write "
        "decimal: comma or decimal: point in the YAML file of --columns"
    )
