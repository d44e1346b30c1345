"""Kills, full disks, damaged files, a lost memory, two runs at once: nothing wrong is taken for a result."""

from __future__ import annotations

import contextlib
import ctypes
import os
import random
import resource
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import psutil
import pytest
import xarray as xr
from project_copy import MINIMAL, Project

from rubfric.results.dataset import load

pytestmark = pytest.mark.thorough

PATIENCE = 300.0  # s
TARGETS = ("tables", "marches")
# Five scenes and a march of 48 steps.
TINY = """
results: results/tiny
multiscale: sum
road: two
roads:
  two:
    - {amplitude: 0.015, wavenumber: 35}
    - {amplitude: 0.006, wavenumber: 80}
grid: {velocities: [100], pressures: [0.5, 5]}
aspect_study: {aspects: [0.5], scales: [1], pressures: [5]}
transient: {columns: 16}
figures: {fields: {velocities: [100], pressures: [5]}}
"""
CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, PR_CAPBSET_DROP = 1, 2, 24


@pytest.fixture(scope="module")
def calm(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The campaign, undisturbed. Not to be changed."""
    project = Project.from_source(tmp_path_factory.mktemp("calm"), options=(*MINIMAL, "tiny.yaml"))
    (project.root / "tiny.yaml").write_text(TINY)
    project.run(*TARGETS)
    return project


@pytest.fixture
def victim(calm: Project, tmp_path: Path) -> Project:
    """A copy of the complete campaign, free to be damaged."""
    return calm.copy(tmp_path / "victim")


@pytest.fixture
def blank(victim: Project) -> Project:
    """The campaign without results and without Snakemake's memory."""
    subprocess.run(["rm", "-r", "results", ".snakemake"], cwd=victim.root, check=True)
    return victim


def numbers(project: Project) -> dict[str, xr.Dataset]:
    """Return all results but the wall times, which no two runs share."""
    files = sorted(project.results.rglob("[!.]*.nc"))
    return {str(path.relative_to(project.root)): load(path).drop_vars("wall_time") for path in files}


def assert_same(project: Project, calm: Project) -> None:
    """Check that two campaigns have the same results, bit for bit."""
    found, expected = numbers(project), numbers(calm)
    assert found.keys() == expected.keys()
    assert len(expected) == 5 + 1 + 1
    for name, result in found.items():
        xr.testing.assert_identical(result, expected[name])
    assert project.tables == calm.tables
    assert len(calm.tables) == 3


def written(logs: Path) -> dict[Path, int]:
    """Return when the logs of jobs were written."""
    return {path: path.stat().st_mtime_ns for path in logs.rglob("*.log") if path.name != "run.log"}


@contextlib.contextmanager
def running(project: Project) -> Iterator[subprocess.Popen[bytes]]:
    """Run the campaign in the background, from its first job on, in a group of processes of its own."""
    logs = project.results / "logs"
    before = written(logs)
    with (project.root / "said").open("wb") as said:
        process = subprocess.Popen(
            project.command(*TARGETS),
            cwd=project.root,
            env=project.environment,
            stdout=said,
            stderr=said,
            start_new_session=True,
        )
    try:
        deadline = time.monotonic() + PATIENCE
        while written(logs) == before:
            assert process.poll() is None, (project.root / "said").read_text()
            assert time.monotonic() < deadline
            time.sleep(0.005)
        yield process
        process.wait(PATIENCE)
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(PATIENCE)


def workers(process: subprocess.Popen[bytes]) -> list[psutil.Process]:
    """Return the processes that do the jobs of a run: the forks of its fork server."""
    servers = [child for child in psutil.Process(process.pid).children() if "forkserver" in " ".join(child.cmdline())]
    return [worker for server in servers for worker in server.children()]


def test_kills_at_any_moment_change_no_number(blank: Project, calm: Project) -> None:
    chance = random.Random(2019)
    for victims in ("worker", "everything", "worker"):
        for made in list(blank.results.rglob("[!.]*.nc"))[:2] if blank.results.is_dir() else ():
            made.unlink()  # on a fast machine the run before may have left nothing to do
        with running(blank) as process:
            time.sleep(chance.uniform(0.0, 0.8))
            if victims == "everything":
                os.killpg(process.pid, signal.SIGKILL)
            elif found := workers(process):
                with contextlib.suppress(psutil.NoSuchProcess):
                    chance.choice(found).kill()
        said = (blank.root / "said").read_text()
        if victims == "worker" and process.returncode:
            assert "the job's process died before it could say why; most likely it was killed" in said
            assert "run again, with fewer jobs at a time (-j1)" in said
        assert "Traceback" not in said
        for path in blank.results.rglob("[!.]*.nc"):
            load(path)  # what exists is whole
        if victims == "everything":
            blank.run("--unlock")
    blank.run(*TARGETS)
    assert_same(blank, calm)
    assert blank.plan(*TARGETS).jobs == {}


def refused(project: Project, prepare: Callable[[], None]) -> str:
    """Run the campaign, which must fail without a traceback, from a process prepared so; return what it said."""
    done = subprocess.run(
        project.command(*TARGETS),
        cwd=project.root,
        env=project.environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE,
        preexec_fn=prepare,
    )
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    return done.stderr


def test_files_that_may_not_grow_are_reported_and_nothing_is_left_of_them(blank: Project, calm: Project) -> None:
    # Logs and Snakemake's records are smaller, results larger.
    said = refused(blank, lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (30000, 30000)))
    assert "NotWritten: results/tiny/" in said
    assert "could not be written, since files may not grow so large: raise that limit (ulimit -f unlimited)" in said
    assert not list(blank.results.rglob("*.nc"))
    assert not list(blank.results.rglob("*.part"))
    blank.run(*TARGETS)
    assert_same(blank, calm)


def bind_by_permissions() -> None:
    """Give up what lets the superuser write everywhere, in this process and in those it starts."""
    if os.geteuid() == 0:
        library = ctypes.CDLL(None, use_errno=True)
        for capability in (CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH):
            if library.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0):
                raise OSError(ctypes.get_errno(), "capability")


@contextlib.contextmanager
def read_only(folder: Path) -> Iterator[None]:
    folders = [folder, *(path for path in folder.rglob("*") if path.is_dir())]
    for path in folders:
        path.chmod(0o555)
    try:
        yield
    finally:
        for path in folders:
            path.chmod(0o755)


def test_results_that_are_read_only_stop_the_campaign_before_any_job(victim: Project) -> None:
    victim.scene_files["scale2_v100_p5_aspect0.75_stress"].unlink()
    logs = {path: path.stat().st_mtime_ns for path in victim.results.rglob("*.log")}
    with read_only(victim.results):
        said = refused(victim, bind_by_permissions)
    assert "results/tiny could not be written, since nothing can be written there: make that place writable" in said
    assert {path: path.stat().st_mtime_ns for path in victim.results.rglob("*.log")} == logs


def test_project_that_is_read_only_and_file_in_place_of_results_are_said_at_once(victim: Project) -> None:
    with read_only(victim.root):
        said = refused(victim, bind_by_permissions)
    assert "No results can be made: .snakemake could not be written, since nothing can be written there" in said
    victim.results.rename(victim.root / "results" / "elsewhere")
    victim.results.touch()
    said = refused(victim, lambda: None)
    assert (
        "No results can be made: results/tiny could not be written, since a file stands where a folder belong" in said
    )


def test_second_run_at_once_is_told_and_harms_nothing(blank: Project, calm: Project) -> None:
    with running(blank) as first:
        os.killpg(first.pid, signal.SIGSTOP)  # else it might end before the second has begun
        second = blank.snakemake(*TARGETS)
        assert first.poll() is None
        os.killpg(first.pid, signal.SIGCONT)
    assert second.returncode == 1
    assert "LockException" in second.stderr
    assert "make sure that no other Snakemake process is trying to create the same files" in second.stderr
    assert first.returncode == 0
    assert_same(blank, calm)


def test_damaged_scenes_are_all_named_with_the_way_out_and_a_damaged_march_begins_afresh(
    victim: Project, calm: Project
) -> None:
    (march,) = victim.results.glob("marches/*/*/*.nc")
    march.unlink()
    checkpoint = march.with_name(f".{march.name}.checkpoint")
    checkpoint.write_bytes(b"PK\x03\x04 and then nothing")
    damaged = [path for name, path in victim.scene_files.items() if "p5" in name]
    assert len(damaged) == 3
    for path, length in zip(damaged, (0, 1000, path_size(damaged[2]) - 1), strict=True):
        os.truncate(path, length)
    said = refused(victim, lambda: None)
    listed = said.partition("delete them all and run again: ")[2].partition(" (log")[0]
    assert sorted(listed.split()[1:]) == sorted(str(path.relative_to(victim.root)) for path in damaged)
    subprocess.run(listed.split(), cwd=victim.root, check=True)
    victim.run(*TARGETS)
    assert_same(victim, calm)
    assert not checkpoint.exists()
    (log,) = victim.results.glob("logs/marches/*/*/*.log")
    assert "starting from the beginning" in log.read_text()


def path_size(path: Path) -> int:
    return path.stat().st_size


def test_damaged_collection_is_named_with_the_way_out(victim: Project) -> None:
    os.truncate(victim.results / "campaign.nc", 20000)
    (victim.results / "tables" / "friction_total.csv").unlink()
    said = refused(victim, lambda: None)
    assert "BrokenResult: results/tiny/campaign.nc cannot be read" in said
    assert "delete it and run again" in said


def test_lost_memory_repeats_no_work_and_takes_no_other_scene_for_a_result(victim: Project, calm: Project) -> None:
    records = victim.root / ".snakemake" / "metadata"
    for record in records.iterdir():
        record.write_bytes(b"\xff\xfe")
    said = refused(victim, lambda: None)
    assert "is damaged: delete all of them (rm -r .snakemake/metadata) and run again" in said
    subprocess.run(["rm", "-r", ".snakemake/metadata"], cwd=victim.root, check=True)
    assert victim.plan(*TARGETS).jobs == {}
    victim.configure("rubber", "soft", "tiny.yaml")
    soft = {"youngs_modulus": 4.0, "poissons_ratio": 0.4, "shear_fractions": [0.5], "relaxation_times": [1.0e-4]}
    victim.configure("rubbers", {"soft": soft}, "tiny.yaml")
    (victim.results / "scenes" / "zhou2019").rename(victim.results / "scenes" / "soft")
    said = refused(victim, lambda: None)
    assert "is the result of another scene, rubber or numerics than the config asks for" in said
    listed = said.partition("delete them all and run again: ")[2].partition(" (log")[0]
    assert len(listed.split()) == 1 + 5
    subprocess.run(listed.split(), cwd=victim.root, check=True)
    victim.run("tables")
    assert victim.tables.keys() == calm.tables.keys()
    assert victim.tables != calm.tables
