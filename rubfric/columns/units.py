"""Units of time, force and length as loggers write them, in s, N and mm."""

from __future__ import annotations

import re
import unicodedata

from rubfric.checks import shown
from rubfric.errors import InvalidInput

_POUND, _KILOPOND = 4.4482216152605, 9.80665
# What a message lists; all other spellings are below.
_TIME = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0}
_FORCE = {"N": 1.0, "kN": 1e3, "daN": 10.0, "cN": 1e-2, "mN": 1e-3, "uN": 1e-6}
_FORCE |= {"kgf": _KILOPOND, "gf": 1e-3 * _KILOPOND, "lbf": _POUND, "ozf": _POUND / 16.0, "dyn": 1e-5}
_LENGTH = {"mm": 1.0, "m": 1e3, "km": 1e6, "dm": 100.0, "cm": 10.0, "um": 1e-3, "nm": 1e-6, "in": 25.4, "mil": 0.0254}
_KNOWN = {"time": _TIME, "force": _FORCE, "length": _LENGTH}
_PREFIXES = {"milli": "m", "micro": "u", "nano": "n", "centi": "c", "deci": "d", "deca": "da", "kilo": "k", "": ""}
_BASES = {"second": "s", "sekunde": "s", "newton": "N", "metre": "m", "meter": "m"}
_SPELLINGS = {
    f"{prefix}{base}{plural}": f"{short}{symbol}"
    for prefix, short in _PREFIXES.items()
    for base, symbol in _BASES.items()
    for plural in ("", "s", "n")
}
_SPELLINGS |= {
    "sec": "s",
    "secs": "s",
    "msec": "ms",
    "msecs": "ms",
    "millisec": "ms",
    "usec": "us",
    "秒": "s",
    "с": "s",
}
_SPELLINGS |= {"mins": "min", "minute": "min", "minutes": "min", "hr": "h", "hrs": "h", "hour": "h", "hours": "h"}
_SPELLINGS |= dict.fromkeys(("kg", "kp", "kilo", "kilogram", "kilograms", "kilogram-force", "kg-f", "кгс"), "kgf")
_SPELLINGS |= dict.fromkeys(("g", "gr", "gram", "grams", "gram-force", "gramforce", "g-f", "гс"), "gf")
_SPELLINGS |= dict.fromkeys(("lb", "lbs", "pound", "pounds", "pound-force", "pounds-force", "lb-f"), "lbf")
_SPELLINGS |= {"oz": "ozf", "dyne": "dyn", "dynes": "dyn", "н": "N", "кн": "kN", "мс": "ms", "мм": "mm", "м": "m"}
_SPELLINGS |= {"micron": "um", "microns": "um", "mkm": "um", "мкм": "um", "inch": "in", "inches": "in", '"': "in"}
_SPELLINGS |= {"thou": "mil", "mils": "mil"}
# Capitals change the meaning of these alone: MN is no mN.
_STRICT = ("mn",)
# Units of mass that are read as the weight of that mass.
_MASSES = ("kg", "kilo", "kilogram", "kilograms", "g", "gr", "gram", "grams", "lb", "lbs", "pound", "pounds", "oz")
# Force (N), Force [N], Force {N}; and Force / N, Force in N, Force, N, Force_N.
_BRACKETED = re.compile(r"\s*[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]\s*")
_APPENDED = re.compile(r"^(?P<name>.*?)\s*(?:/|,|\bin\b|_|\s)\s*(?P<unit>[^\s/,_]+)\s*$")


def factor(kind: str, unit: str) -> float | None:
    """Return what a number in ``unit`` has to be multiplied by to be in s, N or mm; None for an unknown unit.

    Parameters
    ----------
    kind : {"time", "force", "length"}
    unit : str
        ``ms``, ``kN``, ``µm``, ``Newtons`` and the like; capitals matter only where they change the meaning.
    """
    known = _KNOWN[kind]
    plain = _plain(unit)
    if plain in known:
        return known[plain]
    folded = {name.casefold(): number for name, number in known.items() if name.casefold() not in _STRICT}
    small = plain.casefold()
    return folded.get(small, known.get(_SPELLINGS.get(small, "")))


def _plain(unit: str) -> str:
    """Return a unit without brackets, blanks and a point at its end, micro being u."""
    text = unicodedata.normalize("NFKC", unit).replace("μ", "u")
    return text.strip().strip("[](){}<>").strip().removesuffix(".")


def check_factor(key: str, kind: str, unit: object) -> float:
    """Return what a number in a unit has to be multiplied by to be in s, N or mm.

    Parameters
    ----------
    key : str
        Where the unit was given, for the message.
    kind : {"time", "force", "length"}
    unit : object
        Whatever was given there.

    Raises
    ------
    InvalidInput
        For anything but a known unit of that kind; names ``key`` and the known units.
    """
    found = factor(kind, unit) if isinstance(unit, str) else None
    if found is None:
        raise InvalidInput(f"{key} is {shown(unit)}, but must be one of {', '.join(_KNOWN[kind])}")
    return found


def is_mass(unit: str) -> bool:
    """Return whether a unit is one of mass, which a force in it is the weight of."""
    return _plain(unit).casefold() in _MASSES


def is_unit(word: str) -> bool:
    """Return whether a word is a unit of time, force or length."""
    return any(factor(kind, word) is not None for kind in _KNOWN)


def unit_of(word: str) -> str:
    """Return a field of a line of units without brackets, or nothing if it is no more than a mark for none."""
    text = word.strip().strip("\"'").strip("[](){}<> ")
    return text if is_unit(text) or text.strip("-") else ""


def split_heading(heading: str) -> tuple[str, str]:
    """Return the name and the unit of a heading such as ``Normal force [kN]``; no unit is an empty string."""
    text = unicodedata.normalize("NFKC", heading).replace("μ", "µ").strip().strip("\"'").strip()
    groups = list(_BRACKETED.finditer(text))
    # The last one that is a unit, or else, if it ends the heading, the last one.
    chosen = [one for one in groups if is_unit(one[1])] or [one for one in groups if one.end() == len(text)]
    if chosen:
        start, end = chosen[-1].span()
        return f"{text[:start]} {text[end:]}".strip(), chosen[-1][1]
    appended = _APPENDED.match(text)
    # F_N is the name of a normal force, not a force in newtons.
    if appended and appended["name"].casefold() not in ("", "f") and is_unit(appended["unit"]):
        return appended["name"], appended["unit"]
    return text, ""


def heading_words(heading: str) -> str:
    """Return the words of a heading without its unit, in small letters."""
    return " ".join(re.split(r"[\W_]+", split_heading(heading)[0].casefold())).strip()
