"""Whether the totals over the scales support what the paper claims, and whether they are the sum that it makes them."""

from __future__ import annotations

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.results.scales import AXES, TOTAL, total_error
from rubfric.results.selection import WINDOWS
from rubfric.studies.paper.claims import Evidence
from rubfric.studies.paper.evidence import peak


def total_evidence(totals: pd.DataFrame, grid: xr.Dataset, difference: float) -> list[Evidence]:
    """Return what totals over the scales say on C7 and C9.

    Parameters
    ----------
    totals : pandas.DataFrame
        As from ``rubfric.results.totals.total_table``. For C7 a sum counts with the error of leaving the coupling of
        the scales out; for C9, which is about that coupling, with its numerical error alone.
    grid : xarray.Dataset
        Friction of the scales and its errors at the aspect of the table.
    difference : float
        Relative difference up to which two values are called equal.
    """
    found: list[Evidence] = []
    numerical = total_error(grid["friction_coefficient_error"])
    for pressure, rows in totals.sort_values(list(AXES)).groupby("pressure_MPa"):
        where = (None, float(pressure))
        for part, (total, whole) in {
            "the whole road peaks": TOTAL,
            "the sum peaks": ("friction_sum", "friction_sum_error"),
        }.items():
            known = rows.dropna(subset=[total, whole])
            friction, error = (known[name].to_numpy(dtype=float) for name in (total, whole))
            found += peak("C7", part, where, friction, error)
        direct = rows[~_over_windows(rows)].dropna(subset=["friction_direct", "friction_direct_error"])
        for row in direct.to_dict("records"):
            velocity, friction = float(row["velocity_mm_per_s"]), float(row["friction_direct"])
            base = max(abs(friction), float(np.finfo(float).tiny))
            slack = float(row["friction_direct_error"]) + float(numerical.sel(velocity=velocity, pressure=pressure))
            value = abs(float(row["friction_sum"]) - friction) / base
            part = "the sum is the total"
            found.append(Evidence("C9", part, *where, velocity, value, slack / base, difference, "below"))
    return found


def _over_windows(totals: pd.DataFrame) -> pd.Series:
    """Return where the whole road is a mean over windows of a measured profile, which is no sum of scales."""
    if "note" not in totals:
        return pd.Series(False, index=totals.index)
    return totals["note"].astype(str).str.contains(WINDOWS)


def total_note(totals: pd.DataFrame) -> str:
    """Return in a sentence how far the whole road is from the sum over its scales, and where it was refused."""
    known = totals.dropna(subset=["friction_direct"])
    if known.empty:
        return "The whole road was not simulated."
    if _over_windows(known).any():
        return "Not judged: the whole road is a measured profile, and the scales are sines with its spectrum alone."
    ratio = known["friction_direct"] / known["friction_sum"]
    low, high = (
        f"{ratio[at]:.2f} ({known.loc[at, AXES[0]]:g} mm/s, {known.loc[at, AXES[1]]:g} MPa)"
        for at in (ratio.idxmin(), ratio.idxmax())
    )
    refused = int(totals["refused"].astype(bool).sum())
    said = f"; at {refused} of {len(totals)} points it was refused, in whole or in part" if refused else ""
    return f"All scales at once have {low} to {high} times the friction of the sum{said}."


def reading_note(totals: pd.DataFrame, whole: pd.DataFrame) -> str:
    """Return in words what C9 rests on in another reading of the paper.

    Parameters
    ----------
    totals : pandas.DataFrame
        As from ``rubfric.results.totals.total_table``, of that reading.
    whole : pandas.DataFrame
        Observations of the whole road, with the reason in ``note`` where there is no friction.
    """
    missing = whole[whole["friction_coefficient"].isna()]
    if len(missing) == len(whole):
        why = missing["note"].iloc[0] if len(missing) else "the whole road was not simulated"
        return f"C9 was not judged, since {why}."
    left = f" It was judged at {len(whole) - len(missing)} of {len(whole)} speeds and loads"
    reasons = missing["note"].value_counts().items()
    why = "; ".join(f"at {count} {reason}" for reason, count in reasons)
    return f"C9: {total_note(totals)}{left}: {why}." if why else f"C9: {total_note(totals)}"
