"""Points of a run and rejected windows: what they are, and why a window is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.results.friction_map import FrictionMap
from rubfric.rig.bearing import Drag
from rubfric.rig.points import Point, _independent
from rubfric.rig.reduction import Reduced, point_table, reduce_record, rejected_table
from rubfric.rig.sensors import Ideal, Sensors, as_record, recorded
from rubfric.rig.settings import Settings, Tare, Windows
from rubfric.rig.sled import Sled
from rubfric.rig.summary import summary
from rubfric.rig.virtual import Run, make

NO_DRAG = Drag(0.0, 0.0, 0.0, 0.0)


def reduced(readings: np.ndarray, settings: Settings) -> Reduced:
    return reduce_record(as_record("run", readings), settings, NO_DRAG)


def test_point_is_the_truth_within_its_intervals(
    readings: np.ndarray, settings: Settings, friction: FrictionMap, steady: Ideal
) -> None:
    (point,) = reduced(readings, settings).points
    assert point.kind == "steady"
    assert point.speed == pytest.approx(5.0, abs=2.0 * point.speed_ci95 + 1e-4)
    assert point.pressure == pytest.approx(1.0, abs=2.0 * point.pressure_ci95)
    truth = float(friction.at(1.0)(float(steady.speed(0.5 * (point.start + point.end)))))
    assert point.friction_coefficient == pytest.approx(truth, abs=2.0 * point.friction_coefficient_ci95)
    assert 0.0 < point.friction_coefficient_ci95 < 0.005
    assert point.travel == pytest.approx(5.0 * (point.end - point.start), rel=1e-2)
    assert 30 < point.effective_samples <= point.samples


def test_calibration_widens_the_intervals(readings: np.ndarray, settings: Settings) -> None:
    (exact,) = reduced(readings, settings).points
    (rough,) = reduced(readings, replace(settings, calibration={"normal": 0.03, "traction": 0.04})).points
    assert rough.friction_coefficient == exact.friction_coefficient
    assert rough.friction_coefficient_ci95 == pytest.approx(
        np.hypot(exact.friction_coefficient_ci95, 0.05 * exact.friction_coefficient)
    )
    assert rough.pressure_ci95 == pytest.approx(np.hypot(exact.pressure_ci95, 0.03 * exact.pressure))


def test_gain_of_a_sensor_in_the_rope_counts_with_all_that_it_reads(readings: np.ndarray, settings: Settings) -> None:
    rope, drag = replace(settings, traction="rope", sled_mass=5.0), Drag(0.0, 0.0, 0.3, 0.0)
    (exact,) = reduce_record(as_record("run", readings), rope, drag).points
    rough = replace(rope, calibration={"normal": 0.03, "traction": 0.04, "displacement": 0.02})
    (found,) = reduce_record(as_record("run", readings), rough, drag).points
    read = exact.friction_coefficient + 0.3  # but for what little accelerates the sled
    assert found.friction_coefficient_ci95 == pytest.approx(
        np.hypot(exact.friction_coefficient_ci95, 0.05 * read), rel=1e-3
    )
    assert found.speed_ci95 == pytest.approx(np.hypot(exact.speed_ci95, 0.02 * exact.speed))


def test_area_scales_the_pressure_alone(readings: np.ndarray, settings: Settings) -> None:
    (one,) = reduced(readings, settings).points
    (other,) = reduced(readings, replace(settings, area=50.0)).points
    assert other.pressure == pytest.approx(2.0 * one.pressure)
    assert other.friction_coefficient == one.friction_coefficient
    with pytest.raises(InvalidInput, match="area is not given, but pressure needs the nominal area of the rubber, mm²"):
        reduced(readings, replace(settings, area=0.0))


def test_wrong_zero_is_seen_where_nothing_is_tared(readings: np.ndarray, settings: Settings) -> None:
    (tared,) = reduced(readings, settings).points
    (raw,) = reduced(readings, replace(settings, tare=Tare("none"))).points
    assert raw.pressure - tared.pressure == pytest.approx(0.015, abs=0.002)  # the sensor's offset of 1.5 N on 100 mm²


def test_reasons_name_what_is_wrong(readings: np.ndarray, settings: Settings, rng: np.random.Generator) -> None:
    sliding = (readings[0] > 2.0) & (readings[0] < 4.0)
    ramp = np.where(sliding, (readings[0] - 3.0), 0.0)

    def with_(row: int, change: np.ndarray) -> np.ndarray:
        changed = readings.copy()
        changed[row] += change
        return changed

    cases = {
        "the normal force changes by": (with_(1, 10.0 * ramp), settings),
        "friction changes by": (with_(2, 5.0 * ramp), settings),
        "friction is not resolved": (with_(2, 3000.0 * rng.standard_normal(ramp.size) * sliding), settings),
        "more than any rubber's: look at the units": (readings * np.array([[1.0], [0.05], [1.0], [1.0]]), settings),
        "slid only": (readings, replace(settings, windows=Windows(least_travel=50.0))),
        "fewer than 5000": (readings, replace(settings, windows=Windows(least_samples=5000))),
    }
    for reason, (changed, chosen) in cases.items():
        found = reduced(changed, chosen)
        assert not found.points, reason
        assert any(reason in window.reason for window in found.rejected), (reason, found.rejected)


def test_rope_under_tension_is_no_zero(readings: np.ndarray, settings: Settings) -> None:
    rope = replace(settings, traction="rope", sled_mass=5.0)
    taut = readings.copy()
    time = readings[0]
    taut[2] += np.where((time < 2.0) | (time > time[-1] - 1.0), 70.0, 0.0)
    with pytest.raises(InvalidInput, match=r"has a traction of \d+\.?\d* N before the load, more than the .* in sl"):
        reduced(taut, rope)
    assert reduced(readings, rope).points
    tied = readings.copy()
    tied[2] += np.where(time < 2.0, 70.0, 0.0)
    with pytest.raises(InvalidInput, match=r"has a zero of traction that moves by [0-9.]+ N from before the load"):
        reduced(tied, settings)


def test_sled_at_rest_is_told(settings: Settings, readings: np.ndarray) -> None:
    still = readings.copy()
    still[3] = 0.005 * np.round(np.random.default_rng(1).standard_normal(still.shape[1]))
    found = reduced(still, settings)
    assert not found.points
    assert found.rejected[0].reason.startswith("the sled slid only 0.0")


def test_tables_have_a_row_for_each_and_say_what_was_simulated(readings: np.ndarray, settings: Settings) -> None:
    runs = [reduced(readings, settings), reduced(readings, replace(settings, windows=Windows(least_travel=50.0)))]
    points, rejected = point_table(runs), rejected_table(runs)
    assert len(points) == 1
    assert len(rejected) >= 1
    assert set(points["source"]) == set(rejected["source"]) == {"simulated"}
    assert {"speed_mm_per_s", "speed_ci95_mm_per_s", "pressure_MPa", "pressure_ci95_MPa"} < set(points.columns)
    assert {"friction_coefficient", "friction_coefficient_ci95", "start_s", "end_s", "samples"} < set(points.columns)
    assert list(point_table([]).columns) == list(points.columns)
    told = summary(runs)
    assert told.startswith("1 points, ")
    assert "(simulated runs)" in told
    assert "slid only ... mm in all, less than ... mm" in told


def test_quiet_sensors_do_not_matter(steady: Ideal, settings: Settings, friction: FrictionMap) -> None:
    silent = Sensors(500.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    found = reduce_record(as_record("run", recorded(steady, silent, np.random.default_rng(0))), settings, NO_DRAG)
    assert len(found.points) + len(found.rejected) >= 1
    for point in found.points:
        assert point.friction_coefficient == pytest.approx(float(friction.at(1.0)(point.speed)), rel=1e-4)


def test_quiet_sensors_know_that_friction_bends_over_a_sweep(friction: FrictionMap, sled: Sled) -> None:
    silent = Sensors(2000.0, 1e-4, 0.0, 1e-4, 0.0, 0.0, 0.0, 0.0)
    run = make(Run(1.0, 9.0, 100.0, False), friction, sled, silent)
    settings = Settings(area=100.0, windows=Windows(sweep_range=0.5, load_range=0.05))
    points = reduce_record(as_record("run", recorded(run, silent, np.random.default_rng(0))), settings, NO_DRAG).points
    away = [point.friction_coefficient - float(friction.at(1.0)(point.speed)) for point in points]
    assert len(points) > 2
    assert max(map(abs, away)) > 1e-4  # noise alone would move them by 1e-7
    assert all(abs(one) < point.friction_coefficient_ci95 for one, point in zip(away, points, strict=True))
    assert all(point.friction_coefficient_ci95 < 0.02 * point.friction_coefficient for point in points)


def test_correlation_of_a_short_window_is_that_of_the_unloaded_sensors() -> None:
    point = Point("sweep", 0.0, 1.0, 300, 12.0, 1.0, 0.0, 1.0, 0.1, 1.0, 0.1, 0.5, 0.01)
    assert _independent(point, 20.0) == 15.0
    assert _independent(replace(point, effective_samples=8.0), 20.0) == 15.0
    assert _independent(replace(point, effective_samples=7.0), 20.0) == 7.0
