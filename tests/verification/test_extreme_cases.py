"""A sample of the matrix of stability: every case converges within all bounds or is refused with a reason.

``snakemake -j2 stability`` tries the whole matrix.
"""

from __future__ import annotations

import pytest

from rubfric.studies.stability.cases import PANELS, cases
from rubfric.studies.stability.trial import Trial, confined

pytestmark = pytest.mark.thorough

# Every so-manieth case of each panel, and of marches, which take longer.
_EVERY = 31
# Cases with a history: each of them once failed, hung, or gave a number that it should not.
_ONCE_BROKEN = (
    # no rows of cells for a block of eight even ones
    {"panel": "aspect_slope", "aspect": 0.02, "slope": 1e-3, "plane": "strain", "kinematics": "small"},
    # three surface nodes in contact, whose routes to friction agree by chance
    {"panel": "speed_pressure", "velocity": 1e-3, "pressure": 1e-6, "plane": "stress", "kinematics": "small"},
    # a contact of eight nodes sought from one of thousands: no pivoting step ever ended it
    {"panel": "speed_pressure", "velocity": 1e-3, "pressure": 1e-4, "plane": "strain", "kinematics": "finite"},
    # strain energy less than the round-off of the moduli
    {"panel": "speed_pressure", "velocity": 1e-6, "pressure": 1e-4, "plane": "strain", "kinematics": "finite"},
)

# Of roads of many waves in finite strain, which take up to minutes, some that take seconds.
_LIGHT = {"panel": "waves", "kinematics": "finite", "velocity": 0.01, "pressure": 0.2, "slope": 0.3, "plane": "stress"}


def sample() -> list[str]:
    matrix = cases()
    light = [case for case in matrix if all(getattr(case, name) == value for name, value in _LIGHT.items())]
    quick = [case for case in matrix if case.panel != "waves" or case.kinematics == "small" or case in light]
    chosen = [case.name for panel in PANELS for case in [one for one in quick if one.panel == panel][::_EVERY]]
    chosen += [case.name for case in light if case.waves in (2, 16)]
    broken = [
        case.name
        for case in matrix
        for given in _ONCE_BROKEN
        if case.motion == "steady" and all(getattr(case, name) == value for name, value in given.items())
    ]
    assert len(broken) == len(_ONCE_BROKEN)
    return list(dict.fromkeys([*chosen, *broken]))


@pytest.fixture(scope="module")
def outcomes() -> dict[str, Trial]:
    chosen = sample()
    return {case.name: confined(case) for case in cases() if case.name in chosen}


def test_no_case_fails(outcomes: dict[str, Trial]) -> None:
    assert {name: trial.reason for name, trial in outcomes.items() if trial.outcome == "failed"} == {}


def test_most_cases_converge(outcomes: dict[str, Trial]) -> None:
    converged = [trial for trial in outcomes.values() if trial.outcome == "converged"]
    assert len(converged) >= 0.6 * len(outcomes)
    assert all(max(trial.friction) >= 0.0 for trial in converged)


def test_refusals_say_what_and_why(outcomes: dict[str, Trial]) -> None:
    refused = [trial.reason for trial in outcomes.values() if trial.outcome == "refused"]
    assert refused
    for reason in refused:
        kind, _, said = reason.partition(": ")
        assert (kind == "InvalidInput" and "must be" in said) or (kind == "NotConverged" and ";" in said), reason
