"""Solve the whole road in finite strain over the paper's grid, each scene from a cold start in a process of its own.

A row of results/benchmark/whole_road.csv holds CPU time, peak memory, friction, its stated error and the closure of
the energies, or the sentence of the refusal; and the CPU time over that of a bare contact solve in small strain
(closed-form layer) of the same road and columns, in the same process. Rows that are there are not measured again: a run
that was stopped goes on. It may take an hour, and is no part of ``make bench``.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import argparse
import json
import time
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import tables
from alone import child, measured

from rubfric.config.campaign import load
from rubfric.mechanics.block.contact import solve_contact
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.rubber.material import PLANES
from rubfric.scene.scene import Scene

PROJECT = Path(__file__).resolve().parents[2]
TABLE = PROJECT / "results/benchmark/whole_road.csv"
POINT = ["plane", "velocity", "pressure", "accuracy", "budget"]
# CPU seconds of the least work that a bare contact solve is timed over.
_LEAST = 0.05


def main() -> None:
    """Measure what is missing, and print a summary of what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--accuracy", type=float, default=0.01, help="relative, of friction (default: %(default)s)")
    parser.add_argument("--budget", type=int, default=300, metavar="S", help="CPU seconds a scene (default: 300)")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="take only every Nth scene (default: 1)")
    parser.add_argument("--table", type=Path, default=TABLE, help="where the rows go (default: %(default)s)")
    parser.add_argument("--one", nargs=3, metavar=("PLANE", "V", "P"), help="solve one scene and print its row")
    asked = parser.parse_args()
    if asked.one:
        plane, velocity, pressure = asked.one
        print(json.dumps(solved(plane, float(velocity), float(pressure), asked.accuracy)))
        return
    campaign = load(PROJECT / "config/config.yaml")
    grid = list(product(PLANES, campaign.velocities, campaign.pressures))[:: asked.every]
    wanted = [(*point, asked.accuracy, asked.budget) for point in grid]
    known = pd.read_csv(asked.table, dtype={"refusal": str}) if asked.table.exists() else pd.DataFrame(columns=POINT)
    done = set(known[POINT].itertuples(index=False, name=None))
    asked.table.parent.mkdir(parents=True, exist_ok=True)
    for point in wanted:
        if point not in done:
            row = dict(zip(POINT, point, strict=True)) | child(_arguments(*point[:4]), asked.budget)
            known = pd.concat([known, pd.DataFrame([row])], ignore_index=True)
            known.to_csv(asked.table, index=False, float_format="%.6g")
    print(summary(known.set_index(POINT).loc[wanted].reset_index()))


def _arguments(plane: str, velocity: float, pressure: float, accuracy: float) -> list[str]:
    return [__file__, "--one", plane, repr(velocity), repr(pressure), "--accuracy", repr(accuracy)]


def solved(plane: str, velocity: float, pressure: float, accuracy: float) -> dict[str, object]:
    """Return the row of one scene, solved in this process."""
    scene = load(PROJECT / "config/config.yaml").scene("all", velocity, pressure, plane=plane, kinematics="finite")
    scene = replace(scene, numerics=replace(scene.numerics, accuracy=accuracy))
    row, result = measured(scene)
    if result is not None:
        row |= {"closure": float(result["energy_closure"]), "ratio": row["cpu"] / bare(scene, row["columns"])}
    return row


def bare(scene: Scene, columns: int) -> float:
    """Return the CPU seconds of the contact solve alone, in small strain, on the closed-form layer."""
    wavenumber = 2.0 * np.pi / scene.road.period * np.arange(1, columns // 2 + 1)
    compliance = layer_compliance(scene.material, wavenumber, scene.velocity, scene.height, scene.plane)
    profile = scene.road.height(scene.road.period / columns * np.arange(columns))
    started, rounds = time.process_time(), 0
    while time.process_time() < started + _LEAST:
        solve_contact(np.concatenate(([0.0], compliance)), profile, scene.pressure)
        rounds += 1
    return (time.process_time() - started) / rounds


def summary(rows: pd.DataFrame) -> str:
    """Return what a page says of the rows."""
    refused = rows.reindex(columns=["refusal"])["refusal"].notna()  # a column only where there was one
    solved_rows, others = rows[~refused], rows.loc[refused, "cpu"]
    cpu = solved_rows["cpu"]
    return (
        f"{len(solved_rows)} of {len(rows)} scenes solved: {cpu.median():.1f} s of CPU time at the median, "
        f"{cpu.max():.1f} s at most, {rows['memory'].max():.0f} MB at most; {solved_rows['ratio'].median():.0f} times "
        f"a bare contact solve at the median; stated error {solved_rows['error'].median():.2%} at the median, "
        f"{solved_rows['error'].max():.2%} at most; closure {solved_rows['closure'].max():.2%} at most. "
        f"{f'The others took {others.max():.1f} s at most. ' if len(others) else ''}{tables.machine()}."
    )


if __name__ == "__main__":
    main()
