"""Whether estimated errors of friction can be trusted: compared with the true ones on scenes drawn at random.

An estimate is good where it covers the true error and is not much larger.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import pandas as pd

from rubfric.errors import InvalidInput, NotConverged
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate
from rubfric.studies.accuracy.converged import Converged, converge

# Share of scenes whose true error the estimate must cover, and the largest allowed median of estimate over error.
COVERAGE, EXCESS = 0.95, 10.0

_COLUMNS = (
    *("scene", "set", "preset", "kinematics", "plane", "velocity", "pressure", "aspect", "slope", "wavelength"),
    *("friction_coefficient", "reference", "reference_error", "error", "estimate", "covered", "ratio", "note"),
)


def calibrate(name: str, kind: str, scene: Scene, presets: Mapping[str, Numerics]) -> pd.DataFrame:
    """Return one row for each preset: true and estimated error, relative to the scene's converged friction.

    A scene that is refused has its reason in ``note`` and no numbers; so has one without a reference.

    Parameters
    ----------
    name, kind : str
        Name of the scene and of the set that it belongs to.
    scene : Scene
    presets : mapping of str to Numerics
        By name; each replaces the numerics of the scene.

    Returns
    -------
    pandas.DataFrame
        Columns scene, set, preset, kinematics, plane, velocity (mm/s), pressure (MPa), aspect, slope, wavelength (mm),
        friction_coefficient, reference, reference_error (absolute), error and estimate (relative to the reference),
        covered, ratio (estimate over true error), note.
    """
    about = {
        "scene": name,
        "set": kind,
        "plane": scene.plane,
        "velocity": scene.velocity,
        "pressure": scene.pressure,
        "aspect": scene.aspect,
        "slope": scene.road.steepest_slope,
        "wavelength": scene.road.wavelength,
    }
    rows = [
        {"preset": preset} | _simulated(dataclasses.replace(scene, numerics=numerics))
        for preset, numerics in presets.items()
    ]
    if any("estimate" in row for row in rows):
        try:
            reference = converge(scene)
        except NotConverged as refusal:
            rows = [{"preset": row["preset"], "note": f"no reference: {refusal}"} for row in rows]
        else:
            rows = [_judged(row, reference) if "estimate" in row else row for row in rows]
    return pd.DataFrame([about | row for row in rows], columns=list(_COLUMNS))


def _simulated(scene: Scene) -> dict[str, Any]:
    """Return what a user gets: friction and its absolute error, or why there is none."""
    try:
        result = simulate(scene)
    except (InvalidInput, NotConverged) as refusal:
        return {"note": str(refusal)}
    return {
        "kinematics": result.attrs["kinematics_used"],
        "friction_coefficient": float(result["friction_coefficient"]),
        "estimate": float(result["friction_coefficient_error"]),
        "note": " ".join(result.attrs["warnings"].splitlines()),
    }


def _judged(row: dict[str, Any], reference: Converged) -> dict[str, Any]:
    scale = abs(reference.friction)
    error, estimate = abs(row["friction_coefficient"] - reference.friction), row["estimate"]
    return row | {
        "reference": reference.friction,
        "reference_error": reference.error,
        "error": error / scale,
        "estimate": estimate / scale,
        "covered": bool(error <= estimate),
        "ratio": estimate / max(error, reference.error * 1e-3),
    }


def preset_rows(ladder: pd.DataFrame) -> pd.DataFrame:
    """Return the presets of a ladder (``rubfric.studies.accuracy.ladder``) as rows of ``calibrate``, set ``ladder``."""
    chosen = ladder[ladder["knob"] == "preset"].copy()
    chosen["set"], chosen["preset"] = "ladder", chosen["rung"]
    chosen["covered"] = chosen["error"] <= chosen["estimate"]
    least = 1e-3 * chosen["reference_error"] / chosen["reference"].abs()
    chosen["ratio"] = chosen["estimate"] / chosen["error"].clip(lower=least)
    return chosen.reindex(columns=list(_COLUMNS))


def coverage_table(table: pd.DataFrame) -> pd.DataFrame:
    """Return how well the estimates hold, for each set and for all of them.

    Returns
    -------
    pandas.DataFrame
        Columns set, scenes (rows with an estimate), refused, coverage, ratio (median of estimate over true error),
        holds (covers ``COVERAGE`` and exceeds by at most ``EXCESS``).
    """
    groups = [(str(kind), part) for kind, part in table.groupby("set", sort=False)] + [("all", table)]
    rows = []
    for kind, part in groups:
        judged = part.dropna(subset=["estimate"])
        coverage, ratio = judged["covered"].astype(float).mean(), judged["ratio"].median()
        rows.append(
            {
                "set": kind,
                "scenes": len(judged),
                "refused": len(part) - len(judged),
                "coverage": coverage,
                "ratio": ratio,
                "holds": bool(coverage >= COVERAGE and ratio <= EXCESS),
            }
        )
    return pd.DataFrame(rows)
