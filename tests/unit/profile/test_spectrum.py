"""Spectra against profiles whose spectrum is known: variance, slope, level, trusted band, octaves, sines."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.profile.analysis import analyse
from rubfric.profile.band import hurst, trusted
from rubfric.profile.cleaning import clean
from rubfric.profile.measured import Profile
from rubfric.profile.reading import read
from rubfric.profile.scales import octaves, sines
from rubfric.profile.spectrum import periodogram, welch
from rubfric.profile.virtual import self_affine

POINTS, SPACING, LEVEL = 2**14, 0.05, 0.01


def road(rng: np.random.Generator, exponent: float, **ends: float) -> Profile:
    return Profile("road", 0.0, SPACING, self_affine(rng, POINTS, SPACING, exponent, LEVEL, **ends))


@pytest.mark.parametrize("points", [1000, 1001])
def test_periodogram_has_the_variance_of_heights_and_slopes(points: int, rng: np.random.Generator) -> None:
    heights = rng.standard_normal(points)
    heights -= heights.mean()
    spectrum = periodogram(heights, 30.0)
    step = spectrum.wavenumbers[0]
    assert np.sum(spectrum.density) * step == pytest.approx(np.mean(heights**2), rel=1e-13)
    assert spectrum.integral(0.0, 1e9) == pytest.approx(np.mean(heights**2), rel=1e-13)
    wave = periodogram(np.cos(2.0 * np.pi * 7.0 * np.arange(points) / points), 30.0)
    assert wave.integral(0.0, 1e9, 1) == pytest.approx(0.5 * (2.0 * np.pi * 7.0 / 30.0) ** 2, rel=1e-12)


def test_slope_and_level_of_self_affine_roads_are_within_their_confidence() -> None:
    inside = np.zeros((2, 60))
    for seed in range(60):
        rng = np.random.default_rng(seed)
        exponent = rng.uniform(0.3, 0.95)
        profile = road(rng, exponent)
        spectrum = welch(profile)
        band = trusted(spectrum, SPACING)
        law = hurst(spectrum, band)
        assert law is not None
        known = math.log(LEVEL) - (1.0 + 2.0 * exponent) * math.log(law.reference)
        inside[:, seed] = (
            abs(law.exponent - exponent) <= law.error,
            abs(math.log(law.level) - known) <= law.level_error,
        )
        assert law.exponent == pytest.approx(exponent, abs=0.06)
    # 95 % intervals: of 60, 57 are expected, and fewer than 50 in one case of a thousand.
    assert inside.sum(axis=1).min() >= 50, inside.mean(axis=1)


def test_noise_and_roll_off_bound_the_trusted_band() -> None:
    clear = disturbed = 0
    for seed in range(20):
        rng = np.random.default_rng(100 + seed)
        profile = road(rng, 0.8, longest=20.0)
        spectrum = welch(profile)
        band = trusted(spectrum, SPACING)
        clear += band.wavelengths[0] == pytest.approx(4.0 * SPACING)
        assert 2.0 * math.pi / band.roll_off == pytest.approx(20.0, rel=0.5)
        noise = 0.01
        noisy = Profile("road", 0.0, SPACING, profile.heights + noise * rng.standard_normal(POINTS))
        # White noise has the density variance / q_max; the road is as strong at this wavelength.
        equal = 2.0 * math.pi * (noise**2 * SPACING / math.pi / LEVEL) ** (1.0 / 2.6)
        bound = trusted(welch(noisy), SPACING)
        disturbed += "as noise makes it" in bound.why_high and 1.2 * equal < bound.wavelengths[0] < 5.0 * equal
    assert (clear, disturbed) == (20, 20)


def test_octaves_hold_the_variance_of_their_waves() -> None:
    x = SPACING * np.arange(POINTS)
    heights = 0.2 * np.sin(2.0 * np.pi * x / 8.0) + 0.05 * np.sin(2.0 * np.pi * x / 2.0)
    found = {one.wavelength: one for one in octaves(welch(Profile("road", 0.0, SPACING, heights)))}
    assert found[8.0].height == pytest.approx(0.2 / math.sqrt(2.0), rel=0.01)
    assert found[2.0].slope == pytest.approx(0.05 * math.pi / math.sqrt(2.0), rel=0.01)
    assert found[4.0].height < 0.001


@pytest.mark.parametrize("count", [1, 3, 6])
def test_sines_have_the_variance_of_slopes_and_a_short_common_period(count: int, rng: np.random.Generator) -> None:
    spectrum = welch(road(rng, 0.8))
    found = sines(spectrum, count, 40.0, 0.5)
    waves = found.waves
    slopes = spectrum.integral(2.0 * math.pi / 40.0, 2.0 * math.pi / 0.5, 1)
    heights = spectrum.integral(2.0 * math.pi / 40.0, 2.0 * math.pi / 0.5)
    assert 0.5 * np.sum((waves.amplitudes * waves.wavenumbers) ** 2) == pytest.approx(slopes, rel=1e-3)
    assert 0.5 * np.sum(waves.amplitudes**2) == pytest.approx(heights, rel=0.05)
    assert found.period <= 12.0 * found.wavelength


def test_windows_and_cutoffs_that_a_profile_does_not_have(rng: np.random.Generator) -> None:
    cleaned = clean(road(rng, 0.8))
    for given, words in (
        (
            {"length": 800.0},
            "the window is 800 mm long, .* has 819.2 mm without long gaps: the longest window is 743 mm",
        ),
        ({"cutoff": 0.09}, "--cutoff is 0.09 mm, but must be at least 0.1 mm, twice the spacing"),
        ({"length": 400.0, "cutoff": 0.5}, "--cutoff is 0.5 mm, but must be at least 0.7812 mm, a 512th of the window"),
        ({"cutoff": 30.0}, "--cutoff is 30 mm, but must be at most half the window, 20 mm"),
    ):
        with pytest.raises(InvalidInput, match=words):
            analyse(cleaned, **given)
    with pytest.raises(InvalidInput, match="is flat: all of its heights are alike"):
        analyse(clean(Profile("road", 0.0, SPACING, 3.0 + 0.1 * np.arange(500.0))))


def test_the_example_is_found_as_it_was_made() -> None:
    folder = Path(__file__).resolve().parents[3] / "examples/own_road"
    found = analyse(clean(read(str(folder / "street.csv"))))
    table = (folder / "README.md").read_text(encoding="utf-8")
    assert found.hurst is not None
    assert abs(found.hurst.exponent - 0.8) < found.hurst.error
    assert dict(found.cleaned.removed)["Spikes"].startswith("25, of 25 points")
    for value in (
        f"| {found.hurst.exponent:.3f} ± {found.hurst.error:.3f} |",
        f"| {found.moments[0]:.3f} |",
        f"| {found.depth.mean:.3f} ± {found.depth.scatter:.2f} |",
        f"| {found.slope:.3f} |",
    ):
        assert value in table
