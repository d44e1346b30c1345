"""One case of the matrix of stability, run in its own process with limits of time and memory.

A case ends in one of three ways. It converges, and its result keeps every bound (``stability.bounds``); it is refused,
by InvalidInput or NotConverged, with a reason; or it fails: any other error, a floating-point or other warning, a
bound that is broken, or a limit that is exceeded.
"""

from __future__ import annotations

import math
import os
import pickle
import resource
import select
import signal
import time
import warnings
from dataclasses import dataclass, replace

import numpy as np

from rubfric.errors import InvalidInput, NotConverged
from rubfric.marching import march
from rubfric.mechanics.steady.energies import MOST_CLOSURE, most_closure
from rubfric.simulation import simulate
from rubfric.studies.stability.bounds import Verdict, judge_march, judge_steady
from rubfric.studies.stability.cases import Case

OUTCOMES = ("converged", "refused", "failed")
# Limits of a case: processor time, on roads of many waves too, and wall time, s, and memory, MiB.
MOST_SECONDS, MOST_SECONDS_MANY, MOST_WALL, MOST_MEMORY = 120, 300, 1800, 3072
# Limit of the address space, which counts reserved memory too: it only guards the machine.
_MOST_SPACE = 3 * MOST_MEMORY
_MIB = 2**20


@dataclass(frozen=True)
class Trial:
    """How a case ended.

    Attributes
    ----------
    outcome : {"converged", "refused", "failed"}
    reason : str
        Why it was refused or failed; the warnings of the result where it converged.
    friction : tuple of float
        As of ``rubfric.studies.stability.bounds.Verdict``; NaN where there is none.
    closure, resolution : float
        Likewise.
    seconds : float
        Processor time, s.
    memory : float
        Largest resident memory of the process, MiB; what it shares with its parent is counted.
    """

    outcome: str
    reason: str
    friction: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    closure: float = math.nan
    resolution: float = math.nan
    seconds: float = 0.0
    memory: float = 0.0


def attempt(case: Case) -> Trial:
    """Run a case in this process, without limits; warnings and floating-point errors are failures."""
    try:
        with np.errstate(all="raise", under="ignore"), warnings.catch_warnings():
            warnings.simplefilter("error")
            verdict = _judged(case)
    except (InvalidInput, NotConverged) as error:
        return Trial("refused", f"{type(error).__name__}: {error}")
    except Exception as error:
        return Trial("failed", f"{type(error).__name__}: {error}")
    outcome, reason = (
        ("failed", "; ".join(verdict.broken)) if verdict.broken else ("converged", " ".join(verdict.remarks))
    )
    return Trial(outcome, reason, verdict.friction, verdict.closure, verdict.resolution)


def _judged(case: Case) -> Verdict:
    scene = case.scene()
    if case.motion == "march":
        return judge_march(march(scene, case.procedure()), MOST_CLOSURE)
    return judge_steady(simulate(scene), most_closure(scene.numerics.accuracy))


def confined(case: Case) -> Trial:
    """Run a case in its own process, which is killed where it exceeds a limit."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:  # leaves by _exit whatever the case raises
        try:
            os.close(reading)
            _answer(case, writing)
        finally:
            os._exit(0)
    os.close(writing)
    answer = _read_answer(reading, child)
    os.close(reading)
    _, status, used = os.wait4(child, 0)
    seconds, memory = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0
    code = os.waitstatus_to_exitcode(status)
    found = Trial("failed", _ended_by(code, most_seconds(case))) if answer is None else pickle.loads(answer)
    if answer is not None and memory > MOST_MEMORY:
        found = Trial("failed", f"took more than {MOST_MEMORY} MiB of memory")
    return replace(found, seconds=seconds, memory=memory)


def _answer(case: Case, writing: int) -> None:
    """Run the case under limits and write how it ended."""
    resource.setrlimit(resource.RLIMIT_AS, (_MOST_SPACE * _MIB, _MOST_SPACE * _MIB))
    most = most_seconds(case)
    resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
    found = attempt(case)
    with os.fdopen(writing, "wb") as stream:
        stream.write(pickle.dumps(found))


def _read_answer(reading: int, child: int) -> bytes | None:
    """Return what the process wrote before it ended, or None; kills it where it takes too long."""
    received, until = b"", time.monotonic() + MOST_WALL
    while select.select([reading], [], [], max(0.0, until - time.monotonic()))[0]:
        part = os.read(reading, 2**16)
        if not part:
            return received or None
        received += part
    os.kill(child, signal.SIGKILL)
    return None


def most_seconds(case: Case) -> int:
    """Return the processor time that a case may take, s."""
    return MOST_SECONDS_MANY if case.waves > 1 else MOST_SECONDS


def _ended_by(code: int, seconds: int) -> str:
    if code == -signal.SIGXCPU:
        return f"took more than {seconds} s of processor time"
    if code == -signal.SIGKILL:
        return f"took more than {MOST_WALL} s of wall time, or was killed"
    return f"the process died (exit code {code})"
