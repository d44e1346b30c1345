"""The block condensed to its surface: its modes answer to every frequency as the block does."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import PROPORTIONAL, RUBBER, WIDTH

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.small.modes import surface_modes
from rubfric.mechanics.small.response import respond
from rubfric.rubber.material import Material

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL], ids=["elastic bulk", "both"])


def block(plane: str) -> Block:
    return Block.graded(WIDTH, 0.4 * WIDTH, 16, plane, growth=1.05)


@PLANES
@RUBBERS
@pytest.mark.parametrize("velocity", [1e-3, 30.0, 1e4])
def test_compliance_is_that_of_the_block_at_every_frequency(plane: str, rubber: Material, velocity: float) -> None:
    meshed = block(plane)
    modes = surface_modes(meshed)
    frequency = 2.0 * np.pi / WIDTH * velocity * modes.harmonic
    moduli = modes.modulus(rubber.complex_shear_modulus(frequency), rubber.complex_bulk_modulus(frequency))
    found = modes.surface(modes.reach / moduli)[1:] * meshed.column_width
    expected = respond(meshed, rubber, velocity, meshed.harmonics[1:]).compliance
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@PLANES
@RUBBERS
def test_harmonic_zero_is_confined_compression(plane: str, rubber: Material) -> None:
    modes = surface_modes(block(plane))
    relaxed = modes.modulus(rubber.long_term_shear_modulus, rubber.long_term_bulk_modulus)
    strain = modes.surface((modes.reach / relaxed).astype(complex))[0]
    assert strain == pytest.approx(1.0 / rubber.confined_modulus(plane), rel=1e-12)


@PLANES
def test_every_mode_is_stable_and_every_branch_a_share_of_it(plane: str) -> None:
    modes = surface_modes(block(plane))
    assert modes.shear.min() >= 0.0
    assert modes.bulk.min() >= 0.0
    assert (modes.shear + modes.bulk).min() > 0.0
    branches = modes.branch_moduli(PROPORTIONAL)
    ratio = PROPORTIONAL.branch_shear_moduli / PROPORTIONAL.long_term_shear_modulus
    relaxed = modes.modulus(PROPORTIONAL.long_term_shear_modulus, PROPORTIONAL.long_term_bulk_modulus)
    np.testing.assert_allclose(branches, np.outer(ratio, relaxed), rtol=1e-12)


def test_modes_without_dilatation_have_none_to_round_off() -> None:
    modes = surface_modes(block("strain"))
    assert np.all((modes.bulk == 0.0) | (modes.bulk > 1e-12))
    one, other = (modes.surface((modes.reach / modes.modulus(1.0, bulk)).astype(complex))[1:] for bulk in (1e8, 1e11))
    np.testing.assert_allclose(one, other, rtol=1e-6)
