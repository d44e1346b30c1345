"""Every way into the workflow plans and makes the same jobs, in a folder that holds no more than a config."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from project_copy import SOURCE, Plan

from rubfric.config.campaign import Campaign, load

# One scale, two scenes, nothing of the whole road or of other readings.
MINE = """\
results: out
multiscale: sum
road: one
roads: {one: [{amplitude: 0.015, wavenumber: 35}]}
grid: {velocities: [1, 100], pressures: [0.5]}
aspect_study: {aspects: [0.75], pressures: [0.5], scales: [1]}
transient: {scale: 1, velocities: [100], pressure: 0.5, columns: 32, steps_per_wavelength: 16, wavelengths: 2}
claims: {compare: []}
figures: {total_pressure: 0.5, fields: {scale: 1, velocities: [1, 100], pressures: [0.5]}}
rig: {pressures: [0.5], speeds: [1, 100]}
numerics: {preset: draft}
"""
MODULE = """\
{first}
module rubfric:
    snakefile: "{source}/workflow/Snakefile"
{options}
use rule * from rubfric{name}
"""
SNAKEFILES = {
    "module": MODULE.format(first="", source=SOURCE, options="", name=""),
    "its config passed in": MODULE.format(
        first='configfile: "mine.yaml"', source=SOURCE, options="    config: config", name=""
    ),
    "other names, a prefix, a part of the config": MODULE.format(
        first="", source=SOURCE, options='    config: config["rubber"]\n    prefix: "below"', name=" as soft_*"
    ),
}


@pytest.fixture
def campaign(tmp_path: Path) -> Campaign:
    (tmp_path / "mine.yaml").write_text(MINE)
    return load(SOURCE / "config" / "config.yaml", tmp_path / "mine.yaml")


def snakemake(folder: Path, *arguments: str) -> str:
    """Run Snakemake in a folder, which must succeed; return what it said."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("SNAKEMAKE")}
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "2", *arguments],
        cwd=folder,
        env=environment | {"PYTHONPATH": str(SOURCE), "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def planned(folder: Path, *arguments: str) -> dict[str, int]:
    """Return the number of jobs by rule that a dry run names, without what a module puts before a name."""
    jobs = Plan.read(snakemake(folder, "-n", "--quiet", "host", *arguments)).jobs
    return {rule.removeprefix("soft_"): count for rule, count in jobs.items() if rule != "soft_all"}


def assert_whole(jobs: dict[str, int], campaign: Campaign) -> None:
    once = {"campaign", "total_table", "explorer"}
    assert {rule: jobs.get(rule) for rule in ("scene", "march", "scale_table")} == {
        "scene": len(campaign.scenes()),
        "march": len(campaign.marches()),
        "scale_table": 1,
    }
    assert {rule: jobs.get(rule) for rule in once} == dict.fromkeys(once, 1)


def test_snakefile_is_run_from_a_folder_of_the_user(tmp_path: Path, campaign: Campaign) -> None:
    jobs = planned(tmp_path, "-s", str(SOURCE / "Snakefile"), "--configfile", "mine.yaml")
    assert_whole(jobs, campaign)


@pytest.mark.thorough
@pytest.mark.parametrize("way", ["workflow/Snakefile", "its own folder", "another directory"])
def test_every_entry_plans_the_same_jobs(tmp_path: Path, campaign: Campaign, way: str) -> None:
    mine = ("--configfile", str(tmp_path / "mine.yaml"))
    if way == "its own folder":  # which has results of its own, but none of this config
        jobs = planned(SOURCE, *mine, "--config", f"results={tmp_path}/out", "--nolock")
    elif way == "another directory":
        jobs = planned(SOURCE, *mine, "--directory", str(tmp_path / "elsewhere"))
    else:
        jobs = planned(tmp_path, *mine, "-s", str(SOURCE / way))
    assert_whole(jobs, campaign)


@pytest.mark.parametrize(
    "way",
    [
        pytest.param("module", marks=pytest.mark.thorough),
        pytest.param("its config passed in", marks=pytest.mark.thorough),
        "other names, a prefix, a part of the config",
    ],
)
def test_module_plans_the_same_jobs(tmp_path: Path, campaign: Campaign, way: str) -> None:
    text = SNAKEFILES[way]
    if 'config["rubber"]' in text:
        (tmp_path / "theirs.yaml").write_text("rubber:\n" + "".join(f"  {line}\n" for line in MINE.splitlines()))
    (tmp_path / "Snakefile").write_text(text)
    given = {"module": ("--configfile", "mine.yaml"), "its config passed in": ()}.get(
        way, ("--configfile", "theirs.yaml")
    )
    assert_whole(planned(tmp_path, *given), campaign)


@pytest.mark.thorough
def test_module_runs_with_names_and_prefix_and_reports_as_the_workflow_does(tmp_path: Path, campaign: Campaign) -> None:
    theirs = """
rule mine:
    default_target: True
    input: rules.soft_all.input
    output: "mine.txt"
    shell: "touch {output}"
"""
    text = MODULE.format(
        first='configfile: "mine.yaml"',
        source=SOURCE,
        options='    config: config\n    prefix: "below"',
        name=" as soft_*",
    )
    (tmp_path / "Snakefile").write_text(text + theirs)
    said = snakemake(tmp_path, "--force-use-threads")
    results = tmp_path / "below" / "out"
    assert (tmp_path / "mine.txt").exists()
    assert not (tmp_path / "out").exists()
    assert {path.stem for path in results.glob("scenes/*/*/*.nc")} == set(campaign.scenes())
    assert (results / "explorer.html").exists()
    log = (results / "logs" / "run.log").read_text()
    assert "  Done in " in log
    assert "Done in " in said
    assert log.count("\n  Done") == 1
    assert planned(tmp_path) == {}


@pytest.mark.thorough
def test_first_rule_of_a_workflow_around_it_stays_the_target(tmp_path: Path, campaign: Campaign) -> None:
    around = 'rule theirs:\n    output: "theirs.txt"\n    shell: "touch {output}"\n\n' + SNAKEFILES["module"]
    (tmp_path / "Snakefile").write_text(around)
    assert planned(tmp_path, "--configfile", "mine.yaml") == {"theirs": 1}
