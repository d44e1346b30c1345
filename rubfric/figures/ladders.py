"""The knobs of the numerics, each a ladder of rungs from coarse to fine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures.columns import check_columns

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Ladder:
    """One knob from its coarsest rung to its finest.

    Attributes
    ----------
    rungs : tuple of str
    cost, error : ndarray, each of shape (rungs,)
        Medians over the scenes; cost relative to the preset standard, error in per cent.
    worst : ndarray of shape (rungs,)
        Largest error of a scene, per cent.
    costs, errors : ndarray, each of shape (runs,)
        Of every scene on every rung.
    """

    rungs: tuple[str, ...]
    cost: Array
    error: Array
    worst: Array
    costs: Array
    errors: Array


def known_runs(table: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of a table of ladders that have an error and a cost.

    Raises
    ------
    InvalidInput
        For a table without rows, without a column, with a gap in a name or a negative number, or without any such row.
    """
    check_columns(table, "ladder", ("scene", "knob", "rung"), ("error", "cost", "reference_error"), ("reference",))
    known = table[np.isfinite(table["error"]) & np.isfinite(table["cost"]) & (table["cost"] > 0.0)]
    if known.empty:
        raise InvalidInput("the ladder has no run with both an error and a cost, but at least one is needed")
    return known


def by_knob(table: pd.DataFrame) -> dict[str, Ladder]:
    """Return the ladder of each knob that has a run with an error and a cost, in the order of the table.

    The rungs of a knob are in the order of the scene that has most of them, whether its runs have errors or not.

    Raises
    ------
    InvalidInput
        As ``known_runs``.
    """
    known = known_runs(table)
    knobs = dict.fromkeys(table["knob"][table["knob"].isin(known["knob"])])
    return {str(knob): _ladder(known[known["knob"] == knob], _order(table[table["knob"] == knob])) for knob in knobs}


def _order(rows: pd.DataFrame) -> list[str]:
    scenes = sorted(rows.groupby("scene", sort=False)["rung"].agg(list), key=len, reverse=True)
    return list(dict.fromkeys(rung for scene in scenes for rung in scene))


def _ladder(rows: pd.DataFrame, order: list[str]) -> Ladder:
    groups = rows.groupby("rung")
    rungs = [rung for rung in order if rung in groups.groups]
    return Ladder(
        rungs=tuple(str(rung) for rung in rungs),
        cost=groups["cost"].median()[rungs].to_numpy(),
        error=100.0 * groups["error"].median()[rungs].to_numpy(),
        worst=100.0 * groups["error"].max()[rungs].to_numpy(),
        costs=rows["cost"].to_numpy(dtype=np.float64),
        errors=100.0 * rows["error"].to_numpy(dtype=np.float64),
    )


def own_error(known: pd.DataFrame) -> float:
    """Return the median over the scenes of the relative bound on the reference's own error, per cent; 0 if unknown."""
    scenes = known.groupby("scene", sort=False)[["reference", "reference_error"]].first()
    scenes = scenes[scenes["reference"] != 0.0].dropna()
    return float(100.0 * (scenes["reference_error"] / scenes["reference"].abs()).median()) if len(scenes) else 0.0
