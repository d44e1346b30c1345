"""Tables of friction over speed: every point of every curve, and their peaks and half-widths with errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from rubfric.results.curve import Curve
from rubfric.results.limits import MOST
from rubfric.results.peaks import CurvePeak, find_curve_peak
from rubfric.results.scales import AXES, TOTAL
from rubfric.results.selection import RUBBER_ERROR
from rubfric.results.temperature import COLUMN

# Of all points: which curve they are on, whether they were added, and how a total was obtained.
CURVE, POINT, WAY = "curve", "point", "way"
GRID, ADDED = "grid", "added"
FRICTION, ERROR = "friction_coefficient", "friction_coefficient_error"
WHOLE = "whole road"
WORDS = ("rubber", "road", CURVE, POINT, WAY, "kind", "note")

_BEYOND = {
    "rising": "friction is highest at the fastest speed: the peak is there or beyond, add faster speeds",
    "falling": "friction is highest at the slowest speed: the peak is there or beyond, add slower speeds",
    "open": "by its error the highest friction may be at the slowest or the fastest speed: add speeds beyond",
}


def scale_name(scale: int | str) -> str:
    """Return how the curves of a scale are named."""
    return f"scale {scale}"


def points_of(table: pd.DataFrame) -> pd.DataFrame:
    """Return speed, pressure, friction with its whole error and the way of each row of a table.

    Parameters
    ----------
    table : pandas.DataFrame
        Of a scale, as from ``rubfric.results.tables.scale_table``, or of totals.
    """
    axes = [*AXES, *([COLUMN] if COLUMN in table else [])]
    if TOTAL[0] in table:
        return table[[*axes, *TOTAL, WAY]].rename(columns=dict(zip(TOTAL, (FRICTION, ERROR), strict=True)))
    error = table[ERROR] + (table[RUBBER_ERROR].fillna(0.0) if RUBBER_ERROR in table else 0.0)
    return table[[*axes, FRICTION]].assign(**{ERROR: error, WAY: ""})


def curve_of(table: pd.DataFrame) -> Curve | None:
    """Return the curve through the rows of a table, all at one pressure and temperature.

    Parameters
    ----------
    table : pandas.DataFrame
        As for ``points_of``, or as from it.
    """
    points = table if POINT in table else points_of(table)
    return Curve.known(*(points[name].to_numpy(dtype=np.float64) for name in (AXES[0], FRICTION, ERROR)))


def curve_table(
    tables: Mapping[str, pd.DataFrame], added: Mapping[str, list[pd.DataFrame]], aspect: float
) -> pd.DataFrame:
    """Return every point of every curve: by curve, temperature where there are several, pressure and speed.

    Parameters
    ----------
    tables : mapping of str to pandas.DataFrame
        Those of the grid by the name of the curve, as for ``points_of``.
    added : mapping
        Those of the added speeds, likewise; may lack curves.
    aspect : float
        Height over width of the blocks; rows of others are left out.
    """
    found = []
    for name, table in tables.items():
        rows = table[np.isclose(table["aspect"], aspect, rtol=1e-5)] if "aspect" in table else table
        parts = [(GRID, rows), *((ADDED, one) for one in added.get(name, ()) if len(one))]
        points = pd.concat([points_of(one).assign(**{POINT: kind}) for kind, one in parts])
        axes = [axis for axis in (COLUMN, AXES[1], AXES[0]) if axis in points]
        points.insert(0, CURVE, name)
        found.append(points.dropna(subset=FRICTION).sort_values(axes))
    return pd.concat(found, ignore_index=True)


def curves_in(points: pd.DataFrame) -> Iterator[tuple[dict[str, Any], pd.DataFrame]]:
    """Yield each curve of a table: its name, pressure and temperature by column, and its points."""
    axes = [CURVE, *(axis for axis in (COLUMN, AXES[1]) if axis in points)]
    for place, rows in points.groupby(axes, sort=False):
        yield dict(zip(axes, place, strict=True)), rows


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
