"""The page of an areal road: maps of contact to choose from by speed and pressure, and all friction as a table."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.arrays import Real
from rubfric.pages.render import render, sentence
from rubfric.pages.table import table_cells
from rubfric.results.areal_table import plane_words

# Most points along a side of a map, and bytes of all maps.
_SIDE, _BYTES = 256, 1_500_000
# Share of the pressures above the scale's end.
_BEYOND = 0.02


def areal_page(results: Sequence[xr.Dataset], table: pd.DataFrame, road: str, csv: str = "", home: str = "") -> str:
    """Return the page.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        As from ``rubfric.results.areal.build``, of one temperature.
    table : pandas.DataFrame
        As from ``rubfric.results.areal_table.areal_table`` of these.
    road : str
        Its name.
    csv, home : str
        Links to the table as CSV and to the page of all results; none where ``home`` is empty.
    """
    first = results[0]
    periods = [float(first[name][1]) * first.sizes[name] for name in ("x", "y")]
    direction = f"{float(first.attrs['direction']):g} degrees from x"
    lead = (
        f"{first.attrs['rubber']} on the areal road {road}, {periods[0]:.4g} x {periods[1]:.4g} mm, rms height "
        f"{float(first.rms_height):.3g} mm, rms slope {float(first.rms_slope):.3g}; the rubber meets the road along "
        f"{direction}. Small strain."
    )
    off = plane_words(table)
    return render(
        "areal.html",
        title=f"Areal road {road}",
        lead=lead,
        csv=csv,
        home=home,
        warnings=[sentence(off)] if off else [],
        maps=maps(results, table, periods),
        **table_cells(table, group="pressure_MPa"),
    )


def maps(results: Sequence[xr.Dataset], table: pd.DataFrame, periods: Sequence[float]) -> dict[str, Any]:
    """Return what the script draws: heights and pressures as bytes in base64, and numbers beside them.

    Parameters
    ----------
    results : sequence of xarray.Dataset
    table : pandas.DataFrame
        A row for each.
    periods : sequence of float
        L_x and L_y, mm.

    Returns
    -------
    dict
        ``heights`` from 0, the lowest, to 255; in each of ``scenes`` ``pressure``, 0 where nothing touches and from 1
        to 255 on a logarithmic scale between both of ``scale``, MPa; ``shape`` (ny, nx) of all maps.
    """
    ny, nx = _shape(results, periods)
    fields = [_coarse(one.contact_pressure.values, ny, nx) for one in results]
    touching = np.concatenate([field[field > 0.0] for field in fields])
    low = min(float(one.attrs["pressure"]) for one in results)
    high = max(float(np.quantile(touching, 1.0 - _BEYOND)), 1.01 * low)
    heights = _coarse(results[0].road_height.values, ny, nx)
    span = float(np.ptp(heights)) or 1.0
    rows = {(row["velocity_mm_per_s"], row["pressure_MPa"]): row for row in table.to_dict("records")}
    scenes = []
    for one, field in zip(results, fields, strict=True):
        place = float(one.attrs["velocity"]), float(one.attrs["pressure"])
        share = np.log(np.maximum(field, low) / low) / math.log(high / low)
        level = np.where(field > 0.0, 1 + np.rint(254.0 * np.minimum(share, 1.0)), 0)
        numbers = {str(name): _number(value) for name, value in rows[place].items() if name != "note"}
        scenes.append({"velocity": place[0], "load": place[1], "pressure": _text(level), "numbers": numbers})
    return {
        "shape": [ny, nx],
        "periods": list(periods),
        "scale": [low, high],
        "heights": _text(np.rint(255.0 * (heights - heights.min()) / span)),
        "scenes": scenes,
    }


def _shape(results: Sequence[xr.Dataset], periods: Sequence[float]) -> tuple[int, int]:
    """Return (ny, nx) of maps that no result is coarser than, and that are as wide to high as the road."""
    longest = max(periods)
    side = min(_SIDE, int(math.sqrt(_BYTES / (len(results) + 1) * longest / min(periods))))
    ny, nx = (
        max(1, min(round(side * period / longest), *(one.sizes[name] for one in results)))
        for name, period in zip("yx", reversed(periods), strict=True)
    )
    return ny, nx


def _coarse(field: Real, ny: int, nx: int) -> Real:
    """Return the means of a field over ny x nx boxes."""
    for axis, count in enumerate((ny, nx)):
        begins = -(-np.arange(count) * field.shape[axis] // count)
        sizes = np.diff([*begins, field.shape[axis]])
        field = np.add.reduceat(field, begins, axis=axis) / np.expand_dims(sizes, 1 - axis)
    return field


def _text(level: Real) -> str:
    return base64.b64encode(level.astype(np.uint8).tobytes()).decode("ascii")


def _number(value: Any) -> float | None:
    """Return a number as JSON knows it: none for a gap."""
    return float(f"{value:.4g}") if math.isfinite(value) else None
