from __future__ import annotations

import math

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale


def test_coarsest_scale_of_the_paper(paper_road: tuple[SineScale, ...]) -> None:
    coarse = paper_road[0]
    assert coarse.wavelength == pytest.approx(0.1795, abs=5e-5)
    assert coarse.excitation_frequency(100.0) == 3500.0


def test_slopes_of_the_paper_are_not_small(paper_road: tuple[SineScale, ...]) -> None:
    np.testing.assert_allclose([scale.steepest_slope for scale in paper_road], [0.525, 0.48, 0.6, 0.6], rtol=1e-12)


def test_height_is_a_sine_with_crest_and_trough_at_the_quarters() -> None:
    scale = SineScale(0.25, 2.0 * math.pi)
    np.testing.assert_allclose(scale.height([0.0, 0.25, 0.5, 0.75, 1.0]), [0.0, 0.25, 0.0, -0.25, 0.0], atol=1e-12)


def test_slope_and_curvature_are_derivatives_of_the_height() -> None:
    scale = SineScale(0.015, 35.0)
    position, step = np.linspace(0.0, scale.wavelength, 41), 1e-6
    difference = (scale.height(position + step) - scale.height(position - step)) / (2.0 * step)
    np.testing.assert_allclose(scale.slope(position), difference, atol=1e-9)
    difference = (scale.slope(position + step) - scale.slope(position - step)) / (2.0 * step)
    np.testing.assert_allclose(scale.curvature(position), difference, atol=1e-7)


def test_road_repeats_after_a_wavelength(paper_road: tuple[SineScale, ...]) -> None:
    for scale in paper_road:
        position = np.linspace(0.0, scale.wavelength, 11)
        np.testing.assert_allclose(scale.height(position + scale.wavelength), scale.height(position), atol=1e-12)


def test_flat_road_is_legal() -> None:
    assert np.all(SineScale(0.0, 35.0).height(np.linspace(0.0, 1.0, 5)) == 0.0)


@pytest.mark.parametrize(
    ("amplitude", "wavenumber", "complaint"),
    [
        (-0.1, 35.0, r"^road\.amplitude is -0.1 mm, but must be at least 0$"),
        (0.1, 0.0, r"^road\.wavenumber is 0 1/mm, but must be greater than 0$"),
        (0.1, float("inf"), r"^road\.wavenumber is inf, but must be a finite number$"),
        ("1e-2", 35.0, r"^road\.amplitude is the text '1e-2', .* write 1\.0e-2\)$"),
    ],
)
def test_bad_scales_are_refused(amplitude: float, wavenumber: float, complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        SineScale(amplitude, wavenumber)
