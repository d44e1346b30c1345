"""Time steady sliding, solved directly, beside a march in time that meets it to 1 %, both in finite strain on one mesh.

The march presses infinitely slowly and slides until friction has saturated; its steps are halved until the mean over
the last wavelength lies within 1 % of the steady solver's friction on the same mesh. Where that is not met by the
finest steps, or not saturated within the wavelengths allowed, the time is a lower bound and marked so. Steps per
second are measured beside it, in small strain on 128 surface nodes and in finite strain on 64 x 24 cells.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import statistics
import time
from dataclasses import replace
from pathlib import Path

import tables

from rubfric.config.campaign import load
from rubfric.marching import march
from rubfric.markdown import markdown_table
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

# Scale, speed in mm/s, pressure in MPa.
SCENES = ((1, 10, 0.5), (1, 100, 0.5), (1, 100, 2), (2, 100, 1), (3, 10, 1), (4, 10, 0.5))
COLUMNS, ACCURACY = 64, 0.01
LADDER = (16, 32, 64, 128)
MOST_WAVELENGTHS = 24


def steady(scene: Scene) -> tuple[float, float]:
    """Return the friction of steady sliding on the mesh of the march, and the time it took."""
    pinned = replace(
        scene.numerics, finite_contact_nodes=4, finite_columns_min=COLUMNS, columns_min=8, columns_max=COLUMNS
    )
    started = time.perf_counter()
    result = simulate(replace(scene, numerics=pinned))
    return float(result["friction_coefficient_contact"]), time.perf_counter() - started


def marched(scene: Scene, friction: float) -> tuple[int, float, float, int, bool]:
    """Return the steps a wavelength, the time, the error and the wavelengths that meet ``friction``, and whether."""
    for steps in LADDER:
        procedure = Procedure(
            start="relaxed",
            columns=COLUMNS,
            steps_per_wavelength=steps,
            wavelengths=MOST_WAVELENGTHS,
            saturation=0.3 * ACCURACY,
        )
        started = time.perf_counter()
        found = march(scene, procedure)
        spent = time.perf_counter() - started
        error = abs(found.saturation.friction / friction - 1.0)
        met = error <= ACCURACY and found.saturation.reached
        if met or steps == LADDER[-1]:
            return steps, spent, error, found.saturation.wavelengths, met
    raise AssertionError


def steps_per_second(scene: Scene, columns: int, row_growth: float, steps: int) -> tuple[int, float]:
    """Return the rows of the mesh and how many steps of sliding go into a second."""
    chosen = replace(scene, numerics=replace(scene.numerics, row_growth=row_growth))
    procedure = Procedure(
        start="relaxed",
        columns=columns,
        steps_per_wavelength=64,
        wavelengths=max(1, steps // 64),
        until_saturated=False,
    )
    found = march(chosen, procedure)
    return found.block.rows, len(found.records["time"]) / found.seconds


def main() -> None:
    """Measure, print and publish."""
    campaign = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
    rows: list[tuple[str, ...]] = [
        ("scene", "steady", "march", "steps a wavelength", "wavelengths", "difference", "march over steady")
    ]
    ratios = []
    for scale, velocity, pressure in SCENES:
        scene = campaign.scene(scale, velocity, pressure, kinematics="finite")
        steady(scene)
        friction, direct = steady(scene)
        steps, spent, error, wavelengths, met = marched(scene, friction)
        ratios.append(spent / direct)
        bound = "" if met else "> "
        name = f"scale {scale}, {velocity} mm/s, {pressure} MPa"
        rows.append(
            (
                name,
                f"{direct:.2f} s",
                f"{bound}{spent:.1f} s",
                str(steps),
                str(wavelengths),
                f"{error:.2%}",
                f"{bound}{spent / direct:.0f}",
            )
        )
        print(rows[-1], flush=True)
    small_rows, small = steps_per_second(campaign.scene(1, 100, 0.5, kinematics="small"), 128, 1.1, 640)
    finite_rows, finite = steps_per_second(campaign.scene(1, 100, 0.5, kinematics="finite"), 64, 1.055, 128)
    text = (
        f"{markdown_table(rows, numeric=True)}\n\n"
        f"Median {statistics.median(ratios):.0f}. Steps a second: {small:.0f} in small strain (128 x {small_rows} "
        f"cells), {finite:.0f} in finite strain (64 x {finite_rows} cells). {tables.machine()}."
    )
    print(text)
    tables.publish("transient", text, "performance.md")


if __name__ == "__main__":
    main()
