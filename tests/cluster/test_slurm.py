"""The campaign on a real SLURM cluster of one node: the same numbers as here, kills and interruptions included."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from functools import partial

import pandas as pd
import psutil
import pytest
import xarray as xr
from on_cluster import OnCluster
from project_copy import Project

from rubfric.results.dataset import load

PATIENCE = 300.0  # s
SCENES, WHOLE, BATCHES, READINGS, MARCHES, TABLES = 18, 4, 3, 2, 1, 5
# Round-off, since the node of a cluster may have another processor: 1e-9 of a value, or of its unit.
TOLERANCE = 1e-9
SUBMITTED = "has been submitted with SLURM jobid"


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The campaign, run without a cluster."""
    project = Project.from_source(tmp_path_factory.mktemp("here"))
    project.run()
    return project


@pytest.fixture(scope="module")
def survivor(on_cluster: Callable[[str], OnCluster]) -> OnCluster:
    """The campaign, run on the cluster; one of its batches was killed on the node."""
    project = on_cluster("survivor")
    with running(project) as process:
        until(lambda: project.scene_files, process)
        batches_on_the_node(project)[0].kill()
    assert process.returncode == 0, said(project)
    return project


@contextlib.contextmanager
def running(project: OnCluster, *targets: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run the campaign on the cluster in the background, what Snakemake says in the file ``said``."""
    with (project.root / "said").open("wb") as words:
        process = subprocess.Popen(
            project.command(*targets), cwd=project.root, env=project.environment, stdout=words, stderr=words
        )
    try:
        yield process
        process.wait(PATIENCE)
    finally:
        process.kill()
        process.wait(PATIENCE)


def said(project: OnCluster) -> str:
    return (project.root / "said").read_text()


def until(what: Callable[[], object], process: subprocess.Popen[bytes] | None = None) -> None:
    """Wait for something while a process runs."""
    deadline = time.monotonic() + PATIENCE
    while not what():
        assert process is None or process.poll() is None, "the campaign ended too early"
        assert time.monotonic() < deadline
        time.sleep(0.05)


def batches_on_the_node(project: OnCluster) -> list[psutil.Process]:
    """Return the Snakemake processes that run batches of scenes on the node."""
    found = []
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            words = process.cmdline()
            if "remote" in words and f"{project.root}/Snakefile" in words and any("scene:" in word for word in words):
                found.append(process)
    return found


def has_scenes(project: Project, number: int) -> bool:
    return len(project.scene_files) >= number


def ages(project: Project) -> dict[str, int]:
    return {name: path.stat().st_mtime_ns for name, path in project.scene_files.items()}


def test_killed_batch_is_run_again_and_nothing_else(survivor: OnCluster) -> None:
    assert said(survivor).count("Trying to restart job") == 1
    assert said(survivor).count(SUBMITTED) == BATCHES + READINGS + MARCHES + 1


def test_numbers_are_those_of_a_run_without_a_cluster(survivor: OnCluster, here: Project) -> None:
    files = [path.relative_to(here.results) for path in here.results.rglob("[!.]*.nc")]
    assert len(files) == SCENES + WHOLE + MARCHES + 2
    for file in files:
        one, other = (load(project.results / file).drop_vars("wall_time") for project in (survivor, here))
        xr.testing.assert_allclose(one, other, rtol=TOLERANCE, atol=TOLERANCE)
    assert survivor.tables == here.tables
    assert len(here.tables) == TABLES
    one, other = (pd.read_csv(project.results / "tables" / "claims_evidence.csv") for project in (survivor, here))
    pd.testing.assert_frame_equal(one, other, rtol=1e-5)  # written with six digits


def test_what_ran_on_the_node_is_remembered(survivor: OnCluster) -> None:
    assert survivor.here.plan().jobs == {}
    survivor.here.comment("rubfric/mechanics/block/contact.py")
    assert survivor.here.plan().jobs["scene"] == SCENES


def test_interrupted_run_goes_on_with_what_is_missing(on_cluster: Callable[[str], OnCluster], here: Project) -> None:
    project = on_cluster("interrupted")
    for how, most in ((signal.SIGINT, 3), (signal.SIGKILL, 7)):
        before = ages(project)
        with running(project, "tables") as process:
            until(partial(has_scenes, project, most), process)
            process.send_signal(how)
        if process.returncode == 0:  # on a slow node everything may be done before the signal comes
            assert len(project.scene_files) == SCENES
            break
        if how is signal.SIGKILL:  # nobody else takes the batches back
            project.cancel_all()
            project.here.run("--unlock")
        until(lambda: not project.queue())
        assert len(project.scene_files) < SCENES
        # What was being written, one scene in each batch, may be made again.
        kept = ages(project).items() & before.items()
        assert len(kept) >= len(before) - BATCHES
    before = ages(project)
    done = project.snakemake("tables")
    assert done.returncode == 0, done.stderr
    assert len(ages(project).items() & before.items()) >= len(before) - BATCHES
    assert project.tables == here.tables
    assert ages(project).keys() == ages(here).keys()
