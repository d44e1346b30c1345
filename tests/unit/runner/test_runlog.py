"""The short log of a run, from records such as Snakemake's."""

from __future__ import annotations

import io
import logging
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake_interface_logger_plugins.common import LogEvent

from rubfric import streams
from rubfric.runner import runlog
from rubfric.runner.runlog import RunLog, attach

STATS = {"scene": 3, "total_table": 1, "all": 1, "total": 5}


class Snakemake:
    """Sends the records that Snakemake would send."""

    def __init__(self) -> None:
        self.logger = logging.Logger("snakemake")
        self.said = io.StringIO()
        self.logger.addHandler(logging.StreamHandler(self.said))

    def send(self, event: str | None, message: str | None = None, **about: Any) -> None:
        extra = about if event is None else about | {"event": LogEvent[event]}
        self.logger.info(message, extra=extra)

    def start(
        self, job: int, scene: str | None = None, rule: str = "scene", message: str | None = None, output: str = ""
    ) -> None:
        about = {"rule_name": rule, "rule_msg": scene or message, "log": [f"logs/{job}.log"], "output": [output]}
        self.send("JOB_INFO", "job info", jobid=job, **about)

    def finish(self, job: int) -> None:
        self.send("JOB_FINISHED", f"Finished jobid: {job}", job_id=job)

    def fail(self, job: int, **aux: str) -> None:
        self.send("JOB_ERROR", "job error", jobid=job, log=[f"logs/{job}.log", *aux.values()], aux=aux)


@pytest.fixture
def snakemake() -> Snakemake:
    return Snakemake()


class Run:
    """A run log, what it said and what it wrote."""

    def __init__(self, folder: Path, snakemake: Snakemake, **options: Any) -> None:
        self.stream = io.StringIO()
        self.folder = folder
        given = {"targets": ["all"], "stream": self.stream} | options
        self.log = RunLog(str(folder), **given)
        attach(self.log, snakemake.logger, silence=True)

    @property
    def said(self) -> list[str]:
        """What was said; how long the run took is replaced by T."""
        return re.sub(r"(Done in|Stopped after) [\d.]+ s", r"\1 T", self.stream.getvalue()).splitlines()

    @property
    def written(self) -> list[str]:
        path = self.folder / "logs" / "run.log"
        return path.read_text().splitlines() if path.exists() else []


@pytest.fixture
def run(tmp_path: Path, snakemake: Snakemake) -> Iterator[Run]:
    made = Run(tmp_path, snakemake)
    yield made
    made.log.close()


def test_it_opens_with_what_is_understood_and_how_long_it_takes(tmp_path: Path, snakemake: Snakemake) -> None:
    options = {"opening": lambda: ["a rubber"], "expected": lambda rule: 60.0, "at_once": lambda: 2}
    for made in (False, True):  # without a table nothing is removed
        run = Run(tmp_path / str(made), snakemake, **options, leftovers=lambda: ["removed: a table"])
        snakemake.send("RUN_INFO", "Job stats", stats={"total_table": 4})
        assert run.said == ["  a rubber", "  To do: 4 tables; about 2 min"]
        run.log.begin()
        assert run.written[1:] == run.said
        if made:
            snakemake.start(0, rule="total_table")
            snakemake.finish(0)
        run.log.succeed()
        assert ("  removed: a table" in run.said) == made
        snakemake.logger.removeHandler(run.log)


def test_plan_stages_and_end_are_reported(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    run.log.begin()
    for job, scene in enumerate(["a", "b", "c"]):
        snakemake.start(job, scene)
        snakemake.finish(job)
    (run.folder / "tables").mkdir()
    snakemake.start(3, rule="total_table", message="Friction of all scales: a path")
    snakemake.finish(3)
    snakemake.start(4, rule="all")
    snakemake.finish(4)
    run.log.succeed()
    assert run.said[0] == "  To do: 3 scenes, 1 table"
    assert run.said[1].startswith("  3 of 3 scenes; about 5 s left; slowest ")
    assert run.said[2] == "  Done in T: 3 scenes, 1 table"
    assert run.said[3].startswith("  slowest: ")
    assert run.said[4] == f"  tables are in {run.folder}/tables"
    assert len(run.said) == 5
    assert run.written[1:] == run.stream.getvalue().splitlines()


def test_file_gathers_runs_each_with_its_date(tmp_path: Path, snakemake: Snakemake) -> None:
    for _ in range(2):
        run = Run(tmp_path, snakemake)
        run.log.begin()
        run.log.succeed()
    heads = [line for line in run.written if not line.startswith(" ")]
    assert len(heads) == 2
    assert all(line.startswith(time.strftime("%Y-")) for line in heads)


def test_failure_is_reported_with_its_log(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    run.log.begin()
    snakemake.start(0, "a")
    snakemake.start(1, "b")
    snakemake.fail(0)
    snakemake.finish(1)
    assert len(run.said) == 1  # Snakemake reports what failed here
    run.log.fail()
    assert run.said[1:] == [
        "  Stopped after T: 1 failed; done: 1 scene",
        "  failed: a (log: logs/0.log)",
        "  what is done stays; running again makes the rest",
    ]


def test_failure_on_a_cluster_is_reported_at_once_and_forgotten_when_another_attempt_succeeds(
    run: Run, snakemake: Snakemake
) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    snakemake.start(0, "a")
    snakemake.fail(0, external_jobid="17.log")
    assert run.said[1:] == ["  failed: a (log: logs/0.log, 17.log)"]
    snakemake.start(0, "a")
    snakemake.finish(0)
    run.log.succeed()
    assert not [line for line in run.said[2:] if "failed" in line]


def test_group_that_failed_is_reported_at_once_and_its_jobs_at_the_end(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    for job, scene in enumerate(["a", "b"]):
        snakemake.start(job, scene)
    snakemake.send("GROUP_ERROR", "Error in group", groupid="g", aux_logs=["17.log"], job_error_info=[])
    for job in range(2):
        snakemake.fail(job)
    assert run.said[1:] == ["  failed: a group of jobs, or some of them (log: 17.log)"]
    run.log.fail()
    assert run.said[3:5] == ["  failed: a (log: logs/0.log)", "  failed: b (log: logs/1.log)"]


def test_many_failures_are_not_a_flood(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats={"scene": 224, "total": 224})
    for job in range(224):
        snakemake.start(job, f"scene{job}")
        snakemake.fail(job)
    run.log.fail()
    assert len(run.said) == 1 + 1 + 20 + 1 + 1
    assert f"  and 204 more: see {run.folder}/logs" in run.said


def test_interruption_names_no_failures(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    snakemake.start(0, "a")
    try:
        raise KeyboardInterrupt
    except KeyboardInterrupt:
        snakemake.send(None, "Terminating processes on user request, this might take some time.")
    snakemake.fail(0)
    run.log.fail()
    assert run.said[1] == "  Stopped after T: interrupted; done: nothing"
    assert not [line for line in run.said if "failed" in line]


def test_run_with_nothing_to_do_names_the_places_and_writes_nothing(run: Run, snakemake: Snakemake) -> None:
    for name in ("figures", "scenes"):
        (run.folder / name).mkdir()
    snakemake.send(None, NOTHING_TO_BE_DONE_MSG)
    assert run.said == [f"  figures are in {run.folder}/figures, fields in {run.folder}/scenes"]
    assert not run.written


def test_dry_run_names_what_would_be_made_and_writes_nothing(tmp_path: Path, snakemake: Snakemake) -> None:
    run = Run(tmp_path, snakemake, dry=lambda: True)
    stats = {"scene": 7, "total_table": 1, "all": 1, "total": 9}
    snakemake.send("RUN_INFO", "Job stats", stats=stats)
    for job in range(7):
        snakemake.start(job, f"scene{job}")
    snakemake.start(8, rule="total_table", message="Friction of all scales: a path")
    snakemake.start(9, rule="all")
    snakemake.send("RUN_INFO", "Job stats", stats=stats)
    assert run.said == [
        "  Would be made: 7 scenes, 1 table",
        "    scene: scene0, scene1, scene2, scene3, scene4 and 2 more",
        "    total_table: Friction of all scales",
    ]
    assert not run.written


def test_what_the_short_log_covers_is_kept_from_the_other_handlers(run: Run, snakemake: Snakemake) -> None:
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    snakemake.send(None, "Select jobs to execute...")
    snakemake.send("JOB_STARTED", "Execute 2 jobs...", jobs=[0, 1])
    snakemake.start(0, "a")
    snakemake.finish(0)
    snakemake.send(None, "NotConverged: a")
    snakemake.send("ERROR", "WorkflowError")
    assert snakemake.said.getvalue().splitlines() == ["job info", "NotConverged: a", "WorkflowError"]


def test_all_is_left_to_snakemake_where_it_is_not_to_be_quiet(tmp_path: Path, snakemake: Snakemake) -> None:
    attach(RunLog(str(tmp_path), stream=None), snakemake.logger, silence=False)
    snakemake.send(None, "Select jobs to execute...")
    assert snakemake.said.getvalue() == "Select jobs to execute...\n"


def test_lines_come_now_and_then(run: Run, snakemake: Snakemake, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(streams, "_SHORTEST", 0.01)
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    run.log.begin()
    snakemake.start(0, "a")
    deadline = time.monotonic() + 10.0
    while len(run.said) < 2 and time.monotonic() < deadline:
        time.sleep(0.01)
    assert run.said[1] == "  0 of 3 scenes"
    time.sleep(0.1)
    assert len(run.said) == 2  # nothing new, nothing said


def test_measured_times_come_before_those_of_the_records(tmp_path: Path, snakemake: Snakemake) -> None:
    run = Run(tmp_path, snakemake, seconds={"logs/0.log": 12.0}.get)
    snakemake.send("RUN_INFO", "Job stats", stats={"scene": 1, "march": 1, "total": 2})
    snakemake.start(0, "a")
    snakemake.finish(0)
    assert run.said[-1] == "  1 of 1 scene; slowest a 12.0 s"


def test_files_to_open_first_are_those_that_exist(tmp_path: Path, snakemake: Snakemake) -> None:
    names = [str(tmp_path / name) for name in ("claims.html", "friction_total.csv", "fig6.png")]
    for name in names[1:]:
        Path(name).touch()
    run = Run(tmp_path, snakemake, first=names)
    run.log.succeed()
    assert f"  open first: {names[1]}, {names[2]}" in run.said


def test_results_that_are_named_are_those_of_the_run(
    tmp_path: Path, snakemake: Snakemake, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runlog, "findings", lambda tables: [f"of {path}" for path in tables])
    old, new, fields = (str(tmp_path / name) for name in ("tables/old.csv", "tables/new.csv", "scenes/r/a.nc"))
    for path in (old, new, fields, tmp_path / "figures" / "old.pdf"):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).touch()
    for stats, output, said in (
        ({"scene": 1, "scenes": 1}, fields, [f"  fields are in {tmp_path}/scenes"]),
        ({"scale_table": 1}, new, [f"  of {new}", f"  tables are in {tmp_path}/tables", f"  open first: {new}"]),
    ):
        run = Run(tmp_path, snakemake, targets=["all", "scenes"], tables=[old, new], first=[old, new])
        snakemake.send("RUN_INFO", "Job stats", stats=stats)
        snakemake.start(0, rule=next(iter(stats)), message="a", output=output)
        snakemake.finish(0)
        snakemake.logger.removeHandler(run.log)
        assert [line for line in run.said if not line.startswith("  slowest")][-len(said) :] == said
        assert not [line for line in run.said if old in line or "figures" in line]
    # What is up to date is as good as made where everything was asked for.
    run = Run(tmp_path, snakemake, tables=[old, new])
    snakemake.send("RUN_INFO", "Job stats", stats={"fig8": 1, "all": 1})
    snakemake.start(0, rule="fig8")
    snakemake.finish(0)
    assert f"  of {old}" in run.said


def test_what_is_only_marked_is_not_said_to_be_computed(tmp_path: Path, snakemake: Snakemake) -> None:
    run = Run(tmp_path, snakemake, touch=lambda: True, tables=[str(tmp_path / "table.csv")])
    (tmp_path / "table.csv").write_text("friction_total\n0.2\n")
    snakemake.send("RUN_INFO", "Job stats", stats={"scene": 1, "all": 1})
    snakemake.start(0, "a")
    snakemake.finish(0)
    run.log.succeed()
    assert run.said == [
        "  To mark: 1 scene",
        "  Nothing was computed: 1 scene marked as up to date (--touch), whatever config and code they were made with",
    ]
    assert run.written[1:] == run.said


def test_module_reports_its_own_jobs_and_their_end(tmp_path: Path, snakemake: Snakemake) -> None:
    own = {"soft_scene": "scene", "soft_all": "all"}
    stats = {"soft_scene": 2, "soft_all": 1, "theirs": 3, "total": 6}
    runs = []
    for fates in ("ok", "xk"):
        run = Run(tmp_path / fates, snakemake, rules=own)
        runs.append(run)
        snakemake.send("RUN_INFO", "Job stats", stats=stats)
        for job, fate in enumerate(fates):
            snakemake.start(job, f"scene{job}", rule="soft_scene")
            snakemake.start(9, rule="theirs")
            snakemake.finish(9)
            (snakemake.fail if fate == "x" else snakemake.finish)(job)
        run.log.close()
        snakemake.logger.removeHandler(run.log)
    done, failed = runs
    assert done.said[0] == failed.said[0] == "  To do: 2 scenes"
    assert done.said[2] == "  Done in T: 2 scenes"
    assert failed.said[1] == "  Stopped after T: 1 failed; done: 1 scene"
    assert sum("Done in" in line for line in done.written) == 1


def test_module_that_is_not_asked_for_says_nothing(tmp_path: Path, snakemake: Snakemake) -> None:
    run = Run(tmp_path, snakemake, rules={"soft_scene": "scene"})
    snakemake.send("RUN_INFO", "Job stats", stats={"theirs": 3, "total": 3})
    snakemake.start(0, rule="theirs")
    snakemake.finish(0)
    run.log.close()
    assert not run.said
    assert not run.written


def test_full_disk_and_lost_terminal_do_not_stop_the_run(tmp_path: Path, snakemake: Snakemake) -> None:
    (tmp_path / "logs").write_text("no folder")
    run = Run(tmp_path, snakemake)
    run.stream.close()
    snakemake.send("RUN_INFO", "Job stats", stats=STATS)
    run.log.begin()
    run.log.succeed()
    assert (tmp_path / "logs").read_text() == "no folder"
