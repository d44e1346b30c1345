"""The friction of one rubber on one road, of several that are compared: the table of totals, road by road too."""

from __future__ import annotations

import os
from collections.abc import Sequence

import pandas as pd
import xarray as xr

from rubfric.checksums import AGAIN
from rubfric.errors import BrokenResult
from rubfric.results.scales import AXES, ONE_ROAD, WORDS
from rubfric.results.tables import read_table
from rubfric.results.temperature import AXIS, COLUMN

# The column that stands for the scenes that a table was made of.
COLLECTED = "collected"


def road_by_road(table: pd.DataFrame, roads: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Return a table of totals with the direct friction of every road with random phases, or window, in a column.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.
    roads : sequence of xarray.Dataset
        Of each road, as from ``rubfric.results.campaign.collect``.

    Returns
    -------
    pandas.DataFrame
        With the columns ``friction_direct_1``, ...; NaN where a road was refused or not needed.
    """
    axes = dict(zip(("velocity", "pressure"), AXES, strict=True)) | ({AXIS: COLUMN} if COLUMN in table else {})
    points = {axis: xr.DataArray(table[column].to_numpy(), dims="row") for axis, column in axes.items()}
    found = {
        f"{ONE_ROAD}{number}": one["friction_coefficient"].isel(scale=0, aspect=0).sel(points).to_numpy()
        for number, one in enumerate(roads, 1)
    }
    return table.assign(**found)


def read_pair(path: str | os.PathLike[str], collected: str) -> pd.DataFrame:
    """Return the table of one pair, as from ``road_by_road``.

    Parameters
    ----------
    path : path-like
    collected : str
        What the scenes are known by that it must have been made of.

    Raises
    ------
    BrokenResult
        For a file that is missing, damaged, or of other scenes.
    """
    table = read_table(path, (*WORDS, COLLECTED))
    if COLLECTED not in table or set(table[COLLECTED]) != {collected}:
        raise BrokenResult(f"{os.fspath(path)} is made of other scenes than this campaign's; {AGAIN}")
    return table
