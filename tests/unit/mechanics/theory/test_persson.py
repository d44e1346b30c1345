from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.theory.layer import filling_pressures, full_contact_friction
from rubfric.mechanics.theory.persson import contact_fractions, persson_friction, scales
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

ROAD = WaveRoad((0.015, 0.006, 0.003, 0.002), (35.0, 80.0, 200.0, 300.0), (0.0,) * 4)
HEIGHT = 0.75 * ROAD.wavelength
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


@pytest.mark.parametrize(
    ("velocity", "friction"),
    [(0.1, 0.029), (1.0, 0.093), (10.0, 0.331), (100.0, 0.720), (500.0, 0.741), (1000.0, 0.688), (1e4, 0.452)],
)
def test_total_of_the_papers_road(paper_rubber: Material, velocity: float, friction: float) -> None:
    # Computed apart, in integrals over the sines of the road, to three digits.
    found = persson_friction(paper_rubber, ROAD, velocity, 5.0, HEIGHT, "strain")
    assert found.shape == (4,)
    assert float(found.sum()) == pytest.approx(friction, abs=6e-4)


@PLANES
def test_heavy_load_is_full_contact_of_every_scale(paper_rubber: Material, plane: str) -> None:
    pressure = 10.0 * float(np.linalg.norm(filling_pressures(paper_rubber, ROAD, 1.0, HEIGHT, plane)))
    sines = [SineScale(a, k) for a, k in zip(ROAD.amplitudes, ROAD.wavenumbers, strict=True)]
    full = [full_contact_friction(paper_rubber, sine, 1.0, pressure, HEIGHT, plane) for sine in sines]
    for gamma in (1.0, 0.5):
        found = persson_friction(paper_rubber, ROAD, 1.0, pressure, HEIGHT, plane, gamma)
        np.testing.assert_allclose(found, full, rtol=1e-12)


@PLANES
def test_light_load_touches_in_proportion_and_halves_slopes_with_gamma(paper_rubber: Material, plane: str) -> None:
    sine = SineScale(0.015, 35.0)
    filling = float(filling_pressures(paper_rubber, sine, 100.0, HEIGHT, plane)[0])
    loads = filling * np.array([1e-4, 2e-4])
    share = contact_fractions(paper_rubber, sine, 100.0, loads, HEIGHT, plane)
    np.testing.assert_allclose(share[0], 2.0 / math.sqrt(math.pi) * loads / filling, rtol=1e-7)
    friction = persson_friction(paper_rubber, sine, 100.0, loads, HEIGHT, plane)
    limit = full_contact_friction(paper_rubber, sine, 100.0, filling, HEIGHT, plane) * 2.0 / math.sqrt(math.pi)
    np.testing.assert_allclose(friction[0], limit, rtol=1e-7)
    half = persson_friction(paper_rubber, sine, 100.0, loads, HEIGHT, plane, 0.5)
    np.testing.assert_allclose(half, 0.5 * friction, rtol=1e-6)


def test_contact_shrinks_from_coarse_to_fine_and_grows_with_load(paper_rubber: Material) -> None:
    share = contact_fractions(paper_rubber, ROAD, 100.0, [0.1, 1.0, 5.0], HEIGHT, "strain")
    assert share.shape == (4, 3)
    assert np.all(np.diff(share, axis=0) < 0.0)
    assert np.all(np.diff(share, axis=1) > 0.0)


def test_scales_are_ascending_and_waves_of_one_wavenumber_are_one() -> None:
    road = WaveRoad(
        (0.003, 0.003, 0.004, 0.001, 0.001), (80.0, 35.0, 35.0, 200.0, 200.0), (1.0, 0.0, math.pi / 2, 0.0, math.pi)
    )
    amplitudes, wavenumbers = scales(road)
    np.testing.assert_allclose(amplitudes, [0.005, 0.003], rtol=1e-11)
    np.testing.assert_allclose(wavenumbers, [35.0, 80.0], rtol=1e-12)


def test_phases_do_not_matter(paper_rubber: Material) -> None:
    other = replace(ROAD, phases=(0.3, 1.0, 2.0, 5.0))
    found = [persson_friction(paper_rubber, road, 10.0, 1.0, HEIGHT, "stress") for road in (ROAD, other)]
    np.testing.assert_allclose(found[0], found[1], rtol=1e-12)
