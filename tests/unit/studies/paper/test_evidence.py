"""Evidence on the paper's claims from made-up campaigns."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.studies.paper.claims import Evidence
from rubfric.studies.paper.evidence import depth_evidence, gather, march_evidence, march_note

VELOCITIES, PRESSURES, ASPECTS = [1.0, 10.0, 100.0, 1000.0], [0.5, 5.0], [0.25, 0.75, 1.5]
BELL = np.array([1.0, 2.0, 4.0, 2.0])


def campaign(
    over_speed: np.ndarray = BELL,
    over_pressure: tuple[float, float] = (1.0, 2.0),
    over_aspect: tuple[float, float, float] = (1.0, 1.0, 1.0),
    error: float = 0.001,
    contact: tuple[float, float] = (0.3, 1.0),
) -> xr.Dataset:
    """Friction as a product of its dependences, on two scales; contact that grows with pressure, falls with speed."""
    axes = {"scale": [1, 2], "velocity": VELOCITIES, "pressure": PRESSURES, "aspect": ASPECTS}
    friction = np.einsum("s,v,p,a->svpa", [0.1, 0.1], over_speed, over_pressure, over_aspect)
    filled = np.broadcast_to(np.array(contact)[None, None, :, None], friction.shape).copy()
    filled *= np.array([1.0, 0.9, 0.5, 0.2])[None, :, None, None]
    names = tuple(axes)
    return xr.Dataset(
        {
            "friction_coefficient": (names, friction),
            "friction_coefficient_error": (names, error * friction),
            "contact_fraction": (names, filled),
            "columns": (names, np.full(friction.shape, 200.0)),
        },
        coords=axes,
    )


def of(observed: xr.Dataset, claim: str, part: str) -> list[Evidence]:
    found = gather(observed, 0.75, PRESSURES, 0.05)
    return [one for one in found if (one.claim, one.part) == (claim, part)]


def outcomes(evidence: list[Evidence]) -> set[str]:
    return {one.outcome for one in evidence}


@pytest.mark.parametrize(
    ("value", "error", "sense", "outcome"),
    [
        (0.2, 0.05, "above", "yes"),
        (0.2, 0.15, "above", "open"),
        (0.0, 0.05, "above", "no"),
        (0.0, 0.05, "below", "yes"),
        (0.2, math.nan, "below", "no"),
        (0.2, math.inf, "below", "open"),
    ],
)
def test_outcome_is_decided_beyond_the_error(value: float, error: float, sense: str, outcome: str) -> None:
    assert Evidence("C1", "", 1, 5.0, 1.0, value, error, 0.1, sense).outcome == outcome


@pytest.mark.parametrize(("ratios", "outcome"), [((1.0, 1.1, 1.2), "yes"), ((1.2, 1.1, 1.0), "no")])
def test_rise_with_the_ratio_below_the_peak(ratios: tuple[float, float, float], outcome: str) -> None:
    found = of(campaign(over_aspect=ratios), "C1", "rises below the peak")
    assert {one.velocity for one in found} == {1.0, 10.0}
    assert outcomes(found) == {outcome}
    assert found[0].value == pytest.approx(ratios[-1] / ratios[0] - 1.0)
    assert found[0].error == pytest.approx(0.001 * (ratios[-1] + ratios[0]) / ratios[0])


def test_ratios_that_are_equal_within_their_errors_do_not_decide_a_rise() -> None:
    assert outcomes(of(campaign(over_aspect=(1.0, 1.0, 1.001)), "C1", "rises below the peak")) == {"open"}


@pytest.mark.parametrize(("last", "outcome"), [(1.01, "yes"), (1.3, "no")])
def test_ratios_above_the_peak_and_from_three_quarters_up(last: float, outcome: str) -> None:
    observed = campaign(over_aspect=(1.0, 1.0, last))
    above = of(observed, "C1", "hardly differs above the peak")
    assert {one.velocity for one in above} == {1000.0}
    assert outcomes(above) == {outcome}
    assert outcomes(of(observed, "C3", "stable from 0.75 up")) == {outcome}
    flattest = campaign(over_aspect=(last, 1.0, 1.0))
    assert outcomes(of(flattest, "C3", "stable from 0.75 up")) == {"yes"}


def test_filling_of_the_profile() -> None:
    found = [one for one in gather(campaign(), 0.75, PRESSURES, 0.05) if one.claim == "C4"]
    assert outcomes(found) == {"yes"}
    empty = campaign(contact=(0.3, 0.3))
    assert outcomes(of(empty, "C4", "filled when heavy and slow")) == {"no"}
    assert outcomes(of(empty, "C4", "fills with pressure")) == {"open"}
    assert outcomes(of(campaign(contact=(1.0, 0.3)), "C4", "fills with pressure")) == {"no"}


@pytest.mark.parametrize(
    ("over_speed", "outcome"), [(BELL, "yes"), (np.array([1.0, 2.0, 3.0, 4.0]), "no"), (BELL[::-1], "yes")]
)
def test_peak_over_speed_on_each_scale(over_speed: np.ndarray, outcome: str) -> None:
    scales = of(campaign(over_speed=over_speed), "C6", "peaks over speed")
    assert [(one.scale, one.pressure) for one in scales] == list(product([1, 2], PRESSURES))
    assert outcomes(scales) == {outcome}
    expected = max(over_speed[1:-1]) / max(over_speed[0], over_speed[-1]) - 1.0
    assert [one.value for one in scales] == pytest.approx([expected] * 4)


@pytest.mark.parametrize(("last", "outcome"), [(2.0, "yes"), (1.01, "no"), (1.0526, "open")])
def test_variation_with_pressure(last: float, outcome: str) -> None:
    assert outcomes(of(campaign(over_pressure=(1.0, last)), "C6", "varies with pressure")) == {outcome}


def test_scenes_that_are_missing_leave_no_evidence() -> None:
    observed = campaign()
    for name in ("friction_coefficient", "friction_coefficient_error", "contact_fraction", "columns"):
        observed[name][:] = np.nan
    assert gather(observed, 0.75, PRESSURES, 0.05) == []


def test_depth_profiles() -> None:
    rows = pd.DataFrame(
        {"scale": [1], "velocity": [10.0], "pressure": [5.0], "depth_fall": [0.4], "depth_rise": [0.2]}
    ).assign(depth_unsteadiness=0.01)
    found = depth_evidence(rows, 0.05)
    assert [one.outcome for one in found] == ["yes", "no", "yes"]
    assert all(math.isnan(one.error) for one in found)


@pytest.mark.parametrize(
    ("slid", "variation", "outcome"), [(12, 0.004, "yes"), (12, 0.02, "no"), (5, 0.004, "open"), (5, 0.02, "open")]
)
def test_march_decides_once_it_exceeds_the_memory_of_the_rubber(slid: int, variation: float, outcome: str) -> None:
    march = xr.Dataset(
        {"saturation_wavelengths": slid, "saturation_needed": 10, "saturation_variation": variation},
        attrs={"scale": 1, "pressure": 0.5, "velocity": 10.0},
    )
    found = march_evidence(march, 0.01)
    assert found.outcome == outcome
    assert ("At 10 mm/s the march was shorter" in march_note([found])) == (outcome == "open")
