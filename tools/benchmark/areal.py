"""Show what an areal road costs: steady sliding over self-affine roads from 256 to 1024 nodes along a side.

Each scene is solved from coarse nodes to the finest, with its error from two resolutions. CPU times of one thread are
put in ratio to n log n, and, where Tamaas is installed, to its elastic standing contact on the same road at the
contact's own stiffness (Polonsky, Keer and Rey, to 1e-8).
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import resource
import time

import numpy as np
import tables

from rubfric.config.campaign import load
from rubfric.markdown import markdown_table
from rubfric.mechanics.areal.steady import ArealSolution, solve_areal
from rubfric.road.self_affine import SelfAffine
from rubfric.scene.areal import ArealNumerics, ArealScene

# Nodes along a side, and how many of them the shortest wave has.
SIDES, PER_WAVE = (256, 512, 1024), 8
VELOCITIES, PRESSURE = (1.0, 10.0, 100.0, 1000.0, 1e4), 0.3
# Roads whose contact runs from 1 % to 60 %: their pressures, MPa, at one speed and side.
LOADS, LOADED = (0.03, 0.1, 0.3, 1.0, 3.0), (512, 10.0)
# Largest side for Tamaas, which takes minutes beyond.
MOST_TAMAAS = 512


def scene(side: int, velocity: float, pressure: float) -> ArealScene:
    """Return a scene on a self-affine road of rms slope 0.25 and period 1 mm."""
    road = SelfAffine(hurst=0.8, period=1.0, cut_off=PER_WAVE / side, rms_slope=0.25)
    numerics = ArealNumerics(accuracy=1e-4, nodes_per_wave=PER_WAVE, nodes_max=side)
    rubber = load(tables.DOCS.parent / "config/config.yaml").scene(1, velocity, pressure).material
    return ArealScene(road, velocity, pressure, rubber, numerics=numerics)


def seconds(rounds: int, job: ArealScene) -> tuple[ArealSolution, float]:
    """Return a solution and its CPU time, the least of some rounds."""
    times = []
    for _ in range(rounds):
        job.road.__dict__.pop("spectrum", None)  # drawing the road counts
        started = time.process_time()
        solved = solve_areal(job)
        times.append(time.process_time() - started)
    return solved, min(times)


def tamaas_seconds(solved: ArealSolution) -> float | None:
    """Return the CPU time of Tamaas on the road of a solution, elastic and standing, or None."""
    try:
        import tamaas
    except ImportError:
        return None
    job, (side, _) = solved.scene, solved.meshes[-1].shape
    heights = job.road.spectrum.heights((side, side))
    started = time.process_time()
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [side, side])
    turns = job.velocity * float(np.median(job.road.spectrum.wavenumbers))
    model.E, model.nu = float(np.abs(job.material.plane_modulus(turns, "strain"))), 0.0
    tamaas.set_log_level(tamaas.LogLevel.error)
    solver = tamaas.PolonskyKeerRey(model, heights, 1e-8)
    solver.max_iter = 5000
    solver.solve(job.pressure)
    return time.process_time() - started


def main() -> None:
    """Measure, print and publish."""
    rounds = tables.options(__doc__).rounds
    rows: list[tuple[str, ...]] = [
        ("nodes", "mm/s", "MPa", "friction", "error", "contact", "CPU time (s)", "over n log n", "over Tamaas")
    ]
    first: dict[float, float] = {}
    jobs = [(side, velocity, PRESSURE) for side in SIDES for velocity in VELOCITIES]
    jobs += [(*LOADED, pressure) for pressure in LOADS if pressure != PRESSURE]
    for side, velocity, pressure in jobs:
        solved, spent = seconds(rounds if side < SIDES[-1] else 1, scene(side, velocity, pressure))
        growth = spent / (side**2 * np.log(side))
        other = tamaas_seconds(solved) if side <= MOST_TAMAAS else None
        rows.append(
            (
                f"{side}²",
                f"{velocity:g}",
                f"{pressure:g}",
                f"{solved.friction_coefficient:.4f}",
                f"{solved.friction_error / abs(solved.friction_coefficient):.1%}",
                f"{solved.contact.fraction:.1%}",
                f"{spent:.2f}",
                f"{growth / first.setdefault(velocity, growth):.2f}",
                f"{spent / other:.2f}" if other else "",
            )
        )
        print(" | ".join(rows[-1]), flush=True)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    text = (
        f"{markdown_table(rows, numeric=True)}\n\n"
        f"Self-affine roads, H = 0.8, period 1 mm, {PER_WAVE} nodes along the shortest wave, rms slope 0.25, the "
        f"rubber of the shipped config, block height 0.75 mm. All nodes from coarse to fine count, and drawing the "
        f"road; over n log n: relative to {SIDES[0]}² at the same speed; over Tamaas: over the CPU time of its elastic "
        f"standing contact. At most {peak:.0f} MB in all. {tables.machine()}."
    )
    print(text)
    tables.publish("areal", text, "areal_road.md")


if __name__ == "__main__":
    main()
