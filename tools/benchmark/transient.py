"""Time steady sliding, solved directly, beside a march in time that meets it to 1 %, both in finite strain on one mesh.

The march presses infinitely slowly and slides until friction has saturated; its steps are halved until the mean over
the last wavelength lies within 1 % of the steady solver's friction on the same mesh. Where that is not met by the
finest steps, or not saturated within the wavelengths allowed, the time is a lower bound and marked so. Steps per
second are measured beside it, in small strain on 128 surface nodes and in finite strain on 64 x 24 cells.

``transient.py whole`` does so for the whole road, in processor time and at equal error. A march is not run to its end
there: its steps are timed, a few of them, from steady sliding, and it has to take as many as go into the memory of the
slowest branch and a sixteenth of a period, which is the least that a march from rest can do.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path

import tables

from rubfric.config.campaign import load
from rubfric.marching import begin, march
from rubfric.markdown import markdown_table
from rubfric.scene.numerics import Numerics
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import ALL, Scene
from rubfric.simulation import simulate, solve
from rubfric.studies.accuracy.converged import converge

# Scale, speed in mm/s, pressure in MPa.
SCENES = ((1, 10, 0.5), (1, 100, 0.5), (1, 100, 2), (2, 100, 1), (3, 10, 1), (4, 10, 0.5))
COLUMNS, ACCURACY = 64, 0.01
LADDER = (16, 32, 64, 128)
MOST_WAVELENGTHS = 24
# Of the whole road: kinematics, speed in mm/s, pressure in MPa; and of the cheapest march that is within 1 % of steady
# friction, docs/whole_road.md: columns, growth of rows and steps for each finest wave.
WHOLE = (
    ("small", 100, 5, 1024, 1.3, 32),
    ("small", 1000, 5, 1024, 1.3, 32),
    ("small", 1000, 0.5, 3072, 1.2, 64),
    ("finite", 1000, 0.5, 2048, 1.3, 32),
)
STEPS_TIMED, LEAST_WAY = {"small": 200, "finite": 30}, 1.0 / 16.0


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


def steps_of_whole(scene: Scene, columns: int, growth: float, steps: int) -> tuple[float, float, int]:
    """Return the friction of a march over the whole road, the processor time of a step, and how many it has to take."""
    pinned = {"finite_columns_min": columns, "columns_min": columns, "columns_max": columns, "row_growth": growth}
    numerics = replace(scene.numerics, contact_nodes=8, finite_contact_nodes=4, refinements=0, **pinned)
    procedure = Procedure(
        start="steady", columns=columns, steps_per_wavelength=steps, wavelengths=1, until_saturated=False
    )
    marching = begin(replace(scene, numerics=numerics), procedure)
    count = STEPS_TIMED[scene.kinematics]
    started = time.process_time()
    for _ in range(count):
        marching.step()
    spent = (time.process_time() - started) / count
    memory = max(scene.material.relaxation_times) * scene.velocity / scene.road.period
    friction = float(marching.records["friction_contact"][-count // 2 :].mean())
    return friction, spent, int((memory + LEAST_WAY) * procedure.steps_per_period(scene.road))


def steady_of_whole(scene: Scene, presets: dict[str, Numerics], friction: float, error: float) -> tuple[str, float]:
    """Return the first preset whose friction is as near to the converged one as the march's, and its processor time."""
    for name, numerics in presets.items():
        started = time.process_time()
        found = solve(replace(scene, numerics=numerics)).friction.stress_power
        spent = time.process_time() - started
        if abs(found / friction - 1.0) <= error:
            return name, spent
    return f"{name} (farther off)", spent


def whole() -> None:
    """Measure, print and publish steady sliding and marching over the whole road."""
    campaign = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
    rows: list[tuple[str, ...]] = [
        ("scene", "off by", "march: a step", "steps", "march", "steady", "preset", "march over steady")
    ]
    for kinematics, velocity, pressure, *mesh in WHOLE:
        scene = campaign.scene(ALL, velocity, pressure, plane="strain", kinematics=kinematics)
        reference = converge(scene).friction
        friction, step, count = steps_of_whole(scene, *mesh)
        error = max(abs(friction / reference - 1.0), ACCURACY)
        solve(scene)  # what the first of a process costs more
        preset, steady_time = steady_of_whole(scene, campaign.presets, reference, error)
        ratio = step * count / steady_time
        rows.append(
            (
                f"{kinematics} strain, {velocity} mm/s, {pressure} MPa",
                f"{abs(friction / reference - 1.0):.1%}",
                f"{1e3 * step:.0f} ms",
                f"{count}",
                f"{step * count:.0f} s",
                f"{steady_time:.2f} s",
                preset,
                f"{ratio:.0f}",
            )
        )
        print(rows[-1], flush=True)
    tables.publish("march", f"{markdown_table(rows, numeric=True)}\n\n{tables.machine()}.", "whole_road.md")


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
    whole() if sys.argv[1:] == ["whole"] else main()
