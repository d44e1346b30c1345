"""The sled's motion, against closed forms and its own energy, and the weights that bring it somewhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import trapezoid

from rubfric.errors import InvalidInput
from rubfric.results.friction_map import FrictionCurve, FrictionMap
from rubfric.rig.sled import GRAVITY, Motion, Sled, Weight, choose_weight, slide

NO_FRICTION = FrictionCurve(np.array([0.1, 1e5]), np.zeros(2), np.zeros(2))


def speeds_of(motion: Motion, times: np.ndarray) -> np.ndarray:
    return motion.state(times)[1]


def test_without_resistance_the_sled_falls_with_the_weight() -> None:
    sled = Sled(area=100.0, mass=3.0, travel=300.0)
    motion = slide(sled, NO_FRICTION, 1.0, 1.0, 10.0, 300.0)
    acceleration = GRAVITY / 4.0
    assert motion.end == "stopped after 300 mm"
    assert motion.duration == pytest.approx(np.sqrt(600.0 / acceleration), rel=1e-6)
    times = np.linspace(0.0, motion.duration, 11)
    np.testing.assert_allclose(motion.state(times), [0.5 * acceleration * times**2, acceleration * times], rtol=1e-5)


def test_under_a_damping_the_sled_tends_to_its_speed_exponentially() -> None:
    sled = Sled(area=100.0, mass=3.0, travel=300.0, bearing_damping=0.05)
    motion = slide(sled, NO_FRICTION, 1.0, 1.0, 3.0, 1e4)
    rate = 0.05 / 4e-3
    final = 1e-3 * GRAVITY / 0.05
    times = np.linspace(0.01, 1.0, 25)
    assert motion.end == "stopped by hand"
    np.testing.assert_allclose(speeds_of(motion, times), final * (1.0 - np.exp(-rate * times)), rtol=1e-5)


@pytest.mark.parametrize(("speed", "pressure"), [(0.1, 1.0), (5.0, 0.1), (300.0, 1.0), (900.0, 5.0)])
def test_energy_of_the_weight_goes_into_motion_friction_and_bearings(
    speed: float, pressure: float, friction: FrictionMap, sled: Sled
) -> None:
    curve = friction.at(pressure)
    chosen = choose_weight(sled, curve, pressure, speed, 1000.0)
    assert isinstance(chosen, Weight)
    motion = slide(sled, curve, pressure, chosen.mass, 50.0, sled.travel)
    times = motion.duration * np.linspace(0.0, 1.0, 200001) ** 2
    place, moving = motion.state(times)
    lost = trapezoid(sled.resistance(curve, pressure)(moving), place)
    kinetic = 0.5e-3 * (sled.mass + chosen.mass) * moving[-1] ** 2
    assert lost + kinetic == pytest.approx(1e-3 * chosen.mass * GRAVITY * place[-1], rel=1e-5)


def test_sled_settles_before_the_peak_and_runs_through_behind_it(friction: FrictionMap, sled: Sled) -> None:
    curve = friction.at(1.0)
    before, behind = (choose_weight(sled, curve, 1.0, speed, 1000.0) for speed in (5.0, 300.0))
    assert isinstance(before, Weight)
    assert isinstance(behind, Weight)
    assert before.settles
    assert not behind.settles
    slow = slide(sled, curve, 1.0, before.mass, 5.0, 1e4)
    assert float(speeds_of(slow, np.array([5.0]))[0]) == pytest.approx(5.0, rel=1e-5)
    fast = slide(sled, curve, 1.0, behind.mass, 50.0, sled.travel)
    reached = speeds_of(fast, np.linspace(0.0, fast.duration, 10001))
    assert reached.max() > 300.0
    assert np.all(np.diff(reached) > 0.0)


def test_sweep_reaches_its_speed_just_within_the_travel(friction: FrictionMap, sled: Sled) -> None:
    curve = friction.at(0.1)
    chosen = choose_weight(sled, curve, 0.1, 1500.0, 1000.0)
    assert isinstance(chosen, Weight)
    motion = slide(sled, curve, 0.1, chosen.mass, 50.0, sled.travel)
    place, moving = motion.state(np.linspace(0.0, motion.duration, 20001))
    assert float(np.interp(1500.0, moving, place)) == pytest.approx(0.8 * sled.travel, rel=1e-3)


def test_what_cannot_be_reached_is_told(friction: FrictionMap, sled: Sled) -> None:
    curve = friction.at(1.0)
    assert choose_weight(sled, curve, 1.0, 10000.0, 1000.0) == (
        "not reached: even in free fall 240 mm of travel give 2170 mm/s"
    )
    assert "under the heaviest weight, 10 kg" in str(choose_weight(sled, curve, 1.0, 2000.0, 10.0))
    needed = float(sled.resistance(curve, 1.0)(5.0)) / 9.80665
    assert choose_weight(sled, curve, 1.0, 5.0, 1.0) == (
        f"needs a weight of {needed:.1f} kg, more than the heaviest, 1 kg"
    )


def test_weight_that_the_bearings_hold_is_refused(friction: FrictionMap, sled: Sled) -> None:
    stiff = replace(sled, bearing_force=20.0)
    with pytest.raises(InvalidInput, match=r"weight is 2 kg, which pulls with 19.61 N, but must exceed 2.09 kg: the b"):
        slide(stiff, friction.at(1.0), 1.0, 2.0, 1.0, 300.0)


def test_sled_is_stopped_where_nothing_is_known() -> None:
    curve = FrictionCurve(np.array([0.1, 50.0]), np.array([0.1, 0.1]), np.zeros(2))
    motion = slide(Sled(100.0, 5.0, 300.0), curve, 1.0, 20.0, 10.0, 300.0)
    assert motion.end == "faster than what was simulated"
    assert float(speeds_of(motion, np.array([motion.duration]))[0]) == pytest.approx(50.0, rel=1e-6)
