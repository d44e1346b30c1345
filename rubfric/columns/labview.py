"""What LabVIEW's text files (.lvm) say above their headings: separators, units, and times that are not written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rubfric.arrays import Real
from rubfric.columns.format import Format
from rubfric.columns.layout import Layout
from rubfric.columns.numerals import number
from rubfric.errors import InvalidInput

_TITLE, _END = "LabVIEW Measurement", "***End_of_Header***"
_SEPARATORS, _DECIMALS = {"tab": "tab", "comma": "comma"}, {".": "point", ",": "comma"}


def _entries(lines: Sequence[str]) -> dict[str, list[str]]:
    """Return key and fields of all lines of a file's header, the last where there are several; nothing for others."""
    if not lines or not lines[0].startswith(_TITLE):
        return {}
    mark = "," if any(line.startswith("Separator,") for line in lines[:20]) else "\t"
    return {fields[0].strip(): fields for fields in (line.split(mark) for line in lines)}


def completed(path: str, lines: Sequence[str], form: Format) -> Format:
    """Return a format with the separator, the decimal mark and the line of the headings that a file's header says.

    Parameters
    ----------
    path : str
        The file, for messages.
    lines : sequence of str
    form : Format
        What the user says, which comes first.

    Raises
    ------
    InvalidInput
        For several segments of measurement, unless the user names the headings of one.
    """
    said = _entries(lines[:20])
    separator, decimal = (said.get(key, ["", ""])[1].strip() for key in ("Separator", "Decimal_Separator"))
    ends = [place for place, line in enumerate(lines[:-1]) if said and line.startswith(_END)]
    tops = [place + 2 for place in ends if lines[place + 1].startswith("X_Value")]
    if len(tops) > 1 and form.headings is None:
        raise InvalidInput(
            f"{path} holds {len(tops)} segments of measurement, whose headings are in lines "
            f"{', '.join(map(str, tops[:8]))}{', ...' if len(tops) > 8 else ''}: write the line of one of them under "
            "headings in the YAML file of --columns"
        )
    return replace(
        form,
        separator=form.separator or _SEPARATORS.get(separator.casefold()),
        decimal=form.decimal or _DECIMALS.get(decimal),
        headings=form.headings or (tops[0] if tops else None),
    )


def named(lines: Sequence[str], layout: Layout) -> Layout:
    """Return a layout whose columns of X are named and have their unit where the header says that they are times.

    Parameters
    ----------
    lines : sequence of str
        All lines of the file.
    layout : Layout
    """
    said = _entries(lines[: layout.heading_line])
    if said.get("X_Dimension", ["", ""])[1].strip() != "Time":
        return layout
    xs = [heading.strip() == "X_Value" for heading in layout.headings]
    headings = tuple("time" if x else heading for x, heading in zip(xs, layout.headings, strict=True))
    units = tuple("s" if x else unit for x, unit in zip(xs, layout.units, strict=True))
    return replace(layout, headings=headings, units=units)


def times(lines: Sequence[str], count: int) -> Real | None:
    """Return the times (s) of rows without any, from the start and the step that the header gives; else None.

    Parameters
    ----------
    lines : sequence of str
        Those above the rows.
    count : int
        How many rows there are.
    """
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
