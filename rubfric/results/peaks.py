"""The peak of friction over speed and its half-widths, each with its error, from curves that are known at points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd

from rubfric.arrays import Flags, Real
from rubfric.results.curve import Curve
from rubfric.results.curves import ADDED, CURVE, POINT, curve_of, curves_in
from rubfric.results.limits import MOST

_BEYOND = {
    "rising": "friction is highest at the fastest speed: the peak is there or beyond, add faster speeds",
    "falling": "friction is highest at the slowest speed: the peak is there or beyond, add slower speeds",
    "open": "by its error the highest friction may be at the slowest or the fastest speed: add speeds beyond",
}


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


def peak_table(points: pd.DataFrame, rubber: str, road: str, accuracy: float | None) -> pd.DataFrame:
    """Return the peaks of all curves, with what errors of points and of interpolation leave open.

    Parameters
    ----------
    points : pandas.DataFrame
        As from ``curve_table``.
    rubber, road : str
        Their names.
    accuracy : float or None
        To which speeds were added; None where none were.

    Returns
    -------
    pandas.DataFrame
        Without rows where no curve has two speeds.
    """
    rows = []
    for place, curve_points in curves_in(points):
        curve = curve_of(curve_points)
        if curve is None:
            continue
        added = int((curve_points[POINT] == ADDED).sum())
        peak = find_curve_peak(curve)
        rows.append(
            {"rubber": rubber, "road": road, **place, "kind": peak.kind}
            | _described(peak)
            | {"points": curve.speeds.size, "added": added, "interpolation_error": curve.worst}
            | {"note": "; ".join(_notes(peak, curve, added, accuracy))}
        )
    return pd.DataFrame(rows) if rows else pd.DataFrame(columns=["rubber", "road", CURVE, "kind", "note"])


def _described(peak: CurvePeak) -> dict[str, float]:
    """Return speeds with those that they lie between, and the highest friction with its error, by column."""
    found: dict[str, float] = {}
    for name, of in (("peak", peak.speed), ("half_slower", peak.slower), ("half_faster", peak.faster)):
        found |= {f"{name}_speed_mm_per_s": of.speed}
        found |= {f"{name}_speed_low_mm_per_s": of.low, f"{name}_speed_high_mm_per_s": of.high}
        if name == "peak":
            found |= {"peak_friction": peak.friction, "peak_friction_error": peak.error}
    return found


def _notes(peak: CurvePeak, curve: Curve, added: int, accuracy: float | None) -> Iterator[str]:
    """Yield what must be known of a peak."""
    if peak.kind in _BEYOND:
        yield _BEYOND[peak.kind]
    sides = {"slower": peak.slower, "faster": peak.faster}
    ends = {"rising": {"slower": peak.slower}, "falling": {"faster": peak.faster}}.get(peak.kind, sides)
    if lacking := [name for name, of in ends.items() if np.isnan(of.speed)]:
        yield f"within the speeds friction does not fall to half on the {' and the '.join(lacking)} side"
    if accuracy is None or curve.worst <= accuracy:
        return
    if not curve.open(accuracy).any():
        yield (
            f"between points known to {curve.worst:.2g} of friction, since the points are known no better themselves: "
            "a finer preset makes them so"
        )
    elif added >= MOST:
        yield f"{MOST} speeds were added, the most of a curve: it is known to {curve.worst:.2g} of friction"
    else:
        yield f"known to {curve.worst:.2g} of friction, since scenes in between have no solution"
