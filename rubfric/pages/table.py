"""A table as a page for the browser."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd

from rubfric.pages.render import render

_DIGITS = 4
# Ends of headings, and the units that the page writes for them.
_UNITS = {"_mm_per_s": "mm/s", "_MPa": "MPa", "_mm": "mm", "_s": "s", "_MB": "MB", "_degC": "°C"}


def table_page(table: pd.DataFrame, title: str, words: str, group: str | None = None) -> str:
    """Return a page with a title, a sentence or two, and a table.

    Parameters
    ----------
    table : pandas.DataFrame
        Headings end with their unit: ``velocity_mm_per_s``.
    title, words : str
        Plain text.
    group : str, optional
        A column; a line is drawn where its value changes.
    """
    return render("table.html", title=title, words=words, **table_cells(table, group))


def table_cells(table: pd.DataFrame, group: str | None = None) -> dict[str, Any]:
    """Return ``headings`` and ``rows`` of a table for a template.

    Parameters
    ----------
    table : pandas.DataFrame
    group : str, optional
        A column; a line is drawn where its value changes.
    """
    groups = table[group].tolist() if group else [None] * len(table)
    rows = [
        {"cells": [_shown(cell) for cell in cells], "begins_group": place > 0 and groups[place] != groups[place - 1]}
        for place, cells in enumerate(table.itertuples(index=False, name=None))
    ]
    return {"headings": [_heading(str(name)) for name in table.columns], "rows": rows}


def _heading(name: str) -> tuple[str, str]:
    """Return the words of a heading and its unit, which may be empty."""
    ending = next((ending for ending in _UNITS if name.endswith(ending)), "")
    return name.removesuffix(ending).replace("_", " ").replace("poissons", "Poisson's"), _UNITS.get(ending, "")


def _shown(cell: Any) -> str:
    """Return a value as the page shows it; a gap is empty."""
    if not isinstance(cell, float):
        return str(cell)
    if math.isnan(cell):
        return ""
    plain = cell == 0.0 or 1e-6 <= abs(cell) < 1e7
    return np.format_float_positional(cell, _DIGITS, fractional=False, trim="-") if plain else f"{cell:.{_DIGITS}g}"
