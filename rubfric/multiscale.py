"""Friction of a road of many scales from that of each (Zhou, Wang and Wei 2019, section 2.3)."""

from __future__ import annotations

import xarray as xr


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


def scale_shares(friction: xr.DataArray) -> xr.DataArray:
    """Return each scale's share of ``total_friction``; NaN where the total is zero or unknown."""
    total = total_friction(friction)
    return (friction / total.where(total != 0.0)).assign_attrs(units="1", long_name="share of the total friction")
