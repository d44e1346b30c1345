"""Fields of one mesh on another: exact where the other can hold them."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import RUBBER, WAVENUMBER, WIDTH, coarse, random_step, uniform

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.prolongation import prolong

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


def meshed(plane: str, columns: int, growth: float = 1.6) -> FiniteBlock:
    return FiniteBlock(Block.graded(WIDTH, 0.75 * WIDTH, columns, plane, growth=growth), RUBBER, 100.0)


def plane_stress(finite: FiniteBlock) -> bool:
    return finite.block.plane == "stress"


def waves(finite: FiniteBlock) -> Fields:
    """Return one harmonic along the road, linear over the height."""
    block, fields = finite.block, finite.at_rest()
    along, up = WAVENUMBER * block.column_positions, block.row_positions[:, None] / block.height
    fields.displacement[:] = 0.1 * (1.0 - up) * np.sin(along + 0.3), 0.2 + 0.1 * up * np.cos(2.0 * along)
    middle, heights = along + 0.5 * WAVENUMBER * block.column_width, np.diff(block.row_positions)
    points = finite.quadrature.shapes[:, 2:].sum(axis=1)
    centre = np.array([0.5])
    for field, shares in ((fields.log_thickness, points), (fields.volume, points if plane_stress(finite) else centre)):
        rise = (block.row_positions[:-1] + shares[:, None] * heights) / block.height  # (point, row)
        field[:] = 0.9 + 0.1 * rise[..., None] * np.sin(middle - 0.7)
    return fields


@PLANES
def test_fields_on_their_own_mesh_stay(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane)
    smooth = uniform(finite, 0.7, 0.2, 1.3).moved(random_step(finite, rng, 0.2))
    for field in (smooth.displacement, smooth.log_thickness, smooth.volume):
        spectrum = np.fft.rfft(field)
        spectrum[..., -1] = 0.0  # the mesh does not know its phase
        field[:] = np.fft.irfft(spectrum, field.shape[-1])
    found = prolong(smooth, finite, finite)
    np.testing.assert_allclose(found.displacement, smooth.displacement, atol=1e-12)
    np.testing.assert_allclose(found.log_thickness, smooth.log_thickness, atol=1e-12)
    np.testing.assert_allclose(found.volume, smooth.volume, atol=1e-12)


@PLANES
@pytest.mark.parametrize(("before", "after"), [(16, 64), (16, 24), (64, 16), (24, 24)])
@pytest.mark.parametrize("growth", [1.1, 1.6])
def test_linear_fields_of_few_harmonics_are_carried_exactly(plane: str, before: int, after: int, growth: float) -> None:
    old, new = meshed(plane, before), meshed(plane, after, growth)
    found, expected = prolong(waves(old), old, new), waves(new)
    np.testing.assert_allclose(found.displacement, expected.displacement, atol=1e-12)
    np.testing.assert_allclose(found.log_thickness, expected.log_thickness, atol=1e-12)
    np.testing.assert_allclose(found.volume, expected.volume, atol=1e-12)


@PLANES
def test_uniform_blocks_are_carried_exactly(plane: str) -> None:
    old, new = meshed(plane, 16), meshed(plane, 40, 1.2)
    found, expected = prolong(uniform(old, 0.6, 0.3, 1.2), old, new), uniform(new, 0.6, 0.3, 1.2)
    np.testing.assert_allclose(found.displacement, expected.displacement, atol=1e-12)
    np.testing.assert_allclose(found.log_thickness, expected.log_thickness, atol=1e-12)
    np.testing.assert_allclose(found.volume, expected.volume, atol=1e-12)


@PLANES
def test_the_way_to_a_finer_mesh_and_back_changes_nothing(plane: str) -> None:
    old, new = meshed(plane, 16), meshed(plane, 64)
    fields = waves(old)
    there = prolong(fields, old, new)
    np.testing.assert_allclose(prolong(there, new, old).displacement, fields.displacement, atol=1e-12)


def test_plane_strain_has_no_thickness_to_carry() -> None:
    old, new = meshed("strain", 16), meshed("strain", 24)
    assert prolong(old.at_rest(), old, new).log_thickness.shape == new.at_rest().log_thickness.shape
