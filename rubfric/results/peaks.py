"""The peak of friction over speed and its half-widths, each with its error, from curves that are known at points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.results.curve import Curve


class Between(NamedTuple):
    """A speed, and the speeds that it lies between, mm/s; NaN where there is none."""

    speed: float = np.nan
    low: float = np.nan
    high: float = np.nan


class CurvePeak(NamedTuple):
    """The highest friction on a curve.

    Attributes
    ----------
    kind : {"peak", "rising", "falling", "open"}
        Whether the highest friction is at a speed between the slowest and the fastest of the curve; at the fastest, or
        the slowest; or may be at one of these by its error.
    speed : Between
        Of the highest friction. It is at any speed whose friction may be as high, by the errors there.
    friction, error : float
        The highest friction, and its absolute error.
    slower, faster : Between
        The speeds next to it at which friction is half as high; NaN where it does not fall so far.
    """

    kind: str
    speed: Between
    friction: float
    error: float
    slower: Between
    faster: Between


def find_curve_peak(curve: Curve) -> CurvePeak:
    """Return the peak of a curve and its half-widths with what the errors of its points and between them leave open.

    Parameters
    ----------
    curve : Curve
    """
    places = curve.places
    friction, error = curve.at(places)
    low, high = friction - error, friction + error
    top = int(np.argmax(friction))
    sure, most = float(low.max()), float(high.max())
    within = np.flatnonzero(high >= sure)
    first, last, end = int(within[0]), int(within[-1]), places.size - 1
    kind = {0: "falling", end: "rising"}.get(top, "peak" if first > 0 and last < end else "open")
    height = float(friction[top])
    speeds = 10.0**places

    def half(side: int) -> Between:
        """Return where friction has fallen to half on one side (-1 or 1) of the peak."""
        reach = slice(top, None) if side > 0 else slice(top, None, -1)
        found = [
            _first_below(places[reach], values[reach], level)
            for values, level in ((friction, 0.5 * height), (low, 0.5 * most), (high, 0.5 * sure))
        ]
        return Between(found[0], *sorted(found[1:])) if np.isfinite(found[0]) else Between()

    return CurvePeak(
        kind=kind,
        speed=Between(float(speeds[top]), float(speeds[first]), float(speeds[last])),
        friction=height,
        error=max(most - height, height - sure),
        slower=half(-1),
        faster=half(1),
    )


def _first_below(places: Real, values: Real, level: float) -> float:
    """Return the speed at which values first fall below a level, interpolated in logarithms of speed; NaN for none."""
    below: Flags = values < level
    if not below.any():
        return np.nan
    at = int(np.argmax(below))
    if at == 0:
        return float(10.0 ** places[0])
    share = (values[at - 1] - level) / (values[at - 1] - values[at])
    return float(10.0 ** (places[at - 1] + share * (places[at] - places[at - 1])))
