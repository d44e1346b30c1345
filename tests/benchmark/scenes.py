"""Time every scene of the paper's grid in this process, start-up excluded, beside a bare contact solve.

The bare solve is the least that any method needs: the closed-form compliance of the layer at 256 surface points
and the complementarity problem, without a mesh, fields or energies. Both are timed scene by scene, in turn, so
that their ratio holds on a noisy machine.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import resource
import statistics
import time
from pathlib import Path

import numpy as np
import tables

from rubfric.campaign import load
from rubfric.contact import full_contact, solve_contact
from rubfric.reference import layer_compliance
from rubfric.scene import Scene
from rubfric.simulation import simulate

POINTS = 256
ROUNDS = 3


def bare(scene: Scene) -> None:
    """Solve the contact of a scene by the closed-form layer, at a fixed number of points."""
    road = scene.road
    harmonics = np.arange(1, POINTS // 2 + 1)
    compliance = layer_compliance(scene.material, road, scene.velocity, scene.height, scene.plane, harmonics)
    spectrum = np.concatenate(([0.0], compliance))
    profile = road.height(road.wavelength / POINTS * np.arange(POINTS))
    if full_contact(spectrum, profile, scene.pressure) is None:
        solve_contact(spectrum, profile, scene.pressure, np.ones(POINTS, dtype=bool), scene.name)


def seconds(work, scene: Scene) -> float:
    """Return the wall time of one call."""
    started = time.perf_counter()
    work(scene)
    return time.perf_counter() - started


def main() -> None:
    """Measure, print and publish."""
    campaign = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
    scenes = [scene for scene in campaign.scenes().values() if scene.aspect == campaign.aspect]
    simulate(scenes[0])
    bare(scenes[0])
    ours, least = [], []
    for _ in range(ROUNDS):
        for scene in scenes:
            ours.append(seconds(simulate, scene))
            least.append(seconds(bare, scene))
    slowest = [max(ours[index :: len(scenes)]) for index in range(len(scenes))]
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    rows: list[tuple[str, ...]] = [("one scene, in-process", "median", "90 %", "slowest")]
    for name, times in (
        ("whole scene: mesh, contact, fields, energies", ours),
        ("bare contact solve, 256 points", least),
    ):
        rows.append((name, *(f"{1e3 * value:.1f} ms" for value in quantiles(times))))
    text = (
        f"{tables.markdown(rows)}\n\n"
        f"{len(scenes)} scenes, {ROUNDS} rounds; ratio of the medians "
        f"{statistics.median(ours) / statistics.median(least):.2f}; every scene's slowest round at most "
        f"{max(slowest):.2f} s; peak memory {memory:.0f} MB. {tables.machine()}."
    )
    print(text)
    tables.publish("scenes", text)


def quantiles(times: list[float]) -> tuple[float, float, float]:
    """Return the median, the 90 % quantile and the largest."""
    return statistics.median(times), float(np.quantile(times, 0.9)), max(times)


if __name__ == "__main__":
    main()
