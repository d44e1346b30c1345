"""Limits and ticks of axes: speeds, friction coefficients, and whatever spans decades."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.results.selection import written

Array = NDArray[np.float64]

# Friction coefficients below this are zero but for round-off.
NEGLIGIBLE = 1e-12


def scale_speeds(axes: Axes, speeds: Array) -> None:
    """Set the abscissa to a logarithmic scale that holds sliding speeds.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    speeds : numpy.ndarray, shape (speeds,)
        mm/s, positive.
    """
    low, high = float(speeds.min()), float(speeds.max())
    if low <= 0.0:
        raise InvalidInput(f"speed {written(low)} mm/s has no place on a logarithmic axis, but must be greater than 0")
    margin = (high / low) ** 0.03 if high > low else 2.0
    axes.set_xscale("log")
    axes.set_xlim(low / margin, high * margin)
    tick_decades(axes.xaxis, low, high)
    if high < 10.0 * low:
        tick_at(axes.xaxis, speeds.tolist())


def scale_friction(axes: Axes, values: Array) -> None:
    """Set the ordinate to a linear scale from zero that holds every finite value.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    values : numpy.ndarray, of any shape
        Friction coefficients.
    """
    finite = values[np.isfinite(values)]
    low, high = float(finite.min()), float(finite.max())
    axes.set_ylim(1.05 * min(low, 0.0), 1.08 * high if high > NEGLIGIBLE else 1.0)


def scale_decades(axes: Axes, low: float, high: float) -> None:
    """Set the ordinate to a logarithmic scale.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    low, high : float
        Its limits, positive.
    """
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    tick_decades(axes.yaxis, low, high)


def plain(value: float, digits: int = 12) -> str:
    """Return a number as figures have it: with minus signs and no hyphens, and a power of ten where it needs one.

    Parameters
    ----------
    value : float
    digits : int
        Significant ones at most.
    """
    mantissa, _, exponent = written(float(f"{value:.{digits}g}")).partition("e")
    mantissa = mantissa.replace("-", "\N{MINUS SIGN}")
    if not exponent:
        return mantissa
    power = f"10^{{{int(exponent)}}}"
    return f"${power}$" if mantissa == "1" else rf"${mantissa}\times {power}$"


def tick_decades(axis: Axis, low: float, high: float) -> None:
    """Put plain numbers on a logarithmic axis: at powers of ten, and in between where there are few.

    Parameters
    ----------
    axis : matplotlib.axis.Axis
    low, high : float
        Its limits, positive.
    """
    decades = np.log10(high / low)
    between = (1.0,) if decades > 3.5 else (1.0, 2.0, 5.0) if decades > 0.8 else tuple(np.arange(1.0, 10.0))
    axis.set_major_locator(LogLocator(10.0, subs=between, numticks=25))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))


def tick_at(axis: Axis, places: Sequence[float]) -> None:
    """Put plain numbers at some places of an axis, and nowhere else.

    Parameters
    ----------
    axis : matplotlib.axis.Axis
    places : sequence of float
        In the unit of the axis.
    """
    axis.set_major_locator(FixedLocator(list(places)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
