"""A run killed or interrupted half-way: what exists is whole, and the next run finishes it."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time

import pytest
from project_copy import Project

from rubfric.results.dataset import read
from rubfric.results.scalars import SCALARS

pytestmark = pytest.mark.thorough

PATIENCE = 120.0  # s


def stop_when_some_scenes_exist(project: Project, how: signal.Signals) -> int:
    """Start the campaign, send a signal to all its processes as soon as a few results are there; return its exit."""
    with subprocess.Popen(
        project.command(),
        cwd=project.root,
        env=project.environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as running:
        deadline = time.monotonic() + PATIENCE
        try:
            while len(project.scene_files) < 4:
                assert running.poll() is None, "the campaign ended before it could be killed"
                assert time.monotonic() < deadline, "no scene was finished in time"
                time.sleep(0.005)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(running.pid, how)
        return running.wait(PATIENCE)


def assert_whole(project: Project) -> None:
    """Check every result that exists; what was being written may be left under a hidden name only."""
    assert not list(project.results.rglob("[!.]*.part"))
    for name, path in project.scene_files.items():
        result = read(path)
        assert result.attrs["scene"] == name
        assert set(SCALARS) <= set(result.data_vars)


@pytest.fixture(scope="module")
def killed(tmp_path_factory: pytest.TempPathFactory) -> Project:
    project = Project.from_source(tmp_path_factory.mktemp("killed"))
    assert stop_when_some_scenes_exist(project, signal.SIGKILL) == -signal.SIGKILL
    return project


def test_run_was_killed_half_way(killed: Project) -> None:
    assert 4 <= len(killed.scene_files) < 18
    assert not killed.tables


def test_every_result_that_exists_is_whole(killed: Project) -> None:
    assert_whole(killed)


def test_next_run_keeps_what_is_finished(killed: Project) -> None:
    plan = killed.plan("--nolock")
    made = {name for name in killed.scene_files if name not in plan.scenes}
    assert plan.scenes | made == set(killed.campaign.scenes())
    assert len(made) >= 2  # a result whose job had not been noted as finished may be made again


def test_lock_is_explained_and_the_next_run_finishes(killed: Project, template: Project) -> None:
    locked = killed.snakemake()
    assert locked.returncode == 1
    assert "LockException" in locked.stderr
    assert "--unlock" in locked.stderr
    assert "Traceback" not in locked.stderr
    killed.run("--unlock")
    killed.run()
    assert killed.tables == template.tables
    assert set(killed.scene_files) == set(template.scene_files)
    assert killed.plan().jobs == {}


def test_interrupted_run_needs_no_unlocking(empty_project: Project) -> None:
    assert stop_when_some_scenes_exist(empty_project, signal.SIGINT) == 1
    missing = set(empty_project.campaign.scenes()) - set(empty_project.scene_files)
    assert missing
    assert_whole(empty_project)
    one = min(missing)
    empty_project.run(f"results/minimal/scenes/zhou2019/zhou2019/{one}.nc")
    assert one in empty_project.scene_files
    assert_whole(empty_project)
