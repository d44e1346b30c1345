"""What the page shows of a campaign, as plain values for JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.pages.explorer.palette import palette
from rubfric.pages.explorer.pictures import Store, picture
from rubfric.results.scales import total_error, total_friction
from rubfric.results.selection import check_variables, find_peak, position

_FRICTION, _ERROR = "friction_coefficient", "friction_coefficient_error"
# Numbers of every scene: variable, name in the page.
_SCALARS = {
    _FRICTION: "friction",
    _ERROR: "error",
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
_ABOUT = ("rubber", "plane", "kinematics", "source", "references")
# Most nodes of a picture, over the height and along a wavelength, and the fewest; of how many pictures the most are
# kept, so that the page stays below 10 MB.
_MOST, _FEWEST, _ROOM = (28, 128), (12, 32), 400
# Per cent of the scenes whose lowest energies the common scale leaves out, and its least length in decades.
_LOWEST, _LENGTH = 10.0, 0.5


def payload(campaign: xr.Dataset, results: Iterable[xr.Dataset], aspect: float, road: str) -> dict[str, Any]:
    """Return all that the page shows.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``results.campaign.collect``; scenes that were not run are NaN.
    results : iterable of xarray.Dataset
        As built by ``results.dataset.build``, at this height-to-width ratio; a scene without one has numbers but no
        picture.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.

    Returns
    -------
    dict
        Speeds in mm/s, pressures in MPa, lengths in mm; friction and errors absolute, over pressure, then speed; None
        where nothing is known.

    Raises
    ------
    BrokenResult
        For a campaign that lacks a variable.
    InvalidInput
        For a ratio that the campaign lacks or has no scene of, and for results of other scenes.
    """
    grid = _grid(campaign, aspect)
    axes = {name: grid[name].values for name in ("scale", "pressure", "velocity")}
    scenes = _scenes(grid)
    packed, energies = _pictures(results, axes, scenes, aspect)
    return {
        "about": {name: str(campaign.attrs.get(name, "unknown")) for name in _ABOUT}
        | {"road": road, "aspect": aspect, "accuracy": _accuracy(campaign)},
        "speeds": _plain(axes["velocity"]),
        "pressures": _plain(axes["pressure"]),
        "scales": [_scale(grid.sel(scale=number)) for number in axes["scale"]],
        "curves": _curves(grid),
        "scenes": scenes,
        "colours": palette(axes["pressure"].size, axes["scale"].size),
        "energies": energies,
        "pictures": packed,
    }


def _grid(campaign: xr.Dataset, aspect: float) -> xr.Dataset:
    """Return the campaign at one ratio, over scale, pressure and speed, without those of which nothing was run."""
    check_variables(campaign, *_SCALARS, "amplitude", "wavenumber")
    grid = campaign[[*_SCALARS, "amplitude", "wavenumber"]].isel(aspect=position(campaign, "aspect", aspect), drop=True)
    grid = grid.sortby(["scale", "pressure", "velocity"]).transpose("scale", "pressure", "velocity")
    for axis in ("pressure", "velocity"):
        others = [other for other in ("scale", "pressure", "velocity") if other != axis]
        grid = grid.isel({axis: np.flatnonzero(grid[_FRICTION].notnull().any(others).values)})
    if not grid[_FRICTION].size:
        raise InvalidInput(f"the campaign holds no friction coefficient at the height-to-width ratio {aspect:g}")
    return grid


def _accuracy(campaign: xr.Dataset) -> float | None:
    return json.loads(campaign.attrs.get("numerics", "{}")).get("accuracy")


def _scale(grid: xr.Dataset) -> dict[str, Any]:
    wavenumber = float(grid["wavenumber"])
    return {
        "number": int(grid["scale"]),
        "amplitude": float(grid["amplitude"]),
        "wavelength": 2.0 * math.pi / wavenumber,
    }


def _curves(grid: xr.Dataset) -> dict[str, Any]:
    """Return friction, its error and peaks of every scale, and of all scales together where there are several."""
    found = {
        str(number): _curve(grid[_FRICTION].sel(scale=number), grid[_ERROR].sel(scale=number))
        for number in grid["scale"].values
    }
    if len(found) > 1:
        found["total"] = _curve(total_friction(grid[_FRICTION]), total_error(grid[_ERROR]))
    return found


def _curve(friction: xr.DataArray, error: xr.DataArray) -> dict[str, Any]:
    pairs = zip(friction.values, error.values, strict=True)
    peaks = [find_peak(*pair)._asdict() for pair in pairs]
    return {"friction": _plain(friction.values), "error": _plain(error.values), "peaks": peaks}


def _scenes(grid: xr.Dataset) -> dict[str, list[list[dict[str, Any] | None]]]:
    """Return the numbers of every scene by scale, pressure and speed; None where it was not run."""
    names = list(_SCALARS.values())
    fields = np.stack([grid[name].values for name in _SCALARS], axis=-1)
    return {
        str(number): [
            [dict(zip(names, _plain(cell), strict=True)) if np.isfinite(cell[0]) else None for cell in row]
            for row in field
        ]
        for number, field in zip(grid["scale"].values, fields, strict=True)
    }


def _pictures(
    results: Iterable[xr.Dataset], axes: dict[str, np.ndarray], scenes: dict[str, Any], aspect: float
) -> tuple[str, list[float]]:
    """Add picture, reason and warnings of every result to its scene; return the packed numbers and their energies.

    Energies are decimal logarithms of MPa, the ends of the scale that all pictures share.
    """
    store, low, high = Store(), [], []
    count = sum(scene is not None for rows in scenes.values() for row in rows for scene in row)
    share = min(1.0, math.sqrt(_ROOM / count))
    most = [max(fewest, int(share * size)) for size, fewest in zip(_MOST, _FEWEST, strict=True)]
    for result in results:
        scene = _found(result, axes, scenes, aspect)
        made = picture(result, *most)
        low.append(made.about["floor"])
        high.append(made.about["energy"][1])
        scene["picture"] = store.add(made)
        scene["reason"] = result.attrs["kinematics_reason"]
        scene["warnings"] = [sentence for sentence in result.attrs["warnings"].split("\n") if sentence]
    top = max(high, default=0.0)
    return store.packed(), [min(float(np.percentile(low, _LOWEST)) if low else -3.0, top - _LENGTH), top]


def _found(result: xr.Dataset, axes: dict[str, np.ndarray], scenes: dict[str, Any], aspect: float) -> dict[str, Any]:
    """Return the scene of a result."""
    wanted = {"scale": "scale", "pressure": "pressure", "velocity": "velocity"}
    places = [np.flatnonzero(axes[axis] == result.attrs[name]) for axis, name in wanted.items()]
    scene = None
    if all(place.size for place in places) and result.attrs["aspect"] == aspect:
        scale, pressure, speed = (int(place[0]) for place in places)
        scene = scenes[str(axes["scale"][scale])][pressure][speed]
    if scene is None:
        raise InvalidInput(f"the scene {result.attrs['scene']} is not among those of the page")
    return scene


def _plain(values: np.ndarray) -> Any:
    """Return numbers as lists, to eight digits, None for NaN."""
    if values.ndim > 1:
        return [_plain(row) for row in values]
    return [float(f"{value:.8g}") if math.isfinite(value) else None for value in values.tolist()]
