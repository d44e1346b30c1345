"""The friction of the whole road as one dataset: the table of totals over speed and pressure, and every scale."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.results.campaign import AXES as ABOUT_AXES
from rubfric.results.scalars import attributes
from rubfric.results.scales import AXES, WAYS, WORDS
from rubfric.results.temperature import ABOUT, AXIS, COLUMN

# The columns of the table that are coordinates.
_COORDINATES = {COLUMN: AXIS, AXES[1]: "pressure", AXES[0]: "velocity"}
# What the table has a column for at each scale, by its beginning.
_SCALE = "friction_scale"
_OF_SCALES = {
    f"{_SCALE}_error": ("friction_coefficient_error", "absolute error of friction on one scale of the road alone"),
    "contact_fraction_scale": ("contact_fraction", "share of the nominal area in contact on one scale alone"),
    "warnings_scale": ("warnings", "number of warnings of the scene on one scale of the road alone"),
}
_NAMES = {
    "friction_total": "friction coefficient of the whole road, by way",
    "friction_total_error": "its absolute error, the sum of the parts below",
    "friction_numerical_error": "part of the error: mesh, solver and kinematics",
    "friction_coupling_error": "part of the error: the model of the coupling of scales",
    "friction_road_error": "part of the error: the roads or windows averaged over",
    "friction_rubber_error": "part of the error: the data of the rubber",
    "nominal_compression": "compression of the flat block under the nominal pressure",
    "refused": "number of scenes of the whole road that were refused",
    "warnings": "number of warnings of all scenes at the point",
    WORDS[0]: "way to the friction of the whole road; empty where there is none",
    WORDS[1]: "what to know of it, why the whole road was refused for one",
    **{f"friction_{way}": f"friction coefficient of the whole road by way {way}" for way in WAYS},
    **{f"friction_{way}_error": f"absolute error of friction by way {way}" for way in WAYS},
}


def dataset(table: pd.DataFrame, scenes: xr.Dataset, about: Mapping[str, Any]) -> xr.Dataset:
    """Return a table of totals as a dataset; NaN, -1 for counts and an empty text where it has no row.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.
    scenes : xarray.Dataset
        Of every scale, as from ``rubfric.results.campaign.collect``, with one height-to-width ratio.
    about : mapping
        The attributes.

    Returns
    -------
    xarray.Dataset
        Over temperature (degC) where there is one, pressure (MPa) and velocity (mm/s) the columns of the table; over
        scale too ``friction_scale``, its error, contact and warnings, with ``amplitude`` and ``wavelength`` (mm).
    """
    axes = [column for column in _COORDINATES if column in table]
    found = table.set_index(axes)
    own = [str(name) for name in found if str(name).startswith(f"{_SCALE}_")]
    grid = found.to_xarray()
    variables: dict[str, Any] = {}
    for name in map(str, found):
        if name not in own:
            variables[name] = _filled(grid[name], found[name].dtype).assign_attrs(
                attributes("1", _NAMES.get(name, name))
            )
        elif _SCALE not in variables:
            stacked = np.stack([grid[each].values for each in own], axis=-1)
            about_scale = attributes("1", "friction coefficient of one scale of the road alone")
            variables[_SCALE] = ((*axes, "scale"), stacked, about_scale)
    answer = xr.Dataset(variables, coords=grid.coords).rename({name: _COORDINATES[name] for name in axes})
    dims = (*(_COORDINATES[name] for name in axes), "scale")
    one = scenes.squeeze("aspect", drop=True).transpose(*dims)
    answer = answer.assign_coords(
        scale=one["scale"],
        amplitude=one["amplitude"],
        wavelength=("scale", 2.0 * np.pi / one["wavenumber"].values, attributes("mm", "wavelength of the scale")),
    )
    at = one.reindex({name: answer[name] for name in dims})
    for name, (source, words) in _OF_SCALES.items():
        answer[name] = (dims, at[source].values, attributes("1", words))
    for name, described in (ABOUT_AXES | {AXIS: ABOUT}).items():
        if name in answer.dims:
            answer[name].attrs = attributes(*described)
    return answer.assign_attrs(about)


def _filled(column: xr.DataArray, dtype: Any) -> xr.DataArray:
    """Return a column of the table over its axes, with what stands for nothing where there is no row."""
    if dtype.kind == "f":
        return column
    whole = dtype.kind in "iu"
    return column.fillna(-1 if whole else "").astype(dtype if whole else str)


def table(answer: xr.Dataset) -> pd.DataFrame:
    """Return the table of totals of a dataset: rows and columns as they were."""
    dims = [name for name in _COORDINATES.values() if name in answer.dims]
    columns: dict[str, Any] = {}
    for name, variable in answer.data_vars.items():
        values = variable.transpose(*dims, *(["scale"] if "scale" in variable.dims else [])).values
        if name == _SCALE:
            columns |= {f"{_SCALE}_{scale}": values[..., at] for at, scale in enumerate(answer["scale"].values)}
        elif "scale" not in variable.dims:
            columns[str(name)] = values
    places = np.meshgrid(*(answer[name].values for name in dims), indexing="ij")
    back = dict(zip(dims, places, strict=True))
    coordinates = {column: back[axis] for column, axis in reversed(_COORDINATES.items()) if axis in back}
    found = pd.DataFrame({name: values.ravel() for name, values in (coordinates | columns).items()})
    found = found.astype(dict.fromkeys(WORDS, object))
    return found[found[WORDS[0]] != ""].reset_index(drop=True)
