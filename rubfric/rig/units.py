"""Units of what a rig records, as loggers write them, in s, N and mm."""

from __future__ import annotations

import re

from rubfric.errors import InvalidInput

QUANTITIES = ("time", "normal", "traction", "displacement")
_TIME = {"s": 1.0, "sec": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "us": 1e-6}
_TIME |= {"min": 60.0, "h": 3600.0}
_FORCE = {"N": 1.0, "kN": 1e3, "mN": 1e-3, "daN": 10.0, "newton": 1.0, "newtons": 1.0}
_FORCE |= {"kgf": 9.80665, "kp": 9.80665, "gf": 9.80665e-3, "lbf": 4.4482216152605}
_LENGTH = {"mm": 1.0, "m": 1e3, "dm": 100.0, "cm": 10.0, "um": 1e-3, "nm": 1e-6, "in": 25.4, "inch": 25.4}
_LENGTH |= {"millimeter": 1.0, "millimeters": 1.0}
_KNOWN = {"time": _TIME, "normal": _FORCE, "traction": _FORCE, "displacement": _LENGTH}
# Capitals change the meaning of these alone: MN is no mN.
_STRICT = ("mn",)
# Force (N), Force [N], Force {N}, Force / N, Force in N, Force, N and Force_N.
_BRACKETED = re.compile(r"^(?P<name>.*?)\s*[\[({<]\s*(?P<unit>[^\[\](){}<>]*?)\s*[\])}>]\s*$")
_APPENDED = re.compile(r"^(?P<name>.*?)\s*(?:/|,|\bin\b|_|\s)\s*(?P<unit>[^\s/,_]+)\s*$")


def factor(quantity: str, unit: str) -> float | None:
    """Return what a number in ``unit`` has to be multiplied by to be in s, N or mm; None for an unknown unit.

    Parameters
    ----------
    quantity : {"time", "normal", "traction", "displacement"}
    unit : str
        ``ms``, ``kN``, ``µm`` and the like; capitals matter only where they change the meaning.
    """
    known = _KNOWN[quantity]
    plain = unit.strip().replace("µ", "u").replace("μ", "u")
    if plain in known:
        return known[plain]
    folded = {name.casefold(): number for name, number in known.items() if name.casefold() not in _STRICT}
    return folded.get(plain.casefold())


def check_factor(key: str, quantity: str, unit: object) -> float:
    """Return what a number in a unit has to be multiplied by to be in s, N or mm.

    Parameters
    ----------
    key : str
        Where the unit was given, for the message.
    quantity : {"time", "normal", "traction", "displacement"}
    unit : object
        Whatever was given there.

    Raises
    ------
    InvalidInput
        For anything but a known unit of the quantity; names ``key`` and the known units.
    """
    found = factor(quantity, unit) if isinstance(unit, str) else None
    if found is None:
        raise InvalidInput(f"{key} is {unit!r}, but must be one of {', '.join(_KNOWN[quantity])}")
    return found


def split_heading(heading: str) -> tuple[str, str]:
    """Return the name and the unit of a heading such as ``Normal force [kN]``; no unit is an empty string."""
    text = heading.strip().strip("\"'").strip()
    bracketed = _BRACKETED.match(text)
    if bracketed:
        return bracketed["name"], bracketed["unit"]
    appended = _APPENDED.match(text)
    # F_N is the name of a normal force, not a force in newtons.
    if appended and appended["name"].casefold() not in ("", "f") and is_unit(appended["unit"]):
        return appended["name"], appended["unit"]
    return text, ""


def is_unit(word: str) -> bool:
    """Return whether a word is a unit of any of the quantities."""
    return any(factor(quantity, word.strip("[](){} ")) is not None for quantity in QUANTITIES)
