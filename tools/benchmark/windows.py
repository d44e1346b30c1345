"""Solve windows of measured profiles in finite strain, each scene from a cold start in a process of its own.

A line of the file of results (JSON) holds the CPU time of one scene, its peak memory, columns, friction and stated
error, or the sentence of its refusal. Lines that are there are not measured again: a run that was stopped goes on.

    python tools/benchmark/windows.py examples/own_road/street.csv --windows 1 --plane strain
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import argparse
import json
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import pandas as pd
import tables
from alone import child, measured

from rubfric.config.campaign import load
from rubfric.profile.analysis import Analysis, analyse
from rubfric.profile.cleaning import clean
from rubfric.profile.reading import read
from rubfric.results.road_friction import Block
from rubfric.rubber.material import PLANES

PROJECT = Path(__file__).resolve().parents[2]
LINES = PROJECT / "results/benchmark/windows.jsonl"
SPEEDS, PRESSURES = (1.0, 10.0, 100.0, 1e3, 1e4), (0.1, 0.2, 0.5, 1.0)


def main() -> None:
    """Measure what is missing, and print a summary of what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("profiles", nargs="*", type=Path, metavar="FILE", help="measured profiles")
    parser.add_argument("--plane", choices=PLANES, nargs="+", default=list(PLANES), help="(default: both)")
    for name, values, what in (("velocity", SPEEDS, "mm/s"), ("pressure", PRESSURES, "MPa")):
        parser.add_argument(f"--{name}", type=float, nargs="+", default=values, help=f"{what} (default: %(default)s)")
    parser.add_argument("--windows", type=int, default=1, metavar="N", help="of each profile (default: %(default)s)")
    for name, value, what in (
        ("window", 40.0, "its length, mm"),
        ("cutoff", 0.2, "shortest wavelength, mm"),
        ("height", 8.0, "of the block, mm"),
        ("accuracy", 0.01, "relative, of friction"),
    ):
        parser.add_argument(f"--{name}", type=float, default=value, metavar="X", help=f"{what} (default: %(default)s)")
    parser.add_argument("--budget", type=int, default=150, metavar="S", help="CPU seconds a scene (default: 150)")
    parser.add_argument("--lines", type=Path, default=LINES, help="where the lines go (default: %(default)s)")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.one:
        print(json.dumps(solved(json.loads(asked.one))))
        return
    about = {"window_mm": asked.window, "cutoff_mm": asked.cutoff, "height": asked.height, "accuracy": asked.accuracy}
    wanted = [
        {"profile": str(profile), "window": number, "plane": plane, "velocity": velocity, "pressure": pressure} | about
        for plane, profile, number, velocity, pressure in product(
            *(asked.plane, asked.profiles, range(1, asked.windows + 1), asked.velocity, asked.pressure)
        )
    ]
    asked.lines.parent.mkdir(parents=True, exist_ok=True)
    written = asked.lines.read_text(encoding="utf-8").splitlines() if asked.lines.exists() else []
    known = {key(line): line for line in map(json.loads, written)}
    for point in wanted:
        if key(point) not in known:
            known[key(point)] = point | child([__file__, "--one", json.dumps(point)], asked.budget)
            with asked.lines.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps(known[key(point)]) + "\n")
    rows = pd.DataFrame([known[key(point)] for point in wanted]).reindex(columns=[*wanted[0], *MEASURED])
    for plane, part in rows.groupby("plane"):
        print(f"Plane {plane}: {summary(part)}")
    print(f"{tables.machine()}.")


MEASURED = ("cpu", "memory", "columns", "friction", "error", "contact", "refusal")


def key(line: dict[str, Any]) -> str:
    """Return what a scene is known by among the lines."""
    return json.dumps({name: value for name, value in line.items() if name not in MEASURED}, sort_keys=True)


@cache
def analysed(profile: str, window: float, cutoff: float) -> Analysis:
    """Return the analysis of a profile."""
    return analyse(clean(read(profile)), window, cutoff, 1)


def solved(point: dict[str, Any]) -> dict[str, Any]:
    """Return what is measured of one scene, solved in this process."""
    campaign = load(PROJECT / "config/config.yaml")
    road = analysed(point["profile"], point["window_mm"], point["cutoff_mm"]).road(point["window"])
    numerics = replace(campaign.numerics, accuracy=point["accuracy"])
    block = Block(campaign.material, point["height"], point["plane"], "finite", numerics)
    scene = block.scene(road, point["velocity"], point["pressure"])
    row, result = measured(scene)
    if result is not None:
        row["contact"] = float(result["contact_fraction"])
    return row


def summary(rows: pd.DataFrame) -> str:
    """Return in words how long the scenes took, and how many were refused."""
    fine = rows[rows["refusal"].isna()]
    others = rows.drop(fine.index)
    words = (
        f"{len(fine)} of {len(rows)} scenes solved, {fine['cpu'].median():.1f} s of CPU time at the median, "
        f"{fine['cpu'].max():.1f} s at most; peak memory {rows['memory'].max():.0f} MB at most; stated error "
        f"{fine['error'].median():.2%} at the median, {fine['error'].max():.2%} at most."
    )
    if len(others):
        words += f" {len(others)} were refused, after {others['cpu'].median():.1f} s at the median and "
        words += f"{others['cpu'].max():.1f} s at most."
    return words


if __name__ == "__main__":
    main()
