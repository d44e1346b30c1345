"""What the ladders show: what each knob buys, and which first mesh is the cheapest for an accuracy."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from rubfric.errors import BrokenResult
from rubfric.scene.numerics import Numerics, fineness
from rubfric.studies.accuracy.ladder import STARTS
from rubfric.studies.accuracy.ways import DIRECT, KNOB

# First meshes whose costs differ by less than this share count as equally cheap: the finest of them is taken.
_TIE = 0.15


def with_costs(ladder: pd.DataFrame, accuracies: Mapping[str, float]) -> pd.DataFrame:
    """Return a ladder with costs, and with the presets as the cheapest first meshes for their accuracies.

    Parameters
    ----------
    ladder : pandas.DataFrame
        Of all scenes, as from ``rubfric.studies.accuracy.ladder.measure_ladder``.
    accuracies : mapping of str to float
        Accuracy of each preset by name, ``standard`` among them.

    Returns
    -------
    pandas.DataFrame
        First the presets, as rungs of a knob ``preset``; with a column ``cost``, the seconds over those of
        ``standard`` on the same scene, which on the whole road is the direct one.

    Raises
    ------
    BrokenResult
        Where no first mesh keeps an accuracy.
    """
    starts = start_table(ladder)
    parts = []
    for name, accuracy in accuracies.items():
        first = starts[starts["chosen"] & (starts["accuracy"] == accuracy)]["fineness"]
        if first.empty:
            raise BrokenResult(f"the ladder has no accuracy of {accuracy:g}, that of the preset {name}")
        rows = ladder[(ladder["knob"] == "start") & (ladder["rung"] == _rung(accuracy, first.iloc[0]))]
        parts.append(rows.assign(knob="preset", rung=name))
    whole = pd.concat([*parts, ladder], ignore_index=True)
    base = (whole["knob"] == "preset") & (whole["rung"] == "standard") | (whole["knob"] == KNOB) & (
        whole["rung"] == DIRECT
    )
    standard = whole[base].set_index("scene")["seconds"]
    return whole.assign(cost=whole["seconds"] / whole["scene"].map(standard))


def _rung(accuracy: float, first: float) -> str:
    return f"{accuracy:g} from {first:g}"


def knob_table(ladder: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each rung of each knob, over all scenes.

    Returns
    -------
    pandas.DataFrame
        Columns knob, rung, scenes, refused, typical_error (median), worst_error, typical_estimate, cost (median, of a
        ladder ``with_costs``), seconds (sum), memory_MB (most); in the order of the ladder.
    """
    rows = []
    for (knob, rung), part in ladder.groupby(["knob", "rung"], sort=False):
        solved = part.dropna(subset=["error"])
        rows.append(
            {
                "knob": knob,
                "rung": rung,
                "scenes": len(solved),
                "refused": len(part) - len(solved),
                "typical_error": solved["error"].median(),
                "worst_error": solved["error"].max(),
                "typical_estimate": solved["estimate"].median(),
                "cost": solved["cost"].median() if "cost" in solved else float("nan"),
                "seconds": solved["seconds"].sum(),
                "memory_MB": solved["memory_MB"].max(),
            }
        )
    return pd.DataFrame(rows)


def start_table(ladder: pd.DataFrame) -> pd.DataFrame:
    """Return what each accuracy costs from each first mesh; ``chosen`` marks the cheapest that keeps it everywhere.

    Of those that cost the same within 15 %, it is the finest.

    Returns
    -------
    pandas.DataFrame
        Columns accuracy, fineness, typical_error, worst_error, cost (as in ``knob_table``), seconds (sum), chosen.

    Raises
    ------
    BrokenResult
        Where no first mesh keeps an accuracy.
    """
    knobs = knob_table(ladder).query("knob == 'start'").set_index("rung")
    rows = []
    for accuracy, starts in STARTS.items():
        found = [knobs.loc[_rung(accuracy, start)] for start in starts]
        keeping = {
            start: float(entry["seconds"])
            for start, entry in zip(starts, found, strict=True)
            if entry["worst_error"] <= accuracy and not entry["refused"]
        }
        if not keeping:
            raise BrokenResult(f"no first mesh of the ladder keeps an accuracy of {accuracy:g} on every scene")
        cheapest = min(keeping.values())
        chosen = max(start for start, seconds in keeping.items() if seconds <= (1.0 + _TIE) * cheapest)
        for start, entry in zip(starts, found, strict=True):
            numbers = {name: entry[name] for name in ("typical_error", "worst_error", "cost", "seconds")}
            rows.append({"accuracy": accuracy, "fineness": start, **numbers, "chosen": start == chosen})
    return pd.DataFrame(rows)


def presets_that_differ(starts: pd.DataFrame, presets: Mapping[str, Numerics]) -> list[str]:
    """Return the presets whose first mesh is not the one that ``start_table`` chose for their accuracy.

    Parameters
    ----------
    starts : pandas.DataFrame
        As from ``start_table``.
    presets : mapping of str to Numerics
        By name.
    """
    differing = []
    for name, numerics in presets.items():
        chosen = starts[starts["chosen"] & (starts["accuracy"] == numerics.accuracy)]
        first = fineness(float(chosen["fineness"].iloc[0])) if len(chosen) else {}
        if not first or any(getattr(numerics, key) != value for key, value in first.items()):
            differing.append(name)
    return differing
