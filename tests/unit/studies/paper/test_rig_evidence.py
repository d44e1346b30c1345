"""What points of the test rig say on the paper's claim."""

from __future__ import annotations

import pandas as pd
import pytest

from rubfric.studies.paper.evidence import rig_evidence, rig_note


def points(friction: list[float], pressures: list[float], spread: float = 0.001, source: str = "data") -> pd.DataFrame:
    speeds = [1.0, 10.0, 100.0, 1000.0][: len(friction)]
    rows = [
        {"speed_mm_per_s": speed, "pressure_MPa": pressure * (1.0 + 0.001 * place), "friction_coefficient": mu}
        for pressure in pressures
        for place, (speed, mu) in enumerate(zip(speeds, friction, strict=True))
    ]
    columns = ["speed_mm_per_s", "pressure_MPa", "friction_coefficient"]
    return pd.DataFrame(rows, columns=columns).assign(friction_coefficient_ci95=spread, source=source).iloc[::-1]


@pytest.mark.parametrize(
    ("friction", "outcomes"),
    [
        ([0.1, 0.2, 0.4, 0.2], ["yes", "yes"]),
        ([0.1, 0.2, 0.3, 0.4], ["yes", "open"]),
        ([0.4, 0.3, 0.2, 0.1], ["open", "yes"]),
        ([0.4, 0.4001, 0.4, 0.3999], ["open", "open"]),
        ([0.1, 0.2], []),
    ],
)
def test_rise_and_fall_at_each_pressure(friction: list[float], outcomes: list[str]) -> None:
    found = rig_evidence(points(friction, [0.5, 5.0]))
    assert [one.outcome for one in found] == 2 * outcomes
    assert {one.pressure for one in found} == ({0.501, 5.01} if outcomes else set())


def test_value_is_relative_to_the_end_and_its_error_adds_both() -> None:
    rise, fall = rig_evidence(points([0.1, 0.2, 0.4, 0.2], [5.0]))
    assert (rise.value, fall.value) == pytest.approx((3.0, 1.0))
    assert (rise.error, fall.error) == pytest.approx((0.02, 0.01))
    assert rise.velocity == fall.velocity == 100.0


def test_no_points_decide_nothing() -> None:
    assert rig_evidence(points([], [])) == []
    assert rig_note(points([], [])) == "The test rig gave no point."


def test_simulated_points_are_told() -> None:
    assert {one.simulated for one in rig_evidence(points([0.1, 0.2, 0.1], [1.0], source="simulated"))} == {True}
    assert {one.simulated for one in rig_evidence(points([0.1, 0.2, 0.1], [1.0]))} == {False}
    assert rig_note(points([0.1, 0.2, 0.3], [1.0], source="simulated")).startswith("3 of 3 points are SIMULATED")
    assert rig_note(points([0.1, 0.2, 0.3], [1.0])) == "From 3 measured points."
