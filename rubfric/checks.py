"""One sentence for every bad value: the key, the value, and what is allowed.

Numbers are brought to one canonical form here (twelve significant digits), so that 0.1, 1.0e-1 and 0.10 are one number
and 0.30000000000000004 never reaches a file name.
"""

from __future__ import annotations

import difflib
import math
import reprlib
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any

import numpy as np

from rubfric.errors import InvalidInput

SIGNIFICANT_DIGITS = 12
# Symbols of the field, and the keys that they stand for.
_SYNONYMS = {
    **{"E": "youngs_modulus", "nu": "poissons_ratio", "g_i": "shear_fractions", "tau_i": "relaxation_times"},
    **{"k_i": "bulk", "lambda": "wavelength", "k": "wavenumber", "a": "amplitude", "rho": "density"},
}
# What a message shows of a wrong value, which may be nested without end.
_MOST_SHOWN = 80
_SHORT = reprlib.Repr()
_SHORT.maxlevel, _SHORT.maxdict, _SHORT.maxlist, _SHORT.maxtuple = 3, 16, 16, 16
_SHORT.maxstring = _SHORT.maxlong = _SHORT.maxother = 4 * _MOST_SHOWN


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
    return rounded(converted) + 0.0  # no minus zero


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


def known_keys(key: str, given: Any, allowed: Iterable[str], required: Iterable[str] = ()) -> Mapping[str, Any]:
    """Return the mapping ``given`` if its keys are all ``allowed`` and none of ``required`` is missing."""
    names = list(allowed)
    if not isinstance(given, Mapping):
        raise InvalidInput(f"{key} is {shown(given)}, but must hold the keys {', '.join(names)}")
    for name in given:
        if name not in names:
            raise InvalidInput(unknown_key(key, name, names))
    for name in required:
        if name not in given:
            raise InvalidInput(f"{key} lacks the key {name!r}")
    return given


def unknown_key(key: str, name: Any, allowed: Iterable[str]) -> str:
    """Return what to say of a key that is none of those allowed."""
    names = list(allowed)
    return f"{key} has the unknown key {shown(name)}; allowed are {', '.join(names)}{suggestion(name, names)}"


def shown(value: Any) -> str:
    """Return a value as a message shows it, cut short where it is long or deeply nested."""
    try:
        text = _SHORT.repr(value)
    except (ValueError, RecursionError):  # whole numbers of thousands of digits, for one
        return f"a {type(value).__name__} too long to show"
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


def with_unit(value: Any, unit: str) -> str:
    """Return a number, or whatever else it is, with its unit as a message shows it."""
    text = f"{value:g}" if isinstance(value, float) else shown(value)
    return f"{text} {unit}" if unit else text


def rounded(value: float, digits: int = SIGNIFICANT_DIGITS) -> float:
    """Return a number to some significant digits, by default those in which numbers are compared.

    Parameters
    ----------
    value : float
    digits : int
    """
    return float(f"{value:.{digits}g}")


def decimals(value: float, digits: int) -> int:
    """Return how many decimals show so many significant digits of a positive number; below zero to round before them.

    Parameters
    ----------
    value : float
    digits : int
    """
    return digits - 1 - int(f"{value:.{digits - 1}e}".partition("e")[2])


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


def suggestion(value: Any, words: list[str]) -> str:
    """Return the word that may have been meant: one that ``value`` has as a part, or else the nearest in spelling."""
    text = shown(value).strip("'\"")
    if (meant := _SYNONYMS.get(text)) in words:
        return f" (did you mean {meant}?)"
    close = [word for word in words if word in text.split("_")] or difflib.get_close_matches(text, words, n=1)
    return f" (did you mean {close[0]}?)" if close else ""
