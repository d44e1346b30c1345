"""Friction of a road that is known by several: the mean over random phases, or over windows of a measured profile."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from rubfric.checksums import fingerprint
from rubfric.results.campaign import COLLECTED
from rubfric.results.scalars import attributes
from rubfric.results.selection import DRAWS, REFUSALS, ROAD_ERROR, WARNINGS, WINDOWS, refusals

_FRICTION = "friction_coefficient"


def mean_road(roads: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Return what is known of the whole road: its own scalars, or the means over its draws or windows.

    Parameters
    ----------
    roads : mapping of str to xarray.Dataset
        As for ``over_draws``, by the name of the draw or window, which is empty for one road; may be empty.
    """
    if not roads:
        return None
    return roads[""] if "" in roads else over_draws([*roads.values()], windows="window1/" in roads)


def over_draws(collected: Sequence[xr.Dataset], windows: bool = False) -> xr.Dataset:
    """Return the means of all scalars over random roads, with the error that so few roads leave.

    Parameters
    ----------
    collected : sequence of xarray.Dataset
        Of each road, as from ``rubfric.results.campaign.collect``, over the same axes.
    windows : bool
        Whether roads are windows of a measured profile, not roads with random phases.

    Returns
    -------
    xarray.Dataset
        The means over the roads that were solved; ``draws``, their number; and ``friction_road_error``, the standard
        error of the mean friction: the standard deviation over the roads over the root of their number, dimensionless,
        and NaN for fewer than two roads. ``warnings`` is the sum of those of all roads. The mean of the roads'
        numerical errors bounds that of the mean. Why a road was refused is said of the first at each point.
    """
    roads = xr.concat(collected, "draw", combine_attrs="override", data_vars="all", coords="minimal", join="exact")
    friction = roads[_FRICTION]
    number = friction.count("draw")
    found = roads.mean("draw", keep_attrs=True)
    over, kinds = ("windows", WINDOWS) if windows else ("random phases", "roads of random phases")
    error = friction.std("draw", ddof=1) / np.sqrt(number)
    found[ROAD_ERROR] = error.where(number > 1).assign_attrs(
        attributes("1", f"standard error of the mean friction coefficient over {over} of the road, absolute")
    )
    if WARNINGS in roads:
        found[WARNINGS] = roads[WARNINGS].sum("draw", min_count=1, keep_attrs=True)
    found[DRAWS] = number.assign_attrs(attributes("1", f"{kinds} that were solved"))
    reasons = {point: reason for one in reversed(collected) for point, reason in refusals(one).items()}
    found.attrs = {name: value for name, value in collected[0].attrs.items() if name != REFUSALS}
    found.attrs[COLLECTED] = fingerprint(one.attrs.get(COLLECTED, "") for one in collected)
    if reasons:
        found.attrs[REFUSALS] = json.dumps(sorted(reasons.items()))
    return found
