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
    check_results("result", results, ("pressure", "velocity", "scale", "aspect"), variables, ("scale", "aspect"))
    found: dict[tuple[float, float], xr.Dataset] = {}
    for result in results:
        place = (float(result.attrs["pressure"]), float(result.attrs["velocity"]))
        if place in found:
            raise InvalidInput(f"there are two results at {_described(place)}, but one panel can show only one")
        found[place] = result
    pressures, speeds = (tuple(sorted(set(axis))) for axis in zip(*found, strict=True))
    for place in ((pressure, speed) for pressure in pressures for speed in speeds):
        if place not in found:
            raise InvalidInput(f"there is no result at {_described(place)}, so its panel would be empty")
    return SceneGrid(pressures, speeds, found)


def check_results(
    kind: str,
    results: Sequence[xr.Dataset],
    attributes: Sequence[str],
    variables: Sequence[str],
    shared: Sequence[str],
) -> None:
    """Raise InvalidInput unless there are results that hold what is drawn and are of one block.

    Parameters
    ----------
    kind : {"result", "march"}
        What they are called in the message.
    results : sequence of xarray.Dataset
    attributes, variables : sequence of str
        What each must hold.
    shared : sequence of str
        Attributes that are the same in all, out of scale, pressure and aspect.
    """
    plural = f"{kind}es" if kind.endswith("ch") else f"{kind}s"
    if not results:
        raise InvalidInput(f"there are no {plural} to draw, but at least one is needed")
    blocks = set()
    for result in results:
        lacking = [name for name in attributes if name not in result.attrs]
        lacking += [name for name in variables if name not in result]
        if lacking:
            raise InvalidInput(f"the {kind} {result.attrs.get('scene', 'without a name')} lacks {', '.join(lacking)}")
        blocks.add(described(**{name: float(result.attrs[name]) for name in shared}))
    if len(blocks) > 1:
        raise InvalidInput(f"the {plural} are of {' and of '.join(sorted(blocks))}, but one figure shows one block")


def _described(place: tuple[float, float]) -> str:
    return described(pressure=place[0], velocity=place[1])
