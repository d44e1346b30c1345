"""Friction on a measured road itself: block by block over its windows, down to one cutoff after the other."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.theory.persson import contact_fractions, persson_friction
from rubfric.profile import window
from rubfric.profile.analysis import Analysis
from rubfric.profile.scales import sines
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import ALL, Scene
from rubfric.simulation import simulate

# The ways that are not direct, in words.
WAYS = {
    "persson": "the finer ones by Persson's theory",
    "sines": "of sines fitted to the spectrum, all at once",
    "sum": "of sines fitted to the spectrum, summed one by one",
}
_SAME = 1e-9


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


def slide(
    found: Analysis,
    block: Block,
    velocities: Sequence[float],
    pressures: Sequence[float],
    cutoffs: Sequence[float],
    windows: int,
    scales: int = 0,
    progress: Callable[[str], None] = lambda line: None,
) -> pd.DataFrame:
    """Return friction on a road, the mean over its windows, at every speed, pressure and cutoff.

    Below the shortest cutoff, down to the shortest wavelength that can be trusted, rows of ``way`` persson add to the
    direct friction there what Persson's theory says of the finer waves of the same windows; that is a model, without
    an error. With ``scales``, rows of ``way`` sines and sum are for so many sines that are fitted to the spectrum down
    to the shortest cutoff, all at once and one by one: how far the paper's route is from the profile.

    Parameters
    ----------
    found : Analysis
    block : Block
    velocities : sequence of float
        mm/s.
    pressures : sequence of float
        Nominal, MPa.
    cutoffs : sequence of float
        Shortest wavelengths kept, mm.
    windows : int
        How many, from the first on.
    scales : int
        How many sines to compare with; 0 for none.
    progress : callable
        Is given a line for each speed, pressure and cutoff.

    Returns
    -------
    pandas.DataFrame
        ``friction_coefficient`` is the mean over the windows that were solved, ``friction_road_error`` its standard
        error (NaN for one window), ``friction_scatter`` the standard deviation over windows,
        ``friction_numerical_error`` the mean of the windows' own estimates, all absolute; ``friction_persson`` and
        ``contact_persson`` are friction and contact fraction by Persson's theory on the same windows; ``refused``
        counts windows without a solution, and ``note`` says why.

    Raises
    ------
    InvalidInput
        For more windows than the profile has, or a cutoff that a window does not have.
    """
    if windows > found.windows:
        raise InvalidInput(
            f"--windows is {windows}, but the profile has {found.windows} of {found.window:g} mm: take fewer, or "
            "shorter ones with --window"
        )
    numbers = range(1, windows + 1)
    descending = sorted(set(cutoffs), reverse=True)
    profile = found.cleaned.profile
    roads = {
        cutoff: [window.road(profile, found.window, cutoff, number, found.blend) for number in numbers]
        for cutoff in (*descending, *_finer(found, descending[-1]))
    }
    rows = []
    for pressure, velocity in product(sorted(pressures), sorted(velocities)):
        last: dict[str, Any] = {}
        for cutoff, some in roads.items():
            theory, touching = np.mean([_persson(block, road, velocity, pressure) for road in some], axis=0).tolist()
            place = {"velocity_mm_per_s": velocity, "pressure_MPa": pressure, "cutoff_mm": cutoff}
            if cutoff in descending:
                row = last = place | {"way": "direct"} | _direct(block, some, velocity, pressure)
            else:
                friction = last["friction_coefficient"] + theory - last["friction_persson"]
                row = place | {"way": "persson", "friction_coefficient": friction}
            row |= {"friction_persson": theory, "contact_persson": touching}
            rows.append(row)
            progress(_line(row))
        if scales:
            place = {"velocity_mm_per_s": velocity, "pressure_MPa": pressure, "cutoff_mm": descending[-1]}
            few = sines(found.spectrum, scales, found.window, descending[-1])
            for row in _sines(block, few, velocity, pressure):
                rows.append(place | row)
                progress(_line(rows[-1]))
    return pd.DataFrame(rows)


def _finer(found: Analysis, shortest: float) -> list[float]:
    """Return cutoffs below the shortest, each half of the one before, that are still to be trusted."""
    least = max(found.band.wavelengths[0], 2.0 * found.cleaned.profile.spacing, found.window / 500.0)
    halves = math.floor(math.log2(shortest / least) + _SAME) if shortest > least else 0
    return [float(f"{shortest / 2.0**number:.6g}") for number in range(1, halves + 1)]


def _persson(block: Block, road: WaveRoad, velocity: float, pressure: float) -> tuple[float, float]:
    """Return friction and contact fraction by Persson's theory."""
    about = (block.material, road, velocity, pressure, block.height, block.plane)
    return float(persson_friction(*about).sum()), float(contact_fractions(*about)[-1])


def _sines(block: Block, road: WaveRoad, velocity: float, pressure: float) -> list[dict[str, Any]]:
    """Return the rows of a road of sines: all at once, and the sum over them, each under a block of the same height."""
    waves = road.waves
    single = [SineScale(float(a), float(k)) for a, k in zip(waves.amplitudes, waves.wavenumbers, strict=True)]
    theory = dict(zip(("friction_persson", "contact_persson"), _persson(block, road, velocity, pressure), strict=True))
    parts = [_direct(block, [one], velocity, pressure) for one in single]
    whole = _direct(block, [road], velocity, pressure)
    total = {
        name: float(sum(part[name] for part in parts)) for name in ("friction_coefficient", "friction_numerical_error")
    }
    note = next((part["note"] for part in parts if part["refused"]), "")
    return [{"way": "sines"} | whole | theory, {"way": "sum"} | total | {"note": note} | theory]


def _direct(block: Block, roads: Sequence[WaveRoad | SineScale], velocity: float, pressure: float) -> dict[str, Any]:
    """Return the columns of a row: means over the windows that were solved."""
    solved, reasons = [], []
    for number, road in enumerate(roads, 1):
        try:
            result = simulate(block.scene(road, velocity, pressure))
        except NotConverged as error:
            reasons.append(f"window {number}: {error}")
        else:
            names = ("friction_coefficient", "friction_coefficient_error", "contact_fraction")
            solved.append([float(result[name]) for name in names])
    values = np.array(solved).reshape(-1, 3)
    count = len(values)
    mean = values.mean(axis=0) if count else np.full(3, np.nan)
    scatter = float(values[:, 0].std(ddof=1)) if count > 1 else math.nan
    return {
        "friction_coefficient": float(mean[0]),
        "friction_road_error": scatter / math.sqrt(count) if count > 1 else math.nan,
        "friction_numerical_error": float(mean[1]),
        "friction_scatter": scatter,
        "contact_fraction": float(mean[2]),
        "windows": count,
        "refused": len(reasons),
        "note": reasons[0] if reasons else "",
    }


def _line(row: dict[str, Any]) -> str:
    """Return a row in words."""
    at = f"{row['velocity_mm_per_s']:g} mm/s, {row['pressure_MPa']:g} MPa, waves of {row['cutoff_mm']:g} mm and longer"
    friction = row["friction_coefficient"]
    if row["way"] != "direct":
        return f"{at}: {friction:.4g}, {WAYS[row['way']]}"
    if math.isnan(friction):
        return f"{at}: no window was solved; {row['note']}"
    parts = [f"{row['friction_numerical_error']:.2g} (numerical)"]
    parts += [f"{row['friction_road_error']:.2g} (road)"] if not math.isnan(row["friction_road_error"]) else []
    refused = f"; {row['refused']} windows refused" if row["refused"] else ""
    return f"{at}: {friction:.4g} ± {' ± '.join(parts)}, Persson {row['friction_persson']:.4g}{refused}"
