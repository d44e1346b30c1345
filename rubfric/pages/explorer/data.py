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
from rubfric.pages.explorer.pictures import WIDER
from rubfric.pages.explorer.roads import about, pictured, whole_error
from rubfric.pages.explorer.scenes import ERROR, FRICTION, SCALARS, cells, numbers, pictures, plain
from rubfric.pages.explorer.totals import WHOLE, beside, by_way, on_axes, reasons
from rubfric.results.selection import DRAWS, check_variables, find_peak, position

_ABOUT = ("rubber", "plane", "kinematics", "source", "references")
# Of how many pictures the most nodes are kept, so that the page stays below 8 MB; of several roads, whose pictures are
# larger than their weight, of half as many.
_ROOM = 340


def payload(
    campaign: xr.Dataset,
    table: pd.DataFrame,
    results: Iterable[xr.Dataset],
    aspect: float,
    road: str,
    whole: xr.Dataset | None = None,
    share: float = 1.0,
    others: Mapping[str, pd.DataFrame] | None = None,
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
        picture. Of several roads each result says on which it is (``roads.NUMBER``), refused ones among them.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.
    whole : xarray.Dataset, optional
        The collection of the scenes of the whole road, results of which may be among ``results``.
    share : float
        Of the room for pictures, where several payloads share a page.
    others : mapping of str to pandas.DataFrame, optional
        Tables of totals of the other rubbers and roads of a comparison, by what they are called.

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
        curves[WHOLE] = _curve(placed[FRICTION].values, whole_error(placed, ERROR))
        scenes[WHOLE] = cells(placed)
        found["refusals"] = reasons(whole, axes)
    count = sum(cell is not None for name, rows in scenes.items() if name != WHOLE for row in rows for cell in row)
    count += 0 if whole is None else WIDER * pictured(placed, FRICTION)
    several = whole is not None and DRAWS in whole
    thinned = min(1.0, math.sqrt(share * _ROOM * (0.5 if several else 1.0) / count))
    store, energies, roads, refused = pictures(results, axes, scenes, aspect, thinned)
    if whole is not None:
        found[WHOLE] = about(whole, roads, refused)
    for name, other in (others or {}).items():
        friction, error = beside(other, axes)
        found.setdefault("others", []).append({"name": name, "friction": plain(friction), "error": plain(error)})
    return {
        "about": {name: str(campaign.attrs.get(name, "unknown")) for name in _ABOUT}
        | {"road": road, "aspect": aspect, "accuracy": _accuracy(campaign)},
        "speeds": plain(axes["velocity"]),
        "pressures": plain(axes["pressure"]),
        "scales": [_scale(grid.sel(scale=number)) for number in axes["scale"]],
        "curves": curves,
        "scenes": scenes,
        "colours": palette(axes["pressure"].size, axes["scale"].tolist()),
        "energies": energies,
        "pictures": store.packed(),
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
    check_variables(campaign, *SCALARS, "amplitude", "wavenumber")
    grid = campaign[[*numbers(campaign), "amplitude", "wavenumber"]].isel(
        aspect=position(campaign, "aspect", aspect), drop=True
    )
    grid = grid.sortby(["scale", "pressure", "velocity"]).transpose("scale", "pressure", "velocity")
    for axis in ("pressure", "velocity"):
        others = [other for other in ("scale", "pressure", "velocity") if other != axis]
        grid = grid.isel({axis: np.flatnonzero(grid[FRICTION].notnull().any(others).values)})
    if not grid[FRICTION].size:
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
        str(number): _curve(*(grid[name].sel(scale=number).values for name in (FRICTION, ERROR)))
        for number in grid["scale"].values
    }


def _curve(friction: np.ndarray, error: np.ndarray) -> dict[str, Any]:
    peaks = [find_peak(*pair)._asdict() for pair in zip(friction, error, strict=True)]
    return {"friction": plain(friction), "error": plain(error), "peaks": peaks}


def _scenes(grid: xr.Dataset) -> dict[str, list[list[dict[str, Any] | None]]]:
    """Return the numbers of every scene by scale, pressure and speed; None where it was not run."""
    return {str(number): cells(grid.sel(scale=number)) for number in grid["scale"].values}


def _all_plain(nested: Any) -> Any:
    """Return nested dictionaries with every array as lists."""
    if isinstance(nested, dict):
        return {name: _all_plain(one) for name, one in nested.items()}
    return plain(nested) if isinstance(nested, np.ndarray) else nested
