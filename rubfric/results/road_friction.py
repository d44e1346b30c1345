"""Friction on a measured road as one table: the mean over its windows at every cutoff, beside theory and sines."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from rubfric.mechanics.theory.persson import contact_fractions, persson_friction
from rubfric.profile.analysis import Analysis
from rubfric.road.road import Road
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import ALL, Scene

# The ways that are not direct, in words.
WAYS = {
    "persson": "the finer ones by Persson's theory",
    "sines": "sines of the same spectrum, all at once",
    "sum": "sines of the same spectrum, summed one by one",
}
POINT = ("pressure_MPa", "velocity_mm_per_s")
_SAME = 1e-9
# Friction, its estimated numerical error and the contact fraction on a road, or why the scene was refused.
Outcome = tuple[float, float, float] | str


@dataclass(frozen=True)
class Block:
    """What slides over the road.

    Attributes
    ----------
    material : Material
    height : float
        mm.
    plane : {"stress", "strain"}
    kinematics : {"small", "finite", "auto"}
    numerics : Numerics
    """

    material: Material
    height: float
    plane: str
    kinematics: str
    numerics: Numerics

    @classmethod
    def of(cls, scene: Scene) -> Block:
        """Return the block of a scene."""
        return cls(scene.material, scene.height, scene.plane, scene.kinematics, scene.numerics)

    def scene(self, road: WaveRoad | SineScale, velocity: float, pressure: float) -> Scene:
        """Return the scene of this block on a window, on sines, or on one of them.

        Parameters
        ----------
        road : WaveRoad or SineScale
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        """
        aspect = self.height / road.wavelength
        about = (self.material, self.plane, self.numerics, self.kinematics)
        return Scene(ALL if isinstance(road, WaveRoad) else 1, road, velocity, pressure, aspect, *about)

    def row_of_sines(self, way: str, road: WaveRoad, velocity: float, pressure: float) -> dict[str, Any]:
        """Return the beginning of a row of sines that stand for the road.

        Parameters
        ----------
        way : {"sines", "sum"}
        road : WaveRoad
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        """
        friction, contact = self.persson(road, velocity, pressure)
        return {"way": way, "friction_persson": friction, "contact_persson": contact}

    def persson(self, road: Road, velocity: float, pressure: float) -> tuple[float, float]:
        """Return friction and contact fraction by Persson's theory.

        Parameters
        ----------
        road : Road
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        """
        about = (self.material, road, velocity, pressure, self.height, self.plane)
        return float(persson_friction(*about).sum()), float(contact_fractions(*about)[-1])


def tabulate(
    found: Analysis,
    block: Block,
    asked: Mapping[tuple[float, float], Sequence[float]],
    windows: int,
    solved: Callable[[float, float, float], Sequence[Outcome]],
    sines: Callable[[float, float], Sequence[dict[str, Any]]] = lambda pressure, velocity: [],
    progress: Callable[[str], None] = lambda line: None,
    finer: bool = True,
) -> pd.DataFrame:
    """Return friction on a road, the mean over its windows, at every pressure, speed and cutoff that is asked for.

    Below the shortest cutoff, down to the shortest wavelength that can be trusted, rows of ``way`` persson add to the
    direct friction there what Persson's theory says of the finer waves of the same windows; that is a model, without
    an error.

    Parameters
    ----------
    found : Analysis
    block : Block
    asked : mapping
        Cutoffs, mm, by nominal pressure, MPa, and speed, mm/s.
    windows : int
        How many, from the first on.
    solved : callable
        Takes pressure, speed and cutoff and returns what was found on each of the windows.
    sines : callable
        Takes pressure and speed and returns rows of sines that stand for the road, without their place.
    progress : callable
        Is given a line for each row.
    finer : bool
        Whether there are rows of finer waves by Persson's theory.

    Returns
    -------
    pandas.DataFrame
        ``friction_coefficient`` is the mean over the windows that were solved, ``friction_road_error`` its standard
        error (NaN for one window), ``friction_scatter`` the standard deviation over windows,
        ``friction_numerical_error`` the mean of the windows' own estimates, all absolute; ``contact_fraction`` with
        its standard error ``contact_road_error``; ``friction_persson`` and ``contact_persson`` are friction and
        contact fraction by Persson's theory on the same windows; ``refused`` counts windows without a solution, and
        ``note`` says why.
    """
    roads: dict[float, list[WaveRoad]] = {}
    rows: list[dict[str, Any]] = []

    def add(row: dict[str, Any]) -> None:
        rows.append(row)
        progress(line(row))

    for (pressure, velocity), cutoffs in sorted(asked.items()):
        place = {"velocity_mm_per_s": velocity, "pressure_MPa": pressure}
        descending, last = sorted(set(cutoffs), reverse=True), {"friction_coefficient": 0.0, "friction_persson": 0.0}
        for cutoff in (*descending, *(_finer(found, descending[-1]) if finer else ())):
            if cutoff not in roads:
                roads[cutoff] = [found.road(number, cutoff) for number in range(1, windows + 1)]
            theory = np.mean([block.persson(road, velocity, pressure) for road in roads[cutoff]], axis=0).tolist()
            row: dict[str, Any] = place | {"cutoff_mm": cutoff, "way": "direct"}
            if cutoff in descending:
                last = row = row | means(solved(pressure, velocity, cutoff))
            else:
                friction = last["friction_coefficient"] + theory[0] - last["friction_persson"]
                row |= {"way": "persson", "friction_coefficient": friction}
            row |= dict(zip(("friction_persson", "contact_persson"), theory, strict=True))
            add(row)
        for each in sines(pressure, velocity):
            add(place | {"cutoff_mm": descending[-1]} | each)
    return pd.DataFrame(rows)


def _finer(found: Analysis, shortest: float) -> list[float]:
    """Return cutoffs below the shortest, each half of the one before, that are still to be trusted."""
    least = max(found.band.wavelengths[0], 2.0 * found.cleaned.profile.spacing, found.window / 500.0)
    halves = math.floor(math.log2(shortest / least) + _SAME) if shortest > least else 0
    return [float(f"{shortest / 2.0**number:.6g}") for number in range(1, halves + 1)]


def means(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """Return the columns of a row of windows: means over those that were solved.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of each window, in their order.
    """
    solved = [one for one in outcomes if not isinstance(one, str)]
    reasons = [f"window {number}: {one}" for number, one in enumerate(outcomes, 1) if isinstance(one, str)]
    values = np.array(solved).reshape(-1, 3)
    count = len(values)
    mean = values.mean(axis=0) if count else np.full(3, np.nan)
    scatter = values.std(axis=0, ddof=1) if count > 1 else np.full(3, np.nan)
    error = scatter / math.sqrt(max(count, 1))
    return {
        "friction_coefficient": float(mean[0]),
        "friction_road_error": float(error[0]),
        "friction_numerical_error": float(mean[1]),
        "friction_scatter": float(scatter[0]),
        "contact_fraction": float(mean[2]),
        "contact_road_error": float(error[2]),
        "windows": count,
        "refused": len(reasons),
        "note": reasons[0] if reasons else "",
    }


def line(row: Mapping[str, Any]) -> str:
    """Return a row in words."""
    at = f"{row['velocity_mm_per_s']:g} mm/s, {row['pressure_MPa']:g} MPa, waves of {row['cutoff_mm']:g} mm and longer"
    friction = row["friction_coefficient"]
    if row["way"] != "direct":
        known = "not solved" if math.isnan(friction) else f"{friction:.4g}"
        return f"{at}: {known}, {WAYS[row['way']]}"
    if math.isnan(friction):
        return f"{at}: no window was solved; {row['note']}"
    parts = [f"{row['friction_numerical_error']:.2g} (numerical)"]
    parts += [f"{row['friction_road_error']:.2g} (road)"] if not math.isnan(row["friction_road_error"]) else []
    refused = f"; {row['refused']} windows refused" if row["refused"] else ""
    return f"{at}: {friction:.4g} ± {' ± '.join(parts)}, Persson {row['friction_persson']:.4g}{refused}"
