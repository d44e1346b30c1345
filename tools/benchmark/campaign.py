"""Time the default campaign at -j2 beside its floor, all measured in this run.

The floor is half the sum of the in-process times of the scenes, of those in other readings of the paper and of the
marches, plus the same DAG with jobs that only touch their outputs, plus drawing every figure of the simulation once.
The test rig, the verdicts and the page to explore are not in it.
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from importlib import import_module
from pathlib import Path

import tables

from rubfric.config.campaign import Campaign, load
from rubfric.marching import march
from rubfric.markdown import markdown_table
from rubfric.results.campaign import collect
from rubfric.results.dataset import read, write
from rubfric.results.march import build
from rubfric.scene.procedure import Procedure
from rubfric.simulation import simulate
from rubfric.studies.paper.observation import observe

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
    names = ("output", "mark", "page", "points", "rejected")
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


def in_process(campaign: Campaign, folder: Path) -> tuple[float, list[Path]]:
    """Return the sum of the scenes' times without start-up or files, s, and their results."""
    scenes = campaign.scenes()
    simulate(next(iter(scenes.values())))
    total, paths = 0.0, []
    for name, scene in scenes.items():
        started = time.perf_counter()
        result = simulate(scene)
        total += time.perf_counter() - started
        paths.append(folder / f"{name}.nc")
        write(result, paths[-1])
    return total, paths


def observing(campaign: Campaign) -> float:
    """Return the sum of the times of the scenes in other readings of the paper, s."""
    started = time.perf_counter()
    for name in campaign.claims.compare:
        for scene in campaign.reading(name).scenes().values():
            observe(scene)
    return time.perf_counter() - started


def marching(campaign: Campaign, folder: Path) -> float:
    """Return the sum of the marches' times without start-up or files, s."""
    procedure, total = Procedure(**campaign.transient.procedure()), 0.0
    for name, scene in campaign.marches().items():
        started = time.perf_counter()
        found = march(scene, procedure)
        total += time.perf_counter() - started
        steady = float(read(folder / f"{name}.nc")["friction_coefficient"])
        write(build(found, steady), folder / f"march_{name}.nc")
    return total


def drawing(campaign: Campaign, paths: list[Path], folder: Path) -> float:
    """Return the time to draw and save every figure once, s, imports excluded."""
    collected = collect(paths)
    fields = [read(folder / f"{name}.nc") for name in campaign.field_scenes()]
    study = campaign.aspect_study
    choice = {"scales": list(study.scales), "pressures": list(study.pressures), "aspects": list(study.aspects)}
    calls = {
        "fig1": (collected, choice),
        "fig2": (fields, {}),
        "fig3": (collected, choice),
        "fig4": (fields, {}),
        "fig5": ([read(folder / f"march_{name}.nc") for name in campaign.marches()], {}),
        "fig6": (collected, {"aspect": campaign.aspect}),
    }
    save = import_module("rubfric.figures.style").save
    draws = {name: import_module(f"rubfric.figures.{name}").draw for name in calls}
    save(draws["fig1"](collected, **choice), folder / "first.pdf", folder / "first.png")
    started = time.perf_counter()
    for name, (data, arguments) in calls.items():
        save(draws[name](data, **arguments), folder / f"{name}.pdf", folder / f"{name}.png")
    return time.perf_counter() - started


def measure(campaign: Campaign) -> tuple[float, ...]:
    """Return one round's times, s: the campaign, in-process its scenes, readings and marches, touching DAG, figures."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        project = copy_project(folder)
        whole = snakemake(project)
        shutil.rmtree(project / "results")
        shutil.rmtree(project / ".snakemake")
        (project / "rubfric/runner/jobs.py").write_text(TOUCH, encoding="utf-8")
        touching = snakemake(project)
        scenes, paths = in_process(campaign, folder)
        marches = marching(campaign, folder)
        return whole, scenes, observing(campaign), marches, touching, drawing(campaign, paths, folder)


def main() -> None:
    """Measure, print and publish."""
    number = tables.options(__doc__).rounds
    campaign = load(PROJECT / "config/config.yaml")
    rounds = [measure(campaign) for _ in range(number)]
    whole, scenes, readings, marches, touching, figures = (
        statistics.median(times) for times in zip(*rounds, strict=True)
    )
    floor = (scenes + readings + marches) / 2.0 + touching + figures
    ratios = sorted(each[0] / (sum(each[1:4]) / 2.0 + sum(each[4:])) for each in rounds)
    what = f"{len(campaign.scenes())} scenes, {len(campaign.marches())}"
    rows: list[tuple[str, ...]] = [
        ("default campaign, `snakemake -j2`", "wall time"),
        (f"{what} marches, tables, figures and pages, from nothing", f"{whole:.1f} s"),
        ("floor", f"{floor:.1f} s"),
        ("- half the sum of the scenes' in-process times", f"{scenes / 2.0:.1f} s"),
        ("- half the sum of those in other readings of the paper", f"{readings / 2.0:.1f} s"),
        ("- half the sum of the marches' in-process times", f"{marches / 2.0:.1f} s"),
        ("- the same DAG, jobs that only touch their outputs", f"{touching:.1f} s"),
        ("- drawing every figure once", f"{figures:.1f} s"),
        ("campaign over floor, round by round", ", ".join(f"{ratio:.2f}" for ratio in ratios)),
    ]
    text = f"{markdown_table(rows, numeric=True)}\n\n{tables.times(number).capitalize()}. {tables.machine()}."
    print(text)
    tables.publish("campaign", text, "performance.md")


if __name__ == "__main__":
    main()
