"""What the page shows of the whole road: its friction by every way, and its scenes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.figures.columns import check_columns
from rubfric.figures.deformation import profile
from rubfric.results.scales import AXES, RUBBER_PART, TOTAL, WORDS
from rubfric.results.selection import DRAWS, WINDOWS, refusals

# The place of the scenes of the whole road on the page.
WHOLE = "whole"
WAYS = ("sum", "corrected", "cascade", "persson", "direct")
_PARTS = ("numerical", "coupling", "road")
# Points among which the lowest and the highest of the road are found.
_POINTS = 16384

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
    columns = ("pressure_MPa", axes["pressure"]), ("velocity_mm_per_s", axes["velocity"])
    # A table has six digits.
    same = [np.isclose(table[name].to_numpy()[:, None], axis, rtol=1e-5, atol=0.0) for name, axis in columns]
    known = np.flatnonzero(same[0].any(axis=1) & same[1].any(axis=1))
    places = tuple(one[known].argmax(axis=1) for one in same)

    def field(name: str, kind: type = float) -> Any:
        values: Any = np.full([axis.size for _, axis in columns], np.nan, dtype=kind)
        values[places] = table[name].to_numpy(dtype=kind)[known]
        return values

    def words(name: str) -> list[list[str | None]]:
        return [[one if isinstance(one, str) and one else None for one in row] for row in field(name, object)]

    return {
        "friction": field("friction_total"),
        "error": field("friction_total_error"),
        "ways": {way: {"friction": field(one), "error": field(other)} for way, (one, other) in pairs.items()},
        "parts": {part: field(name) for part, name in parts.items()},
        **{name: words(name) for name in WORDS},
    }


def on_axes(whole: xr.Dataset, axes: Axes) -> xr.Dataset:
    """Return the collection of the whole road over pressure and speed, NaN where it was refused or not run."""
    one = whole.isel(scale=0, aspect=0, drop=True).reindex(pressure=axes["pressure"], velocity=axes["velocity"])
    return one.transpose("pressure", "velocity", ...)


def reasons(whole: xr.Dataset, axes: Axes) -> list[list[str | None]]:
    """Return why scenes of the whole road were refused, over pressure and speed."""
    # A scene that does not converge says its name first, which the page has said already.
    said = {
        (pressure, velocity): reason.partition(": ")[2] if reason.startswith("all_") else reason
        for (_, velocity, pressure, _), reason in refusals(whole).items()
    }
    return [[said.get((pressure, velocity)) for velocity in axes["velocity"]] for pressure in axes["pressure"]]


def about(whole: xr.Dataset, result: xr.Dataset | None) -> dict[str, Any]:
    """Return what the page has to know of the road: its waves, mm, 1/mm and rad, its size, and its highest crest.

    Parameters
    ----------
    whole : xarray.Dataset
    result : xarray.Dataset or None
        Of any scene on it that is pictured.
    """
    found: dict[str, Any] = {"number": WHOLE, "draws": int(whole[DRAWS].max()) if DRAWS in whole else 0}
    if found["draws"] and WINDOWS in whole[DRAWS].attrs.get("long_name", ""):
        found["windows"] = True
    if result is None:
        return found | {"wavelength": 2.0 * math.pi / float(whole["wavenumber"].min()), "waves": []}
    road = profile(result)
    x = np.linspace(0.0, road.period, _POINTS)
    heights = road.height(x)
    waves = road.waves
    return found | {
        "wavelength": road.wavelength,
        "period": road.period,
        "waves": np.stack((waves.amplitudes, waves.wavenumbers, waves.phases), axis=1).tolist(),
        "lowest": float(heights.min()),
        "highest": float(heights.max()),
        "crest": float(x[np.argmax(heights)]),
    }
