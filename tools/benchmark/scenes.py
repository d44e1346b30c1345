"""Time every scene of the paper's grid in this process, start-up excluded: small strain, finite strain and auto.

They are compared with a bare contact solve, the least that any method needs in small strain: the closed-form compliance
of the layer at 256 surface points and the complementarity problem, without a mesh, fields or energies. All are
timed scene by scene, in turn, so that their ratios hold on a noisy machine.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import resource
import statistics
import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import tables

from rubfric import simulation
from rubfric.config.campaign import load
from rubfric.markdown import markdown_table
from rubfric.mechanics.block.contact import full_contact, solve_contact
from rubfric.mechanics.finite import contact as slidingcontact
from rubfric.mechanics.finite import newton
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.scene.scene import KINEMATICS, Scene
from rubfric.simulation import simulate

POINTS = 256
PLANES = ("stress", "strain")
# What the parts of a scene in finite strain are called: module, name, label.
PARTS = (
    (newton, "Circulant", "averaged tangent, built and factorised"),
    (slidingcontact.Linearised, "__call__", "Krylov iterations"),
    (slidingcontact.SlidingContact, "correct", "stresses and linearised contact solves"),
    (simulation, "evaluate", "energies and fields"),
    (simulation.dataset, "build", "dataset"),
)


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


def measure(scenes: list[Scene], rounds: int) -> dict[str, list[float]]:
    """Return the times of all scenes in the three kinematics and of the bare solve; each scene's median round."""
    found: dict[str, list[list[float]]] = defaultdict(list)
    for scene in scenes:
        kinds = {kind: (simulate, replace(scene, kinematics=kind)) for kind in KINEMATICS}
        kinds["bare"] = (bare, scene)
        for kind, (work, chosen) in kinds.items():
            found[kind].append([seconds(work, chosen) for _ in range(rounds)])
    return {kind: [statistics.median(times) for times in scene_times] for kind, scene_times in found.items()}


def shares(scenes: list[Scene]) -> dict[str, float]:
    """Return the share of the time of all scenes in finite strain that goes into each of ``PARTS``."""
    spent: dict[str, float] = defaultdict(float)

    def timed(function: Callable, label: str) -> Callable:
        def call(*arguments, **named):
            started = time.perf_counter()
            try:
                return function(*arguments, **named)
            finally:
                spent[label] += time.perf_counter() - started

        return call

    kept = [(owner, name, getattr(owner, name)) for owner, name, _ in PARTS]
    for (owner, name, function), (_, _, label) in zip(kept, PARTS, strict=True):
        setattr(owner, name, timed(function, label))
    total = sum(seconds(simulate, replace(scene, kinematics="finite")) for scene in scenes)
    for owner, name, function in kept:
        setattr(owner, name, function)
    found = {label: spent[label] / total for _, _, label in PARTS}
    return found | {"tangent, meshes and the rest": 1.0 - sum(found.values())}


def main() -> None:
    """Measure, print and publish."""
    asked = tables.options(__doc__, every=(1, "take only every Nth scene"))
    rounds = asked.rounds
    campaign = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
    scenes = [scene for scene in campaign.scenes().values() if scene.aspect == campaign.aspect]
    scenes = scenes[:: asked.every]
    simulate(scenes[0])
    bare(scenes[0])
    rows: list[tuple[str, ...]] = [("one scene, in-process", "median", "90 %", "slowest")]
    ratio = 0.0
    for plane in PLANES:
        times = measure([replace(scene, plane=plane) for scene in scenes], rounds)
        for kind in KINEMATICS:
            rows.append((f"plane {plane}, {kind}", *written(times[kind])))

        if plane == "strain":
            rows.append(("bare contact solve in small strain, 256 points", *written(times["bare"])))
            ratio = statistics.median(times["small"]) / statistics.median(times["bare"])
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    parts = ", ".join(f"{label} {share:.0%}" for label, share in shares(scenes).items())
    text = (
        f"{markdown_table(rows, numeric=True)}\n\n"
        f"{len(scenes)} scenes in each plane, {tables.times(rounds)} of each; small strain takes {ratio:.1f} "
        f"times a bare contact solve; peak memory {memory:.0f} MB. Where the time of finite strain goes: {parts}. "
        f"{tables.machine()}."
    )
    print(text)
    tables.publish("scenes", text, "performance.md")


def written(times: list[float]) -> tuple[str, str, str]:
    """Return the median, the 90 % quantile and the largest, in words."""
    values = (statistics.median(times), float(np.quantile(times, 0.9)), max(times))
    return tuple(f"{1e3 * value:.0f} ms" if value < 1.0 else f"{value:.1f} s" for value in values)


if __name__ == "__main__":
    main()
