"""The results of scenes in the order of the panels that show them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.results.selection import described


@dataclass(frozen=True)
class SceneGrid:
    """Results over pressure and speed.

    Attributes
    ----------
    pressures : tuple of float
        Nominal, MPa, ascending.
    speeds : tuple of float
        mm/s, ascending.
    results : dict
        The result at every pressure and speed.
    """

    pressures: tuple[float, ...]
    speeds: tuple[float, ...]
    results: dict[tuple[float, float], xr.Dataset]


def by_pressure_and_speed(results: Sequence[xr.Dataset], variables: Sequence[str]) -> SceneGrid:
    """Return results by pressure and speed, without gaps.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        Of one scale and one height-to-width ratio, in any order.
    variables : sequence of str
        What each must hold.

    Raises
    ------
    InvalidInput
        For no results, one that lacks something, two of one pressure and speed, a gap, or different scales or ratios.
    """
    if not results:
        raise InvalidInput("there are no results to draw, but at least one is needed")
    found: dict[tuple[float, float], xr.Dataset] = {}
    blocks = set()
    for result in results:
        lacking = [name for name in ("pressure", "velocity", "scale", "aspect") if name not in result.attrs]
        lacking += [name for name in variables if name not in result]
        if lacking:
            raise InvalidInput(f"the result {result.attrs.get('scene', 'without a name')} lacks {', '.join(lacking)}")
        place = (float(result.attrs["pressure"]), float(result.attrs["velocity"]))
        if place in found:
            raise InvalidInput(f"there are two results at {_described(place)}, but one panel can show only one")
        found[place] = result
        blocks.add(described(scale=float(result.attrs["scale"]), aspect=float(result.attrs["aspect"])))
    if len(blocks) > 1:
        raise InvalidInput(f"the results are of {' and of '.join(sorted(blocks))}, but one figure shows one block")
    pressures, speeds = (tuple(sorted(set(axis))) for axis in zip(*found, strict=True))
    for place in ((pressure, speed) for pressure in pressures for speed in speeds):
        if place not in found:
            raise InvalidInput(f"there is no result at {_described(place)}, so its panel would be empty")
    return SceneGrid(pressures, speeds, found)


def _described(place: tuple[float, float]) -> str:
    return described(pressure=place[0], velocity=place[1])
