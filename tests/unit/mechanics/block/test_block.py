from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from periodic_block import PeriodicBlock

from rubfric.mechanics.block.block import Block, RowOperator, fewest_rows, graded_rows

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["auto", "pointwise", "mean"])
COLUMNS = 12


def small_block(plane: str, dilatation: str = "auto") -> Block:
    """Return a block with rows of very different heights."""
    return Block(1.7, 0.9, COLUMNS, np.array([0.0, 0.05, 0.2, 0.3, 0.9]), plane, dilatation)


def harmonic_forces(operator: RowOperator, rows: Complex, angle: float) -> Complex:
    """Apply a form to the amplitudes (i u_x, u_y) of the rows of nodes, shape (rows + 1, 2)."""
    weights = np.array([1.0, 1.0 - np.cos(angle), np.sin(angle)])
    diagonal, upward = (np.tensordot(weights, part, axes=1) for part in (operator.diagonal, operator.upward))
    forces = np.einsum("rij,rj->ri", diagonal, rows)
    forces[:-1] += np.einsum("rij,rj->ri", upward, rows[1:])
    forces[1:] += np.einsum("rji,rj->ri", upward, rows[:-1])
    return forces


@pytest.mark.parametrize(
    ("plane", "dilatation", "pointwise"),
    [
        ("stress", "auto", True),
        ("strain", "auto", False),
        *((plane, "pointwise", True) for plane in ("stress", "strain")),
        *((plane, "mean", False) for plane in ("stress", "strain")),
    ],
)
@pytest.mark.parametrize("harmonic", [0, 1, 2, 5, COLUMNS // 2])
def test_operators_equal_a_full_periodic_assembly(
    plane: str, dilatation: str, pointwise: bool, harmonic: int, rng: np.random.Generator
) -> None:
    block = small_block(plane, dilatation)
    assert block.pointwise == pointwise
    full = PeriodicBlock(block.column_positions, block.width, block.row_positions)
    rows = rng.standard_normal((block.rows + 1, 2)) + 1j * rng.standard_normal((block.rows + 1, 2))
    angle = 2.0 * np.pi * harmonic / COLUMNS
    wave = np.exp(1j * angle * np.arange(COLUMNS))
    displacement = rows[:, :, None] * wave  # row, component, column
    displacement[:, 0] *= -1j
    for operator, matrix in zip(block.operators(), full.forms(plane, pointwise), strict=True):
        forces = (matrix @ displacement.ravel()).reshape(displacement.shape) / wave
        forces[:, 0] *= 1j
        expected = harmonic_forces(operator, rows, angle)
        np.testing.assert_allclose(forces, np.repeat(expected[:, :, None], COLUMNS, axis=2), atol=1e-12)


@PLANES
def test_operators_do_not_depend_on_the_size_of_the_block(plane: str) -> None:
    block = small_block(plane)
    larger = Block(10.0 * block.width, 10.0 * block.height, COLUMNS, 10.0 * block.row_positions, plane)
    for one, two in zip(block.operators(), larger.operators(), strict=True):
        np.testing.assert_allclose(one.diagonal, two.diagonal, atol=1e-12)
        np.testing.assert_allclose(one.upward, two.upward, atol=1e-12)


@PLANES
@DILATATIONS
def test_rigid_motion_costs_nothing(plane: str, dilatation: str) -> None:
    block = small_block(plane, dilatation)
    rigid = np.tile(np.array([0.3, -1.1]), (block.rows + 1, 1)).astype(complex)
    for operator in block.operators():
        np.testing.assert_allclose(harmonic_forces(operator, rigid, 0.0), 0.0, atol=1e-12)


@pytest.mark.parametrize("height", [0.13463968515384828, 1.0, 3.7])
@pytest.mark.parametrize("growth", [1.02, 1.15, 2.0])
def test_rows_grow_by_one_ratio_near_the_one_asked_for(height: float, growth: float) -> None:
    first = height / 300.0
    rows = graded_rows(height, first, growth)
    heights = np.diff(rows)
    ratio = heights[1:] / heights[:-1]
    assert rows[0] == 0.0
    assert rows[-1] == pytest.approx(height, rel=4e-16)
    assert heights[0] == pytest.approx(first, rel=1e-9)
    assert np.ptp(ratio) < 1e-9
    assert 1.0 < ratio[0] <= growth * (1.0 + 1e-12)


@pytest.mark.parametrize("growth", [1.02, 1.15, 1.3])
def test_no_row_more_than_the_growth_needs(growth: float) -> None:
    rows = len(graded_rows(1.0, 1e-3, growth)) - 1
    with_one_less = 1e-3 * (growth ** (rows - 1) - 1.0) / (growth - 1.0)
    assert with_one_less < 1.0


def test_growth_of_almost_one_gives_even_rows() -> None:
    heights = np.diff(graded_rows(1.0, 0.01, 1.0 + 1e-9))
    assert len(heights) in (100, 101)
    np.testing.assert_allclose(heights, heights[0], rtol=1e-6)


@pytest.mark.parametrize("height", [0.04, 0.01, 1e-4])
@pytest.mark.parametrize("growth", [2.0, 1.3, 1.15, 1.1, 1.01])
def test_flat_blocks_keep_the_fewest_rows_and_all_alike(height: float, growth: float) -> None:
    rows = graded_rows(height, 0.01, growth)
    np.testing.assert_allclose(rows, np.linspace(0.0, height, fewest_rows(growth) + 1), rtol=1e-12)


def test_fewest_rows_are_more_the_slower_they_grow_and_bounded() -> None:
    assert [fewest_rows(growth) for growth in (1.1, 1.05, 1.2)] == [12, 24, 6]
    fewest = [fewest_rows(growth) for growth in (3.0, 2.0, 1.5, 1.3, 1.1, 1.05, 1.03, 1.01, 1.00001)]
    assert fewest == sorted(fewest)
    assert (fewest[0], fewest[-1]) == (4, 64)


def test_block_starts_with_cells_of_the_shape_asked_for() -> None:
    for first_row in (0.5, 1.0, 2.0):
        block = Block.graded(1.0, 0.75, 256, "strain", growth=1.2, first_row=first_row)
        assert block.row_positions[1] / block.column_width == pytest.approx(first_row, rel=1e-9)


def test_columns_are_even_and_leave_out_the_repeated_one() -> None:
    block = Block.graded(2.0, 1.0, 16, "strain")
    np.testing.assert_allclose(block.column_positions, 0.125 * np.arange(16), rtol=1e-12)
    np.testing.assert_array_equal(block.harmonics, np.arange(9))


@PLANES
def test_quadrature_weights_add_up_to_the_area(plane: str) -> None:
    block = small_block(plane)
    weights = block.quadrature().weights
    assert np.all(weights > 0.0)
    np.testing.assert_allclose(weights.sum(axis=1), block.column_width * np.diff(block.row_positions), rtol=1e-12)
    assert block.columns * weights.sum() == pytest.approx(block.width * block.height, rel=1e-12)


def test_shapes_interpolate_and_gradients_differentiate() -> None:
    block = small_block("strain")
    quadrature = block.quadrature()
    corners = np.array([(x, y) for y in (0.0, 1.0) for x in (0.0, 1.0)])  # left low, right low, left high, right high
    assert np.all(quadrature.shapes > 0.0)
    np.testing.assert_allclose(quadrature.shapes.sum(axis=1), 1.0, rtol=1e-12)
    points = quadrature.shapes @ corners
    bilinear = (1.0 - points[:, :1]) * (1.0 - points[:, 1:])
    np.testing.assert_allclose(quadrature.shapes[:, :1], bilinear, atol=1e-12)
    for row, height in enumerate(np.diff(block.row_positions)):
        nodes = corners * (block.column_width, height)
        gradient = np.einsum("pni,nj->pij", quadrature.gradients[row], nodes)
        np.testing.assert_allclose(gradient, np.broadcast_to(np.eye(2), gradient.shape), atol=1e-12)


def test_quadrature_integrates_quadratics_in_each_direction_exactly() -> None:
    quadrature = Block(1.0, 1.0, 1, np.array([0.0, 1.0]), "strain").quadrature()
    x, y = (quadrature.shapes @ np.array([(0, 0), (1, 0), (0, 1), (1, 1)], dtype=float)).T
    assert quadrature.weights[0] @ (x**2 * y**2) == pytest.approx(1.0 / 9.0, rel=1e-12)


def test_strain_matrix_returns_the_strains_of_affine_displacements(rng: np.random.Generator) -> None:
    block = small_block("strain")
    gradient = rng.standard_normal((2, 2))  # du_i / dx_j
    matrix = block.quadrature().strain_matrix()
    for row, (low, high) in enumerate(zip(block.row_positions, block.row_positions[1:], strict=False)):
        nodes = np.array([(x, y) for y in (low, high) for x in (0.3, 0.3 + block.column_width)])
        strain = matrix[row] @ (nodes @ gradient.T).ravel()
        expected = [gradient[0, 0], gradient[1, 1], 0.5 * (gradient[0, 1] + gradient[1, 0])]
        np.testing.assert_allclose(strain, np.tile(expected, (4, 1)), atol=1e-12)
