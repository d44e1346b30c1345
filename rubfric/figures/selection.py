"""Picking the friction coefficients that a figure needs out of a campaign."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.figures.style import written

_VARIABLE = "friction_coefficient"
_ERROR = "friction_coefficient_error"
_NAMES = {"scale": "scale", "velocity": "speed", "pressure": "pressure", "aspect": "height-to-width ratio"}
_UNITS = {"velocity": " mm/s", "pressure": " MPa"}


def friction(campaign: xr.Dataset, **chosen: float) -> xr.DataArray:
    """Return friction coefficients (dimensionless) at chosen places, in ascending order of the other axes.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; scenes that were not run are NaN.
    **chosen : float
        Values of ``scale``, ``velocity`` (mm/s), ``pressure`` (MPa) or ``aspect``.

    Raises
    ------
    InvalidInput
        Where the campaign lacks a value, or has nothing but NaN there.
    """
    if _VARIABLE not in campaign:
        raise InvalidInput(f"the campaign lacks the variable {_VARIABLE}")
    field = _picked(campaign[_VARIABLE], chosen)
    if not bool(np.isfinite(field.values).any()):
        raise InvalidInput(f"the campaign holds no friction coefficient at {described(**chosen)}")
    return field


def friction_error(campaign: xr.Dataset, **chosen: float) -> xr.DataArray:
    """Return the estimated absolute errors (dimensionless) of the coefficients that ``friction`` returns, in its order.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    **chosen : float
        As for ``friction``.

    Raises
    ------
    BrokenResult
        For a campaign of an earlier version, which has no errors.
    InvalidInput
        Where the campaign lacks a value.
    """
    if _ERROR not in campaign:
        raise BrokenResult(
            f"the campaign lacks the variable {_ERROR}, the estimated error: gather the results of its scenes again"
        )
    return _picked(campaign[_ERROR], chosen)


def described(**chosen: float) -> str:
    """Return places on the axes of a campaign in words: ``scale 1, pressure 5 MPa``."""
    return ", ".join(f"{_NAMES[axis]} {written(value)}{_UNITS.get(axis, '')}" for axis, value in chosen.items())


def _picked(field: xr.DataArray, chosen: Mapping[str, float]) -> xr.DataArray:
    missing = [axis for axis in _NAMES if axis not in field.dims or axis not in field.coords]
    if missing:
        raise InvalidInput(f"the friction coefficients of the campaign lack the axis {missing[0]}")
    for axis, value in chosen.items():
        field = field.isel({axis: _position(field, axis, value)})
    return field.sortby([str(axis) for axis in field.dims])


def _position(field: xr.DataArray, axis: str, value: float) -> int:
    known = np.asarray(field[axis].values, dtype=np.float64)
    found = np.flatnonzero(np.isclose(known, value, rtol=1e-9, atol=0.0))
    if found.size == 0:
        listed = ", ".join(written(float(number)) for number in np.sort(known))
        raise InvalidInput(
            f"{described(**{axis: value})} is not in the campaign, which has {listed}{_UNITS.get(axis, '')}"
        )
    return int(found[0])
