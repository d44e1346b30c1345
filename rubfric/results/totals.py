"""The friction of the whole road at every speed and pressure: by which way, and what its error is made of."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.config.multiscale import DIRECT
from rubfric.errors import NotConverged
from rubfric.results.scales import AXES, RUBBER_PART, TOTAL, WAYS, WORDS, total_error, total_friction
from rubfric.results.selection import (
    DRAWS,
    NOT_NEEDED,
    ROAD_ERROR,
    RUBBER_ERROR,
    WARNINGS,
    WINDOWS,
    check_variables,
    refusals,
)
from rubfric.results.tables import by_temperature
from rubfric.results.temperature import at_temperature
from rubfric.results.whole_road import WholeRoad

# What the note says where the whole road would take minutes in finite strain.
_DEAR = "many fine waves are in contact, and all scales at once would take minutes; multiscale: direct tries them"
# What the note says of a direct total over several roads, and of one without random phases.
DRAWN = "roads with random phases"
ONE_ROAD = "one road with these phases"
# The ways that are models of the coupling; the direct total is what they are judged by.
MODELS = tuple(way for way in WAYS if way != "direct")
_PARTS = ("friction_numerical_error", "friction_coupling_error", "friction_road_error")


class _Total(NamedTuple):
    """A total by one way, and the parts of its absolute error; NaN where they are not known."""

    friction: float = np.nan
    numerical: float = np.nan
    coupling: float = 0.0
    road: float = np.nan
    draws: int = 0
    rubber: float = np.nan

    @property
    def error(self) -> float:
        """The whole error; random phases count where they were drawn, the rubber's data where it was measured."""
        return self.numerical + self.coupling + sum(part for part in (self.road, self.rubber) if not np.isnan(part))


def total_tables(
    campaign: xr.Dataset, whole: xr.Dataset | None, roads: Mapping[float | None, WholeRoad]
) -> pd.DataFrame:
    """Return ``total_table`` of every temperature as one table, which has it in its third column.

    Parameters
    ----------
    campaign, whole
        As for ``total_table``, over temperature too.
    roads : mapping of float to WholeRoad
        By temperature, degC; a rubber as it is given has one, under None, and no such column.
    """
    tables = {
        one: total_table(at_temperature(campaign, one), None if whole is None else at_temperature(whole, one), road)
        for one, road in roads.items()
    }
    warm = {one: table for one, table in tables.items() if one is not None}
    return by_temperature(warm) if warm else tables[None]


def total_table(campaign: xr.Dataset, whole: xr.Dataset | None, road: WholeRoad) -> pd.DataFrame:
    """Return the friction of every scale and of the whole road, by all ways, and what its error is made of.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    whole : xarray.Dataset or None
        The same of the whole road, or the mean over draws of it; None where it was not simulated.
    road : WholeRoad

    Returns
    -------
    pandas.DataFrame
        A row for each pressure (MPa) and speed (mm/s) at which all scales were run. ``friction_total`` is that by
        ``way``; its absolute error is the sum of ``friction_numerical_error``, ``friction_coupling_error``, which
        bounds what a model of the coupling of scales changes, and, where phases were drawn,
        ``friction_road_error``, the standard error of the mean over them, and, of a measured rubber,
        ``friction_rubber_error``, what its data leave open. The other ways have their whole errors. ``warnings`` is the
        number of warnings of the scenes at a point: its scales', and those of the whole road that were solved.

    Raises
    ------
    BrokenResult
        If the campaign lacks a variable of the table.
    """
    check_variables(campaign, "friction_coefficient", "friction_coefficient_error", "nominal_compression")
    at = campaign.sel(aspect=road.aspect)
    total, error = total_friction(at["friction_coefficient"]), total_error(at["friction_coefficient_error"])
    data = total_error(at[RUBBER_ERROR]) if RUBBER_ERROR in at else None  # one rubber: its errors have one sign
    reasons = {point[1:3]: reason for point, reason in (refusals(whole) if whole is not None else {}).items()}
    scales, rows = [f"friction_scale_{scale}" for scale in at["scale"].values], []
    for pressure, velocity in product(at["pressure"].values.tolist(), at["velocity"].values.tolist()):
        place = {"velocity": velocity, "pressure": pressure}
        single = _Total(float(total.sel(place)), float(error.sel(place)))
        if np.isnan(single.friction):
            continue
        if data is not None:
            single = single._replace(rubber=float(data.sel(place)))
        found = _totals(road, velocity, pressure, single)
        if whole is not None:
            found["direct"] = _direct(whole.sel(place))
        way, refused, note = _chosen(road, found, reasons.get((velocity, pressure), ""), velocity, pressure)
        counts, one = found[way], at.sel(place)
        rows.append(
            dict(zip(AXES, (velocity, pressure), strict=True))
            | dict(zip(scales, one["friction_coefficient"].values.tolist(), strict=True))
            | {f"friction_{name}": each.friction for name, each in found.items()}
            | {f"friction_{name}_error": each.error for name, each in found.items()}
            | dict(zip(TOTAL, (counts.friction, counts.error), strict=True))
            | dict(zip(_PARTS, (counts.numerical, counts.coupling, counts.road), strict=True))
            | ({} if data is None else {RUBBER_PART: counts.rubber})
            | {"nominal_compression": float(one["nominal_compression"].max()), "refused": refused}
            | {WARNINGS: _warnings(one) + (0 if whole is None else _warnings(whole.sel(place)))}
            | dict(zip(WORDS, (way, note), strict=True))
        )
    ways = [f"friction_{way}" for way in WAYS]
    others = [*ways, *(f"{way}_error" for way in ways), *scales, "nominal_compression", "refused", WARNINGS]
    parts = [*_PARTS, *([] if data is None else [RUBBER_PART])]
    return pd.DataFrame(rows, columns=[*AXES, *TOTAL, WORDS[0], *parts, *others, WORDS[1]])


def _totals(road: WholeRoad, velocity: float, pressure: float, single: _Total) -> dict[str, _Total]:
    """Return the totals by every way at a speed (mm/s) and pressure (MPa), given the sum with its numerical error."""
    found = dict.fromkeys(WAYS, _Total()) | {"sum": single._replace(coupling=np.nan)}
    try:
        couplings = road.couplings(velocity, pressure)
    except NotConverged:
        return found
    for way in MODELS:
        totals = [one.total(way, single.friction) for one in couplings]
        friction = float(np.mean(totals))
        share = friction / single.friction if single.friction else 1.0
        bound = max(
            one.error(way) * abs(each) + abs(each - friction) for one, each in zip(couplings, totals, strict=True)
        )
        found[way] = _Total(friction, abs(single.numerical * share), bound, rubber=abs(single.rubber * share))
    return found


def _direct(whole: xr.Dataset) -> _Total:
    """Return the direct total at one point of the collection of the whole road."""
    at = whole.isel(scale=0, aspect=0)
    total = _Total(float(at["friction_coefficient"]), float(at["friction_coefficient_error"]))
    if RUBBER_ERROR in at:
        total = total._replace(rubber=float(at[RUBBER_ERROR]))
    return total._replace(road=float(at[ROAD_ERROR]), draws=int(at[DRAWS])) if DRAWS in at else total


def _warnings(at: xr.Dataset) -> int:
    """Return the number of warnings of all scenes at one point; observations of the paper's readings have none."""
    return int(at[WARNINGS].sum()) if WARNINGS in at else 0


def _chosen(
    road: WholeRoad, found: Mapping[str, _Total], reason: str, velocity: float, pressure: float
) -> tuple[str, int, str]:
    """Return the way that counts at one point, how many scenes of the whole road were refused there, and what to know.

    Parameters
    ----------
    road : WholeRoad
    found : mapping of str to _Total
        By every way.
    reason : str
        Why the whole road, or a draw of it, was refused or not needed; empty where it was not.
    velocity, pressure : float
        mm/s and MPa.
    """
    direct = found["direct"]
    if road.way not in DIRECT:
        return road.way, 0, ""
    if reason.startswith(NOT_NEEDED):
        way = reason.removeprefix(NOT_NEEDED)
        dear = road.kinematics != "small" and way == "corrected" and road.accurate_enough(velocity, pressure) != way
        return way, 0, _DEAR if dear else "the cheapest way that is accurate enough"
    if np.isnan(direct.friction):
        missing = road.count if reason else 0
        return (
            "corrected",
            missing,
            f"the corrected sum stands in for the whole road, which was refused: {reason or 'it was not run'}",
        )
    refused = road.count - direct.draws if direct.draws else 0
    alone = f"the first of the {WINDOWS}" if road.windows else ONE_ROAD
    about = f"mean of {direct.draws} {WINDOWS if road.windows else DRAWN}" if direct.draws else alone
    return "direct", refused, about + (f"; {refused} more refused: {reason}" if refused else "")
