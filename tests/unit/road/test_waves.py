"""A road of many waves: its period, its profile, and what has no period."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.road.road import finest_waves, fourier_series
from rubfric.road.waves import MOST_WAVES, WaveRoad

AMPLITUDES, WAVENUMBERS = (0.015, 0.006, 0.003, 0.002), (35.0, 80.0, 200.0, 300.0)


def road(phases: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)) -> WaveRoad:
    return WaveRoad(AMPLITUDES, WAVENUMBERS, phases)


def test_period_is_the_shortest_that_holds_every_wave() -> None:
    assert road().period == pytest.approx(2.0 * math.pi / 5.0, rel=1e-15)
    assert road().wavelength == pytest.approx(2.0 * math.pi / 35.0, rel=1e-15)
    assert finest_waves(road()) == 60


@pytest.mark.parametrize("ratio", [1.5, 7.0 / 3.0, 51.2])
def test_period_does_not_hang_on_the_last_digits(ratio: float) -> None:
    wavenumbers = (2.0 * math.pi / 0.18, ratio * 2.0 * math.pi / 0.18)
    perturbed = tuple(one * (1.0 + 1e-13) for one in wavenumbers)
    first, second = (WaveRoad((0.01, 0.01), one, (0.0, 0.0)) for one in (wavenumbers, perturbed))
    assert first.period == pytest.approx(second.period, rel=1e-11)


def test_profile_is_the_sum_of_its_waves_with_its_derivatives() -> None:
    waves, place, step = road((0.3, -1.0, 2.0, 0.0)), np.linspace(0.0, 1.0, 9), 1e-6
    expected = 0.015 * np.sin(35.0 * place + 0.3) + 0.006 * np.sin(80.0 * place - 1.0)
    expected += 0.003 * np.sin(200.0 * place + 2.0) + 0.002 * np.sin(300.0 * place)
    np.testing.assert_allclose(waves.height(place), expected, atol=1e-14)
    np.testing.assert_allclose(waves.height(place + waves.period), expected, atol=1e-14)
    for lower, upper in ((waves.height, waves.slope), (waves.slope, waves.curvature)):
        numeric = (lower(place + step) - lower(place - step)) / (2.0 * step)
        np.testing.assert_allclose(upper(place), numeric, atol=1e-5)


def test_series_has_the_harmonics_of_the_waves() -> None:
    harmonics, amplitudes = fourier_series(road((0.5, 0.0, 0.0, 0.0)))
    assert list(harmonics) == [7, 16, 40, 60]
    np.testing.assert_allclose(amplitudes, -0.5j * np.array(AMPLITUDES) * np.exp(1j * np.array([0.5, 0.0, 0.0, 0.0])))


def test_steepest_slope_is_that_of_the_profile() -> None:
    waves = road((0.3, -1.0, 2.0, 0.0))
    finely = np.abs(waves.slope(np.linspace(0.0, waves.period, 100_000))).max()
    assert waves.steepest_slope == pytest.approx(finely, rel=0.02)


def test_waves_without_a_short_period_are_refused_with_the_nearest_that_have_one() -> None:
    with pytest.raises(InvalidInput, match=f"at most {MOST_WAVES} times: the nearest that have one are") as caught:
        WaveRoad((0.01, 0.01, 0.01), (35.123, 80.0401, 201.3), (0.0, 0.0, 0.0))
    nearest = str(caught.value).partition("have one are ")[2].partition(" 1/mm")[0]
    wavenumbers = tuple(float(one) for one in nearest.split(", "))
    assert WaveRoad((0.01, 0.01, 0.01), wavenumbers, (0.0, 0.0, 0.0)).period > 0.0
    np.testing.assert_allclose(wavenumbers, (35.123, 80.0401, 201.3), rtol=3e-4)


def test_lists_of_different_lengths_are_refused() -> None:
    with pytest.raises(InvalidInput, match="road has 2 amplitudes, 1 wavenumbers and 2 phases"):
        WaveRoad((0.01, 0.02), (35.0,), (0.0, 0.0))
