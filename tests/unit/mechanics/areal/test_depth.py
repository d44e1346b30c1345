"""Finite elements over the depth, against the closed form of the homogeneous layer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.areal.compliance import ArealCompliance
from rubfric.mechanics.areal.depth import depth_compliance
from rubfric.mechanics.theory.layer import layer_factor
from rubfric.rubber.material import Material


@pytest.mark.parametrize("ratio", [1e8, 50.0, 0.1 + 0.05j, 0.01])
def test_elements_converge_to_the_layer_at_fourth_order_however_incompressible(ratio: complex) -> None:
    height, waves = 0.75, np.geomspace(0.5, 60.0, 7)
    modulus = 4.0 * (3.0 * ratio + 1.0) / (3.0 * ratio + 4.0)
    layer = 2.0 / (waves * modulus * layer_factor(waves * height))
    errors = [
        np.abs(
            depth_compliance(waves, np.full(7, ratio, dtype=complex), np.linspace(0.0, height, rows + 1)) / layer - 1
        )
        for rows in (16, 32, 64)
    ]
    assert errors[-1].max() < 2e-3
    assert (errors[1][-3:] / errors[2][-3:]).min() > 10.0
    assert (errors[0] > errors[2]).all()


@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
def test_compliance_of_the_block_is_that_of_the_layer_for_all_but_the_shortest_waves(
    paper_rubber: Material, bulk: str
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    block = ArealCompliance(rubber, 100.0, 0.0, 0.75, (1.0, 1.0), (64, 64))
    found = block.surface((64, 64)).compliance
    kx, ky = 2.0 * np.pi * np.arange(33), 2.0 * np.pi * np.fft.fftfreq(64, 1.0 / 64)
    k = np.hypot(kx, ky[:, None])
    k[0, 0] = 1.0
    moving = np.where(kx < kx[-1], kx, 0.0)
    expected = 2.0 / (k * rubber.plane_modulus(100.0 * moving, "strain") * layer_factor(0.75 * k))
    near = (k < 0.5 * kx[-1]) & (k > 1.0)
    np.testing.assert_allclose(found[near], expected[near], rtol=1e-4)
    np.testing.assert_allclose(found[k > 1.0], expected[k > 1.0], rtol=1e-2)
    assert (found.real[k > 1.0] > 0.0).all()
    # Waves along y do not move, and their elements are no different from those solved one by one.
    still = np.array([3, 11])
    ratio = np.full(2, rubber.long_term_bulk_modulus / rubber.long_term_shear_modulus, dtype=complex)
    one = depth_compliance(k[still, 0], ratio, block.rows) / rubber.long_term_shear_modulus
    np.testing.assert_allclose(found[still, 0], one, rtol=1e-6)


@pytest.mark.parametrize("direction", [0.0, 30.0, 90.0])
def test_interpolated_factor_is_that_of_the_elements(paper_rubber: Material, direction: float) -> None:
    block = ArealCompliance(paper_rubber, 1000.0, direction, 0.75, (1.0, 0.5), (64, 128))
    waves, turns = np.geomspace(6.3, 500.0, 9), np.geomspace(7e3, 4e5, 9)
    shear, bulk = paper_rubber.complex_shear_modulus(turns), paper_rubber.complex_bulk_modulus(turns)
    expected = depth_compliance(waves, bulk / shear, block.rows) / shear
    np.testing.assert_allclose(block.compliance(waves, turns), expected, rtol=2e-5)
    np.testing.assert_allclose(block.compliance(waves, -turns), expected.conj(), rtol=2e-5)
    rates = block.rates((64, 128))
    assert np.abs(rates).max() < 2.0 * np.pi * 64.0 * 1.5
