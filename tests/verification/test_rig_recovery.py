"""The reduction recovers what the virtual rig was given, as often as its intervals say.

Each case makes one run, of which the true friction, pressure and speed are known at every moment, records it with
noise of many seeds, and counts how often the 95 % intervals hold the truth. Both bounds on that count are such that
fair intervals miss either once in a thousand; half as wide or twice as wide ones miss them always.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom

from rubfric.results.friction_map import FrictionCurve, FrictionMap
from rubfric.rig.bearing import Drag
from rubfric.rig.points import Point
from rubfric.rig.reduction import reduce_record
from rubfric.rig.sensors import Ideal, Sensors, as_record, recorded
from rubfric.rig.sled import Sled
from rubfric.rig.virtual import make, plan, settings_of
from rubfric.rig.windows import STEADY, SWEEP

RUNS = 200
# A heavy sled gains speed slowly: a sweep needs few samples, and a run costs little.
SLED = Sled(area=100.0, mass=80.0, travel=40.0, bearing_force=0.5, bearing_coefficient=0.005)
SENSORS = Sensors(sampling=500.0, force_memory=2e-3)
ALONG = np.linspace(-1.0, 1.0, 201)
QUANTITIES = ("friction_coefficient", "pressure", "speed")


@pytest.fixture(scope="module")
def friction() -> FrictionMap:
    speeds = np.geomspace(0.1, 10000.0, 41)
    bell = 0.7 * np.exp(-0.4 * (np.log10(speeds) - 1.5) ** 2)
    values = bell * np.array([[1.0], [0.9], [0.7]])
    return FrictionMap(speeds, np.array([0.1, 1.0, 5.0]), values, 0.01 * values)


def deviations(
    run: Ideal, pressure: float, friction: FrictionMap, sensors: Sensors, kind: str
) -> dict[str, list[np.ndarray]]:
    """Return, per quantity and run, the distances of its points from the truth over the half-widths."""
    settings = settings_of(SLED, sensors)
    drag = Drag(SLED.bearing_force, 0.0, SLED.bearing_coefficient, 0.0)
    curve = friction.at(pressure)
    times = run.release + np.linspace(0.0, run.motion.duration, 20001)
    path = np.stack([times, run.speed(times)])
    found: dict[str, list[np.ndarray]] = defaultdict(list)
    for seed in range(RUNS):
        values = recorded(run, sensors, np.random.default_rng([seed, 1]))
        reduced = reduce_record(as_record("run", values), settings, drag)
        points = [point for point in reduced.points if point.kind == kind]
        assert points
        truths = [_truth(point, path, pressure, curve) for point in points]
        for name in QUANTITIES:
            away = [
                (getattr(point, name) - truth[name]) / getattr(point, f"{name}_ci95")
                for point, truth in zip(points, truths, strict=True)
            ]
            found[name].append(np.array(away))
    return found


def _truth(point: Point, path: np.ndarray, pressure: float, curve: FrictionCurve) -> dict[str, float]:
    """Return the mean of the true speed under the weight (1 - u²)² of a window, and friction at that speed."""
    weight = (1.0 - ALONG**2) ** 2
    times = 0.5 * (point.start + point.end + ALONG * (point.end - point.start))
    speed = float(weight @ np.interp(times, *path) / weight.sum())
    return {"speed": speed, "pressure": pressure, "friction_coefficient": float(curve(speed))}


# Speed (mm/s), sensor, and the windows that count. At 15 mm/s the sled nears its speed within all of the plateau: a
# bend that noise hides is then as large as the interval.
CASES = {
    "steady, sensor at the rubber": (2.0, "rubber", STEADY),
    "creeping into its speed, sensor at the rubber": (15.0, "rubber", STEADY),
    "sweep, sensor in the rope": (60.0, "rope", SWEEP),
}


@pytest.mark.thorough
@pytest.mark.parametrize("case", CASES)
def test_intervals_hold_the_truth_as_often_as_they_say(case: str, friction: FrictionMap) -> None:
    speed, traction, kind = CASES[case]
    pressure = 1.0
    sensors = replace(SENSORS, traction=traction)
    (one,), none = plan(friction, SLED, [(speed, pressure)], 1000.0)
    assert not none
    found = deviations(make(one, friction, SLED, sensors), pressure, friction, sensors, kind)
    low, high = binom.ppf([0.001, 0.999], RUNS, 0.95)
    assert high < RUNS
    rng = np.random.default_rng(1)
    for name, runs in found.items():
        # One point of each run: those of one run share its zero.
        chosen = np.abs([away[rng.integers(away.size)] for away in runs])
        held = int(np.count_nonzero(chosen <= 1.0))
        assert low <= held <= high, (name, held)
        # The count must tell: intervals half as wide would fail, and so would those twice as wide.
        assert np.count_nonzero(chosen <= 0.5) < low, name
        assert np.count_nonzero(chosen <= 2.0) > high, name


def test_bearings_and_inertia_matter_where_the_sensor_is_in_the_rope(friction: FrictionMap) -> None:
    sensors = replace(SENSORS, traction="rope")
    (one,), _ = plan(friction, SLED, [(60.0, 1.0)], 1000.0)
    run = make(one, friction, SLED, sensors)
    record = as_record("run", recorded(run, sensors, np.random.default_rng(3)))
    right = settings_of(SLED, sensors)
    wrong = replace(right, traction="rubber")
    drag = Drag(SLED.bearing_force, 0.0, SLED.bearing_coefficient, 0.0)
    errors = []
    for settings in (right, wrong):
        points = reduce_record(record, settings, drag).points
        truth = friction.at(1.0)(np.array([point.speed for point in points]))
        errors.append(float(np.mean([point.friction_coefficient for point in points] - truth)))
    assert abs(errors[0]) < 0.002
    assert errors[1] > 0.01
