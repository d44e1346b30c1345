"""Which column of a logger's file holds which quantity: as the user says, or by usual names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.columns.textfile import TextTable
from rubfric.columns.units import check_factor, factor, heading_words, is_mass, split_heading
from rubfric.errors import InvalidInput
from rubfric.rig.names import EXAMPLES, PULLS, QUANTITIES, USUAL, quantity_of

_ORDINAL = re.compile(r"(\d+)(?:st|nd|rd|th)(?:\s+(.*))?")
# Part of a column's range within which two columns are equal.
_EQUAL = 1e-6


@dataclass(frozen=True)
class Column:
    """A column of a file.

    Attributes
    ----------
    place : int
        Its number, from 0.
    factor : float
        What its numbers have to be multiplied by to be in s, N or mm.
    notes : tuple of str
        On what was chosen among equal columns, and on units of mass.
    """

    place: int
    factor: float
    notes: tuple[str, ...] = ()


def unused_loads(table: TextTable, used: Mapping[str, Column]) -> list[str]:
    """Return the headings of columns that look like the normal force, and hold no other quantity.

    Parameters
    ----------
    table : TextTable
    used : mapping of str to Column
        The columns that hold a quantity.
    """
    taken = [column.place for column in used.values()]
    return [
        heading
        for place, heading in enumerate(table.headings)
        if place not in taken and heading_words(heading) in USUAL["normal"]
    ]


def recognise(
    path: str,
    table: TextTable,
    named: Mapping[str, str | int],
    given: Mapping[str, str],
    quantities: Sequence[str] = tuple(QUANTITIES),
) -> dict[str, Column]:
    """Return the columns of time, normal force, traction and displacement, or of some of them.

    Parameters
    ----------
    path : str
        The file, for messages.
    table : TextTable
    named : mapping
        Quantity to heading, with the unit or without, to the number of the column, from 1, or to ``2nd`` and the like,
        with a heading or without, where the user names it.
    given : mapping
        Quantity to unit, where the user gives it.
    quantities : sequence of str
        Those that are looked for. Without the normal force, the one force that there is may be the traction.

    Raises
    ------
    InvalidInput
        Where a column is missing, may be one of several, or has no unit.
    """
    search = _Search(path, table, named, given, "normal" not in quantities)
    found = {quantity: search.column(quantity) for quantity in quantities}
    places = [column.place for column in found.values()]
    for quantity, column in found.items():
        if places.count(column.place) > 1:
            raise InvalidInput(
                f"{path} has one column, {table.headings[column.place]!r}, for {quantity} and another quantity"
            )
    return found


@dataclass(frozen=True)
class _Search:
    """A search for columns, as ``recognise`` takes it; ``pulled`` is whether the normal force is known."""

    path: str
    table: TextTable
    named: Mapping[str, str | int]
    given: Mapping[str, str]
    pulled: bool

    def column(self, quantity: str) -> Column:
        """Return the one column of a quantity, and what its numbers have to be multiplied by."""
        places = self._places(quantity)
        if len(places) > 1 and not self._same(quantity, places):
            raise InvalidInput(self._which(quantity, places))
        scale, notes = self._scale(quantity, places[0])
        shown = ", ".join(str(place + 1) for place in places)
        same = (f"the columns number {shown} of {quantity} are equal: the first is taken",) if len(places) > 1 else ()
        return Column(places[0], scale, (*same, *notes, *self._other_times(quantity, places)))

    def _other_times(self, quantity: str, places: Sequence[int]) -> list[str]:
        """Return a note where channels have times of their own, which are not read."""
        name, values = heading_words(self.table.headings[places[0]]), self.table.values
        alike = [at for at, one in enumerate(self.table.headings) if at not in places and heading_words(one) == name]
        ways = [(at, float(np.nanmax(np.abs(values[:, at] - values[:, places[0]]), initial=0.0))) for at in alike]
        return [
            f"the times of column number {at + 1} differ by up to {way:.3g}; those of number {places[0] + 1} are taken"
            for at, way in ways
            if quantity == "time" and name and way > 0.0
        ]

    def _same(self, quantity: str, places: Sequence[int]) -> bool:
        """Return whether columns hold the same values, each in its unit."""
        try:
            first, *others = (self.table.values[:, place] * self._scale(quantity, place)[0] for place in places)
        except InvalidInput:
            return False
        return all(_equal(first, other) for other in others)

    def _places(self, quantity: str) -> list[int]:
        """Return the columns that may hold a quantity: the ones named, or those with a usual name and numbers."""
        wanted = self.named.get(quantity)
        if wanted is not None:
            return self._named(quantity, wanted)
        plain = [heading_words(heading) for heading in self.table.headings]
        usual = USUAL[quantity] | (PULLS if self.pulled and quantity == "traction" else set())
        exact = [place for place, name in enumerate(plain) if name in usual]
        typical = [place for place, name in enumerate(plain) if quantity_of(name) == quantity]
        # Distances are of two kinds, the place and the way in all, whose names do not tell them apart.
        found = sorted({*exact, *typical}) if quantity == "displacement" else exact or typical
        filled = [place for place in found if np.isfinite(self.table.values[:, place]).any()]
        if filled:
            return filled
        if found:
            raise InvalidInput(f"{self.path} has no number in the column {self._shown(found[:1])} of {quantity}")
        if not any(self.table.headings):
            raise InvalidInput(
                f"{self.path} has no line of headings right above its numbers, which begin in line {self.table.line}: "
                "in the YAML file of --columns, write its line under headings, or the number of each column (from 1) "
                "under columns and their units under units"
            )
        load = "; if the normal force is a known constant load, write normal: and the force in N there, or --normal"
        known = {
            "normal": load,
            "traction": "" if self.pulled else load,
            "time": "; if rows are evenly spaced in time, write sampling: and their number per second there",
        }
        raise InvalidInput(
            f"{self.path} has no column that looks like {quantity}; its columns are {self._shown()}: name it under "
            f"columns in the YAML file of --columns{known.get(quantity, '')}"
        )

    def _named(self, quantity: str, wanted: str | int) -> list[int]:
        headings = self.table.headings
        text = str(wanted).strip()
        exact = [place for place, heading in enumerate(headings) if isinstance(wanted, str) and text == heading.strip()]
        bare = [place for place, heading in enumerate(headings) if text == split_heading(heading)[0].strip()]
        bare = bare or [
            place for place, heading in enumerate(headings) if heading_words(text) == heading_words(heading)
        ]
        ordinal = _ORDINAL.fullmatch(text)
        if exact or (bare and isinstance(wanted, str)):
            return exact or bare
        if text.isdigit():
            if not 1 <= int(text) <= len(headings):
                raise InvalidInput(f"columns.{quantity} is {text}, but {self.path} has {len(headings)} columns")
            return [int(text) - 1]
        if ordinal:
            rest = {name: one for name, one in self.named.items() if name != quantity}
            rest |= {quantity: ordinal[2]} if ordinal[2] else {}
            several = _Search(self.path, self.table, rest, self.given, self.pulled)._places(quantity)
            if not 1 <= int(ordinal[1]) <= len(several):
                raise InvalidInput(
                    f"columns.{quantity} is {text!r}, but {self.path} has {len(several)} such columns: "
                    f"{self._shown(several)}"
                )
            return [several[int(ordinal[1]) - 1]]
        raise InvalidInput(
            f"{self.path} has no column named {wanted!r} for {quantity}; its columns are {self._shown()}"
        )

    def _scale(self, quantity: str, place: int) -> tuple[float, tuple[str, ...]]:
        """Return what the numbers of a column have to be multiplied by, and a note on units of mass."""
        heading, given = self.table.headings[place], self.given.get(quantity)
        if place in self.table.clocks:
            if quantity != "time":
                raise InvalidInput(
                    f"{self.path} has clock times in the column {heading!r}, but it is to hold {quantity}"
                )
            if given and factor("time", given) != 1.0:
                raise InvalidInput(
                    f"units.time is {given!r}, but {self.path} has clock times in the column {heading!r}: leave it out"
                )
            return 1.0, ()
        below, inside = self.table.units[place], split_heading(heading)[1]
        where = f"{heading!r}" if heading else f"number {place + 1}"
        both = [factor(QUANTITIES[quantity], one) for one in (below, inside) if one]
        if not given and len(both) == 2 and None not in both and both[0] != both[1]:
            raise InvalidInput(
                f"{self.path} has the units {inside!r} and {below!r} for the column {where}: write the right one "
                f"under units in the YAML file of --columns, as in units: {{{quantity}: {below}}}"
            )
        unit = given or below or inside
        if not unit:
            example = EXAMPLES[quantity]
            raise InvalidInput(
                f"{self.path} names no unit for the column {where}: write it in the heading, as in "
                f"'{heading or quantity} ({example})', or in the YAML file of --columns, as in units: "
                f"{{{quantity}: {example}}}"
            )
        what = f"the unit of the column {where} of {self.path}, which holds {quantity},"
        scale = check_factor(what, QUANTITIES[quantity], unit)
        weighed = quantity in ("normal", "traction") and is_mass(unit)
        return scale, (f"{quantity} in {unit} is read as the weight of that mass, {scale:.6g} N",) if weighed else ()

    def _which(self, quantity: str, places: Sequence[int]) -> str:
        named = f" named {self.named[quantity]!r}" if quantity in self.named else ""
        kinds = ""
        if quantity == "displacement" and "displacement" not in self.named:
            kinds = " (the position of the sled, which falls again where it moves back, not the way in all)"
        # The way in all is never shorter than the range of the places.
        likely = min(places, key=self._range) if kinds else places[0]
        return (
            f"{self.path} has {len(places)} columns{named} that may be {quantity}{kinds}, and they differ: "
            f"{self._shown(places)}; write which one in the YAML file of --columns, as in columns: "
            f"{{{quantity}: {likely + 1}}}"
        )

    def _range(self, place: int) -> float:
        """Return the range of a displacement, mm, or infinity where its unit is not known."""
        values = self.table.values[:, place]
        try:
            return float(np.nanmax(values) - np.nanmin(values)) * self._scale("displacement", place)[0]
        except InvalidInput:
            return np.inf

    def _shown(self, places: Sequence[int] | None = None) -> str:
        """Return headings as messages list them; chosen ones with their numbers."""
        headings = self.table.headings
        if places is None:
            return ", ".join(map(repr, headings))
        return ", ".join(f"{headings[place]!r} (number {place + 1})" for place in places)


def _equal(one: Real, other: Real) -> bool:
    both = np.isfinite(one) & np.isfinite(other)
    if not both.any() or both.sum() < 0.5 * np.isfinite(one).sum():
        return False
    return bool(np.abs(one[both] - other[both]).max() <= _EQUAL * max(float(np.ptp(one[both])), 1e-300))
