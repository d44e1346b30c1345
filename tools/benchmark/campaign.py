"""Time the default campaign at -j2 beside its floor, all measured in this run.

The floor is half the CPU time of all its jobs, as their logs say it, plus the same DAG with jobs that only touch their
outputs.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import tables

from rubfric.markdown import markdown_table
from rubfric.runner.times import costs, shares

PROJECT = Path(__file__).resolve().parents[2]
# Replaces rubfric/runner/jobs.py: a job that only touches its outputs.
TOUCH = """
from pathlib import Path

def warm_up():
    pass

def seconds(log):
    return None

def run(script, log, **arguments):
    outputs = arguments.get("outputs")
    if isinstance(outputs, dict):
        outputs = outputs.values()
    names = ("output", "mark", "page", "points", "rejected", "curves", "peaks")
    for path in outputs or [arguments[name] for name in names if name in arguments]:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).touch()
"""


def copy_project(folder: Path) -> Path:
    """Copy what the workflow needs."""
    target = folder / "project"
    target.mkdir()
    for name in ("Snakefile", "workflow", "rubfric", "config", "profiles"):
        source = PROJECT / name
        if source.is_dir() and not source.is_symlink():
            shutil.copytree(source, target / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, target / name, follow_symlinks=False)
    return target


def snakemake(project: Path) -> float:
    """Run the campaign in a copy of the project and return its wall time, s."""
    environment = os.environ | {"PYTHONPATH": str(project)}
    started = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "-j2"], cwd=project, env=environment, capture_output=True, text=True
    )
    elapsed = time.perf_counter() - started
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    return elapsed


def measure() -> tuple[float, float, dict[str, tuple[int, float, float]]]:
    """Return wall times of campaign and of its DAG alone, s, and number, CPU time and share of its kinds of jobs."""
    with tempfile.TemporaryDirectory() as name:
        project = copy_project(Path(name))
        whole = snakemake(project)
        cost = shares(costs(project / "results/logs"))
        shutil.rmtree(project / "results")
        shutil.rmtree(project / ".snakemake")
        (project / "rubfric/runner/jobs.py").write_text(TOUCH, encoding="utf-8")
        return whole, snakemake(project), cost


def main() -> None:
    """Measure, print and publish."""
    number = tables.options(__doc__).rounds
    rounds = [measure() for _ in range(number)]
    floors = [sum(cpu for _, cpu, _ in cost.values()) / 2.0 + touching for _, touching, cost in rounds]
    ratios = sorted(whole / floor for (whole, _, _), floor in zip(rounds, floors, strict=True))
    # The round in the middle.
    (whole, touching, cost), floor = sorted(zip(rounds, floors, strict=True), key=lambda each: each[0][0])[number // 2]
    wall: list[tuple[str, ...]] = [
        ("default campaign, `snakemake -j2`", "wall time"),
        ("from nothing", f"{whole:.1f} s"),
        ("floor: half the jobs' CPU time, and the same DAG with jobs that only touch", f"{floor:.1f} s"),
        ("- of it the DAG", f"{touching:.1f} s"),
        ("campaign over floor, round by round", ", ".join(f"{ratio:.2f}" for ratio in ratios)),
    ]
    where: list[tuple[str, ...]] = [("jobs, by the folder of their logs", "number", "CPU time", "share")]
    where += [(kind, f"{many}", f"{cpu:.1f} s", f"{share:.0%}") for kind, (many, cpu, share) in cost.items()]
    both = f"{markdown_table(wall, numeric=True)}\n\n{markdown_table(where, numeric=True)}"
    text = f"{both}\n\n{tables.times(number).capitalize()}. {tables.machine()}."
    print(text)
    tables.publish("campaign", text, "performance.md")


if __name__ == "__main__":
    main()
