"""Clipping, zeros, cells, windows and bearings, each on signals of which the answer is known."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.results.friction_map import FrictionCurve
from rubfric.rig.bearing import measured_drag
from rubfric.rig.clipping import clipped
from rubfric.rig.record import MEASURED, Record, ordered
from rubfric.rig.sensors import Sensors, as_record, ideal, recorded
from rubfric.rig.settings import Bearing, Settings, Tare, Windows
from rubfric.rig.sled import Sled, slide
from rubfric.rig.speed import cells, resolution
from rubfric.rig.tare import find_zero
from rubfric.rig.windows import STEADY, SWEEP, find_windows

RATE = 500.0


def record(place: np.ndarray, normal: np.ndarray | None = None, traction: np.ndarray | None = None) -> Record:
    time = np.arange(place.size) / RATE
    zeros = np.zeros(place.size)
    forces = [zeros if force is None else force for force in (normal, traction)]
    return ordered("made", MEASURED, np.stack([time, *forces, place]))


def pushed(noise: float, rng: np.random.Generator) -> np.ndarray:
    """Rest, 20 mm/s for 3 s, then a growing speed up to 60 mm/s, and rest again."""
    speed = np.concatenate((np.zeros(500), np.full(1500, 20.0), np.linspace(20.0, 60.0, 1000), np.zeros(500)))
    return np.cumsum(speed) / RATE + noise * rng.standard_normal(speed.size)


def test_noise_and_coarse_steps_are_not_clipped(rng: np.random.Generator) -> None:
    noise = 10.0 + rng.standard_normal(5000)
    assert not clipped(noise).any()
    assert not clipped(np.round(noise, 1)).any()


@pytest.mark.parametrize("step", [0.0, 0.05])
def test_pile_at_the_end_of_the_range_is_clipped(step: float, rng: np.random.Generator) -> None:
    force = 10.0 + 5.0 * np.sin(np.linspace(0.0, 20.0, 5000)) + 0.2 * rng.standard_normal(5000)
    force = np.clip(np.round(force / step) * step if step else force, 6.0, 14.0)
    np.testing.assert_array_equal(clipped(force), (force <= 6.0) | (force >= 14.0))


def test_known_limit_counts_alone(rng: np.random.Generator) -> None:
    force = rng.standard_normal(1000)
    np.testing.assert_array_equal(clipped(force, 2.0), np.abs(force) >= 2.0)


def test_zeros_follow_a_drift(rng: np.random.Generator) -> None:
    count = 4000
    load = 100.0 * np.clip(np.minimum(np.arange(count) - 800, 3200 - np.arange(count)) / 100.0, 0.0, 1.0)
    drift = np.linspace(1.0, 2.0, count)
    normal, traction = (force + 0.05 * rng.standard_normal(count) for force in (load + drift, drift - 3.0))
    found = find_zero(record(np.zeros(count), normal, traction), Tare())
    np.testing.assert_allclose(found.normal, drift, atol=0.02)
    np.testing.assert_allclose(found.traction, drift - 3.0, atol=0.02)
    assert "before and after the load, drift 1" in found.notes[0]
    assert 0.0 < found.normal_error.max() < 0.05


def test_zero_is_that_of_the_times_or_of_the_user(rng: np.random.Generator) -> None:
    run = record(np.zeros(2000), 5.0 + 0.1 * rng.standard_normal(2000), np.full(2000, -1.0))
    timed = find_zero(run, Tare("times", start=1.0, end=2.0))
    assert timed.normal[0] == pytest.approx(5.0, abs=0.03)
    assert timed.traction[0] == pytest.approx(-1.0)
    given = find_zero(run, Tare("given", normal=4.0, traction=2.0))
    assert (given.normal[7], given.traction[7], given.normal_error[7]) == (4.0, 2.0, 0.0)
    assert find_zero(run, Tare("none")).normal[0] == 0.0
    with pytest.raises(InvalidInput, match="made has 0 samples from 100 to 200 s, but needs 20 to tare from"):
        find_zero(run, Tare("times", start=100.0, end=200.0))


@pytest.mark.parametrize("noise", [0.0, 0.003])
def test_speed_is_that_of_the_sled(noise: float, rng: np.random.Generator) -> None:
    run = record(pushed(noise, rng))
    pieces = cells(run, 1.0)
    middle = 0.5 * (run.time[pieces.start] + run.time[pieces.end - 1])
    steady = (middle > 1.05) & (middle < 3.95)
    np.testing.assert_allclose(pieces.speed[steady], 20.0, rtol=0.1)
    if noise:
        assert pieces.speed[steady].std() == pytest.approx(pieces.error[steady].mean(), rel=0.4)
    assert abs(pieces.speed[steady].mean() - 20.0) < 0.05
    assert not pieces.moving[pieces.end <= 500].any()
    assert pieces.moving[steady].all()


def test_resolution_is_noise_or_half_a_step(rng: np.random.Generator) -> None:
    assert resolution(0.01 * rng.standard_normal(5000)) == pytest.approx(0.01, rel=0.1)
    assert resolution(0.02 * np.floor(np.arange(5000) / 100.0)) == pytest.approx(0.01)


def test_windows_are_the_plateau_and_pieces_of_the_sweep(rng: np.random.Generator) -> None:
    run = record(pushed(0.002, rng))
    limits = Windows()
    found = find_windows(run, cells(run, limits.least_travel), limits)
    (plateau,) = [window for window in found if window.kind == STEADY]
    assert run.time[plateau.start] == pytest.approx(1.0, abs=0.06)
    assert run.time[plateau.end - 1] == pytest.approx(4.0, abs=0.1)
    sweeps = [window for window in found if window.kind == SWEEP]
    assert 5 <= len(sweeps) <= 12
    for window in sweeps:
        speed = np.gradient(pushed(0.0, rng), run.time)[window.start : window.end]
        assert np.ptp(speed) < 0.25 * speed.mean()
    assert all(one.end <= other.start for one, other in pairwise(found))


def test_rest_has_no_window(rng: np.random.Generator) -> None:
    run = record(0.002 * rng.standard_normal(3000))
    assert find_windows(run, cells(run, 1.0), Windows()) == []


@pytest.mark.parametrize("damping", [0.0, 0.004])
def test_unloaded_pull_gives_the_drag_of_the_bearings(damping: float) -> None:
    sled = Sled(100.0, 5.0, 300.0, bearing_force=1.5, bearing_damping=damping)
    nothing = FrictionCurve(np.array([0.1, 1e5]), np.zeros(2), np.zeros(2))
    weight = 0.25
    motion = slide(sled, nothing, 1e-9, weight, 10.0, 300.0)
    sensors = Sensors(sampling=2000.0, force_noise=0.02, traction="rope", traction_offset=-0.2)
    run = ideal(sled, nothing, motion, 1e-9, weight, sensors)
    pull = as_record("pull.csv", recorded(run, sensors, np.random.default_rng(4)))
    settings = Settings(area=100.0, traction="rope", sled_mass=5.0, bearing=Bearing(coefficient=0.01, file="pull.csv"))
    found = measured_drag(pull, settings)
    for speed in (100.0, 300.0):
        assert found(speed, 0.0) == pytest.approx(1.5 + damping * speed, abs=max(3.0 * found.error, 0.02))
    assert found(100.0, 50.0) == pytest.approx(found(100.0, 0.0) + 0.5)
    assert 0.0 < found.error < 0.1
    assert "from pull.csv at" in found.notes[0]
    assert found.error_at(found.middle) == found.error
    far = found(3000.0, 0.0) - 1.5 - 3000.0 * damping
    assert abs(far) < 3.0 * found.error_at(3000.0)
    assert found.error_at(3000.0) > 2.0 * found.error


def test_pull_without_sliding_is_refused(rng: np.random.Generator) -> None:
    force = np.concatenate((np.zeros(1000), np.ones(2000))) + 0.01 * rng.standard_normal(3000)
    settings = replace(Settings(), area=1.0, traction="rope", sled_mass=5.0)
    with pytest.raises(InvalidInput, match="made shows no unloaded sliding"):
        measured_drag(record(np.zeros(3000), traction=force), settings)
