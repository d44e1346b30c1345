from __future__ import annotations

import math

import numpy as np
import pytest

from rubfric.mechanics.theory import layer as reference
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


def test_layer_factor_at_the_papers_aspect() -> None:
    assert float(reference.layer_factor(2.0 * math.pi * 0.75)) == pytest.approx(0.99832, abs=5e-6)


@pytest.mark.parametrize("depth", [1.1e-3, 0.1, 1.0, 5.0, 30.0])
def test_layer_factor_is_the_formula(depth: float) -> None:
    formula = (math.sinh(depth) * math.cosh(depth) - depth) / math.cosh(depth) ** 2
    assert float(reference.layer_factor(depth)) == pytest.approx(formula, rel=1e-12)


@pytest.mark.parametrize("depth", [1e-12, 1e-6, 0.999e-3])
def test_thin_layer_factor_is_its_series_without_cancellation(depth: float) -> None:
    series = 2.0 * depth**3 / 3.0 * (1.0 - 4.0 * depth**2 / 5.0)  # cosh² q (...) expanded to the second term
    assert float(reference.layer_factor(depth)) == pytest.approx(series, rel=1e-6)


def test_layer_factor_has_no_step_where_series_and_formula_meet() -> None:
    below, above = reference.layer_factor(np.array([1e-3 * (1.0 - 1e-7), 1e-3 * (1.0 + 1e-7)]))
    assert above / below == pytest.approx(1.0, abs=2e-6)


def test_deep_layer_is_a_half_space() -> None:
    np.testing.assert_allclose(reference.layer_factor([20.0, 39.9, 40.1, 1e3, 1e300]), 1.0, rtol=1e-12)


def test_layer_factor_rises_with_depth() -> None:
    factors = reference.layer_factor(np.logspace(-4.0, 1.0, 200))
    assert np.all(np.diff(factors) > 0.0)


@PLANES
def test_compliance_of_a_half_space(paper_rubber: Material, plane: str) -> None:
    harmonics = np.array([1, 2, 7])
    compliance = reference.layer_compliance(paper_rubber, 35.0 * harmonics, 100.0, 50.0, plane)
    modulus = paper_rubber.plane_modulus(35.0 * 100.0 * harmonics, plane)
    np.testing.assert_allclose(compliance, 2.0 / (35.0 * harmonics * modulus), rtol=1e-12)


def test_thin_layer_bends_like_a_plate(elastic_rubber: Material) -> None:
    height = 1e-4
    plate = 1.0 / (elastic_rubber.plane_modulus(0.0, "strain").real * height**3 / 12.0 * 35.0**4)
    compliance = reference.layer_compliance(elastic_rubber, 35.0, 1.0, height, "strain")
    # Not exactly: the top cannot slide along itself, so the layer bends about its top, four times as stiff.
    assert compliance.real == pytest.approx(plate / 4.0, rel=1e-4)


def test_surface_lags_behind_the_pressure(paper_rubber: Material) -> None:
    compliance = reference.layer_compliance(paper_rubber, [35.0, 175.0], 100.0, 0.13, "strain")
    assert np.all(compliance.real > 0.0)
    assert np.all(compliance.imag < 0.0)


@PLANES
def test_full_contact_pressure_and_friction_are_their_formulas(paper_rubber: Material, plane: str) -> None:
    road, height = SineScale(0.015, 35.0), 0.75 * 2.0 * math.pi / 35.0
    modulus = complex(paper_rubber.plane_modulus(3500.0, plane))
    factor = 0.998324
    filled = reference.full_contact_pressure(paper_rubber, road, 100.0, height, plane)
    friction = reference.full_contact_friction(paper_rubber, road, 100.0, 7.0, height, plane)
    assert filled == pytest.approx(factor * 0.525 / 2.0 * abs(modulus), rel=1e-5)
    assert friction == pytest.approx(factor * 0.525**2 * modulus.imag / 28.0, rel=1e-5)


def test_full_contact_friction_agrees_with_the_papers_table(paper_rubber: Material) -> None:
    road, height = SineScale(0.015, 35.0), 0.75 * 2.0 * math.pi / 35.0
    friction = [
        reference.full_contact_friction(paper_rubber, road, velocity, 5.0, height, "strain")
        for velocity in (0.1, 1.0, 10.0, 100.0)
    ]
    np.testing.assert_allclose(friction, [0.0014, 0.0127, 0.0291, 0.1617], atol=2e-4)


def test_flat_road_needs_no_pressure_and_has_no_friction(paper_rubber: Material) -> None:
    flat = SineScale(0.0, 35.0)
    assert reference.full_contact_pressure(paper_rubber, flat, 100.0, 0.13, "strain") == 0.0
    assert reference.full_contact_friction(paper_rubber, flat, 100.0, 5.0, 0.13, "strain") == 0.0


def test_westergaard_without_load_half_way_and_filled() -> None:
    np.testing.assert_allclose(
        reference.westergaard_contact_fraction([0.0, 0.5, 1.0, 3.0]), [0.0, 0.5, 1.0, 1.0], atol=1e-12
    )


def test_westergaard_solves_its_equation() -> None:
    ratio = np.linspace(0.0, 1.0, 101)
    fraction = reference.westergaard_contact_fraction(ratio)
    np.testing.assert_allclose(np.sin(0.5 * np.pi * fraction) ** 2, ratio, atol=1e-12)


def test_westergaard_tends_to_hertz_for_light_loads() -> None:
    # A line contact on a crest of curvature a k²: half-width² = 4 p lambda / (pi E* a k²).
    ratio = 1e-6
    hertz = 2.0 / np.pi * math.sqrt(ratio)  # 2 x half-width / lambda, with p = ratio E* k a / 2
    assert float(reference.westergaard_contact_fraction(ratio)) == pytest.approx(hertz, rel=1e-6)
