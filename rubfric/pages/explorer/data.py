"""What the page shows of a campaign, as plain values for JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.pages.explorer.palette import palette
from rubfric.pages.explorer.pictures import WIDER, Store, is_whole, picture
from rubfric.pages.explorer.totals import WHOLE, about, by_way, on_axes, reasons
from rubfric.results.selection import RUBBER_ERROR, check_variables, find_peak, position

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
# And of a measured rubber.
_RUBBER = {RUBBER_ERROR: "rubberError"}
_ABOUT = ("rubber", "plane", "kinematics", "source", "references")
# Most nodes of a picture, over the height and along a wavelength, and the fewest; of how many pictures the most are
# kept, so that the page stays below 10 MB.
_MOST, _FEWEST, _ROOM = (28, 128), (12, 32), 400
# Per cent of the scenes whose lowest energies the common scale leaves out, and its least length in decades.
_LOWEST, _LENGTH = 10.0, 0.5


def payload(
    campaign: xr.Dataset,
    table: pd.DataFrame,
    results: Iterable[xr.Dataset],
    aspect: float,
    road: str,
    whole: xr.Dataset | None = None,
    share: float = 1.0,
) -> dict[str, Any]:
    """Return all that the page shows.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``results.campaign.collect``; scenes that were not run are NaN.
    table : pandas.DataFrame
        The friction of the whole road, as from ``results.totals.total_table``; of one scale it is not shown.
    results : iterable of xarray.Dataset
        As built by ``results.dataset.build``, at this height-to-width ratio; a scene without one has numbers but no
        picture.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.
    whole : xarray.Dataset, optional
        The collection of the scenes of the whole road, results of which may be among ``results``.
    share : float
        Of the room for pictures, where several payloads share a page.

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
    curves, scenes, found = _curves(grid), _scenes(grid), {}
    if len(curves) > 1:
        totals = by_way(table, axes)
        curves["total"] = _curve(totals.pop("friction"), totals.pop("error"))
        found["totals"] = _all_plain(totals)
    if whole is not None:
        placed = on_axes(whole, axes)
        curves[WHOLE] = _curve(placed[_FRICTION].values, placed[_ERROR].values)
        scenes[WHOLE] = _cells(placed)
        found["refusals"] = reasons(whole, axes)
    packed, energies, pictured = _pictures(results, axes, scenes, aspect, share * _ROOM)
    if whole is not None:
        found[WHOLE] = about(whole, pictured)
    return {
        "about": {name: str(campaign.attrs.get(name, "unknown")) for name in _ABOUT}
        | {"road": road, "aspect": aspect, "accuracy": _accuracy(campaign)},
        "speeds": _plain(axes["velocity"]),
        "pressures": _plain(axes["pressure"]),
        "scales": [_scale(grid.sel(scale=number)) for number in axes["scale"]],
        "curves": curves,
        "scenes": scenes,
        "colours": palette(axes["pressure"].size, axes["scale"].size),
        "energies": energies,
        "pictures": packed,
        **found,
    }


def together(payloads: Mapping[float | None, dict[str, Any]], shown: float | None) -> dict[str, Any]:
    """Return the payload of a page that shows one of several temperatures.

    Parameters
    ----------
    payloads : mapping of float to dict
        By temperature, degC; one under None stays as it is.
    shown : float or None
        The temperature with which the page begins.
    """
    if None in payloads:
        return payloads[None]
    return {"temperatures": list(payloads), "shown": shown, "pages": list(payloads.values())}


def _grid(campaign: xr.Dataset, aspect: float) -> xr.Dataset:
    """Return the campaign at one ratio, over scale, pressure and speed, without those of which nothing was run."""
    check_variables(campaign, *_SCALARS, "amplitude", "wavenumber")
    grid = campaign[[*_numbers(campaign), "amplitude", "wavenumber"]].isel(
        aspect=position(campaign, "aspect", aspect), drop=True
    )
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
    amplitude, wavenumber = float(grid["amplitude"]), float(grid["wavenumber"])
    return {
        "number": int(grid["scale"]),
        "wavelength": 2.0 * math.pi / wavenumber,
        "waves": [[amplitude, wavenumber, 0.0]],
        "lowest": -amplitude,
        "highest": amplitude,
        "crest": 0.5 * math.pi / wavenumber,
    }


def _curves(grid: xr.Dataset) -> dict[str, Any]:
    """Return friction, its error and peaks of every scale."""
    return {
        str(number): _curve(*(grid[name].sel(scale=number).values for name in (_FRICTION, _ERROR)))
        for number in grid["scale"].values
    }


def _curve(friction: np.ndarray, error: np.ndarray) -> dict[str, Any]:
    peaks = [find_peak(*pair)._asdict() for pair in zip(friction, error, strict=True)]
    return {"friction": _plain(friction), "error": _plain(error), "peaks": peaks}


def _scenes(grid: xr.Dataset) -> dict[str, list[list[dict[str, Any] | None]]]:
    """Return the numbers of every scene by scale, pressure and speed; None where it was not run."""
    return {str(number): _cells(grid.sel(scale=number)) for number in grid["scale"].values}


def _cells(field: xr.Dataset) -> list[list[dict[str, Any] | None]]:
    numbers = _numbers(field)
    return [
        [dict(zip(numbers.values(), _plain(cell), strict=True)) if np.isfinite(cell[0]) else None for cell in row]
        for row in np.stack([field[name].values for name in numbers], axis=-1)
    ]


def _numbers(field: xr.Dataset) -> dict[str, str]:
    """Return the numbers of every scene that there are: variable, name in the page."""
    return _SCALARS | {name: shown for name, shown in _RUBBER.items() if name in field}


def _pictures(
    results: Iterable[xr.Dataset], axes: dict[str, np.ndarray], scenes: dict[str, Any], aspect: float, room: float
) -> tuple[str, list[float], xr.Dataset | None]:
    """Add picture, reason and warnings of every result to its scene; return the packed numbers and their energies.

    Energies are decimal logarithms of MPa, the ends of the scale that all pictures share. The last is any result of the
    whole road.
    """
    store, low, high, whole = Store(), [], [], None
    weights = {name: WIDER if name == WHOLE else 1 for name in scenes}
    count = sum(weights[name] * (scene is not None) for name, rows in scenes.items() for row in rows for scene in row)
    share = min(1.0, math.sqrt(room / count))
    most = [max(fewest, int(share * size)) for size, fewest in zip(_MOST, _FEWEST, strict=True)]
    for result in results:
        scene = _found(result, axes, scenes, aspect)
        made = picture(result, *most)
        whole = result if is_whole(result) else whole
        low.append(made.about["floor"])
        high.append(made.about["energy"][1])
        scene["picture"] = store.add(made)
        scene["reason"] = result.attrs["kinematics_reason"]
        scene["warnings"] = [sentence for sentence in result.attrs["warnings"].split("\n") if sentence]
    top = max(high, default=0.0)
    return store.packed(), [min(float(np.percentile(low, _LOWEST)) if low else -3.0, top - _LENGTH), top], whole


def _found(result: xr.Dataset, axes: dict[str, np.ndarray], scenes: dict[str, Any], aspect: float) -> dict[str, Any]:
    """Return the scene of a result."""
    places = [np.flatnonzero(axes[axis] == result.attrs[axis]) for axis in ("pressure", "velocity")]
    name, scene = WHOLE if is_whole(result) else str(result.attrs["scale"]), None
    # The block on the whole road has a height of its own where that is a measured profile.
    fits = is_whole(result) or result.attrs["aspect"] == aspect
    if all(place.size for place in places) and fits and name in scenes:
        pressure, speed = (int(place[0]) for place in places)
        scene = scenes[name][pressure][speed]
    if scene is None:
        raise InvalidInput(f"the scene {result.attrs['scene']} is not among those of the page")
    return scene


def _plain(values: np.ndarray) -> Any:
    """Return numbers as lists, to eight digits, None for NaN."""
    if values.ndim > 1:
        return [_plain(row) for row in values]
    return [float(f"{value:.8g}") if math.isfinite(value) else None for value in values.tolist()]


def _all_plain(nested: Any) -> Any:
    """Return nested dictionaries with every array as lists."""
    if isinstance(nested, dict):
        return {name: _all_plain(one) for name, one in nested.items()}
    return _plain(nested) if isinstance(nested, np.ndarray) else nested
