"""Friction on a measured road, against roads whose friction is known."""

from __future__ import annotations

import numpy as np
import pytest

import rubfric
from rubfric import Scene, SineScale, WaveRoad
from rubfric.profile.cleaning import clean
from rubfric.profile.measured import Profile
from rubfric.profile.virtual import as_measured, self_affine
from rubfric.profile.window import count, road

CAMPAIGN = rubfric.load()
# Height of the block, mm.
HEIGHT = 1.5


def friction(
    road: SineScale | WaveRoad, velocity: float = 100.0, pressure: float = 0.5, kinematics: str = "small"
) -> float:
    """Return friction of a block of one height on any road."""
    scene = Scene(
        "all" if isinstance(road, WaveRoad) else 1,
        road,
        velocity,
        pressure,
        HEIGHT / road.wavelength,
        CAMPAIGN.material,
        "strain",
        CAMPAIGN.numerics,
        kinematics,
    )
    return float(rubfric.simulate(scene)["friction_coefficient"])


@pytest.mark.parametrize(
    ("velocity", "pressure", "kinematics"),
    [(10.0, 2.0, "small"), (100.0, 0.5, "small"), (1000.0, 0.2, "small"), (100.0, 0.5, "finite")],
)
def test_a_sine_with_tilt_gaps_and_spikes_comes_back_as_its_scene(
    velocity: float, pressure: float, kinematics: str
) -> None:
    rng = np.random.default_rng(3)
    x = 0.03125 * np.arange(20 * 64)
    heights = 0.1 * np.sin(np.pi * x) + 0.02 * x + 1.0
    cleaned = clean(Profile("road", 0.0, 0.03125, as_measured(rng, heights, 12, 5, 20, 0.5)[0]))
    about = (velocity, pressure, kinematics)
    found = friction(road(cleaned.profile, 8.0, 0.5), *about)
    assert found == pytest.approx(friction(SineScale(0.1, np.pi), *about), rel=0.01)


def test_two_waves_are_the_road_of_two_waves_wherever_the_profile_is_cut() -> None:
    waves = WaveRoad((0.1, 0.03), (np.pi, 4.0 * np.pi), (0.0, 1.0))
    known = friction(waves)
    for begin in (0.0, 0.377, 1.1):
        profile = Profile("road", 0.0, 2.0 / 128, waves.height(begin + 2.0 / 128 * np.arange(1024)))
        assert friction(road(profile, 4.0, 0.25)) == pytest.approx(known, rel=0.01)


@pytest.mark.thorough
def test_windows_of_one_stationary_road_agree_within_their_scatter() -> None:
    heights = self_affine(np.random.default_rng(7), 2**13, 0.02, 0.8, 4e-3, longest=2.0, shortest=0.2)
    profile = Profile("road", 0.0, 0.02, heights)
    number = count(profile, 8.0)
    found = np.array([friction(road(profile, 8.0, 0.2, at)) for at in range(1, number + 1)])
    halves = found[: number // 2], found[number // 2 :]
    error = np.sqrt(sum(half.var(ddof=1) / len(half) for half in halves))
    assert abs(halves[0].mean() - halves[1].mean()) < 2.5 * error
    # The mean is known to far better than one window's scatter, and that is more than the error of a mesh.
    assert 0.01 < found.std(ddof=1) / found.mean() < 0.3
