"""What a config says of the test rig: measured files, or the virtual rig that stands in for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput

# Where the sensor of traction sits.
TRACTIONS = ("rubber", "rope")
MOST_SAMPLING = 1e6
_LONGEST_PATH = 1000


@dataclass(frozen=True)
class VirtualRig:
    """The virtual rig.

    Attributes
    ----------
    area : float
        Nominal area of the rubber, mm².
    traction : {"rubber", "rope"}
        Where the sensor of traction sits.
    sled_mass, heaviest_weight : float
        kg.
    travel : float
        Of the sled, mm.
    bearing_force : float
        N.
    bearing_coefficient : float
        Drag of the bearings per normal force, dimensionless.
    force_noise : float
        Standard deviation, N.
    displacement_noise, displacement_step : float
        Standard deviation and step of the readings, mm.
    sampling : float
        Hz.
    seed : int
    """

    area: float
    traction: str
    sled_mass: float
    heaviest_weight: float
    travel: float
    bearing_force: float
    bearing_coefficient: float
    force_noise: float
    displacement_noise: float
    displacement_step: float
    sampling: float
    seed: int


@dataclass(frozen=True)
class RigChoice:
    """Measured files, the YAML file that names their columns, and what Fig. 9 shows.

    Attributes
    ----------
    data : tuple of str
        Files of measured runs; while there are none, the virtual rig stands in.
    columns : str or None
        YAML file on them.
    pressures, speeds : tuple of float
        Of the lines of Fig. 9, MPa and mm/s.
    virtual : VirtualRig
    """

    data: tuple[str, ...]
    columns: str | None
    pressures: tuple[float, ...]
    speeds: tuple[float, ...]
    virtual: VirtualRig


def read_rig(entry: Any) -> RigChoice:
    """Read and check the key ``rig`` of a config."""
    keys = [field.name for field in fields(RigChoice)]
    checks.known_keys("rig", entry, keys, keys)
    data = entry["data"]
    if not isinstance(data, (list, tuple)):
        raise InvalidInput(f"rig.data is {checks.shown(data)}, but must be a list of files")
    files = tuple(_path(f"rig.data[{place}]", name) for place, name in enumerate(data))
    if len(set(files)) < len(files):
        raise InvalidInput("rig.data names a file twice; each may stand once")
    return RigChoice(
        data=files,
        columns=None if entry["columns"] is None else _path("rig.columns", entry["columns"]),
        pressures=checks.grid("rig.pressures", entry["pressures"], "MPa"),
        speeds=checks.grid("rig.speeds", entry["speeds"], "mm/s"),
        virtual=read_virtual(entry["virtual"]),
    )


def read_virtual(entry: Any) -> VirtualRig:
    """Read and check the key ``rig.virtual`` of a config."""
    keys = [field.name for field in fields(VirtualRig)]
    checks.known_keys("rig.virtual", entry, keys, keys)
    units = {"area": "mm²", "sled_mass": "kg", "heaviest_weight": "kg", "travel": "mm", "sampling": "Hz"}
    positive = {name: checks.positive(f"rig.virtual.{name}", entry[name], unit) for name, unit in units.items()}
    checks.at_most(
        "rig.virtual.sampling", checks.at_least("rig.virtual.sampling", entry["sampling"], 100.0), MOST_SAMPLING
    )
    return VirtualRig(
        **positive,
        traction=checks.one_of("rig.virtual.traction", entry["traction"], TRACTIONS),
        **{name: _no_less_than_nothing(entry, name) for name in _MAY_BE_ZERO},
        seed=checks.whole("rig.virtual.seed", entry["seed"], 0, 2**31),
    )


_MAY_BE_ZERO = ("bearing_force", "bearing_coefficient", "force_noise", "displacement_noise", "displacement_step")


def _no_less_than_nothing(entry: Mapping[str, Any], name: str) -> float:
    key = f"rig.virtual.{name}"
    return checks.at_most(key, checks.at_least(key, entry[name], 0.0), checks.LARGEST)


def _path(key: str, value: Any) -> str:
    if not isinstance(value, str) or not value.strip() or not value.isprintable() or set(value) & set("{}"):
        raise InvalidInput(f"{key} is {checks.shown(value)}, but must be the path of a file, without braces")
    if len(value) > _LONGEST_PATH:
        raise InvalidInput(f"{key} is {checks.shown(value)}, but must be a path of at most {_LONGEST_PATH} letters")
    return value
