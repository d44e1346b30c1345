"""Jobs in processes of their own: results, logs, and failures that stay theirs."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from rubfric.errors import RubfricError
from rubfric.runner import jobs
from rubfric.runner.jobs import JobFailed

SCRIPT = """
import os, signal, sys, time
from pathlib import Path

import rubfric


def meet(folder, number):
    (folder / f"{os.getpid()}.here").touch()
    while len(list(folder.glob("*.here"))) < number:
        time.sleep(0.01)


def main(output, act="write", number=0):
    print("number", number)
    print("on stderr", file=sys.stderr)
    if act == "raise":
        raise ValueError(f"{number} is no good")
    if act == "exit":
        sys.exit("gone early")
    if act == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if act == "meet":
        meet(Path(output).parent, number)
    names = "rubfric.simulation" in sys.modules, os.environ["OPENBLAS_NUM_THREADS"]
    Path(output).write_text(f"{number} {os.getpid()} {names[0]} {names[1]}")
"""


@pytest.fixture(scope="module", autouse=True)
def environment() -> Iterator[None]:
    """Ask for more threads than jobs shall have, and leave the environment of the other tests as it was."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
            patch.setenv(name, "3")
        patch.setenv("MPLBACKEND", "Agg")
        yield


class Workplace:
    """A folder with a script, and a short way to run it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.script = folder / "script.py"
        self.script.write_text(SCRIPT)

    def run(self, name: str, **arguments: Any) -> Path:
        output = self.folder / f"{name}.txt"
        jobs.run(str(self.script), str(self.log(name)), output=str(output), **arguments)
        return output

    def log(self, name: str) -> Path:
        return self.folder / "logs" / f"{name}.log"


@pytest.fixture
def place(tmp_path: Path) -> Workplace:
    return Workplace(tmp_path)


def test_main_runs_in_another_process_that_is_warm(place: Workplace) -> None:
    number, process, warm, threads = place.run("one", number=7).read_text().split()
    assert number == "7"
    assert int(process) != os.getpid()
    assert warm == "True"
    assert threads == "1"
    assert jobs.__name__ in sys.modules


def test_time_of_a_job_is_known_by_its_log(place: Workplace) -> None:
    before = time.monotonic()
    place.run("one")
    took = jobs.seconds(str(place.log("one")))
    assert took is not None
    assert 0.0 < took < time.monotonic() - before
    assert jobs.seconds(str(place.log("none"))) is None


def test_next_job_takes_the_same_worker(place: Workplace) -> None:
    processes = [place.run(name).read_text().split()[1] for name in ("one", "two")]
    assert len(set(processes)) == 1


def test_jobs_side_by_side_have_workers_of_their_own(place: Workplace) -> None:
    with ThreadPoolExecutor(3) as pool:
        outputs = list(pool.map(lambda name: place.run(name, act="meet", number=3), ["a", "b", "c"]))
    assert len({output.read_text().split()[1] for output in outputs}) == 3


def test_idle_worker_that_died_is_replaced(place: Workplace) -> None:
    idle = [int(place.run(name).read_text().split()[1]) for name in ("one", "two")]
    os.kill(idle[-1], signal.SIGKILL)
    assert place.run("three", number=3).read_text().startswith("3 ")


def test_log_holds_what_the_job_printed(place: Workplace, capfd: pytest.CaptureFixture[str]) -> None:
    place.run("one", number=7)
    *printed, cost = place.log("one").read_text().splitlines()
    assert sorted(printed) == ["number 7", "on stderr"]
    assert re.fullmatch(r"took \d+\.\d+ s, \d+\.\d+ s of CPU time(, \d+ MB of memory at most)?", cost)
    assert capfd.readouterr() == ("", "")


def test_log_is_that_of_the_last_run(place: Workplace) -> None:
    place.run("one", number=1)
    place.run("one", number=2)
    assert "number 1" not in place.log("one").read_text()


def test_exception_fails_the_job_with_its_sentence_and_log(place: Workplace) -> None:
    with pytest.raises(JobFailed, match=r"^ValueError: 3 is no good \(log: .*one.log\)$"):
        place.run("one", act="raise", number=3)
    log = place.log("one").read_text()
    assert "Traceback (most recent call last)" in log
    assert log.endswith("ValueError: 3 is no good\n")
    assert not (place.folder / "one.txt").exists()


def test_early_exit_fails_the_job(place: Workplace) -> None:
    with pytest.raises(JobFailed, match=r"the job's process ended with exit status 1 before .*one.log\)$"):
        place.run("one", act="exit")
    assert place.log("one").read_text().endswith("gone early\n")
    assert place.run("two", number=2).read_text().startswith("2 ")


def test_killed_job_fails_alone(place: Workplace) -> None:
    with pytest.raises(JobFailed, match=r"the job's process died before it could say why.*\(log: .*one.log\)$"):
        place.run("one", act="kill")
    assert place.run("two", number=2).read_text().startswith("2 ")


def test_log_that_cannot_be_opened_fails_the_job_with_a_sentence(place: Workplace) -> None:
    (place.folder / "logs").write_text("")
    sentence = r"^NotWritten: .*logs\S* could not be written, since a file stands where a folder belongs: move it away"
    with pytest.raises(JobFailed, match=sentence):
        place.run("one")
    assert not (place.folder / "one.txt").exists()


def test_log_on_a_full_disk_fails_the_job_with_a_sentence(place: Workplace) -> None:
    (place.folder / "logs").mkdir()
    place.log("one").symlink_to("/dev/full")
    with pytest.raises(JobFailed, match=r"^NotWritten: .*one\.log could not be written, since the disk is full: make"):
        place.run("one", number=1)
    assert place.run("two", number=2).read_text().startswith("2 ")


def test_failure_is_an_error_of_the_project() -> None:
    assert issubclass(JobFailed, RubfricError)
    assert issubclass(JobFailed, RuntimeError)


def test_missing_script_and_missing_main_fail_the_job(place: Workplace) -> None:
    with pytest.raises(JobFailed, match=r"^FileNotFoundError: .*nowhere.py"):
        jobs.run(str(place.folder / "nowhere.py"), str(place.log("one")))
    place.script.write_text("x = 1\n")
    with pytest.raises(JobFailed, match="main"):
        place.run("two")


def test_job_with_arguments_that_cannot_be_sent_leaves_main_in_place(place: Workplace) -> None:
    before = sys.modules["__main__"]
    with pytest.raises(Exception, match="pickle"):
        place.run("one", number=lambda: 1)
    assert sys.modules["__main__"] is before
    assert place.run("two", number=2).read_text().startswith("2 ")


def test_main_module_is_back_after_each_job(place: Workplace) -> None:
    before = sys.modules["__main__"]
    place.run("one")
    assert sys.modules["__main__"] is before


def test_many_threads_lose_no_result(place: Workplace) -> None:
    names = [str(number) for number in range(40)]
    with ThreadPoolExecutor(8) as pool:
        outputs = list(pool.map(lambda name: place.run(name, number=int(name)), names))
    assert [output.read_text().split()[0] for output in outputs] == names
    assert len({output.read_text().split()[1] for output in outputs}) <= 8


def test_failures_among_many_threads_hit_their_own_jobs_only(place: Workplace) -> None:
    acts = ["write", "raise", "kill"] * 6
    before = signal.getsignal(signal.SIGINT)

    def outcome(number: int) -> str:
        try:
            place.run(str(number), act=acts[number], number=number)
        except JobFailed as error:
            return "raise" if f"ValueError: {number} is no good" in str(error) else "kill"
        return "write"

    with ThreadPoolExecutor(6) as pool:
        outcomes = list(pool.map(outcome, range(len(acts))))
    assert outcomes == acts
    assert threading.active_count() == 1
    assert signal.getsignal(signal.SIGINT) is before


def test_workers_leave_the_main_module_alone_and_end_with_it(place: Workplace) -> None:
    output, master_script = place.folder / "one.txt", place.folder / "master.py"
    master_script.write_text(
        "import sys; from rubfric.runner import jobs\n"
        "open('runs.txt', 'a').write('run')\n"
        f"jobs.run({str(place.script)!r}, {str(place.log('one'))!r}, output={str(output)!r})\n"
        "print('done', flush=True); sys.stdin.read()"
    )
    command = [sys.executable, str(master_script)]
    with subprocess.Popen(command, cwd=place.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as master:
        assert master.stdout is not None
        assert master.stdout.readline() == b"done\n"
        worker = int(output.read_text().split()[1])
        assert is_running(worker)
        master.kill()
    deadline = time.monotonic() + 30.0
    while is_running(worker) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not is_running(worker)
    assert (place.folder / "runs.txt").read_text() == "run"


@pytest.mark.thorough
@pytest.mark.parametrize("closed", ["<&- >&- 2>&-", ">&-", "> /dev/full 2> /dev/full"])
def test_jobs_need_no_standard_files(place: Workplace, closed: str) -> None:
    master = place.folder / "master.py"
    master.write_text(
        "from rubfric.runner import jobs\n"
        f"for name in ('one', 'two'):\n"
        f"    jobs.run({str(place.script)!r}, {str(place.folder)!r} + f'/logs/{{name}}.log', output=name + '.txt')\n"
    )
    command = f"exec {sys.executable} {master} {closed}"
    done = subprocess.run(["sh", "-c", command], cwd=place.folder, check=False, timeout=60)
    assert done.returncode == 0
    for name in ("one", "two"):
        assert place.log(name).read_text().startswith("number 0\non stderr\ntook ")
        assert (place.folder / f"{name}.txt").exists()


def is_running(process: int) -> bool:
    """Return whether a process runs; one that ended and waits to be counted does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False
