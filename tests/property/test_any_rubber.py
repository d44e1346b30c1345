"""Any rubber of up to forty branches over twenty decades: what thermodynamics asks of its moduli."""

from __future__ import annotations

import math

import numpy as np
import pytest
from admissible import rubbers
from hypothesis import given, settings
from hypothesis import strategies as st

from rubfric.rubber.material import PLANES, Material
from rubfric.rubber.pruning import fold

# Of sums of up to forty terms of one sign.
ROUND_OFF = 1e-12
# Far below the slowest branch and far above the fastest, rad/s.
SLOWEST, FASTEST = 1e-60, 1e60
frequencies = np.logspace(-24.0, 24.0, 97)
planes = st.sampled_from(PLANES)


@given(rubbers())
@settings(max_examples=60)
def test_storage_modulus_rises_from_the_relaxed_to_the_glassy_one(rubber: Material) -> None:
    relaxed, glassy = rubber.long_term_shear_modulus, rubber.instantaneous_shear_modulus
    storage = rubber.complex_shear_modulus(frequencies).real
    assert (np.diff(storage) >= -ROUND_OFF * storage[1:]).all()
    assert storage.min() >= relaxed * (1.0 - ROUND_OFF)
    assert storage.max() <= glassy * (1.0 + ROUND_OFF + _left_out(rubber))
    ends = rubber.complex_shear_modulus(np.array([0.0, SLOWEST, FASTEST]))
    np.testing.assert_allclose(ends.real[:2], relaxed, rtol=ROUND_OFF)
    assert ends.real[2] == pytest.approx(glassy, rel=ROUND_OFF + _left_out(rubber))
    assert (np.abs(ends.imag) <= ROUND_OFF * glassy).all()


def _left_out(rubber: Material) -> float:
    """Return the relative round-off of 1 - sum of g_i, which divides every instantaneous modulus."""
    return 4e-16 * (1.0 + len(rubber.shear_fractions)) / rubber.long_term_fraction


@given(rubbers(), planes)
@settings(max_examples=60)
def test_no_modulus_gives_energy_back(rubber: Material, plane: str) -> None:
    for modulus in (
        rubber.complex_shear_modulus(frequencies),
        rubber.complex_bulk_modulus(frequencies),
        rubber.plane_modulus(frequencies, plane),
    ):
        assert (modulus.real > 0.0).all()
        assert (modulus.imag >= -ROUND_OFF * np.abs(modulus)).all()


@given(rubbers())
@settings(max_examples=60)
def test_relaxation_falls_from_the_glassy_to_the_relaxed_modulus(rubber: Material) -> None:
    times = np.concatenate(([0.0], np.logspace(-24.0, 24.0, 97)))
    kinds = [
        (rubber.shear_relaxation, rubber.long_term_shear_modulus),
        (rubber.bulk_relaxation, rubber.long_term_bulk_modulus),
    ]
    for relaxation, relaxed in kinds:
        values = relaxation(times)
        assert (np.diff(values) <= ROUND_OFF * values[:-1]).all()
        assert values[-1] == pytest.approx(relaxed, rel=ROUND_OFF)
    glassy = rubber.instantaneous_shear_modulus
    assert rubber.shear_relaxation(0.0) == pytest.approx(glassy, rel=ROUND_OFF + _left_out(rubber))


@given(rubbers())
@settings(max_examples=60)
def test_modulus_is_the_one_that_the_convention_names(rubber: Material) -> None:
    shear, bulk = rubber.long_term_shear_modulus, rubber.long_term_bulk_modulus
    if rubber.moduli == "instantaneous":
        shear, bulk = rubber.instantaneous_shear_modulus, float(rubber.bulk_relaxation(0.0))
    precision = 1e-9 + 4.0 * _left_out(rubber)
    assert 2.0 * shear * (1.0 + rubber.poissons_ratio) == pytest.approx(rubber.youngs_modulus, rel=precision)
    assert 3.0 * bulk * (1.0 - 2.0 * rubber.poissons_ratio) == pytest.approx(rubber.youngs_modulus, rel=precision)


@given(rubbers())
@settings(max_examples=60)
def test_proportional_bulk_keeps_poissons_ratio_and_elastic_bulk_its_modulus(rubber: Material) -> None:
    ratio, bulk = rubber.effective_poissons_ratio(frequencies), rubber.complex_bulk_modulus(frequencies)
    assert (ratio > -1.0 - 1e-9).all()
    assert (ratio < 0.5 + 1e-9).all()
    if rubber.bulk == "elastic":
        np.testing.assert_array_equal(bulk, rubber.long_term_bulk_modulus)
    else:
        np.testing.assert_allclose(ratio, rubber.poissons_ratio, atol=1e-9)


@given(rubbers(), st.integers(1, 64), st.floats(-12.0, 12.0), st.floats(-8.0, -0.5))
@settings(max_examples=60)
def test_folding_keeps_its_bound(rubber: Material, harmonics: int, power: float, tolerance: float) -> None:
    excited = 10.0**power * np.arange(1.0, harmonics + 1.0)
    folding = fold(rubber, excited, 10.0**tolerance)
    assert 0.0 <= folding.bound <= 10.0**tolerance
    before, after = (material.complex_shear_modulus(excited) for material in (rubber, folding.material))
    assert (np.abs(after - before) <= folding.bound * before.imag * (1.0 + 1e-6) + 1e-300).all()
    assert math.isfinite(folding.material.instantaneous_shear_modulus)
