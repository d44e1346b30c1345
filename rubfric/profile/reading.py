"""A profile from a file: text with distances and heights, ISO 25178-71, or what SurfaceTopography reads."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rubfric.arrays import Real
from rubfric.columns.decoding import decode
from rubfric.columns.format import AS_FOUND, SEPARATORS, Format
from rubfric.columns.textfile import TextTable, read_text, readable
from rubfric.columns.units import check_factor, factor, heading_words, split_heading
from rubfric.errors import InvalidInput
from rubfric.profile.measured import Profile, at_distances, with_notes
from rubfric.profile.scan import Scan
from rubfric.profile.sdf import is_sdf, read_sdf

_USUAL = {
    "distance": {"distance", "dist", "x", "position", "pos", "lateral", "length", "chainage", "station", "abscissa"}
    | {"travel", "s", "weg", "strecke", "lateral position", "scan position", "x position", "location", "offset"},
    "height": {"height", "heights", "z", "elevation", "profile", "raw", "y", "h", "texture", "level", "höhe", "total"}
    | {"profile height", "surface height", "z height", "depth", "amplitude", "laser", "texture height", "relief"},
}
# Lines in which headings are looked for that say what separates columns.
_MOST_ABOVE = 300
_WORDS = {"distance": {"distance", "lateral", "chainage"}, "height": {"height", "elevation", "profile", "texture"}}


@dataclass(frozen=True)
class Options:
    """What a file does not say.

    Attributes
    ----------
    unit : tuple of str
        Of distances and heights, in that order, or of both; nothing where the file says.
    spacing : float, optional
        Of heights alone, mm.
    columns : tuple of (str or None), shape (2,)
        Heading or number (from 1) of distance and height, where they are not recognised.
    line : int, optional
        Which line of an areal scan, from 1; the middle one by default.
    direction : {"x", "y"}
        Of the lines of an areal scan.
    form : Format
        Separator, decimal mark, encoding and line of headings of a file of text, where those are not found out.
    """

    unit: tuple[str, ...] = ()
    spacing: float | None = None
    columns: tuple[str | None, str | None] = (None, None)
    line: int | None = None
    direction: str = "x"
    form: Format = AS_FOUND

    def __post_init__(self) -> None:
        if len(self.unit) > 2:
            raise InvalidInput(
                f"--unit is {','.join(self.unit)}, but must be one unit, or those of distance and height"
            )
        for unit in self.unit:
            check_factor("--unit", "length", unit)

    def factor(self, quantity: str) -> float | None:
        """Return what a distance or a height has to be multiplied by to be in mm, where the user says it."""
        if not self.unit:
            return None
        return factor("length", self.unit[0 if quantity == "distance" else -1])


def read(path: str, options: Options = Options()) -> Profile:
    """Read a profile.

    Parameters
    ----------
    path : str
        A file of text (CSV), an ISO 25178-71 file, or, with the extra ``topography``, any that SurfaceTopography reads.
    options : Options

    Raises
    ------
    InvalidInput
        For a file that cannot be read, has no unit or spacing, or holds what cannot be a road.
    FileNotFoundError
        For a missing file.
    """
    if os.path.isdir(path):
        raise InvalidInput(f"{path} is a folder, but must be a file of heights")
    with open(path, "rb") as stream:
        head = stream.read(4096)
    if is_sdf(head):
        return _line(read_sdf(path), options).checked()
    if b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff")):
        from rubfric.profile.topography import read_topography

        return _line(read_topography(path), options).checked()
    return _from_text(path, options).checked()


def _line(scan: Scan, options: Options) -> Profile:
    """Return a line of an areal scan, the middle one unless another is named."""
    return scan.line(options.direction, options.line)


def _from_text(path: str, options: Options) -> Profile:
    names = sorted(set[str]().union(*_USUAL.values()))
    table = _table(path, options.form, names)
    places = [_place(path, table, quantity, options) for quantity in ("distance", "height")]
    numeric = [at for at in range(table.values.shape[1]) if np.isfinite(table.values[:, at]).any()]
    notes = []
    if len(numeric) == 1 and places[0] is None:
        places[1] = numeric[0]
    elif None in places and len(numeric) == 2 and options.spacing is None:
        places = [places[0], next(one for one in numeric if one != places[0])] if places[0] is not None else places
        places = [next(one for one in numeric if one != places[1]), places[1]] if places[1] is not None else places
        if None in places and (np.diff(table.values[:, numeric[0]]) > 0.0).all():
            places = list(numeric)
            notes.append("the first of two columns is taken as distances, the second as heights")
    if places[1] is None or (places[0] is None and options.spacing is None):
        _ask(path, table, places, numeric)
    at = places[1]
    assert at is not None
    kept, words = readable(path, table, [at])
    heights = np.where(kept, table.values[:, at], np.nan)
    heights[~np.isfinite(heights)] = np.nan
    heights = heights * _factor(path, table, at, "height", options)
    notes = [*table.notes, *words, *notes]
    lines = [line for line, _ in table.rows]
    if options.spacing is not None:
        if places[0] is not None:
            notes.append(f"{table.headings[places[0]]!r} is not read: heights are {options.spacing:g} mm apart")
        return with_notes(Profile(path, 0.0, options.spacing, _with_blanks(table, heights, notes)), *notes)
    assert places[0] is not None
    distances = table.values[:, places[0]] * _factor(path, table, places[0], "distance", options)
    return with_notes(at_distances(path, distances, heights, lines), *notes)


def _table(path: str, form: Format, names: Sequence[str]) -> TextTable:
    """Return the table of a file, whose separator is not easily found where heights are few or alone."""
    if form.decimal == "comma" and form.separator is None:  # then a comma separates nothing
        tables = (read_text(path, replace(form, separator=kind), names, 1) for kind in SEPARATORS if kind != "comma")
        return next((table for table in tables if len(table.headings) > 1), None) or read_text(
            path, replace(form, separator="semicolon"), names, 1
        )
    lines = decode(path, form.encoding, names)[0].splitlines()[:_MOST_ABOVE]
    for kind, mark in SEPARATORS.items() if form.separator is None else ():
        words = [{heading_words(part) for part in line.split(mark)} for line in lines if mark in line]
        if any(_USUAL["distance"] & one and _USUAL["height"] & one for one in words):
            return read_text(path, replace(form, separator=kind), names, 1)
    return read_text(path, form, names, 1)


def _with_blanks(table: TextTable, heights: Real, notes: list[str]) -> Real:
    """Return heights alone with a gap for every blank line, which would move all that follow."""
    lines = np.array([line for line, _ in table.rows])
    whole = np.full(lines[-1] - lines[0] + 1, np.nan)
    whole[lines - lines[0]] = heights
    if len(whole) > len(heights):
        notes.append(f"{len(whole) - len(heights)} lines without a height are gaps")
    return whole


def _place(path: str, table: TextTable, quantity: str, options: Options) -> int | None:
    """Return the column that holds a quantity, as the user or its heading says."""
    wanted = options.columns[0 if quantity == "distance" else 1]
    headings = table.headings
    if wanted is not None:
        exact = [at for at, one in enumerate(headings) if wanted in (one.strip(), split_heading(one)[0].strip())]
        if not exact and wanted.isdigit() and 1 <= int(wanted) <= len(headings):
            exact = [int(wanted) - 1]
        if len(exact) != 1:
            raise InvalidInput(
                f"--{quantity} is {wanted!r}, but {path} has {'no' if not exact else len(exact)} such columns; its "
                f"columns are {_listed(headings)}"
            )
        return exact[0]
    plain = [heading_words(one) for one in headings]
    exact = [at for at, name in enumerate(plain) if name in _USUAL[quantity]]
    found = exact or [at for at, name in enumerate(plain) if _WORDS[quantity] & set(name.split())]
    if len(found) > 1:
        raise InvalidInput(
            f"{path} has {len(found)} columns that may be {quantity}, {_listed([headings[at] for at in found])}: name "
            f"one with --{quantity}"
        )
    return found[0] if found else None


def _ask(path: str, table: TextTable, places: Sequence[int | None], numeric: Sequence[int]) -> None:
    if len(numeric) == 1 or (places[1] is not None and places[0] is None and len(numeric) < 2):
        raise InvalidInput(f"{path} has heights alone, but not how far apart they are: say it with --spacing, in mm")
    lacks = " and ".join(name for name, place in zip(("distance", "height"), places, strict=True) if place is None)
    raise InvalidInput(
        f"{path} has no column that looks like {lacks}; its columns are {_listed(table.headings)}: name them with "
        "--distance and --height, by heading or by number from 1"
    )


def _factor(path: str, table: TextTable, at: int, quantity: str, options: Options) -> float:
    said = options.factor(quantity)
    if said is not None:
        return said
    heading = table.headings[at]
    below, inside = table.units[at], split_heading(heading)[1]
    unit = below or inside
    where = repr(heading) if heading else f"number {at + 1}"
    if not unit:
        raise InvalidInput(
            f"{path} names no unit for the column {where} of {quantity}s: write it in the heading, as in "
            f"'{heading or quantity} (mm)', or say --unit mm, or --unit mm,um for distances and heights"
        )
    if below and inside and factor("length", below) != factor("length", inside):
        raise InvalidInput(
            f"{path} has the units {inside!r} and {below!r} for the column {where}: say the right one with --unit"
        )
    return check_factor(f"the unit of the column {where} of {path}, which holds {quantity}s,", "length", unit)


def _listed(headings: Sequence[str]) -> str:
    return ", ".join(repr(one) if one else f"number {at}" for at, one in enumerate(headings, 1))
