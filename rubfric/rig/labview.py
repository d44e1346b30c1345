"""What LabVIEW's text files (.lvm) say above their headings: separators, units, and times that are not written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rubfric.arrays import Real
from rubfric.rig.layout import Layout
from rubfric.rig.numerals import number

_TITLE = "LabVIEW Measurement"
_SEPARATORS, _DECIMALS = {"tab": "tab", "comma": "comma"}, {".": "point", ",": "comma"}


def _entries(lines: Sequence[str]) -> dict[str, list[str]]:
    """Return key and fields of all lines of a file's header, the last where there are several; nothing for others."""
    if not lines or not lines[0].startswith(_TITLE):
        return {}
    mark = "," if any(line.startswith("Separator,") for line in lines[:20]) else "\t"
    return {fields[0].strip(): fields for fields in (line.split(mark) for line in lines)}


def marks(lines: Sequence[str]) -> tuple[str | None, str | None]:
    """Return separator and decimal mark as ``rubfric.rig.textfile.Format`` names them; None where they are not said."""
    said = _entries(lines[:20])
    separator, decimal = (said.get(key, ["", ""])[1].strip() for key in ("Separator", "Decimal_Separator"))
    return _SEPARATORS.get(separator.casefold()), _DECIMALS.get(decimal)


def named(lines: Sequence[str], layout: Layout) -> Layout:
    """Return a layout whose columns of X are named and have their unit where the header says that they are times."""
    said = _entries(lines[: layout.heading_line])
    if said.get("X_Dimension", ["", ""])[1].strip() != "Time":
        return layout
    xs = [heading.strip() == "X_Value" for heading in layout.headings]
    headings = tuple("time" if x else heading for x, heading in zip(xs, layout.headings, strict=True))
    units = tuple("s" if x else unit for x, unit in zip(xs, layout.units, strict=True))
    return replace(layout, headings=headings, units=units)


def times(lines: Sequence[str], count: int) -> Real | None:
    """Return the times (s) of rows without any, from the start and the step that the header gives; else None."""
    said = _entries(lines)
    if said.get("X_Columns", ["", ""])[1].strip() != "No":
        return None
    start, step = (
        next((found for word in said.get(key, [])[1:] if (found := _number(word)) is not None), None)
        for key in ("X0", "Delta_X")
    )
    return None if start is None or not step else start + step * np.arange(count)


def _number(word: str) -> float | None:
    return number(word, ",") if "," in word else number(word, ".") if word.strip() else None
