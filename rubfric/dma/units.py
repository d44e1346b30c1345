"""Units of what a dynamic mechanical analyser records, in rad/s, degC and MPa."""

from __future__ import annotations

import math
import re

from rubfric.errors import InvalidInput

_FREQUENCY = {"Hz": 2.0 * math.pi, "kHz": 2e3 * math.pi, "mHz": 2e-3 * math.pi, "rad/s": 1.0, "rad/sec": 1.0}
_PRESSURE = {"Pa": 1e-6, "kPa": 1e-3, "MPa": 1.0, "GPa": 1e3, "N/mm2": 1.0, "N/m2": 1e-6, "bar": 0.1}
_PRESSURE |= {"dyn/cm2": 1e-7, "dyne/cm2": 1e-7, "dyn": 1e-7, "psi": 6.894757293168e-3, "ksi": 6.894757293168}
# Factor, and what is added after it: T in degC.
_TEMPERATURE = {"degC": (1.0, 0.0), "K": (1.0, -273.15), "degF": (5.0 / 9.0, -160.0 / 9.0)}
_ANGLE = {"deg": math.pi / 180.0, "rad": 1.0}
_NUMBER = {"": 1.0, "1": 1.0, "%": 0.01}
_AS = {"c": "degC", "deg c": "degC", "celsius": "degC", "kelvin": "K", "f": "degF", "deg f": "degF", "degrees": "deg"}
_AS |= {"hertz": "Hz", "rads": "rad/s", "rad s-1": "rad/s", "dimensionless": ""}
_KNOWN: dict[str, dict[str, tuple[float, float]]] = {
    "frequency": {name: (factor, 0.0) for name, factor in _FREQUENCY.items()},
    "temperature": _TEMPERATURE,
    "modulus": {name: (factor, 0.0) for name, factor in _PRESSURE.items()},
    "angle": {name: (factor, 0.0) for name, factor in _ANGLE.items()},
    "ratio": {name: (factor, 0.0) for name, factor in _NUMBER.items()},
}
# Capitals change the meaning of these alone.
_STRICT = ("mpa", "mhz")
_BRACKETED = re.compile(r"^(?P<name>.*?)\s*[\[({<]\s*(?P<unit>[^\[\](){}<>]*?)\s*[\])}>]\s*$")
_APPENDED = re.compile(r"^(?P<name>.*?\S)\s*(?:/|,|\bin\b|_|\s)\s*(?P<unit>\S+)\s*$")


def _canonical(unit: str) -> str:
    plain = " ".join(unit.replace("²", "2").replace("^", "").replace("·", " ").replace("°", "deg ").split())
    plain = re.sub(r"^(rad|rads)\s*(\.|\*)?\s*s-1$|^(rad|rads)\s*/\s*(s|sec)$", "rad/s", plain)
    return _AS.get(plain.casefold(), plain)


def convert(kind: str, unit: str) -> tuple[float, float] | None:
    """Return factor and offset that bring a number in ``unit`` to rad/s, degC, MPa or rad; None if it is unknown.

    Parameters
    ----------
    kind : {"frequency", "temperature", "modulus", "angle", "ratio"}
    unit : str
        Capitals matter only where they change the meaning: mHz is not MHz.
    """
    known, plain = _KNOWN[kind], _canonical(unit)
    if plain in known:
        return known[plain]
    folded = {name.casefold(): pair for name, pair in known.items() if name.casefold() not in _STRICT}
    return folded.get(plain.casefold())


def check_unit(key: str, kind: str, unit: str) -> tuple[float, float]:
    """Return factor and offset of a unit.

    Parameters
    ----------
    key : str
        Where the unit was given, for the message.
    kind : str
        As of ``convert``.
    unit : str

    Raises
    ------
    InvalidInput
        For an unknown unit, and for 1/s, which may be Hz or rad/s.
    """
    found = convert(kind, unit)
    if found is None:
        several = ", which may be either," if kind == "frequency" and re.fullmatch(r"1/s|s-1|s\^-1", unit) else ","
        raise InvalidInput(f"{key} is {unit!r}{several} but must be one of {', '.join(filter(None, _KNOWN[kind]))}")
    return found


def is_unit(word: str) -> bool:
    """Return whether a word is a unit of any of these quantities."""
    plain = word.strip("[](){} ")
    return bool(plain) and any(convert(kind, plain) is not None for kind in _KNOWN if kind != "ratio")


def split_heading(heading: str) -> tuple[str, str]:
    """Return the name and the unit of a heading such as ``Storage modulus [MPa]``; no unit is an empty string."""
    text = heading.strip()
    bracketed = _BRACKETED.match(text)
    if bracketed and bracketed["name"] and (is_unit(bracketed["unit"]) or bracketed["unit"] in ("", "-", "1", "%")):
        return bracketed["name"], bracketed["unit"].strip("-")
    appended = _APPENDED.match(text)
    if appended and is_unit(appended["unit"]):
        return appended["name"].rstrip(" /,"), appended["unit"]
    return text, ""
