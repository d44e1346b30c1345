"""Temperature as an axis of a campaign: the shift factors of a rubber, and the temperatures that they reach."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import MISSING, fields
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from pydantic import create_model, model_validator

from rubfric.checks import written
from rubfric.config.entries import Entry, keys
from rubfric.errors import InvalidInput
from rubfric.rubber.material import COLDEST, HOTTEST, Material
from rubfric.rubber.shift import Shift, ShiftedRubber
from rubfric.rules import HERE, Number, rules


def _sound(shift: Any) -> Any:
    """Refuse shift factors whose entries do not go together."""
    try:
        Shift(**shift.given())
    except InvalidInput as error:
        raise InvalidInput(*(fault.replace("shift.", f"{HERE}.") for fault in error.faults)) from None
    return shift


if TYPE_CHECKING:  # made of the dataclass below
    ShiftChoice = Entry
else:
    ShiftChoice = create_model(
        "ShiftChoice",
        __base__=Entry,
        __doc__="Shift factors of a rubber over temperature; its moduli and times are those at the reference.",
        **keys(Shift, rules(Shift), {one.name: one.default for one in fields(Shift) if one.default is not MISSING}),
        __validators__={"_sound": model_validator(mode="after")(_sound)},
    )


def degrees(about: str) -> Number:
    """Return the rule of a temperature, degC."""
    return Number(about, "degC", COLDEST, HOTTEST)


def rubber_of(name: str, entry: Mapping[str, Any]) -> tuple[Material, Shift | None]:
    """Return a rubber, at the reference of its shift factors, and these, where it has any.

    Parameters
    ----------
    name : str
    entry : mapping
        What the config gives under ``rubbers``.
    """
    own = dict(entry)
    shift = own.pop("shift", None)
    return Material(name=name, **own), Shift(**shift) if shift else None


@lru_cache(maxsize=64)
def rubber_at(material: Material, shift: Shift | None, temperature: float) -> Material:
    """Return a rubber at a temperature.

    Parameters
    ----------
    material : Material
        The rubber at the reference of its shift factors.
    shift : Shift or None
    temperature : float
        degC.

    Raises
    ------
    InvalidInput
        For a rubber without shift factors, and for a temperature that they do not reach.
    """
    if shift is None:
        raise InvalidInput(f"temperature is {written(temperature)} degC, but {_needs_shift(material.name)}")
    return ShiftedRubber(material, shift).at(temperature)


def _needs_shift(name: str) -> str:
    return (
        f"rubber {name} is known at one temperature only: give its shift factors, rubbers.{name}.shift (law, c1, c2, "
        "reference_temperature for one), or moduli measured at several temperatures"
    )


def check_temperatures(material: Material, shift: Shift | None, temperatures: Sequence[float]) -> None:
    """Check that a rubber is known at all temperatures of the grid.

    Parameters
    ----------
    material : Material
        The rubber at the reference of its shift factors.
    shift : Shift or None
    temperatures : sequence of float
        degC.

    Raises
    ------
    InvalidInput
        For a rubber without shift factors, and for every temperature that they do not reach.
    """
    faults = []
    if temperatures and shift is None:
        given = ", ".join(map(written, temperatures))
        faults.append(f"grid.temperatures has {given} degC, but {_needs_shift(material.name)}")
    for one in temperatures if shift else ():
        try:
            rubber_at(material, shift, one)
        except InvalidInput as error:
            faults += [fault.replace("temperature is ", "grid.temperatures has ", 1) for fault in error.faults]
    if faults:
        raise InvalidInput(*faults)


def shown_temperature(given: float | None, temperatures: Sequence[float], shift: Shift | None) -> float | None:
    """Return the temperature at which figures and claims look at a campaign: by default the nearest to the reference.

    Parameters
    ----------
    given : float or None
        What the config chooses.
    temperatures : sequence of float
        Of the grid, degC, ascending.
    shift : Shift or None
    """
    if given is not None or not temperatures or shift is None:
        return given
    return min(temperatures, key=lambda one: abs(one - shift.reference_temperature))
