"""Show how the cost of a contact grows with its nodes: all scales of the paper's road at once, half of it in contact.

The surface is the closed-form layer in small strain, from 1024 to 16384 nodes, each solved from coarse to fine without
a first guess. CPU times are compared with n log n, and with one dense system of the nodes in contact.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import tables

from rubfric.config.campaign import load
from rubfric.markdown import markdown_table
from rubfric.mechanics.block import contact, surface
from rubfric.mechanics.theory.layer import layer_compliance

COLUMNS = (1024, 2048, 4096, 8192, 16384)
VELOCITY, PRESSURE, PLANE = 1.0, 2.0, "strain"
# The largest dense system that is timed.
MOST_DENSE = 5000


class Counted(surface.Convolution):
    """A surface that counts to how many nodes C is applied."""

    applied = 0

    def deflection(self, pressure):
        Counted.applied += len(pressure)
        return super().deflection(pressure)


def seconds(work: Callable[[], object], rounds: int) -> float:
    """Return the least CPU time of some rounds."""
    times = []
    for _ in range(rounds):
        started = time.process_time()
        work()
        times.append(time.process_time() - started)
    return min(times)


def main() -> None:
    """Measure, print and publish."""
    rounds = tables.options(__doc__).rounds
    campaign = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
    scene = campaign.scene("all", VELOCITY, PRESSURE, plane=PLANE, kinematics="small")
    contact.Convolution = Counted
    rows: list[tuple[str, ...]] = [
        ("nodes n", "in contact", "pivots", "C applied, times n", "CPU time", "over n log n", "one dense system")
    ]
    first = 0.0
    for nodes in COLUMNS:
        wavenumber = 2.0 * np.pi / scene.road.period * np.arange(1, nodes // 2 + 1)
        compliance = layer_compliance(scene.material, wavenumber, scene.velocity, scene.height, scene.plane)
        spectrum = np.concatenate(([0.0], compliance))
        profile = scene.road.height(scene.road.period / nodes * np.arange(nodes))
        Counted.applied = 0
        found = contact.solve_contact(spectrum, profile, scene.pressure)
        applied, inside = Counted.applied / nodes, np.flatnonzero(found.touching)
        spent = seconds(lambda s=spectrum, p=profile: contact.solve_contact(s, p, scene.pressure), rounds)
        first = first or spent / (nodes * np.log(nodes))
        rows.append(
            (
                f"{nodes}",
                f"{len(inside)} ({len(inside) / nodes:.0%})",
                f"{found.iterations}",
                f"{applied:.0f}",
                f"{1e3 * spent:.0f} ms",
                f"{spent / (nodes * np.log(nodes)) / first:.2f}",
                dense(surface.Convolution(spectrum, nodes), inside) if len(inside) <= MOST_DENSE else "",
            )
        )
    text = (
        f"{markdown_table(rows, numeric=True)}\n\n"
        f"All scales of the road at once, {VELOCITY:g} mm/s, {PRESSURE:g} MPa, plane {PLANE}, small strain; C is that "
        f"of the closed-form layer. Pivots and applications on all meshes from coarse to fine; CPU time over n log n "
        f"relative to the first; dense: filling and solving the system of the nodes in contact once. Least of {rounds} "
        f"rounds. {tables.machine()}."
    )
    print(text)
    tables.publish("contact", text, "performance.md")


def dense(level: surface.Convolution, inside: np.ndarray) -> str:
    """Return the CPU time of one dense system of the nodes in contact, in words."""

    def work() -> None:
        matrix = level.matrix(inside)
        np.linalg.solve(matrix + np.abs(matrix[0, 0]), np.ones(len(inside)))

    return f"{1e3 * seconds(work, 1):.0f} ms"


if __name__ == "__main__":
    main()
