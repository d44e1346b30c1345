"""One temperature out of a campaign of several: of its collection of scenes, and of its tables."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.checks import written
from rubfric.errors import InvalidInput
from rubfric.results.selection import REFUSALS, refusals

AXIS, COLUMN = "temperature", "temperature_degC"
# What is said of the axis: unit and long name.
ABOUT = ("degC", "temperature of the rubber")
# The attribute of a collection that holds the rubber at each temperature.
MATERIALS = "materials"


def at_temperature(campaign: xr.Dataset, temperature: float | None = None) -> xr.Dataset:
    """Return a campaign at one temperature, without that axis.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; without the axis it is returned as it is.
    temperature : float, optional
        degC; may be left out where there is only one.

    Raises
    ------
    InvalidInput
        For a temperature that the campaign lacks, and for none where it has several.
    """
    if AXIS not in campaign.dims:
        if temperature is not None:
            raise InvalidInput(f"temperature is {written(temperature)} degC, but the campaign has no temperatures")
        return campaign
    place = _place(campaign[AXIS].values, temperature, "the campaign")
    kept, at = campaign.isel({AXIS: place}, drop=True), float(campaign[AXIS].values[place])
    kept.attrs = {name: value for name, value in campaign.attrs.items() if name not in (REFUSALS, MATERIALS)}
    if MATERIALS in campaign.attrs:
        kept.attrs["material"] = json.dumps(json.loads(campaign.attrs[MATERIALS])[written(at)], sort_keys=True)
    if here := [(point[:-1], why) for point, why in refusals(campaign).items() if point[-1] == at]:
        kept.attrs[REFUSALS] = json.dumps(here)
    return kept


def rows_at(table: pd.DataFrame, temperature: float | None = None) -> pd.DataFrame:
    """Return the rows of a table at one temperature, without that column.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.tables`` or ``rubfric.results.totals``; without the column it is returned as it is.
    temperature : float, optional
        degC; may be left out where there is only one.

    Raises
    ------
    InvalidInput
        For a temperature that the table lacks, and for none where it has several.
    """
    if COLUMN not in table:
        if temperature is not None:
            raise InvalidInput(f"temperature is {written(temperature)} degC, but the table has no temperatures")
        return table
    known = np.unique(table[COLUMN].to_numpy(dtype=np.float64))
    at = known[_place(known, temperature, "the table")]
    return table[table[COLUMN] == at].drop(columns=COLUMN).reset_index(drop=True)


def _place(known: np.ndarray, temperature: float | None, where: str) -> int:
    """Return the place of a temperature among those that there are; a table has six digits of them."""
    listed = ", ".join(written(float(one)) for one in known)
    if temperature is None:
        if known.size != 1:
            raise InvalidInput(f"temperature is not given, but {where} has {listed} degC: choose one of them")
        return 0
    found = np.flatnonzero(np.isclose(known, temperature, rtol=1e-5, atol=0.0))
    if not found.size:
        raise InvalidInput(f"temperature is {written(temperature)} degC, but {where} has {listed} degC")
    return int(found[np.argmin(np.abs(known[found] - temperature))])
