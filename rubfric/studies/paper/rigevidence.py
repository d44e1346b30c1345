"""What points of the test rig say on the paper's claim C8: friction that rises with speed, and falls past a peak."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from rubfric.studies.paper.evidence import Evidence

# Points count as of one pressure where the next is at most this factor above the last.
_NEAR = 1.1
_SPEED, _PRESSURE, _FRICTION = "speed_mm_per_s", "pressure_MPa", "friction_coefficient"


def rig_evidence(points: pd.DataFrame) -> list[Evidence]:
    """Return by how much the largest friction of each pressure exceeds that at its lowest and at its highest speed.

    Parameters
    ----------
    points : pandas.DataFrame
        As ``rubfric.rig.reduction.point_table`` returns it. Errors are the half widths of the 95 % confidence
        intervals of both points, added. A pressure with fewer than three points decides nothing.
    """
    return [one for group in _by_pressure(points) if len(group) > 2 for one in _of_one_pressure(group)]


def rig_note(points: pd.DataFrame) -> str:
    """Return in a sentence whether the points were measured."""
    simulated = int((points["source"] == "simulated").sum())
    if not len(points):
        return "The test rig gave no point."
    if not simulated:
        return f"From {len(points)} measured points."
    return (
        f"{simulated} of {len(points)} points are SIMULATED: a virtual rig measured what was simulated. That shows "
        "what a rig would see; only a measurement, named in rig.data, can decide."
    )


def _by_pressure(points: pd.DataFrame) -> Iterator[pd.DataFrame]:
    ordered = points.sort_values(_PRESSURE)
    pressures = ordered[_PRESSURE].to_numpy(dtype=float)
    apart = np.append(False, pressures[1:] > _NEAR * pressures[:-1])[: len(pressures)]
    for _, group in ordered.groupby(np.cumsum(apart)):
        yield group.sort_values(_SPEED)


def _of_one_pressure(group: pd.DataFrame) -> Iterator[Evidence]:
    friction = group[_FRICTION].to_numpy(dtype=float)
    spread = group[f"{_FRICTION}_ci95"].to_numpy(dtype=float)
    pressure = float(f"{group[_PRESSURE].median():.3g}")
    top = int(np.argmax(friction))
    speed = float(f"{group[_SPEED].iloc[top]:.3g}")
    simulated = bool((group["source"] == "simulated").any())
    for part, end in (("rises to a peak", 0), ("falls past the peak", -1)):
        base = max(abs(friction[end]), float(np.finfo(float).tiny))
        value, error = (friction[top] - friction[end]) / base, (spread[top] + spread[end]) / base
        yield Evidence("C8", part, None, pressure, speed, value, error, 0.0, "above", simulated)
