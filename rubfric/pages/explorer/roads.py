"""The roads that the whole road is known by: one, or several of random phases or windows of a measured profile."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from rubfric.figures.deformation import spot_width
from rubfric.pages.explorer.totals import WHOLE
from rubfric.results.selection import DRAWS, ROAD_ERROR, WINDOWS
from rubfric.road.waves import WaveRoad

# The attribute that says on which of several roads a result is, from 1; a result on the only one has none.
NUMBER = "road_number"
# Points among which the lowest and the highest of the road are found.
_POINTS = 16384
# The least share of a window that the page magnifies: its pictures have no more than some 500 columns.
_SPOT = 0.125

Array = np.ndarray


def whole_error(whole: xr.Dataset, numerical: str) -> Array:
    """Return the absolute error of the friction of the whole road: the numerical one, and that of so few roads."""
    errors = whole[numerical].values
    return errors + np.nan_to_num(whole[ROAD_ERROR].values) if ROAD_ERROR in whole else errors


def pictured(whole: xr.Dataset, name: str) -> int:
    """Return how many scenes of the whole road have a picture: one of which ``name`` is known, or one of each road."""
    return int(whole[DRAWS].sum() if DRAWS in whole and whole[DRAWS].ndim else whole[name].notnull().sum())


def place_of(result: xr.Dataset) -> str:
    """Return the place of a result of the whole road on the page."""
    return f"{WHOLE}{result.attrs.get(NUMBER, '')}"


def about(whole: xr.Dataset, roads: Mapping[str, WaveRoad], refused: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the page has to know of the roads: waves, mm, 1/mm and rad, size, and highest crest of each.

    Parameters
    ----------
    whole : xarray.Dataset
        The collection of its scenes, or the mean over several roads.
    roads : mapping of str to WaveRoad
        By place on the page; without those of which there is no result.
    refused : mapping of str to list
        By place: why scenes on one of several roads were refused, over pressure and speed.
    """
    found: dict[str, Any] = {"number": WHOLE, "draws": int(whole[DRAWS].max()) if DRAWS in whole else 0}
    windows = bool(found["draws"] and WINDOWS in whole[DRAWS].attrs.get("long_name", ""))
    if windows:
        found["windows"] = True
    if not roads:
        return found | {"wavelength": 2.0 * math.pi / float(whole["wavenumber"].min()), "waves": []}
    shapes = {place: _shape(road, windows) for place, road in sorted(roads.items())}
    if WHOLE in shapes:
        return found | shapes[WHOLE]
    ends = {
        "lowest": min(shape["lowest"] for shape in shapes.values()),
        "highest": max(shape["highest"] for shape in shapes.values()),
    }
    return found | {
        "roads": [shape | ends | {"number": place, "refusals": refused.get(place)} for place, shape in shapes.items()]
    }


def _shape(road: WaveRoad, windows: bool) -> dict[str, Any]:
    x = np.linspace(0.0, road.period, _POINTS)
    heights, waves = road.height(x), road.waves
    return {
        "wavelength": road.wavelength,
        "period": road.period,
        "spot": max(spot_width(road, windows), _SPOT * road.period if windows else 0.0),
        "waves": np.stack((waves.amplitudes, waves.wavenumbers, waves.phases), axis=1).tolist(),
        "lowest": float(heights.min()),
        "highest": float(heights.max()),
        "crest": float(x[np.argmax(heights)]),
    }
