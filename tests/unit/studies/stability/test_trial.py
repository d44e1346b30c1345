"""A case ends in one of three ways, and in the last whatever goes wrong."""

from __future__ import annotations

import math
import os
import time
import warnings
from collections.abc import Callable

import numpy as np
import pytest

from rubfric.studies.stability import trial
from rubfric.studies.stability.bounds import Verdict
from rubfric.studies.stability.cases import Case
from rubfric.studies.stability.trial import Trial, attempt, confined

CASE = Case("corners", kinematics="small", pressure=0.5, velocity=1.0)


def ending(monkeypatch: pytest.MonkeyPatch, act: Callable[[Case], object]) -> Trial:
    monkeypatch.setattr(trial, "_judged", act)
    return confined(CASE)


def test_case_that_converges() -> None:
    found = confined(CASE)
    assert found.outcome == "converged"
    assert 0.0 < min(found.friction) <= max(found.friction) < CASE.slope
    assert 0.0 <= found.closure < 0.05
    assert found.seconds > 0.0
    assert found.memory > 10.0


def test_march_that_converges() -> None:
    found = confined(Case("corners", "march", kinematics="small", pressure=1.0, velocity=1e-3))
    assert found.outcome == "converged"
    assert found.resolution < min(found.friction)


def test_case_that_is_refused_says_why() -> None:
    found = confined(Case("corners", pressure=1e-6))
    assert found.outcome == "refused"
    assert found.reason.startswith("InvalidInput: pressure of scale1_v100_p1e-6")
    assert math.isnan(found.friction[0])


def test_a_broken_bound_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ending(monkeypatch, lambda case: Verdict((1.0, 1.0, 1.0), 0.0, 0.0, ("a gap is negative",), ()))
    assert (found.outcome, found.reason) == ("failed", "a gap is negative")


def test_a_warning_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ending(monkeypatch, lambda case: warnings.warn("look here", UserWarning, stacklevel=1))
    assert (found.outcome, found.reason) == ("failed", "UserWarning: look here")


def test_overflow_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ending(monkeypatch, lambda case: np.exp(np.array([1e4])))
    assert found.outcome == "failed"
    assert found.reason.startswith("FloatingPointError: overflow")


def test_underflow_is_harmless(monkeypatch: pytest.MonkeyPatch) -> None:
    def underflowing(case: Case) -> Verdict:
        assert float(np.exp(np.array([-1e4]))[0]) == 0.0
        return Verdict((0.0, 0.0, 0.0), 0.0, 0.0, (), ("a remark",))

    found = ending(monkeypatch, underflowing)
    assert (found.outcome, found.reason) == ("converged", "a remark")


def test_a_process_that_dies_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ending(monkeypatch, lambda case: os._exit(3))
    assert (found.outcome, found.reason) == ("failed", "the process died (exit code 3)")


def test_a_hang_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trial, "MOST_WALL", 0.2)
    found = ending(monkeypatch, lambda case: time.sleep(60.0))
    assert found.outcome == "failed"
    assert "took more than 0.2 s of wall time" in found.reason


def test_endless_work_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    def work(case: Case) -> None:
        while True:
            pass

    monkeypatch.setattr(trial, "MOST_SECONDS", 1)
    found = ending(monkeypatch, work)
    assert (found.outcome, found.reason) == ("failed", "took more than 1 s of processor time")


def test_too_much_memory_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trial, "MOST_MEMORY", 1)
    monkeypatch.setattr(trial, "_MOST_SPACE", 4096)
    assert confined(CASE).reason == "took more than 1 MiB of memory"


def test_memory_that_the_machine_does_not_give_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = ending(monkeypatch, lambda case: np.ones(2**32))
    assert found.outcome == "failed"
    assert "MemoryError" in found.reason


def test_trying_here_leaves_warnings_and_errors_as_they_were() -> None:
    with np.errstate(all="ignore"):
        before = np.geterr()
        assert attempt(CASE).outcome == "converged"
        assert np.geterr() == before
