"""Windows that repeat, and the roads of their Fourier series."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.profile.measured import Profile
from rubfric.profile.virtual import self_affine
from rubfric.profile.window import count, longest, road, window
from rubfric.road.profile import ProfileRoad
from rubfric.road.road import finest_waves
from rubfric.road.waves import WaveRoad

SPACING = 0.05


def test_windows_repeat_without_a_step_and_keep_what_is_not_blended(rng: np.random.Generator) -> None:
    heights = self_affine(rng, 4096, SPACING, 0.8, 0.02)[:4000]
    profile = Profile("road", 0.0, SPACING, heights)
    assert count(profile, 40.0) == 4
    steps = np.abs(np.diff(heights)).max()
    for number in range(1, 5):
        found, period = window(profile, 40.0, number)
        assert period == 40.0
        assert abs(found[0] - found[-1]) <= steps
        own = heights[800 * (number - 1) :][:800]
        assert np.ptp((found - own)[80:]) < 1e-12  # but for their mean
    for length, number, words in ((190.0, 1, "the longest window is 181 mm"), (40.0, 5, "has 4 of 40 mm")):
        with pytest.raises(InvalidInput, match=words):
            window(profile, length, number)
    assert count(profile, longest(profile)) == 1


def test_a_periodic_profile_is_not_changed_by_blending(rng: np.random.Generator) -> None:
    period = self_affine(rng, 800, SPACING, 0.8, 0.02)
    found, _ = window(Profile("road", 0.0, SPACING, np.tile(period, 2)), 40.0)
    assert found == pytest.approx(period - period.mean(), abs=1e-12)


@pytest.mark.parametrize("points", [400, 401])
def test_series_goes_through_the_heights_and_has_their_derivatives(points: int, rng: np.random.Generator) -> None:
    heights = self_affine(rng, points, SPACING, 0.8, 0.02)
    heights -= heights.mean()
    period = points * SPACING
    found = ProfileRoad.of_heights(heights, period, 2.0 * SPACING)
    place = SPACING * np.arange(points)
    assert found.height(place) == pytest.approx(heights, abs=1e-9)  # values of twelve digits
    assert found.period == pytest.approx(period, rel=1e-11)
    fewer = ProfileRoad.of_heights(heights, period, 1.0)
    assert finest_waves(fewer) == math.floor(period)
    waves = WaveRoad(fewer.amplitudes, fewer.wavenumbers, fewer.phases)
    x = rng.uniform(-30.0, 30.0, (5, 7))
    for name in ("height", "slope", "curvature"):
        assert getattr(fewer, name)(x) == pytest.approx(getattr(waves, name)(x), rel=1e-9, abs=1e-9)
    assert fewer.steepest_slope == pytest.approx(waves.steepest_slope)


def test_cutoff_keeps_the_waves_above_it_and_no_others() -> None:
    x = SPACING * np.arange(1600)
    heights = 0.2 * np.sin(2.0 * np.pi * x / 4.0 + 0.3) + 0.1 * np.sin(2.0 * np.pi * x / 0.5)
    found = road(Profile("road", 0.0, SPACING, heights), 20.0, 1.0)
    assert found.amplitudes[4] == pytest.approx(0.2, rel=1e-12)
    assert found.phases[4] == pytest.approx(0.3, abs=1e-9)
    assert sum(found.amplitudes) == pytest.approx(0.2, rel=1e-9)
    for cutoff, words in ((0.09, "at least 0.1 mm: twice the spacing"), (25.0, "must be shorter than that")):
        with pytest.raises(InvalidInput, match=words):
            road(Profile("road", 0.0, SPACING, heights), 20.0, cutoff)
    with pytest.raises(InvalidInput, match="one mesh resolves 512 waves at most"):
        road(Profile("road", 0.0, SPACING, heights), 70.0, 0.1)
