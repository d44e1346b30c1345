from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.road.road import Road, Waves, fourier_series
from rubfric.road.sine import SineScale


@dataclass(frozen=True)
class Sum(SineScale):
    """Waves of harmonics 1, 3 and 3 again, with phases."""

    @property
    def waves(self) -> Waves:
        return Waves(np.array([0.3, 0.2, 0.1]), self.wavenumber * np.array([3.0, 1.0, 3.0]), np.array([0.4, -1.0, 2.0]))


def test_sine_is_a_road_of_one_wave() -> None:
    road: Road = SineScale(0.015, 35.0)
    waves, place = road.waves, np.linspace(-0.3, 0.4, 7)
    summed = np.sin(np.outer(place, waves.wavenumbers) + waves.phases) @ waves.amplitudes
    np.testing.assert_allclose(summed, road.height(place), rtol=1e-14)
    assert road.period == road.waves.wavenumbers.size * 2.0 * np.pi / 35.0


def test_fourier_series_adds_up_to_the_waves() -> None:
    road = Sum(0.3, 35.0)
    harmonics, amplitudes = fourier_series(road)
    assert harmonics.tolist() == [1, 3]
    place, waves = np.linspace(0.0, road.period, 11), road.waves
    series = 2.0 * (np.exp(2j * np.pi / road.period * np.outer(place, harmonics)) @ amplitudes).real
    summed = np.sin(np.outer(place, waves.wavenumbers) + waves.phases) @ waves.amplitudes
    np.testing.assert_allclose(series, summed, atol=1e-15)
