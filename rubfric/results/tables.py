"""Tables of a campaign, one row per scene, units in the headings."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import pandas as pd
import xarray as xr

from rubfric.checksums import AGAIN, check_signature, sign
from rubfric.errors import BrokenResult
from rubfric.files import whole
from rubfric.results.scalars import OF_MEASURED
from rubfric.results.selection import BEYOND, RUBBER_ERROR, check_variables
from rubfric.results.temperature import AXIS, COLUMN, at_temperature

# variable: heading
_COLUMNS = {
    "friction_coefficient": "friction_coefficient",
    "friction_coefficient_error": "friction_coefficient_error",
    RUBBER_ERROR: RUBBER_ERROR,
    BEYOND: BEYOND,
    "friction_coefficient_dissipation": "friction_coefficient_dissipation",
    "friction_coefficient_contact": "friction_coefficient_contact",
    "energy_closure": "energy_closure",
    "contact_fraction": "contact_fraction",
    "maximum_contact_pressure": "maximum_contact_pressure_MPa",
    "maximum_local_contact_pressure": "maximum_local_contact_pressure_MPa",
    "nominal_compression": "nominal_compression",
    "finite_strain": "finite_strain",
    "finite_strain_correction": "finite_strain_correction",
    "effective_poissons_ratio": "effective_poissons_ratio",
    "shear_wave_speed_ratio": "shear_wave_speed_ratio",
    "meshes": "meshes",
    "columns": "columns",
    "rows": "rows",
    "contact_nodes": "contact_nodes",
    "warnings": "warnings",
}
# What a text may begin with that a spreadsheet would take for a formula, unless an apostrophe comes before it.
_FORMULA, _AS_TEXT = r"^(?=[=+\-@\t\r＝＋－＠])(?![+-]?[\d.]+(?:[eE][+-]?\d+)?$)", r"^'(?=[=+\-@\t\r＝＋－＠])"
_WHOLE = ("finite_strain", "meshes", "columns", "rows", "contact_nodes", "warnings")
_AXES = {"velocity": "velocity_mm_per_s", "pressure": "pressure_MPa"}


def scale_table(campaign: xr.Dataset, scale: int) -> pd.DataFrame:
    """Return all scenes of one scale, by temperature where there are several, aspect, pressure and speed.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    scale : int
        Of the road, 1 being the coarsest.

    Raises
    ------
    BrokenResult
        If the campaign lacks a variable of the table.
    """
    columns = [name for name in _COLUMNS if name not in OF_MEASURED or name in campaign]
    check_variables(campaign, *columns)
    if AXIS in campaign.dims:
        return by_temperature(
            {one: scale_table(at_temperature(campaign, one), scale) for one in campaign[AXIS].values.tolist()}
        )
    chosen = campaign[columns].sel(scale=scale, drop=True)
    table = chosen.to_dataframe(dim_order=["aspect", "pressure", "velocity"]).dropna(subset=["friction_coefficient"])
    table = table.astype(dict.fromkeys(_WHOLE, int))
    return table.reset_index()[["velocity", "pressure", "aspect", *columns]].rename(columns=_AXES | _COLUMNS)


def by_temperature(tables: Mapping[float, pd.DataFrame]) -> pd.DataFrame:
    """Return tables, each of a temperature (degC), as one that has it in its third column."""
    for temperature, table in tables.items():
        table.insert(2, COLUMN, temperature)
    return pd.concat(tables.values(), ignore_index=True)


def read_table(path: str | os.PathLike[str], words: Sequence[str], signed: bool = True) -> pd.DataFrame:
    """Return a table from a CSV file; empty fields and nan are missing values.

    Parameters
    ----------
    path : path-like
    words : sequence of str
        Columns to read as text, where the table has them: ``0.10`` stays ``0.10``, ``off`` a word.
    signed : bool
        Whether a table without its checksum is refused, as every table of a campaign.

    Raises
    ------
    BrokenResult
        For a file that is no CSV table, or that was changed after it was written.
    """
    check_signature(path, signed)
    try:
        table = pd.read_csv(path, dtype=dict.fromkeys(words, str), keep_default_na=False, na_values=["", "nan"])
    except (OSError, ValueError) as error:  # pandas' own errors are ValueErrors
        reason = " ".join(str(error).split())
        again = f"; {AGAIN}" if signed else ""  # another may be the user's only copy
        raise BrokenResult(f"{os.fspath(path)} is no readable table: {reason}{again}") from error
    return _replaced(table, _AS_TEXT, "")


def _replaced(table: pd.DataFrame, pattern: str, by: str) -> pd.DataFrame:
    """Return a table with a pattern replaced in all its texts."""
    texts = table.select_dtypes(include=["object", "string"]).columns
    return table.assign(**{name: table[name].replace(pattern, by, regex=True) for name in texts})


def write_table(table: pd.DataFrame, path: str | os.PathLike[str]) -> None:
    """Write a table as CSV with six significant digits, whole or not at all, and its checksum beside it.

    A text that a spreadsheet would take for a formula has an apostrophe before it, which ``read_table`` takes away.

    Parameters
    ----------
    table : pandas.DataFrame
    path : path-like
        Missing folders are made.

    Raises
    ------
    NotWritten
        Where the disk is full or the place is not writable.
    """
    with whole(path) as part:
        _replaced(table, _FORMULA, "'").to_csv(part, index=False, float_format="%.6g")
    sign(path)
