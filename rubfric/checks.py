"""One sentence for every bad value: the key, the value, and what is allowed.

Numbers are brought to one canonical form here (twelve significant digits), so that 0.1, 1.0e-1 and
0.10 are one number and 0.30000000000000004 never reaches a file name.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any

import numpy as np

from rubfric.errors import InvalidInput

SIGNIFICANT_DIGITS = 12
# Words that stand in file names, which have room for 255 bytes.
LONGEST_WORD = 100
# What a message shows of a wrong value.
_MOST_SHOWN = 80
# Bounds on every quantity that must be positive: their products stay far from overflow and underflow.
SMALLEST, LARGEST = 1e-30, 1e30


def number(key: str, value: Any) -> float:
    """Return ``value`` as a canonical finite float, or raise InvalidInput naming ``key``."""
    if isinstance(value, str):
        raise InvalidInput(f"{key} is the text {shown(value)}, but must be a number{_yaml_hint(value)}")
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InvalidInput(f"{key} is {shown(value)}, but must be a number")
    try:
        converted = float(value)
    except OverflowError:
        converted = math.inf
    if not math.isfinite(converted):
        raise InvalidInput(f"{key} is {converted}, but must be a finite number")
    return float(f"{converted:.{SIGNIFICANT_DIGITS}g}") + 0.0  # no minus zero


def _yaml_hint(text: str) -> str:
    try:
        parsed = float(text)
    except ValueError:
        return ""
    if not math.isfinite(parsed) or "e" not in text.lower():
        return ""
    mantissa, _, exponent = f"{parsed:e}".partition("e")
    mantissa = mantissa.rstrip("0")
    written = f"{mantissa}{'0' if mantissa.endswith('.') else ''}e{int(exponent):+d}"
    return f" (YAML reads it as text; write {written})"


def positive(key: str, value: Any, unit: str = "") -> float:
    """Return a canonical number greater than zero."""
    checked = number(key, value)
    if checked <= 0.0:
        raise InvalidInput(f"{key} is {checked:g}{_unit(unit)}, but must be greater than 0")
    if not SMALLEST <= checked <= LARGEST:
        raise InvalidInput(f"{key} is {checked:g}{_unit(unit)}, but must lie between {SMALLEST:g} and {LARGEST:g}")
    return checked


def at_least(key: str, value: Any, low: float, unit: str = "") -> float:
    """Return a canonical number of at least ``low``."""
    checked = number(key, value)
    if checked < low:
        raise InvalidInput(f"{key} is {checked:g}{_unit(unit)}, but must be at least {low:g}")
    return checked


def at_most(key: str, value: Any, high: float, unit: str = "") -> float:
    """Return a canonical number of at most ``high``."""
    checked = number(key, value)
    if checked > high:
        raise InvalidInput(f"{key} is {checked:g}{_unit(unit)}, but must be at most {high:g}")
    return checked


def between(key: str, value: Any, low: float, high: float) -> float:
    """Return a canonical number strictly between ``low`` and ``high``."""
    checked = number(key, value)
    if not low < checked < high:
        raise InvalidInput(f"{key} is {checked:g}, but must lie between {low:g} and {high:g}, both excluded")
    return checked


def whole(key: str, value: Any, low: int, high: int | None = None) -> int:
    """Return a whole number of at least ``low`` and, where it is given, at most ``high``."""
    checked = number(key, value)
    if checked != int(checked) or checked < low:
        raise InvalidInput(f"{key} is {checked:g}, but must be a whole number of at least {low}")
    if high is not None and checked > high:
        raise InvalidInput(f"{key} is {checked:g}, but must be at most {high}")
    return int(checked)


def multiple(key: str, value: Any, base: int, high: int | None = None) -> int:
    """Return a positive whole multiple of ``base``, of at most ``high`` where that is given."""
    checked = whole(key, value, 1, high)
    if checked % base:
        raise InvalidInput(f"{key} is {checked}, but must be a multiple of {base}")
    return checked


def one_of(key: str, value: Any, allowed: Iterable[str]) -> str:
    """Return ``value`` if it is one of the words ``allowed``."""
    words = list(allowed)
    if value not in words:
        raise InvalidInput(f"{key} is {shown(value)}, but must be one of {', '.join(words)}{_suggest(value, words)}")
    return str(value)


def known_keys(key: str, given: Any, allowed: Iterable[str], required: Iterable[str] = ()) -> Mapping[str, Any]:
    """Return the mapping ``given`` if its keys are all ``allowed`` and none of ``required`` is missing."""
    names = list(allowed)
    if not isinstance(given, Mapping):
        raise InvalidInput(f"{key} is {shown(given)}, but must hold the keys {', '.join(names)}")
    for name in given:
        if name not in names:
            raise InvalidInput(
                f"{key} has the unknown key {shown(name)}; allowed are {', '.join(names)}{_suggest(name, names)}"
            )
    for name in required:
        if name not in given:
            raise InvalidInput(f"{key} lacks the key {name!r}")
    return given


def grid(key: str, values: Any, unit: str = "") -> tuple[float, ...]:
    """Return a non-empty list of distinct positive numbers, canonical and in ascending order."""
    if not isinstance(values, (list, tuple)):
        raise InvalidInput(f"{key} is {values!r}, but must be a list of numbers")
    if not values:
        raise InvalidInput(f"{key} is empty, but must hold at least one number")
    numbers = [positive(f"{key}[{index}]", value, unit) for index, value in enumerate(values)]
    seen: dict[float, int] = {}
    for index, value in enumerate(numbers):
        if value in seen:
            raise InvalidInput(
                f"{key}[{index}] is {value:g}{_unit(unit)}, the same as {key}[{seen[value]}]; each may stand once"
            )
        seen[value] = index
    return tuple(sorted(numbers))


def text(key: str, value: Any) -> str:
    """Return a word that is fit to stand in a file name."""
    if not isinstance(value, str) or not value or not all(c.isascii() and (c.isalnum() or c in "-_") for c in value):
        raise InvalidInput(f"{key} is {shown(value)}, but must be a word of letters, digits, '-' and '_'")
    if len(value) > LONGEST_WORD:
        raise InvalidInput(f"{key} is {shown(value)}, {len(value)} letters long, but must have at most {LONGEST_WORD}")
    return value


def shown(value: Any) -> str:
    """Return a value as a message shows it, cut short where it is long."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # whole numbers of thousands of digits, for one
        return f"a {type(value).__name__} too long to show"
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


def written(value: float) -> str:
    """Return the canonical text of a number, for names of scenes and files: 0.1, 10000, 1e-9."""
    canonical = number("value", value)
    if canonical == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(canonical)))
    if -5 <= exponent < 9:
        return f"{Decimal(repr(canonical)).normalize():f}"
    mantissa, _, power = f"{canonical:.{SIGNIFICANT_DIGITS - 1}e}".partition("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(power)}"


def _unit(unit: str) -> str:
    return f" {unit}" if unit else ""


def _suggest(value: Any, words: list[str]) -> str:
    close = difflib.get_close_matches(shown(value).strip("'\""), words, n=1)
    return f" (did you mean {close[0]}?)" if close else ""
