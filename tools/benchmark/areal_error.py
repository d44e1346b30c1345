"""Show whether the estimated errors of areal roads can be trusted: random scenes on nodes from coarse to fine.

Every scene is solved up to 512 nodes along a side; the error on coarser ones is the difference from there, extrapolated
at second order.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

from dataclasses import replace

import numpy as np
import tables

from rubfric.config.campaign import load
from rubfric.errors import NotConverged
from rubfric.mechanics.areal.steady import friction_error, solve_areal
from rubfric.road.self_affine import SelfAffine
from rubfric.rubber.material import BULK
from rubfric.scene.areal import ArealNumerics, ArealScene

SIDE, CUT_OFF = 512, 0.125


def scene(draw: np.random.Generator) -> ArealScene:
    """Return a scene at random."""
    velocity, pressure = 10.0 ** draw.uniform(-2.0, 4.0), 10.0 ** draw.uniform(-1.7, 0.6)
    hurst, slope = float(draw.choice([0.3, 0.8, 1.0])), float(draw.choice([0.1, 0.25, 0.6]))
    road = SelfAffine(hurst, 1.0, CUT_OFF, rms_slope=slope, seed=int(draw.integers(1, 99)))
    rubber = replace(load(tables.DOCS.parent / "config/config.yaml").material, bulk=str(draw.choice(BULK)))
    numerics = ArealNumerics(accuracy=1e-4, nodes_max=SIDE)
    return ArealScene(road, velocity, pressure, rubber, float(draw.choice([0.0, 30.0, 90.0])), numerics=numerics)


def main() -> None:
    """Solve, and print and publish how many errors are covered."""
    asked = tables.options(__doc__, scenes=(40, "scenes at random"), seed=(2026, "of the scenes"))
    draw, ratios = np.random.default_rng(asked.seed), []
    for number in range(asked.scenes):
        job = scene(draw)
        try:
            meshes = solve_areal(job).meshes
        except NotConverged as refused:
            print(refused, flush=True)
            continue
        before, last = (mesh.dissipation for mesh in meshes[-2:])
        true = last + (last - before) / 3.0
        for place in range(1, len(meshes)):
            error = abs(meshes[place].dissipation - true)
            if error > 1e-9 * abs(true):
                ratios.append(friction_error(meshes[: place + 1]) / error)
        print(number, job.name, f"{true:.4g}", [f"{one:.2g}" for one in ratios[1 - len(meshes) :]], flush=True)
    found = np.array(ratios)
    text = (
        f"Of {len(found)} errors on {asked.scenes} scenes at random, {np.count_nonzero(found >= 1.0)} are covered by "
        f"their estimate, which is {np.median(found):.1f} times as large in the median."
    )
    print(text)
    tables.publish("areal_error", text, "areal_road.md")


if __name__ == "__main__":
    main()
