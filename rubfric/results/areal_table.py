"""Friction on an areal road as one table: the surface, beside its profiles in the plane model and Persson's theory."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd
import xarray as xr


def areal_table(results: Sequence[xr.Dataset], profiles: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Return a row for each scene on an areal road, by temperature where it is known, pressure and speed.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        As from ``rubfric.results.areal.build``.
    profiles : sequence of xarray.Dataset
        Of each, what its profiles came to: as from ``rubfric.areal_plane.slide_profiles``; or none at all.

    Returns
    -------
    pandas.DataFrame
        ``friction_coefficient`` of the surface and ``friction_error``, its estimated error. ``friction_plane`` is the
        mean over the profiles, ``friction_plane_error`` its standard error over profiles and their mean numerical
        error, as the root of the sum of squares; both errors are absolute. ``plane_over_surface`` is the one friction
        over the other: what the plane model is off by on this road; ``plane_over_surface_error`` is what both errors
        leave open of it. ``contact_plane`` and ``persson_contact_fraction`` stand for ``contact_fraction`` likewise.
        ``refused`` counts profiles without a solution, and ``note`` says why of the first.
    """
    beside: Sequence[xr.Dataset | None] = profiles or [None] * len(results)
    rows = [_row(result, plane) for result, plane in zip(results, beside, strict=True)]
    order = [name for name in ("temperature_degC", "pressure_MPa", "velocity_mm_per_s") if name in rows[0]]
    return pd.DataFrame(rows).sort_values(order, ignore_index=True)


def _row(result: xr.Dataset, plane: xr.Dataset | None) -> dict[str, Any]:
    friction, error = float(result.friction_coefficient), float(result.friction_error)
    row: dict[str, Any] = {
        "velocity_mm_per_s": float(result.attrs["velocity"]),
        "pressure_MPa": float(result.attrs["pressure"]),
    }
    if "temperature" in result.attrs:
        row["temperature_degC"] = float(result.attrs["temperature"])
    row |= {"friction_coefficient": friction, "friction_error": error}
    row |= {} if plane is None else _plane(friction, error, plane)
    names = ("persson_friction", "persson_friction_reduced", "contact_fraction", "persson_contact_fraction")
    row |= {name: float(result[name]) for name in names}
    if plane is not None:
        reasons = str(plane.attrs["refused"]).splitlines()
        solved = int(plane.friction_coefficient.notnull().sum())
        row["contact_plane"] = float(plane.contact_fraction.mean()) if solved else math.nan
        row |= {"profiles": solved, "refused": len(reasons), "note": reasons[0] if reasons else ""}
    return row


def _plane(friction: float, error: float, plane: xr.Dataset) -> dict[str, float]:
    names = "friction_plane", "friction_plane_error", "plane_over_surface", "plane_over_surface_error"
    solved = plane.friction_coefficient.dropna("profile")
    if not solved.size:
        return dict.fromkeys(names, math.nan)
    mean, numerical = float(solved.mean()), float(plane.friction_coefficient_error.mean())
    scatter = float(solved.std(ddof=1)) / math.sqrt(solved.size) if solved.size > 1 else math.nan
    doubt = math.hypot(scatter, numerical)
    if not friction or not mean:
        return dict(zip(names, (mean, doubt, math.nan, math.nan), strict=True))
    ratio = mean / friction
    unsure = abs(ratio) * math.hypot(doubt / mean, error / friction)
    return dict(zip(names, (mean, doubt, ratio, unsure), strict=True))


def plane_words(table: pd.DataFrame) -> str:
    """Return in a sentence how far the plane model is off on this road; nothing where no profile was slid over.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``areal_table``.
    """
    known = table.dropna(subset=["plane_over_surface"]) if "plane_over_surface" in table else table[:0]
    if known.empty:
        return ""
    ratio = known["plane_over_surface"]
    low, high = known.loc[ratio.idxmin()], known.loc[ratio.idxmax()]
    ends = [
        f"{one['plane_over_surface']:.2f} ± {one['plane_over_surface_error']:.2f} ({one['velocity_mm_per_s']:g} mm/s, "
        f"{one['pressure_MPa']:g} MPa)"
        for one in ((low,) if low.equals(high) else (low, high))
    ]
    return f"friction of its profiles in the plane model is {' to '.join(ends)} times that of the surface"
