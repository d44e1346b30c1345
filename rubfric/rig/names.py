"""What a rig records: the kinds and usual units of its quantities, and their usual headings in small letters."""

from __future__ import annotations

from collections.abc import Mapping

from rubfric.columns.units import heading_words

QUANTITIES = {"time": "time", "normal": "force", "traction": "force", "displacement": "length"}
EXAMPLES = {"time": "s", "normal": "N", "traction": "N", "displacement": "mm"}
USUAL = {
    "time": {"time", "t", "zeit", "elapsed", "elapsed time", "relative time", "timestamp", "test time", "temps"}
    | {"testzeit", "prüfzeit", "tiempo", "tempo", "时间", "時間", "시간", "время"},
    "normal": {"normal", "normal force", "normal load", "vertical force", "vertical load", "load", "fn", "f n", "fz"}
    | {"f z", "n", "normalkraft", "axial force", "force normale", "fuerza normal", "垂直荷重", "荷重", "法向力"}
    | {"载荷", "하중", "нормальная сила", "нагрузка"},
    "traction": {"traction", "traction force", "traction load", "friction", "friction force", "tangential force"}
    | {"horizontal force", "rope force", "ft", "f t", "fx", "f x", "reibkraft", "zugkraft", "pull", "drag"}
    | {"pulling force", "force de frottement", "摩擦力", "마찰력", "сила трения"},
    "displacement": {"x", "s", "weg", "pos", "disp", "extension", "crosshead", "crosshead displacement"}
    | {"standardweg", "traverse", "traversenweg"}
    | {"déplacement", "desplazamiento", "変位", "位移", "변위", "перемещение"},
}
_TYPICAL = {
    "time": {"time", "zeit"},
    "normal": {"normal", "vertical", "normalkraft"},
    "traction": {"traction", "tangential", "friction", "horizontal", "reibkraft", "zugkraft", "rope"},
    "displacement": {"displacement", "position", "travel", "distance", "stroke", "weg"},
}
# Under a known load, the one force that a testing machine records is the pull.
PULLS = {
    "load",
    "force",
    "f",
    "kraft",
    "standard force",
    "standardkraft",
    "load cell",
    "荷重",
    "하중",
    "载荷",
    "нагрузка",
}
# Quantities that loggers compute are none of the four.
_DERIVED = {"coefficient", "cof", "mu", "speed", "velocity", "acceleration", "coeff"}


def quantity_of(name: str) -> str | None:
    """Return the one quantity that the words of a heading name, or None."""
    words = set(name.split())
    named = [quantity for quantity, typical in _TYPICAL.items() if words & typical]
    return named[0] if len(named) == 1 and not words & _DERIVED else None


def expected(named: Mapping[str, str | int]) -> list[str]:
    """Return headings by which a table is recognised: those that the user names, and usual ones."""
    said = [heading_words(name) for name in named.values() if isinstance(name, str)]
    return [*said, *sorted(set[str]().union(*USUAL.values(), *_TYPICAL.values(), PULLS))]
