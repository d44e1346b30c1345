"""Which column of a logger's file holds which quantity: by the names given, or by usual names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rubfric.errors import InvalidInput
from rubfric.rig.units import QUANTITIES, check_factor, factor, split_heading

_USUAL = {
    "time": {"time", "t", "zeit", "elapsed", "elapsed time", "relative time", "timestamp", "test time"},
    "normal": {"normal", "normal force", "normal load", "vertical force", "vertical load", "load", "fn", "f n", "fz"}
    | {"f z", "n", "normalkraft", "axial force"},
    "traction": {"traction", "traction force", "traction load", "friction", "friction force", "tangential force"}
    | {"horizontal force", "rope force", "ft", "f t", "fx", "f x", "reibkraft", "zugkraft", "pull", "drag"},
    "displacement": {"displacement", "position", "distance", "travel", "x", "s", "weg", "pos", "disp", "stroke"},
}
_TYPICAL = {
    "time": {"time", "zeit"},
    "normal": {"normal", "vertical", "normalkraft"},
    "traction": {"traction", "tangential", "friction", "horizontal", "reibkraft", "zugkraft", "rope"},
    "displacement": {"displacement", "position", "travel", "distance", "stroke", "weg"},
}
# Quantities that loggers compute are none of the four.
_DERIVED = {"coefficient", "cof", "mu", "speed", "velocity", "acceleration", "coeff"}


@dataclass(frozen=True)
class Column:
    """A column of a file.

    Attributes
    ----------
    place : int
        Its number, from 0.
    factor : float
        What its numbers have to be multiplied by to be in s, N or mm.
    """

    place: int
    factor: float


def recognise(
    path: str,
    headings: Sequence[str],
    units: Sequence[str],
    named: Mapping[str, str],
    given: Mapping[str, str],
    clocks: Sequence[int] = (),
) -> dict[str, Column]:
    """Return the columns of time, normal force, traction and displacement.

    Parameters
    ----------
    path : str
        The file, for messages.
    headings : sequence of str
        Of all columns.
    units : sequence of str
        Of all columns, where a line below the headings holds them; else empty strings.
    named : mapping
        Quantity to heading, where the user names it: with the unit or without.
    given : mapping
        Quantity to unit, where the user gives it.
    clocks : sequence of int
        Columns of clock times, which are in s whatever the heading says.

    Raises
    ------
    InvalidInput
        Where a column is missing, may be one of several, or has no unit.
    """
    split = [split_heading(heading) for heading in headings]
    found = {}
    for quantity in QUANTITIES:
        place = _place(path, quantity, headings, [name for name, _ in split], named.get(quantity))
        if place in clocks:
            found[quantity] = _clock(path, quantity, headings[place], place, given.get(quantity, "s"))
            continue
        unit = given.get(quantity) or units[place] or split[place][1]
        if not unit:
            raise InvalidInput(
                f"{path} names no unit for the column {headings[place]!r}: write it in the heading, as in "
                f"'{headings[place]} (N)', or under units in the YAML file of --columns"
            )
        key = f"the unit of {headings[place]!r} in {path}, the column of {quantity},"
        found[quantity] = Column(place, check_factor(key, quantity, unit))
    places = [column.place for column in found.values()]
    for quantity, column in found.items():
        if places.count(column.place) > 1:
            raise InvalidInput(
                f"{path} has one column, {headings[column.place]!r}, for {quantity} and another quantity"
            )
    return found


def _clock(path: str, quantity: str, heading: str, place: int, unit: str) -> Column:
    if quantity != "time":
        raise InvalidInput(f"{path} has clock times in the column {heading!r}, but it is to hold {quantity}")
    if factor("time", unit) != 1.0:
        raise InvalidInput(
            f"units.time is {unit!r}, but {path} has clock times in the column {heading!r}: leave it out"
        )
    return Column(place, 1.0)


def _place(path: str, quantity: str, headings: Sequence[str], names: Sequence[str], named: str | None) -> int:
    listed = ", ".join(repr(heading) for heading in headings)
    if named is not None:
        wanted = named.strip()
        found = [i for i, words in enumerate(zip(headings, names, strict=True)) if wanted in (w.strip() for w in words)]
        if len(found) != 1:
            many = "no column" if not found else f"{len(found)} columns"
            raise InvalidInput(f"{path} has {many} named {named!r} for {quantity}; its columns are {listed}")
        return found[0]
    plain = [" ".join(re.split(r"[\W_]+", name.casefold())).strip() for name in names]
    found = [i for i, name in enumerate(plain) if name in _USUAL[quantity]]
    if not found:
        found = [i for i, name in enumerate(plain) if _quantity_of(name) == quantity]
    if len(found) != 1:
        many = "no column that looks like" if not found else f"{len(found)} columns that may be"
        raise InvalidInput(
            f"{path} has {many} {quantity}; its columns are {listed}: name it under columns in the "
            "YAML file of --columns"
        )
    return found[0]


def _quantity_of(name: str) -> str | None:
    """Return the one quantity that the words of a heading name, or None."""
    words = set(name.split())
    named = [quantity for quantity, typical in _TYPICAL.items() if words & typical]
    return named[0] if len(named) == 1 and not words & _DERIVED else None
