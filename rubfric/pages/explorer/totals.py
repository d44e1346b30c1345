"""What the page shows of the whole road: its friction by every way, and its scenes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.figures.columns import check_columns
from rubfric.results.scales import AXES, RUBBER_PART, TOTAL, WORDS
from rubfric.results.selection import refusals

# The place of the scenes of the whole road on the page.
WHOLE = "whole"
WAYS = ("sum", "corrected", "cascade", "persson", "direct")
_PARTS = ("numerical", "coupling", "road")

Axes = dict[str, np.ndarray]


def by_way(table: pd.DataFrame, axes: Axes) -> dict[str, Any]:
    """Return the total friction over pressure and speed.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.totals.total_table``.
    axes : dict of numpy.ndarray
        ``pressure`` (MPa) and ``velocity`` (mm/s) of the page.

    Returns
    -------
    dict
        Numpy arrays, shape (pressures, speeds): ``friction`` and ``error`` of the total; ``ways``, of each way the same
        two; ``parts`` of the error; ``way`` and ``note`` of every point, None where there is none.
    """
    pairs = {way: (f"friction_{way}", f"friction_{way}_error") for way in WAYS}
    parts = {part: f"friction_{part}_error" for part in _PARTS}
    parts |= {"rubber": RUBBER_PART} if RUBBER_PART in table else {}
    numbers = [name for pair in pairs.values() for name in pair] + list(TOTAL)
    check_columns(table, "table of totals", ("way",), [*AXES, *parts.values()], numbers)
    field = _fields(table, axes)

    def words(name: str) -> list[list[str | None]]:
        return [[one if isinstance(one, str) and one else None for one in row] for row in field(name, object)]

    return {
        "friction": field("friction_total"),
        "error": field("friction_total_error"),
        "ways": {way: {"friction": field(one), "error": field(other)} for way, (one, other) in pairs.items()},
        "parts": {part: field(name) for part, name in parts.items()},
        **{name: words(name) for name in WORDS},
    }


def beside(table: pd.DataFrame, axes: Axes) -> tuple[np.ndarray, np.ndarray]:
    """Return total friction and its error of another rubber or road over pressure and speed, NaN where there is none.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.pair.read_pair``.
    axes : dict of numpy.ndarray
        ``pressure`` (MPa) and ``velocity`` (mm/s) of the page.
    """
    check_columns(table, "table of totals", (), AXES, TOTAL)
    field = _fields(table, axes)
    return field("friction_total"), field("friction_total_error")


def _fields(table: pd.DataFrame, axes: Axes) -> Callable[..., Any]:
    """Return a function that gives a column of a table of totals over pressure and speed."""
    columns = ("pressure_MPa", axes["pressure"]), ("velocity_mm_per_s", axes["velocity"])
    # A table has six digits.
    same = [np.isclose(table[name].to_numpy()[:, None], axis, rtol=1e-5, atol=0.0) for name, axis in columns]
    known = np.flatnonzero(same[0].any(axis=1) & same[1].any(axis=1))
    places = tuple(one[known].argmax(axis=1) for one in same)

    def field(name: str, kind: type = float) -> Any:
        values: Any = np.full([axis.size for _, axis in columns], np.nan, dtype=kind)
        values[places] = table[name].to_numpy(dtype=kind)[known]
        return values

    return field


def on_axes(whole: xr.Dataset, axes: Axes) -> xr.Dataset:
    """Return the collection of the whole road over pressure and speed, NaN where it was refused or not run."""
    one = whole.isel(scale=0, aspect=0, drop=True).reindex(pressure=axes["pressure"], velocity=axes["velocity"])
    return one.transpose("pressure", "velocity", ...)


def reasons(whole: xr.Dataset, axes: Axes) -> list[list[str | None]]:
    """Return why scenes of the whole road were refused, over pressure and speed."""
    said = {(pressure, velocity): bare(reason) for (_, velocity, pressure, _), reason in refusals(whole).items()}
    return [[said.get((pressure, velocity)) for velocity in axes["velocity"]] for pressure in axes["pressure"]]


def bare(reason: str) -> str:
    """Return a reason without the name of its scene, which the page has said already."""
    return reason.partition(": ")[2] if reason.startswith("all_") else reason
