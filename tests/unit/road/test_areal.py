"""Areal roads: their waves, heights and slopes; the same road on any nodes; scans; what is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator

from rubfric.errors import InvalidInput
from rubfric.road.areal import unit_vector
from rubfric.road.areal_scan import ScannedRoad, _filled
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine

ROUGH = SelfAffine(hurst=0.8, period=1.0, cut_off=0.05, rms_slope=0.25)


def test_waves_add_up_with_their_slopes_whatever_their_directions() -> None:
    waves = ((0.01, 10.0, 0.0, 0.3), (0.02, 20.0, 90.0, 0.2), (0.004, math.hypot(30.0, 40.0), 233.13010235415598, 1.0))
    spectrum = ArealWaves(*zip(*waves, strict=True)).spectrum
    np.testing.assert_allclose(spectrum.periods, (2.0 * math.pi / 10.0, 2.0 * math.pi / 20.0), rtol=1e-11)
    shape = (16, 32)
    x, y = (period / n * np.arange(n) for period, n in zip(spectrum.periods, reversed(shape), strict=True))
    x, y = np.meshgrid(x, y)
    height, slope = np.zeros(shape), np.zeros(shape)
    for amplitude, wavenumber, direction, phase in waves:
        kx, ky = wavenumber * unit_vector(direction)
        height += amplitude * np.sin(kx * x + ky * y + phase)
        slope += amplitude * (kx * 0.6 + ky * 0.8) * np.cos(kx * x + ky * y + phase)
    np.testing.assert_allclose(spectrum.heights(shape), height, atol=1e-11)
    np.testing.assert_allclose(spectrum.slopes(shape, math.degrees(math.atan2(0.8, 0.6))), slope, atol=1e-10)
    assert spectrum.rms_height == pytest.approx(height.std(), rel=1e-9)


def test_waves_that_run_opposite_ways_are_one() -> None:
    spectrum = ArealWaves((0.01, 0.01), (10.0, 10.0), (30.0, 210.0), (0.5 * math.pi, 0.5 * math.pi)).spectrum
    assert len(spectrum.amplitudes) == 1
    assert spectrum.rms_height == pytest.approx(0.02 / math.sqrt(2.0))


def test_waves_without_common_periods_are_refused_with_the_nearest() -> None:
    waves = ((0.01, 0.02), (10.0, 20.0), (0.0, 33.0), (0.0, 0.0))
    with pytest.raises(
        InvalidInput, match=r"10 1/mm at 0 degrees, 20 1/mm at 33 degrees, but must have a common"
    ) as told:
        ArealWaves(*waves)
    near = ArealWaves.nearest(*waves)
    assert f"{near.wavenumbers[1]:.8g}" in str(told.value)
    assert near.wavenumbers[1] == pytest.approx(20.0, rel=0.01)
    assert near.directions[1] == pytest.approx(33.0, abs=0.5)


@pytest.mark.parametrize(("key", "size"), [("rms_slope", 0.25), ("rms_height", 0.02)])
def test_self_affine_road_is_as_rough_as_asked_and_falls_as_its_exponent(key: str, size: float) -> None:
    road = SelfAffine(0.7, 2.0, 0.05, roll_off=0.5, seed=3, **{key: size})
    spectrum = road.spectrum
    assert getattr(spectrum, key) == pytest.approx(size, rel=1e-12)
    slopes = [spectrum.slopes((96, 96), angle) for angle in (0.0, 90.0)]
    assert spectrum.rms_slope == pytest.approx(math.sqrt(np.mean(np.square(slopes).sum(axis=0))), rel=1e-10)
    assert spectrum.wavenumbers.max() == pytest.approx(2.0 * math.pi / 0.05, rel=1e-9)
    lengths = 2.0 * math.pi / spectrum.wavenumbers
    coarse, roll, fine = (np.abs(spectrum.amplitudes[np.isclose(lengths, length)]) for length in (2.0, 0.5, 0.1))
    np.testing.assert_allclose(coarse, roll[0], rtol=1e-12)
    np.testing.assert_allclose(fine, roll[0] * 5.0**-1.7, rtol=1e-9)


def test_self_affine_road_is_the_same_on_any_nodes_and_its_coarse_waves_with_any_cut_off() -> None:
    fine = ROUGH.spectrum.heights((128, 128))
    np.testing.assert_allclose(ROUGH.spectrum.heights((64, 64)), fine[::2, ::2], atol=1e-15)
    cut = replace(ROUGH, cut_off=0.1).spectrum
    kept = ROUGH.spectrum.without(0.1)
    np.testing.assert_array_equal(cut.harmonics, kept.harmonics)
    np.testing.assert_allclose(cut.amplitudes / kept.amplitudes, cut.amplitudes[0] / kept.amplitudes[0], rtol=1e-12)
    # The raw bits of the generator, so a road stays what it is on other machines and with other versions.
    assert np.angle(ROUGH.spectrum.amplitudes[:2]) == pytest.approx(PHASES, abs=1e-12)
    assert abs(np.corrcoef(fine.ravel(), replace(ROUGH, seed=2).spectrum.heights((128, 128)).ravel())[0, 1]) < 0.5


PHASES = (-3.0673151949661492, -0.31124577541687004)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rms_height": 0.1}, "road must have one of rms_slope and rms_height"),
        ({"cut_off": 2.0}, "road.cut_off is 2 mm, but must be at most the roll-off, 1 mm"),
        ({"roll_off": 2.0}, "road.roll_off is 2 mm, but must be at most the period, 1 mm"),
        ({"cut_off": 1e-4}, "road.cut_off is 0.0001 mm, but must be at least 0.001953 mm"),
        ({"hurst": 1.2}, "road.hurst is 1.2, but must be at most 1"),
    ],
)
def test_self_affine_roads_that_cannot_be_are_refused(changes: dict[str, float], words: str) -> None:
    with pytest.raises(InvalidInput, match=words.replace("(", r"\(")):
        replace(ROUGH, **changes)


def test_scan_of_a_periodic_road_gives_it_back(rng: np.random.Generator) -> None:
    heights = ROUGH.spectrum.heights((64, 64))
    scan = ScannedRoad.of_heights(heights, (1.0 / 64, 1.0 / 64), degree=0, blend=0.0)
    assert scan.missing == 0
    np.testing.assert_allclose(scan.spectrum.heights((64, 64)), heights, atol=1e-15)
    longer = np.pad(heights, ((0, 8), (0, 8)), mode="wrap")  # blended into what it goes on as, nothing changes
    blended = ScannedRoad.of_heights(longer, (1.0 / 64, 1.0 / 64), degree=0, blend=0.125)
    assert blended.spectrum.periods == (1.0, 1.0)
    np.testing.assert_allclose(blended.spectrum.heights((64, 64)), heights, atol=1e-15)
    fine = ROUGH.spectrum.heights((256, 256))
    lacking = np.where(rng.random(fine.shape) < 0.05, np.nan, fine)
    filled = ScannedRoad.of_heights(lacking, (1.0 / 256, 1.0 / 256), degree=0, blend=0.0)
    assert filled.missing == np.count_nonzero(np.isnan(lacking))
    assert np.abs(filled.spectrum.heights((256, 256)) - fine).max() < 0.05 * fine.std()


def test_holes_are_filled_from_what_is_beside_them() -> None:
    y, x = np.mgrid[0:40, 0:60].astype(float)
    heights = np.sin(0.1 * x) * np.cos(0.1 * y)
    holes = (np.hypot(x - 20, y - 15) < 6) | ((x > 40) & (y > 30)) | (np.abs(x - y - 10) < 1) | (y + x < 8)
    found = _filled(heights, ~holes)
    np.testing.assert_array_equal(found[~holes], heights[~holes])
    all_known = LinearNDInterpolator(np.argwhere(~holes), heights[~holes])(np.argwhere(holes))
    inside = np.isfinite(all_known)
    np.testing.assert_allclose(found[holes][inside], all_known[inside], atol=0.01)  # where circles have ties, either
    nearest = NearestNDInterpolator(np.argwhere(~holes), heights[~holes])(np.argwhere(holes))
    assert 0 < np.count_nonzero(~inside) < inside.size
    np.testing.assert_allclose(found[holes][~inside], nearest[~inside], atol=0.1)  # two may be as near


def test_form_of_a_scan_is_removed_whatever_is_missing(rng: np.random.Generator) -> None:
    y, x = np.meshgrid(np.linspace(-1.0, 1.0, 40), np.linspace(-1.0, 1.0, 60), indexing="ij")
    form = 0.3 + 0.2 * x - 0.1 * y + 0.05 * x * x + 0.02 * x * y - 0.07 * y * y
    form[rng.random(form.shape) < 0.2] = np.nan
    scan = ScannedRoad.of_heights(form, (0.01, 0.02), degree=2)
    np.testing.assert_allclose(scan.form, (0.3, 0.2, -0.1, 0.05, 0.02, -0.07), atol=1e-13)
    assert scan.spectrum.rms_height < 1e-13


def test_scans_that_cannot_be_a_road_are_refused() -> None:
    with pytest.raises(InvalidInput, match=r"the shape \(4, 100\), but must have 8 x 8 heights or more"):
        ScannedRoad.of_heights(np.zeros((4, 100)), (0.1, 0.1))
    with pytest.raises(InvalidInput, match="lacks 210 of 400 heights, but at most half"):
        ScannedRoad.of_heights(np.where(np.arange(400).reshape(20, 20) < 210, np.nan, 1.0), (0.1, 0.1))
    with pytest.raises(InvalidInput, match="degree of the form is 3"):
        ScannedRoad.of_heights(np.zeros((20, 20)), (0.1, 0.1), degree=3)
