"""A function called in worker processes side by side: results, errors, deaths, and nothing left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

# The functions of a worker are of a module.
FUNCTIONS = """
import os, time
from pathlib import Path

from rubfric.errors import NotConverged

def process(task):
    return task, os.getpid(), os.environ["OPENBLAS_NUM_THREADS"]

def meet(task):
    Path(f"{os.getpid()}.here").touch()
    while len(list(Path().glob("*.here"))) < task:
        time.sleep(0.01)
    return os.getpid()

def fail(task):
    raise NotConverged(task, 3, 0.5, "residual", "less load")

def interrupt(task):
    os.kill(os.getpid(), 2)
    time.sleep(600)

def sleep(task):
    Path(f"{os.getpid()}.sleeps").touch()
    time.sleep(600)
"""
# It has no guard, and a process of its own: there is one server in each.
SCRIPT = """
open("runs.txt", "a").write("run")
import os
os.environ["OPENBLAS_NUM_THREADS"] = "3"
import functions
from rubfric.errors import NotConverged
from rubfric.workers import WorkerDied, as_completed

found = dict(as_completed(functions.process, [5, 6, 7], jobs=2))
assert [found[place][0] for place in range(3)] == [5, 6, 7], found
assert {one[2] for one in found.values()} == {"1"} and os.environ["OPENBLAS_NUM_THREADS"] == "3"
assert len({one[1] for one in found.values()} - {os.getpid()}) <= 2
assert len({one for _, one in as_completed(functions.meet, [3, 3, 3], jobs=3)}) == 3
try:
    list(as_completed(functions.fail, ["scene1"], jobs=1))
except NotConverged as error:
    assert (error.scene, error.advice) == ("scene1", "less load") and "functions.py" in error.__notes__[0]
    print("failed")
for function, task in ((os._exit, 7), (functions.interrupt, 0)):
    try:
        list(as_completed(function, [task], jobs=1))
    except WorkerDied as error:
        print(error)
print("asleep", flush=True)
list(as_completed(functions.sleep, [1, 2], jobs=2))
"""


def test_script_without_a_guard_runs_side_by_side_and_an_interrupt_ends_all(tmp_path: Path) -> None:
    (tmp_path / "functions.py").write_text(FUNCTIONS)
    (tmp_path / "script.py").write_text(SCRIPT)
    with subprocess.Popen(
        [sys.executable, "script.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([*sys.path, str(tmp_path)])},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as script:
        assert script.stdout is not None
        assert script.stdout.readline() == "failed\n"
        assert script.stdout.readline().startswith("task 1: the job's process ended with exit status 7 before")
        assert script.stdout.readline().startswith("task 1: the job was interrupted: ")
        assert script.stdout.readline() == "asleep\n"
        while len(sleepers := list(tmp_path.glob("*.sleeps"))) < 2:
            time.sleep(0.01)
        script.send_signal(signal.SIGINT)
        _, err = script.communicate(timeout=60)
    assert err.endswith("KeyboardInterrupt\n")
    assert (tmp_path / "runs.txt").read_text() == "run"
    deadline = time.monotonic() + 30.0
    while any(Path("/proc", one.stem).exists() for one in sleepers):
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_ctrl_c_while_the_server_imports_leaves_no_traceback_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text("import time; open('importing', 'w'); time.sleep(0.3)")
    script = "import time; from rubfric import workers; workers.start_server('slow'); time.sleep(600)"
    with subprocess.Popen(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([*sys.path, str(tmp_path)])},
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        while not (tmp_path / "importing").exists():
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, err = process.communicate(timeout=60)
    assert err.count("Traceback") == 1
    assert err.endswith("KeyboardInterrupt\n")
