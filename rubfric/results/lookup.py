"""Friction of the whole road as a lookup table over slip speed, pressure and temperature, with its errors."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pandas as pd
import xarray as xr
from scipy.interpolate import PchipInterpolator

import rubfric
from rubfric.arrays import Real
from rubfric.checks import written
from rubfric.errors import InvalidInput
from rubfric.results.provenance import CONVENTIONS
from rubfric.results.scalars import attributes
from rubfric.results.scales import AXES, RUBBER_PART, TOTAL, WORDS
from rubfric.results.temperature import AXIS, COLUMN, rows_at

_FRICTION, _ERROR = TOTAL
WAY = WORDS[0]
# What an error is made of, and what points between those of the campaign add to it.
_INTERPOLATION = "friction_interpolation_error"
_PARTS = {
    "friction_numerical_error": "numerics",
    "friction_coupling_error": "the model of the coupling of scales",
    "friction_road_error": "the roads or windows averaged over",
    RUBBER_PART: "the data of the rubber",
    _INTERPOLATION: "interpolation between the campaign's speeds",
}
# How points between those of the campaign came about, in place of a way.
BETWEEN = "interpolated"
_UNITS = {AXES[0]: "mm/s", AXES[1]: "MPa", COLUMN: "degC"}
_NAMES = {AXES[0]: "slip speed", AXES[1]: "contact pressure", COLUMN: "temperature"}


def lookup_table(totals: pd.DataFrame, temperature: float | None = None, per_decade: int = 0) -> pd.DataFrame:
    """Return friction over speed, pressure and temperature, sorted, with its error and the parts of it.

    Parameters
    ----------
    totals : pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.
    temperature : float, optional
        degC, to take one of several.
    per_decade : int
        Points to have in a decade of speed at least, between those of the campaign: codes interpolate linearly in
        speed, over which friction is a curve of decades. They lie on the monotone cubic through friction over the
        logarithm of speed (Fritsch and Butland 1984), which has no peak but those of the points. What this leaves open
        is a part of their error.

    Returns
    -------
    pandas.DataFrame
        Speed (mm/s) fastest, then pressure (MPa), then temperature (degC) where there are several; all ascending.

    Raises
    ------
    InvalidInput
        For a temperature that the table lacks, a point that it has twice, or no friction at all.
    """
    table = totals if temperature is None else rows_at(totals, temperature).assign(**{COLUMN: temperature})
    axes = [name for name in (COLUMN, AXES[1], AXES[0]) if name in table]
    parts = [name for name in _PARTS if name in table and table[name].notna().any()]
    found = table[[*reversed(axes), *TOTAL, *parts, WAY]].dropna(subset=_FRICTION)
    if found.empty:
        raise InvalidInput("the table has no friction at any point")
    if (again := found[found.duplicated(axes)]).size:
        point = ", ".join(f"{written(again.iloc[0][name])} {_UNITS[name]}" for name in reversed(axes))
        raise InvalidInput(f"the table has {point} twice: keep one row of each point")
    found = found.sort_values(axes, ignore_index=True)
    return _denser(found, axes, per_decade) if per_decade else found


def curves(table: pd.DataFrame) -> Iterator[pd.DataFrame]:
    """Yield the rows of each pressure and temperature, over speed."""
    axes = [name for name in (COLUMN, AXES[1]) if name in table]
    for _, curve in table.groupby(axes, sort=True):
        yield curve.reset_index(drop=True)


def _denser(table: pd.DataFrame, axes: list[str], per_decade: int) -> pd.DataFrame:
    found = []
    table = table.drop(columns=WAY).assign(**{_INTERPOLATION: 0.0, WAY: table[WAY]})
    for curve in curves(table):
        known = np.log10(curve[AXES[0]].to_numpy())
        steps = [math.ceil((high - low) * per_decade - 1e-9) for low, high in pairwise(known)]
        gaps = zip(pairwise(known), steps, strict=True)
        at = np.concatenate([[], *(np.linspace(*ends, count + 1)[1:-1] for ends, count in gaps)])
        new = pd.DataFrame({AXES[0]: [float(f"{speed:.4g}") for speed in 10.0**at]})
        at = np.log10(new[AXES[0]].to_numpy())
        for name in curve.columns.difference([AXES[0], WAY]):
            # A part that one of two neighbours has not goes to zero there.
            absent = np.interp(at, known, curve[name].isna().to_numpy(dtype=np.float64)) == 1.0
            new[name] = np.where(absent, np.nan, np.interp(at, known, curve[name].fillna(0.0).to_numpy()))
        if len(at):
            new[_FRICTION], new[_INTERPOLATION] = _between(known, curve[_FRICTION].to_numpy(), at)
        new[_ERROR] += new[_INTERPOLATION]
        found.append(pd.concat([curve, new.assign(**{WAY: BETWEEN})]))
    return pd.concat(found).sort_values(axes, ignore_index=True)


def _between(known: Real, friction: Real, at: Real) -> tuple[Real, Real]:
    """Return friction between known points on the monotone cubic, and its error.

    The error is the larger of two: how far the cubic is from straight lines; and by how much it misses a neighbour that
    is left out, less the nearer a known point is. In small strain it covered 93 % of the true errors of the paper's
    curves from one point a decade, and 97 % or more from two to six.

    Parameters
    ----------
    known : array, shape (points,)
        Ascending, two at least.
    friction : array, shape (points,)
        There.
    at : array, shape (others,)
        Within the known points.
    """
    smooth = PchipInterpolator(known, friction)(at)
    missed = np.full(known.size, 0.5 * abs(friction[-1] - friction[0]))
    for place in range(1, known.size - 1):
        others = np.arange(known.size) != place
        missed[place] = abs(friction[place] - PchipInterpolator(known[others], friction[others])(known[place]))
    if known.size > 2:
        missed[0], missed[-1] = missed[1], missed[-2]
    left = np.clip(np.searchsorted(known, at) - 1, 0, known.size - 2)
    share = (at - known[left]) / (known[left + 1] - known[left])
    near = np.maximum(missed[left], missed[left + 1]) * 4.0 * share * (1.0 - share)
    return smooth, np.maximum(np.abs(smooth - np.interp(at, known, friction)), near)


def astray(table: pd.DataFrame) -> float:
    """Return by how much of itself friction is off, at most, where a code interpolates it linearly between speeds.

    Of the monotone cubic over the logarithm of speed.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``lookup_table``.
    """
    worst = 0.0
    for curve in curves(table):
        speed, friction = curve[AXES[0]].to_numpy(), curve[_FRICTION].to_numpy()
        if len(speed) < 2:
            continue
        at = np.concatenate([np.geomspace(*ends, 18)[1:-1] for ends in pairwise(speed)])
        smooth = PchipInterpolator(np.log(speed), friction)(np.log(at))
        off = np.abs(np.interp(at, speed, friction) - smooth)
        worst = max(worst, float(np.max(off[smooth > 0.0] / smooth[smooth > 0.0], initial=0.0)))
    return worst


def notes(table: pd.DataFrame) -> list[str]:
    """Return in lines what must be known to use a table: units, meanings, range, interpolation, errors."""
    axes = [name for name in _NAMES if name in table]
    ranges = ", ".join(f"{_NAMES[name]} {_range(table[name])} {_UNITS[name]}" for name in axes)
    parts = [about for name, about in _PARTS.items() if name in table]
    lines = [
        "units: mm, s, N, MPa; temperatures in degC; friction and its absolute errors are dimensionless",
        f"range: {ranges}",
        "contact pressure is the nominal one, not that on single asperities; temperature is that of the rubber",
        "outside the range the value at its end holds, also below the slowest speed; between points friction is linear",
        f"errors add up those of {', '.join(parts)}" if parts else "errors are whole ones",
    ]
    if (between := table[_INTERPOLATION].max() if _INTERPOLATION in table else 0.0) > 0.0:
        lines.append(
            f"interpolation between the campaign's speeds is uncertain by up to {between:.2g}: more of them "
            "(grid.velocities) lower that"
        )
    if (off := astray(table)) > 0.005:
        lines.append(
            f"linear interpolation in speed is up to {off:.1%} off the smooth curve through the points over the "
            "logarithm of speed: more speeds in the campaign, or --per-decade, bring it closer"
        )
    return lines


def _range(values: pd.Series) -> str:
    return " to ".join(dict.fromkeys(written(float(one)) for one in (values.min(), values.max())))


def lookup_dataset(table: pd.DataFrame, about: list[str]) -> xr.Dataset:
    """Return a lookup table as a dataset; NaN where a point is missing.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``lookup_table``.
    about : list of str
        What made it.

    Returns
    -------
    xarray.Dataset
        ``friction_coefficient`` and its errors, dimensionless, over temperature (degC) where there are several,
        pressure (MPa) and velocity (mm/s); ``way`` as flags.
    """
    names = {
        COLUMN: (AXIS, "degC", "temperature of the rubber"),
        AXES[1]: ("pressure", "MPa", "nominal pressure"),
        AXES[0]: ("velocity", "mm s-1", "sliding speed"),
    }
    axes = {column: name for column, name in names.items() if column in table}
    ways = list(dict.fromkeys(table[WAY]))
    numbers = table.assign(**{WAY: [float(ways.index(way)) for way in table[WAY]]})
    found = numbers.astype(float).set_index([*axes]).to_xarray()
    found = found.rename({column: name for column, (name, _, _) in axes.items()})
    found = found.rename({_FRICTION: "friction_coefficient", _ERROR: "friction_coefficient_error"})
    for name, unit, long_name in axes.values():
        found[name].attrs = attributes(unit, long_name)
    for name, variable in found.data_vars.items():
        what = _PARTS.get(str(name), "all its parts" if str(name).endswith("error") else "")
        variable.attrs = attributes(
            "1", f"absolute error of friction: {what}" if what else "friction coefficient of the whole road"
        )
    found[WAY] = found[WAY].fillna(-1.0).astype(np.int8)
    found[WAY].attrs = attributes("1", "way to the friction of the whole road; -1 where there is none") | {
        "flag_values": np.arange(len(ways), dtype=np.int8),
        "flag_meanings": " ".join(ways),
    }
    return found.assign_attrs(
        title="Friction of a rubber on a road over slip speed and pressure",
        Conventions=CONVENTIONS.split()[0],
        source=f"rubfric {rubfric.__version__}",
        history="\n".join(about),
        comment="\n".join(notes(table)),
    )
