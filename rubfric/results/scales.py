"""Friction of a road of many scales: the sum over them (Zhou, Wang and Wei 2019, section 2.3), and its table."""

from __future__ import annotations

import xarray as xr

# The ways to the friction of the whole road, in the order of the table of totals, whose columns these are.
WAYS = ("sum", "direct", "corrected", "cascade", "persson")
AXES = ("velocity_mm_per_s", "pressure_MPa")
TOTAL = ("friction_total", "friction_total_error")
# What the data of a measured rubber leave open of it.
RUBBER_PART = "friction_rubber_error"
# With the number of a road with random phases, or a window: the direct friction on it, for comparisons.
ONE_ROAD = "friction_direct_"
# Columns of that table that are text.
WORDS = ("way", "note")


def total_friction(friction: xr.DataArray) -> xr.DataArray:
    """Return the sum over the scales of the friction coefficients at one nominal pressure and speed.

    Parameters
    ----------
    friction : xarray.DataArray
        Friction coefficients with a dimension ``scale``.

    Returns
    -------
    xarray.DataArray
        Without ``scale``; NaN wherever any scale is missing, never a partial sum.
    """
    total = friction.sum("scale", skipna=False)
    return total.assign_attrs(units="1", long_name="friction coefficient, sum over the scales")


def total_error(error: xr.DataArray) -> xr.DataArray:
    """Return a bound on the error of ``total_friction``: the sum over the scales of the absolute errors.

    One rule makes the meshes of all scales, so that their errors may share a sign: they are not independent, and their
    squares must not be added instead.

    Parameters
    ----------
    error : xarray.DataArray
        Absolute errors of friction coefficients, none negative, dimensionless, with a dimension ``scale``.

    Returns
    -------
    xarray.DataArray
        Without ``scale``; NaN wherever the error of any scale is unknown.
    """
    total = error.sum("scale", skipna=False)
    return total.assign_attrs(units="1", long_name="bound on the estimated error of the sum over the scales, absolute")
