"""What a config refers to in other parts of itself: names, scales of the road, values of the grid, presets."""

from __future__ import annotations

from typing import Any

from rubfric import checks
from rubfric.config.models import Config
from rubfric.errors import InvalidInput
from rubfric.rules import Choice, Integer
from rubfric.scene.numerics import PRESET_KEYS, Numerics


def scale_number(key: str, value: Any, scales: int) -> int:
    """Return the number of one of the road's scales.

    Parameters
    ----------
    key : str
    value : int
        1 for the coarsest.
    scales : int
        How many there are.
    """
    number = Integer().check(key, value)
    if number > scales:
        raise InvalidInput(f"{key} is {number}, but must be one of the road's scales, 1 to {scales}")
    return number


def check_references(given: Config, scales: int) -> None:
    """Check what refers to other entries of the config: scales, values of the grid, presets and readings.

    Parameters
    ----------
    given : Config
    scales : int
        How many scales the road in use has.
    """
    study, fields = given.aspect_study, given.figures.fields
    numbered = [("transient.scale", given.transient.scale), ("figures.fields.scale", fields.scale)]
    for key, number in [*numbered, *(("aspect_study.scales", number) for number in study.scales)]:
        scale_number(key, number, scales)
    chosen = (
        ("figures.total_pressure", (given.figures.total_pressure,), "pressures"),
        ("figures.fields.pressures", fields.pressures, "pressures"),
        ("figures.fields.velocities", fields.velocities, "velocities"),
    )
    for key, values, axis in chosen:
        allowed = getattr(given.grid, axis)
        for value in values:
            if value not in allowed:
                known = ", ".join(map(checks.written, allowed))
                raise InvalidInput(f"{key} has {checks.written(value)}, but must be chosen from grid.{axis}: {known}")
    for key, name in (("claims.preset", given.claims.preset), ("multiscale_preset", given.multiscale_preset)):
        Choice(words=given.presets).check(key, name)
    for name in given.claims.compare:
        Choice(words=given.claims.readings).check("claims.compare", name)


def numerics_of(given: Config) -> tuple[Numerics, dict[str, Numerics]]:
    """Return the preset in use with what is laid over it, and every preset with nothing laid over.

    A bound on columns below those that a preset begins with concerns the preset in use only.
    """
    own = given.numerics.given()
    preset = Choice(words=given.presets).check("numerics.preset", own.pop("preset"))
    entries = {name: entry.given() for name, entry in given.presets.items()}
    rest = {name: value for name, value in own.items() if name not in PRESET_KEYS}
    presets = {}
    for name, entry in entries.items():
        most = max(rest["columns_max"], entry["columns_min"], entry["finite_columns_min"])
        presets[name] = Numerics(**entry | rest | {"columns_max": most})
    return Numerics(**entries[preset] | own), presets
