"""Which waves of a measured road carry its friction, from the table of friction over the cutoff."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pandas as pd

from rubfric.results.road_friction import POINT


def carried(table: pd.DataFrame) -> Iterator[tuple[float, float, list[tuple[str, float]], str]]:
    """Yield which waves carry friction, at each point with several cutoffs that were all solved on all windows.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.

    Yields
    ------
    pressure, velocity : float
        MPa and mm/s.
    bands : list of (str, float)
        Wavelengths in words, from long to short, and their share of the direct friction down to the shortest cutoff.
    finer : str
        What finer waves would add, in words; empty where no model says so.
    """
    for (pressure, velocity), rows in table.groupby(list(POINT)):
        direct = rows[rows["way"] == "direct"].sort_values("cutoff_mm", ascending=False)
        friction, cutoffs = direct["friction_coefficient"].to_numpy(), direct["cutoff_mm"].tolist()
        if len(direct) < 2 or direct["refused"].any() or not friction[-1] > 0.0:
            continue
        names = [
            f"{cutoffs[0]:g} mm and longer",
            *(f"{b:g} to {a:g} mm" for a, b in pairwise(cutoffs)),
        ]
        shares = np.diff(friction, prepend=0.0) / friction[-1]
        model = rows[rows["way"] == "persson"].sort_values("cutoff_mm")
        finer = ""
        if len(model):
            more = float(model["friction_coefficient"].iloc[0] / friction[-1]) - 1.0
            finer = f"{more:+.0%} down to {model['cutoff_mm'].iloc[0]:g} mm"
        yield pressure, velocity, list(zip(names, shares.tolist(), strict=True)), finer


def carriers(table: pd.DataFrame) -> str:
    """Return in words which waves carry friction, where that is highest; empty where a table does not say so.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.
    """
    found = {(pressure, velocity): (bands, finer) for pressure, velocity, bands, finer in carried(table)}
    direct = table[table["way"] == "direct"].sort_values("cutoff_mm").drop_duplicates(list(POINT))
    known = direct[[place in found for place in zip(*(direct[name] for name in POINT), strict=True)]]
    if known.empty:
        return ""
    top = known.loc[known["friction_coefficient"].idxmax()]
    bands, finer = found[top["pressure_MPa"], top["velocity_mm_per_s"]]
    (longest, first), *others = bands
    words = [f"waves of {longest} carry {first:.0%} of friction"]
    words += [f"those of {name} {share:.0%}" for name, share in others]
    model = f"; by Persson's theory, a model, finer ones would change it by {finer}" if finer else ""
    return (
        f"at {top['velocity_mm_per_s']:g} mm/s and {top['pressure_MPa']:g} MPa {', '.join(words[:-1])} and {words[-1]}"
        f"{model}"
    )
