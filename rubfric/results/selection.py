"""Values on the axes of a campaign: looked up, described in words, and the peak of friction over speed."""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np
import xarray as xr

from rubfric.arrays import Real
from rubfric.errors import BrokenResult, InvalidInput

_NAMES = {"scale": "scale", "velocity": "speed", "pressure": "pressure", "aspect": "height-to-width ratio"}
_UNITS = {"velocity": " mm/s", "pressure": " MPa", "temperature": " degC"}
# The axis that only some campaigns have.
_TEMPERATURE = "temperature"
# The attribute that says why a scene has no result, and what one says there that was not needed, before the way that
# will do.
REFUSAL, NOT_NEEDED = "refusal", "not solved at once; instead the total is by way of: "
# The attribute of a collection that holds the coordinates of refused scenes, and why they were refused.
REFUSALS = "refusals"
# Of a mean over roads with random phases: how many were solved, and the standard error of the mean friction over them.
DRAWS, ROAD_ERROR = "draws", "friction_road_error"
# What they are in words where they are no roads with random phases.
WINDOWS = "windows of the measured road"
# The number of warnings of a scene in a collection of scenes, and of all scenes at a point in the table of totals.
WARNINGS = "warnings"
# What the data of a measured rubber leave open of friction, and how much of that comes from frequencies not measured.
RUBBER_ERROR, BEYOND = "friction_coefficient_rubber_error", "friction_beyond_window"
# Share of friction beyond the measured frequencies that is worth a word.
WORTH_A_WORD = 0.01
# With fewer points no peak can lie between others.
_FEWEST = 3


def check_variables(campaign: xr.Dataset, *names: str) -> None:
    """Raise BrokenResult unless a campaign has some variables.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``.
    *names : str
        Variables that it must have.
    """
    lacking = [name for name in names if name not in campaign]
    if lacking:
        raise BrokenResult(f"the campaign lacks {', '.join(lacking)}: gather the results of its scenes again")


def refusals(collected: xr.Dataset) -> dict[tuple[float, ...], str]:
    """Return why scenes were refused, by scale, velocity (mm/s), pressure (MPa), aspect and, with it, temperature."""
    listed = json.loads(collected.attrs.get(REFUSALS, "[]"))
    return {tuple(float(number) for number in point): reason for point, reason in listed}


def pick(campaign: xr.Dataset, variable: str, **chosen: float) -> xr.DataArray:
    """Return a variable at chosen values of some axes, in ascending order of the others.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; scenes that were not run are NaN.
    variable : str
        Name of a variable over scale, velocity, pressure, aspect and, in some campaigns, temperature.
    **chosen : float
        Values of ``scale``, ``velocity`` (mm/s), ``pressure`` (MPa), ``aspect`` or ``temperature`` (degC), to 1e-9; of
        several temperatures one has to be chosen.

    Raises
    ------
    BrokenResult
        For a campaign without the variable.
    InvalidInput
        Where the campaign lacks an axis or a value, or has several temperatures.
    """
    check_variables(campaign, variable)
    field = campaign[variable]
    missing = [axis for axis in _NAMES if axis not in field.dims or axis not in field.coords]
    if missing:
        raise InvalidInput(f"the variable {variable} of the campaign lacks the axis {missing[0]}")
    for axis, value in chosen.items():
        field = field.isel({axis: position(campaign, axis, value)})
    if _TEMPERATURE in field.dims:
        if field[_TEMPERATURE].size > 1:
            listed = ", ".join(written(float(one)) for one in field[_TEMPERATURE].values)
            raise InvalidInput(f"temperature is not given, but the campaign has {listed} degC: choose one of them")
        field = field.isel({_TEMPERATURE: 0})
    return field.sortby([str(axis) for axis in field.dims])


def position(campaign: xr.Dataset, axis: str, value: float) -> int:
    """Return where a value is on an axis of a campaign.

    Parameters
    ----------
    campaign : xarray.Dataset
    axis : {"scale", "velocity", "pressure", "aspect", "temperature"}
    value : float
        In the unit of the axis (mm/s, MPa, degC, dimensionless); coordinates within 1e-9 of it count as equal.

    Raises
    ------
    InvalidInput
        Where the axis does not have the value, or there is no such axis.
    """
    if axis not in campaign.dims:
        raise InvalidInput(f"{described(**{axis: value})} is not in the campaign, which has no such axis")
    known = np.asarray(campaign[axis].values, dtype=np.float64)
    found = np.flatnonzero(np.isclose(known, value, rtol=1e-9, atol=0.0))
    if not found.size:
        listed = ", ".join(written(float(number)) for number in np.sort(known))
        raise InvalidInput(
            f"{described(**{axis: value})} is not in the campaign, which has {listed}{_UNITS.get(axis, '')}"
        )
    return int(found[0])


def friction(campaign: xr.Dataset, **chosen: float) -> xr.DataArray:
    """Return friction coefficients (dimensionless) as ``pick`` does; InvalidInput where all of them are NaN.

    Parameters
    ----------
    campaign, **chosen
        As for ``pick``.
    """
    field = pick(campaign, "friction_coefficient", **chosen)
    if not bool(np.isfinite(field.values).any()):
        raise InvalidInput(f"the campaign holds no friction coefficient at {described(**chosen)}")
    return field


def friction_error(campaign: xr.Dataset, **chosen: float) -> xr.DataArray:
    """Return the estimated absolute errors (dimensionless) of friction coefficients, as ``pick`` does.

    Parameters
    ----------
    campaign, **chosen
        As for ``pick``.
    """
    return pick(campaign, "friction_coefficient_error", **chosen)


def rubber_error(campaign: xr.Dataset, **chosen: float) -> xr.DataArray | None:
    """Return what the rubber's data leave open of friction, absolute, as ``pick`` does; None for one not measured.

    Parameters
    ----------
    campaign, **chosen
        As for ``pick``.
    """
    return pick(campaign, RUBBER_ERROR, **chosen) if RUBBER_ERROR in campaign else None


def described(**chosen: float) -> str:
    """Return values on the axes of a campaign in words: ``scale 1, pressure 5 MPa``."""
    return ", ".join(
        f"{_NAMES.get(axis, axis)} {written(value)}{_UNITS.get(axis, '')}" for axis, value in chosen.items()
    )


def written(value: float) -> str:
    """Return a number as it is printed in figures and messages: 0.1, 10, 1000, 10 000."""
    plain = f"{value:.12g}"
    if "e" in plain or abs(value) < 10000.0:
        return plain
    whole, _, fraction = plain.partition(".")
    grouped = f"{int(whole):,}".replace(",", "\N{NO-BREAK SPACE}")
    return f"{grouped}.{fraction}" if fraction else grouped


class Peak(NamedTuple):
    """The largest of the friction coefficients on a curve over speed, and whether it is a peak.

    Attributes
    ----------
    kind : {"peak", "rising", "falling", "level", "few", "none"}
        ``rising`` or ``falling`` where the last or the first point is highest, ``level`` where the highest cannot be
        distinguished from one at an end, ``few`` below three points, ``none`` without any.
    at : int or None
        Number of the highest point.
    between : tuple of int or None
        For a peak, the numbers of the points that enclose every point which may be the highest, so that a curve with
        a single peak has it between them.
    missing : int
        Points that are not known.
    """

    kind: str
    at: int | None
    between: tuple[int, int] | None
    missing: int


def find_peak(values: Real, error: Real | float = 0.0) -> Peak:
    """Return the highest point of a curve over speed, given the errors of its points.

    Parameters
    ----------
    values : numpy.ndarray, shape (speeds,)
        Friction coefficients in ascending order of the speeds, dimensionless; NaN where not known.
    error : numpy.ndarray, shape (speeds,), or float
        Their absolute errors; NaN, unknown, counts as zero.
    """
    known = np.flatnonzero(np.isfinite(values))
    missing = int(values.size - known.size)
    if not known.size:
        return Peak("none", None, None, missing)
    curve = values[known]
    slack = np.nan_to_num(np.broadcast_to(error, values.shape)[known], nan=0.0)
    top = int(np.argmax(curve))
    highest = np.flatnonzero(curve + slack >= curve[top] - slack[top])
    first, last, end = int(highest[0]), int(highest[-1]), known.size - 1
    between = None
    if known.size < _FEWEST:
        kind = "few"
    elif first > 0 and last < end:
        kind, between = "peak", (int(known[first - 1]), int(known[last + 1]))
    elif top == end and first > 0:
        kind = "rising"
    elif top == 0 and last < end:
        kind = "falling"
    else:
        kind = "level"
    return Peak(kind, int(known[top]), between, missing)
