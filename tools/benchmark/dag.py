"""Time how long Snakemake plans campaigns of many scenes: from nothing, up to date, and one scene of them.

The scenes are those of a finer grid. None is simulated: their results are empty files, and Snakemake is made to write
the records that it would have written after each.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tables
import yaml
from campaign import copy_project

from rubfric.config.campaign import Campaign, load
from rubfric.markdown import markdown_table

SIZES = (1_000, 10_000, 30_000)
PRESSURES = 10
OVERLAY = "many.yaml"
# At the end of the copy's Snakefile: what Snakemake does after a job, for every scene, and nothing else.
REMEMBER = """

onstart:
    for job in workflow.dag.needrun_jobs():
        if job.rule.name == "scene":
            workflow.async_run(workflow.persistence.finished(job))
    os._exit(0)
"""


@dataclass(frozen=True)
class Cost:
    """Wall time and processor time in s, and most memory held in MB, of a run of Snakemake that may find all done."""

    wall: float
    processor: float
    memory: float
    idle: bool


def grid(scenes: int) -> dict[str, object]:
    """Return a config of so many scenes, on the four scales of the paper's road, over its speeds and pressures."""
    velocities = np.geomspace(0.1, 1e4, scenes // (4 * PRESSURES)).tolist()
    pressures = np.geomspace(0.1, 5.0, PRESSURES).tolist()
    return {
        "results": "results/many",
        "grid": {"velocities": velocities, "pressures": pressures, "aspect": 0.75},
        "aspect_study": {"aspects": [0.75], "scales": [1], "pressures": pressures[-1:]},
        "figures": {
            "total_pressure": pressures[-1],
            "fields": {"scale": 1, "velocities": velocities[:1], "pressures": pressures[-1:]},
        },
    }


def snakemake(project: Path, *arguments: str) -> Cost:
    """Run Snakemake on the many scenes, which must succeed, and return what that cost and whether all was done."""
    command = [sys.executable, "-m", "snakemake", *arguments, "--quiet", "rules", "--configfile", OVERLAY]
    with tempfile.TemporaryFile() as said:
        started = time.perf_counter()
        environment = os.environ | {"PYTHONPATH": str(project)}
        process = subprocess.Popen(command, cwd=project, env=environment, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - started
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode()
        if process.returncode:
            raise SystemExit(text)
    # Linux gives kilobytes, macOS bytes.
    memory = used.ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)
    return Cost(wall, used.ru_utime + used.ru_stime, memory, "Nothing to be done" in text)


def scene_files(campaign: Campaign) -> list[str]:
    """Return where the results of all scenes belong."""
    folder = f"{campaign.results}/scenes/{campaign.material.name}/{campaign.road_name}"
    return [f"{folder}/{name}.nc" for name in campaign.scenes()]


def measure(scenes: int) -> dict[str, Cost]:
    """Return what it costs to plan a campaign of so many scenes, by what there is to plan."""
    with tempfile.TemporaryDirectory() as name:
        project = copy_project(Path(name))
        (project / OVERLAY).write_text(yaml.safe_dump(grid(scenes)), encoding="utf-8")
        campaign = load(project / "config/config.yaml", project / OVERLAY)
        files = scene_files(campaign)
        if len(files) != scenes:
            raise SystemExit(f"the grid has {len(files)} scenes, but was to have {scenes}")
        costs = {
            what: snakemake(project, target, "-n")
            for what, target in (("from nothing", "scenes"), ("one scene", files[0]))
        }
        (project / files[0]).parent.mkdir(parents=True)
        for file in files:
            (project / file).touch()
        snakefile = project / "Snakefile"
        text = snakefile.read_text(encoding="utf-8")
        snakefile.write_text(text + REMEMBER, encoding="utf-8")
        costs["remembered"] = snakemake(project, "scenes", "--forceall", "--nolock", "--cores", "1")
        snakefile.write_text(text, encoding="utf-8")
        costs["up to date"] = snakemake(project, "scenes", "-n")
        if [what for what, cost in costs.items() if cost.idle] != ["up to date"]:
            raise SystemExit("Snakemake takes something for done that is not, or for undone what is done")
        return costs


def main() -> None:
    """Measure, print and publish."""
    sizes = SIZES[: tables.options(__doc__, sizes=(len(SIZES), f"how many of the sizes {SIZES} to measure")).sizes]
    rows: list[tuple[str, ...]] = [
        ("scenes", "planned from nothing", "planned, all up to date", "planned, one scene of them", "memory")
    ]
    for scenes in sizes:
        costs = measure(scenes)
        cells = [f"{costs[what].processor:.1f} s" for what in ("from nothing", "up to date", "one scene")]
        most = max(cost.memory for cost in costs.values())
        rows.append((f"{scenes:,}".replace(",", " "), *cells, f"{most:.0f} MB"))
        print(rows[-1], {what: f"{cost.wall:.1f} s" for what, cost in costs.items()}, flush=True)
    note = f"Processor time of one run each, start-up included. {tables.machine()}."
    text = f"{markdown_table(rows, numeric=True)}\n\n{note}"
    print(text)
    tables.publish("dag", text, "performance.md")


if __name__ == "__main__":
    main()
