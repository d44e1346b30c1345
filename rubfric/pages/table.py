"""A table as a page for the browser."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import groupby, takewhile
from typing import Any, NamedTuple

import pandas as pd

from rubfric.checks import decimals
from rubfric.pages.render import render

_DIGITS, _ERROR_DIGITS = 4, 2
# Numbers between these are written without powers of ten.
_PLAIN = (1e-6, 1e7)
# Ends of headings, and the units that the page writes for them.
_UNITS = {"_mm_per_s": "mm/s", "_MPa": "MPa", "_mm": "mm", "_s": "s", "_MB": "MB", "_degC": "°C"}
# Columns that say which scene or point a row is of; the first of them stay in sight, up to a width in digits.
_AXES = ("rubber", "road", "curve", "velocity_mm_per_s", "pressure_MPa", "temperature_degC", "aspect")
_FROZEN = 24
# Groups of columns: pattern of the name, group, and what the page writes in place of the name, if not that itself.
_GROUPS = (
    (r"aspect", "block", "height over width"),
    (r"friction_total", "whole road", "friction"),
    (r"way", "whole road", ""),
    (r"friction_total_error", "whole road", "error"),
    (r"friction_(numerical|coupling|road|rubber)_error", "parts of the error", r"\1"),
    (r"friction_(sum|direct|corrected|cascade|persson)", "by every way", r"\1"),
    (r"friction_scale_(\d+)", "each scale by itself", r"scale \1"),
    (r"nominal_compression", "block", ""),
    (r"friction_total_ci95", "whole road", "half of the 95 % interval"),
    (r"refused|warnings|note|draws|not_covered", "to know", ""),
    (r"friction_coefficient", "friction", "from stress power"),
    (r"friction_coefficient_error", "friction", "error"),
    (r"friction_coefficient_rubber_error", "friction", "error from the rubber's data"),
    (r"friction_beyond_window", "friction", "share beyond measured frequencies"),
    (r"friction_coefficient_dissipation", "friction", "from dissipation"),
    (r"friction_coefficient_contact", "friction", "from contact pressure"),
    (r"energy_closure", "friction", "largest relative difference"),
    (r"contact_fraction", "contact", "area over nominal"),
    (r"maximum_contact_pressure_MPa", "contact", "largest pressure per undeformed area"),
    (r"maximum_local_contact_pressure_MPa", "contact", "largest pressure per deformed area"),
    (r"finite_strain|finite_strain_correction|effective_poissons_ratio|shear_wave_speed_ratio", "model", ""),
    (r"meshes|columns|rows|contact_nodes", "numerics", ""),
    (r"kind", "peak", ""),
    (r"peak_friction(_error)?", "peak", r"friction\1"),
    (r"peak_speed(_low|_high)?_mm_per_s", "peak", r"speed\1"),
    (r"half_(slower|faster)_speed_mm_per_s", r"half of it, \1", "speed"),
    (r"half_(slower|faster)_speed_(low|high)_mm_per_s", r"half of it, \1", r"\2"),
    (r"points|added", "known from", ""),
    (r"interpolation_error", "known from", ""),
)
# Texts longer than this are set in lines, characters.
_LINE = 40


class _Column(NamedTuple):
    """A column as the page shows it: its group, heading and unit, its kind as classes of CSS, its width in digits."""

    group: str
    heading: str
    unit: str
    kind: str
    width: int


def table_page(
    table: pd.DataFrame, title: str, words: str, group: str | None = None, csv: str = "", home: str = ""
) -> str:
    """Return a page with a title, a sentence or two, and a table.

    Parameters
    ----------
    table : pandas.DataFrame
        Headings end with their unit: ``velocity_mm_per_s``.
    title, words : str
        Plain text.
    group : str, optional
        A column; a line is drawn where its value changes.
    csv, home : str
        Links to the table as CSV and to the page of all results, relative to this page; none where ``home`` is empty.
    """
    return render("table.html", title=title, words=words, csv=csv, home=home, **table_cells(table, group))


def table_cells(table: pd.DataFrame, group: str | None = None) -> dict[str, Any]:
    """Return ``columns``, ``rows``, ``heads`` and ``frozen`` of a table for a template.

    Parameters
    ----------
    table : pandas.DataFrame
    group : str, optional
        A column; a line is drawn where its value changes.
    """
    groups = table[group].tolist() if group else [None] * len(table)
    places = _decimals(table)
    texts = {str(name): _column_texts(table[name], places.get(str(name))) for name in table.columns}
    named = all(_of_group(name)[0] for name in texts if name not in _AXES)  # else headings are those of the file
    columns = [_column(name, cells, table[name].dtype.kind in "OTSU", named) for name, cells in texts.items()]
    rows = [
        {"cells": cells, "begins_group": place > 0 and groups[place] != groups[place - 1]}
        for place, cells in enumerate(zip(*texts.values(), strict=True))
    ]
    heads = len(list(takewhile(lambda name: name in _AXES, texts)))
    frozen = [0]
    while len(frozen) <= heads and frozen[-1] + columns[len(frozen) - 1].width <= _FROZEN:
        frozen.append(frozen[-1] + columns[len(frozen) - 1].width)
    spans = [(name, len(list(run))) for name, run in groupby(column.group for column in columns)]
    return {
        "columns": columns,
        "rows": rows,
        "heads": heads,
        "frozen": frozen[:-1],
        "spans": spans if len(spans) > 1 else [],
    }


def _of_group(name: str) -> tuple[str, str]:
    """Return the group of a column and its heading within it; empty where it has none, or keeps its own."""
    for pattern, group, heading in _GROUPS:
        if re.fullmatch(pattern, name):
            named = re.sub(pattern, heading, name).replace("_", " ") if heading else ""
            return re.sub(pattern, group, name), named
    return "", ""


def _column(name: str, cells: Sequence[str], text: bool, grouped: bool) -> _Column:
    kind = "note" if text and max(map(len, cells), default=0) > _LINE else "text" if text else ""
    bare, unit = _heading(name)
    group, heading = _of_group(name) if grouped else ("", "")
    heading = heading or bare
    width = 2 + max([len(unit), *map(len, heading.split()), *map(len, cells)])
    return _Column(group, heading, unit, kind, width)


def _heading(name: str) -> tuple[str, str]:
    """Return the words of a heading and its unit, which may be empty."""
    ending = next((ending for ending in _UNITS if name.endswith(ending)), "")
    return name.removesuffix(ending).replace("_", " ").replace("poissons", "Poisson's"), _UNITS.get(ending, "")


def _decimals(table: pd.DataFrame) -> dict[str, list[int | None]]:
    """Return with how many decimals each error, and the value that it is of, is shown: two digits of the error."""
    found: dict[str, list[int | None]] = {}
    for name in map(str, table.columns):
        if not name.endswith("_error") or table[name].dtype.kind != "f":
            continue
        small = _PLAIN[0] * 1e-3
        found[name] = [max(0, decimals(one, _ERROR_DIGITS)) if small < one < math.inf else None for one in table[name]]
        if (of := name.removesuffix("_error")) in table:
            found[of] = found[name]
    return found


def value_and_error(value: float, error: float) -> str:
    """Return a value with its absolute error, as far as two digits of the error go."""
    if math.isnan(value):
        return ""
    if not _PLAIN[0] * 1e-3 < error < math.inf:
        return _shown(float(value), None)
    places = max(0, decimals(error, _ERROR_DIGITS))
    return f"{_shown(float(value), places)} ± {error:.{places}f}"


def _column_texts(values: pd.Series, known: Sequence[int | None] | None) -> list[str]:
    """Return the values of a column as the page shows them, decimal points below one another."""
    places = known or [None] * len(values)
    texts = [_shown(value, place) for value, place in zip(values, places, strict=True)]
    if values.name in _AXES:
        texts = [text.rstrip("0").rstrip(".") if "." in text else text for text in texts]
    if values.dtype.kind != "f" or any("e" in text for text in texts):
        return texts
    most = max((len(text.partition(".")[2]) for text in texts), default=0)
    point = "\N{PUNCTUATION SPACE}" if most else ""
    return [
        text and text + ("" if "." in text else point) + "\N{FIGURE SPACE}" * (most - len(text.partition(".")[2]))
        for text in texts
    ]


def _shown(cell: Any, places: int | None) -> str:
    """Return a value as the page shows it, with so many decimals where that is given; a gap is empty."""
    if not isinstance(cell, float):
        return str(cell)
    if math.isnan(cell):
        return ""
    if places is not None:
        text = f"{cell:.{places}f}"
    elif cell.is_integer() and abs(cell) < _PLAIN[1]:
        text = f"{cell:.0f}"
    elif _PLAIN[0] <= abs(cell) < _PLAIN[1]:
        text = f"{cell:.{max(0, decimals(abs(cell), _DIGITS))}f}"
    else:
        text = f"{cell:.{_DIGITS}g}"
    return text.replace("-", "\N{MINUS SIGN}")
