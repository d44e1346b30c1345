"""What the user says of a rig and its files: columns, units, area, zeros, bearings and windows, in a YAML file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from rubfric import checks
from rubfric.columns.format import AS_FOUND, FORMAT, Format
from rubfric.columns.units import check_factor
from rubfric.config.overlay import read_yaml
from rubfric.config.place import Place
from rubfric.config.plausibility import check_area
from rubfric.config.rig import VirtualRig
from rubfric.errors import InvalidInput
from rubfric.rig.names import QUANTITIES
from rubfric.rules import Choice, Integer, Number, rules

_FORCES = ("normal", "traction")
_AMOUNT, _SHARE = Number(low=0.0), Number(low=0.0, high=1.0, excluded=True)
_WINDOWS = {"least_samples": Integer(low=20), "least_travel": Number(unit="mm")}


@dataclass(frozen=True)
class Tare:
    """Readings of the unloaded sensors.

    Attributes
    ----------
    how : {"auto", "times", "given", "none"}
        Found in the record, at given times, given, or none subtracted.
    start, end : float
        The given times, s.
    normal, traction : float
        The given readings, N; NaN where there is no sensor of the normal force.
    """

    how: str = "auto"
    start: float = 0.0
    end: float = 0.0
    normal: float = 0.0
    traction: float = 0.0


@dataclass(frozen=True)
class Bearing:
    """Drag of the sled's bearings: ``force`` plus ``coefficient`` times the normal force.

    Attributes
    ----------
    force, uncertainty : float
        N.
    coefficient : float
        Dimensionless.
    file : str
        Record of an unloaded pull, from which the force over speed is taken; empty for none.
    """

    force: float = 0.0
    coefficient: float = 0.0
    uncertainty: float = 0.0
    file: str = ""


@dataclass(frozen=True)
class Windows:
    """What a window of a record must be like.

    Attributes
    ----------
    least_travel : float
        mm.
    least_samples : int
    steady_range, sweep_range : float
        Largest change of speed, over the speed, within a window of steady speed and within one of a sweep.
    load_range : float
        Largest change of the normal force, over the force, within a window.
    drift : float
        Largest change of friction, over the friction, within a window of steady speed.
    largest_uncertainty : float
        Largest half-width of the confidence interval of friction, over the friction.
    """

    least_travel: float = 1.0
    least_samples: int = 30
    steady_range: float = 0.03
    sweep_range: float = 0.15
    load_range: float = 0.05
    drift: float = 0.1
    largest_uncertainty: float = 0.25


@dataclass(frozen=True)
class Settings:
    """All that the user may say.

    Attributes
    ----------
    columns, units : mapping
        Quantity (time, normal, traction, displacement) to heading (or number, from 1) and to unit, where they are not
        recognised.
    normal : float
        A known constant load, N, which no sensor measures; 0 for none.
    sampling : float
        Rows per second, Hz, of a file without times; 0 for none.
    area : float
        Nominal area of the rubber, mm²; 0 where it is not given.
    traction : {"rubber", "rope"}
        Where the sensor of traction sits: at the rubber, or in the rope.
    sled_mass : float
        Of all that slides and is pulled by the rope's sensor, kg; for a sensor in the rope.
    tare : Tare
    bearing : Bearing
    range : mapping
        Force (normal, traction) to the reading, N, at which its sensor clips.
    calibration : mapping
        Force, or displacement, to the uncertainty of its sensor's gain, relative, 95 %.
    windows : Windows
    form : Format
        How files are written, where that is not found out.
    """

    columns: Mapping[str, str | int] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    area: float = 0.0
    normal: float = 0.0
    sampling: float = 0.0
    traction: str = "rubber"
    sled_mass: float = 0.0
    tare: Tare = Tare()
    bearing: Bearing = Bearing()
    range: Mapping[str, float] = field(default_factory=dict)
    calibration: Mapping[str, float] = field(default_factory=dict)
    windows: Windows = Windows()
    form: Format = AS_FOUND

    def __post_init__(self) -> None:
        if self.traction == "rope" and self.sled_mass <= 0.0:
            raise InvalidInput(
                "traction is rope, so sled_mass must be given (kg): the rope also accelerates the sled with the road"
            )
        for quantity, key, value in (("normal", "normal", self.normal), ("time", "sampling", self.sampling)):
            if value > 0.0 and quantity in self.columns:
                raise InvalidInput(
                    f"{key} is given, and columns.{quantity} names a column for the same: keep one of them"
                )
        if math.isnan(self.tare.normal) and self.normal <= 0.0:
            raise InvalidInput("tare holds traction alone, but must hold normal (N) too where the load is measured")


def read_settings(path: str | None, **above: Any) -> Settings:
    """Read the YAML file of ``--columns``, and lay over it what else was given.

    Parameters
    ----------
    path : str or None
        None for no file.
    **above
        Entries to replace, as they would stand in the file; None is passed over.

    Raises
    ------
    InvalidInput
        One sentence for whatever is wrong.
    FileNotFoundError
        For a missing file.
    """
    entry: Any = {}
    if path is not None:
        entry = read_yaml(path) or {}
    names = [*(one.name for one in fields(Settings) if one.name != "form"), *FORMAT]
    where = path or "the settings of the rig"
    checks.known_keys(where, entry, names)
    given = dict(entry) | {name: value for name, value in above.items() if value is not None}
    checked = {name: (_READERS | FORMAT)[name](name, value) for name, value in given.items()}
    form = Format(**{name: checked.pop(name) for name in FORMAT if name in checked})
    settings = Settings(**checked, form=form)
    if settings.bearing.file and path is not None:
        found = Path(path).parent / settings.bearing.file
        settings = replace(settings, bearing=replace(settings.bearing, file=str(found)))
    return settings


def _columns(key: str, value: Any) -> dict[str, str | int]:
    checks.known_keys(key, value, QUANTITIES)
    for name, heading in value.items():
        named = isinstance(heading, str) and heading.strip()
        if not named and (not isinstance(heading, int) or isinstance(heading, bool) or heading < 1):
            raise InvalidInput(
                f"{key}.{name} is {checks.shown(heading)}, but must be the heading of a column, or its number from 1 on"
            )
    return dict(value)


def _units(key: str, value: Any) -> dict[str, str]:
    checks.known_keys(key, value, QUANTITIES)
    for name, unit in value.items():
        check_factor(f"{key}.{name}", QUANTITIES[name], unit)
    return dict(value)


def _tare(key: str, value: Any) -> Tare:
    if isinstance(value, str):
        return Tare(Choice(words=("auto", "none")).check(key, value))
    checks.known_keys(key, value, ("from", "to", *_FORCES))
    if set(value) == {"from", "to"}:
        start, end = (checks.number(f"{key}.{name}", value[name]) for name in ("from", "to"))
        if end <= start:
            raise InvalidInput(f"{key}.to is {end:g} s, but must be later than {key}.from, {start:g} s")
        return Tare("times", start=start, end=end)
    if "traction" in value and set(value) <= set(_FORCES):
        readings = {name: checks.number(f"{key}.{name}", number) for name, number in value.items()}
        return Tare("given", **({"normal": math.nan} | readings))
    raise InvalidInput(f"{key} is {checks.shown(value)}, but must hold from and to (s), or normal and traction (N)")


def _bearing(key: str, value: Any) -> Bearing:
    checks.known_keys(key, value, [one.name for one in fields(Bearing)])
    numbers = {name: _AMOUNT.check(f"{key}.{name}", entry) for name, entry in value.items() if name != "file"}
    file = value.get("file", "")
    if not isinstance(file, str):
        raise InvalidInput(f"{key}.file is {checks.shown(file)}, but must be the path of an unloaded pull")
    if file and "force" in value:
        raise InvalidInput(f"{key} has both a force and a file, but the force comes from the file: keep one of them")
    return Bearing(file=Place().check(f"{key}.file", file) or "" if file else "", **numbers)


def _forces(key: str, value: Any) -> dict[str, float]:
    checks.known_keys(key, value, _FORCES)
    return {name: _AMOUNT.check(f"{key}.{name}", number) for name, number in value.items()}


def _gains(key: str, value: Any) -> dict[str, float]:
    checks.known_keys(key, value, (*_FORCES, "displacement"))
    return {name: Number(low=0.0, high=1.0).check(f"{key}.{name}", gain) for name, gain in value.items()}


def _windows(key: str, value: Any) -> Windows:
    checks.known_keys(key, value, [one.name for one in fields(Windows)])
    return Windows(
        **{name: _WINDOWS.get(name, _SHARE).check(f"{key}.{name}", number) for name, number in value.items()}
    )


_READERS: dict[str, Any] = {
    "columns": _columns,
    "units": _units,
    "area": lambda key, value: check_area(key, rules(VirtualRig)["area"].check(key, value)),
    "normal": Number(unit="N").check,
    "sampling": Number(unit="Hz").check,
    "traction": rules(VirtualRig)["traction"].check,
    "sled_mass": rules(VirtualRig)["sled_mass"].check,
    "tare": _tare,
    "bearing": _bearing,
    "range": _forces,
    "calibration": _gains,
    "windows": _windows,
}
