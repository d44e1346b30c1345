"""The scenes of the page: their numbers, and their pictures, by place, pressure and speed."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.deformation import profile
from rubfric.pages.explorer.pictures import Store, is_whole, picture
from rubfric.pages.explorer.roads import place_of
from rubfric.pages.explorer.totals import WHOLE, bare
from rubfric.results.selection import REFUSAL, RUBBER_ERROR
from rubfric.road.waves import WaveRoad

FRICTION, ERROR = "friction_coefficient", "friction_coefficient_error"
# Numbers of every scene: variable, name in the page.
SCALARS = {
    FRICTION: "friction",
    ERROR: "error",
    "friction_coefficient_dissipation": "dissipation",
    "friction_coefficient_contact": "contactRoute",
    "energy_closure": "closure",
    "contact_fraction": "contact",
    "maximum_contact_pressure": "largest",
    "maximum_local_contact_pressure": "largestLocal",
    "nominal_compression": "compression",
    "finite_strain": "finite",
    "columns": "columns",
    "rows": "rows",
}
# And of a measured rubber.
_RUBBER = {RUBBER_ERROR: "rubberError"}
# Most nodes of a picture, over the height and along a wavelength, and the fewest.
_MOST, _FEWEST = (28, 128), (12, 32)
# Per cent of the scenes whose lowest energies the common scale leaves out, and its least length in decades.
_LOWEST, _LENGTH = 10.0, 0.5
Axes = dict[str, np.ndarray]


def cells(field: xr.Dataset) -> list[list[dict[str, Any] | None]]:
    """Return the numbers of every scene over pressure and speed; None where it was not run."""
    listed = numbers(field)
    return [
        [dict(zip(listed.values(), plain(cell), strict=True)) if np.isfinite(cell[0]) else None for cell in row]
        for row in np.stack([field[name].values for name in listed], axis=-1)
    ]


def numbers(field: xr.Dataset) -> dict[str, str]:
    """Return the numbers of every scene that there are: variable, name in the page."""
    return SCALARS | {name: shown for name, shown in _RUBBER.items() if name in field}


def pictures(
    results: Iterable[xr.Dataset], axes: Axes, scenes: dict[str, Any], aspect: float, share: float
) -> tuple[Store, list[float], dict[str, WaveRoad], dict[str, Any]]:
    """Add picture, reason and warnings of every result to its scene.

    Returns
    -------
    store : Store
        The numbers of the pictures, each axis of which keeps a share of the most nodes.
    energies : list of float
        Decimal logarithms of MPa, the ends of the scale that all pictures share.
    roads : dict of WaveRoad
        Whole roads by place.
    refused : dict of list
        Why scenes on one of several roads were refused, by place, over pressure and speed.
    """
    store, low, high = Store(), [], []
    roads: dict[str, WaveRoad] = {}
    refused: dict[str, Any] = {}
    most = [max(fewest, int(share * size)) for size, fewest in zip(_MOST, _FEWEST, strict=True)]
    for result in results:
        name = place_of(result) if is_whole(result) else str(result.attrs["scale"])
        pressure, speed = _place(result, axes, scenes, aspect)
        if is_whole(result):
            roads.setdefault(name, profile(result))
        if REFUSAL in result.attrs:
            refused.setdefault(name, _blank(axes))[pressure][speed] = bare(str(result.attrs[REFUSAL]))
            continue
        if name not in scenes:
            scenes[name] = _blank(axes)
        if is_whole(result) and name != WHOLE:
            listed = numbers(result)
            values = plain(np.array([float(result[one]) for one in listed]))
            scenes[name][pressure][speed] = dict(zip(listed.values(), values, strict=True))
        scene = scenes[name][pressure][speed]
        if scene is None:
            raise _stranger(result)
        made = picture(result, *most)
        low.append(made.about["floor"])
        high.append(made.about["energy"][1])
        scene["picture"] = store.add(made)
        scene["reason"] = result.attrs["kinematics_reason"]
        scene["warnings"] = [sentence for sentence in result.attrs["warnings"].split("\n") if sentence]
    top = max(high, default=0.0)
    return store, [min(float(np.percentile(low, _LOWEST)) if low else -3.0, top - _LENGTH), top], roads, refused


def _blank(axes: Axes) -> list[list[Any]]:
    return [[None] * axes["velocity"].size for _ in axes["pressure"]]


def _place(result: xr.Dataset, axes: Axes, scenes: dict[str, Any], aspect: float) -> tuple[int, int]:
    """Return where a result is over pressure and speed."""
    places = [np.flatnonzero(axes[axis] == result.attrs[axis]) for axis in ("pressure", "velocity")]
    name = WHOLE if is_whole(result) else str(result.attrs["scale"])
    # The block on the whole road has a height of its own where that is a measured profile.
    fits = is_whole(result) or result.attrs["aspect"] == aspect
    if not (all(place.size for place in places) and fits and name in scenes):
        raise _stranger(result)
    pressure, speed = (int(place[0]) for place in places)
    return pressure, speed


def _stranger(result: xr.Dataset) -> InvalidInput:
    return InvalidInput(f"the scene {result.attrs['scene']} is not among those of the page")


def plain(values: np.ndarray) -> Any:
    """Return numbers as lists, to eight digits, None for NaN."""
    if values.ndim > 1:
        return [plain(row) for row in values]
    return [float(f"{value:.8g}") if math.isfinite(value) else None for value in values.tolist()]
