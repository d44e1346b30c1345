from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric import simulation as steady
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.small.strain import StrainHarmonics, harmonic_strain, synthesise
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
Complex = NDArray[np.complex128]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
COLUMNS = 16
HARMONICS = np.arange(1, COLUMNS // 2 + 1)


def small_block(plane: str, dilatation: str) -> Block:
    return Block.graded(0.2, 0.08, COLUMNS, plane, growth=1.4, first_row=0.6, dilatation=dilatation)


def cell_strains(block: Block, rows: Complex, harmonic: int, row: int, column: int) -> Complex:
    """Return the 3-D in-plane strain tensors (points, 2, 2) of one cell, from u(y) exp(i n k x)."""
    matrix = block.quadrature().strain_matrix()[row]
    phase = [np.exp(2j * np.pi * harmonic * side / block.columns) for side in (column, column + 1)]
    nodes = np.concatenate([rows[level] * turn for level in (row, row + 1) for turn in phase])
    xx, yy, xy = (matrix @ nodes).T
    return np.array(((xx, xy), (xy, yy))).transpose(2, 0, 1)


def dilatations(block: Block, strain: Complex, row: int) -> Complex:
    """Return what counts as in-plane dilatation at the points of a cell: its value there, or its mean."""
    pointwise = strain[:, 0, 0] + strain[:, 1, 1]
    if block.dilatation == "pointwise":
        return pointwise
    return np.full_like(pointwise, np.average(pointwise, weights=block.quadrature().weights[row]))


def shear_squares(block: Block, strain: Complex, thickness: complex, row: int) -> list[float]:
    """Return |e|² at the points of a cell, such that shear and volume together make the strain-energy density.

    Where rubber bulges across the thickness by the mean dilatation, the square is that of the strains less a third
    of that of the volume, which is no square of any one deviator.
    """
    across = thickness * dilatations(block, strain, row)
    squares = []
    for tensor, bulge in zip(strain, across, strict=True):
        solid = np.zeros((3, 3), dtype=complex)
        solid[:2, :2] = tensor
        solid[2, 2] = bulge
        volume = np.trace(solid)
        if block.plane == "stress" and block.dilatation == "mean":
            volume = (1.0 + thickness) / thickness * bulge
        squares.append(np.sum(np.abs(solid) ** 2) - np.abs(volume) ** 2 / 3.0)
    return squares


def random_strain(
    plane: str, dilatation: str, rubber: Material, rng: np.random.Generator
) -> tuple[Block, Complex, Complex, StrainHarmonics]:
    block = small_block(plane, dilatation)
    response = respond(block, rubber, 100.0, HARMONICS)
    shape = (block.rows + 1, 2, len(HARMONICS))
    displacement = rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    thickness = rubber.thickness_ratio(3500.0 * HARMONICS, plane)
    return block, thickness, displacement, harmonic_strain(block, response, thickness, displacement)


@PLANES
@DILATATIONS
def test_squares_equal_those_of_the_strain_tensors_cell_by_cell(
    plane: str, dilatation: str, paper_rubber: Material, rng: np.random.Generator
) -> None:
    block, thickness, displacement, strain = random_strain(plane, dilatation, paper_rubber, rng)
    weights = block.quadrature().weights
    for row in range(block.rows):
        for index in (0, 3, 7):
            tensors = cell_strains(block, displacement[..., index], HARMONICS[index], row, 5)
            volume = (1.0 + thickness[index]) * dilatations(block, tensors, row)
            shear = shear_squares(block, tensors, thickness[index], row)
            assert strain.shear_square[row, index] == pytest.approx(weights[row] @ shear, rel=1e-11)
            assert strain.volume_square[row, index] == pytest.approx(weights[row] @ np.abs(volume) ** 2, rel=1e-11)


@PLANES
@DILATATIONS
def test_nodal_strains_are_averages_over_the_cells_around_by_area(
    plane: str, dilatation: str, paper_rubber: Material, rng: np.random.Generator
) -> None:
    block, _, displacement, strain = random_strain(plane, dilatation, paper_rubber, rng)
    quadrature = block.quadrature()
    for index in (0, 3, 7):
        for level in range(block.rows + 1):
            total, area = np.zeros(4, dtype=complex), 0.0
            for row, vertical in ((level - 1, 1), (level, 0)):
                for column, sideways in ((-1, 1), (0, 0)):
                    if not 0 <= row < block.rows:
                        continue
                    tensors = cell_strains(block, displacement[..., index], HARMONICS[index], row, column)
                    share = quadrature.weights[row] * quadrature.shapes[:, 2 * vertical + sideways]
                    parts = (tensors[:, 0, 0], tensors[:, 1, 1], tensors[:, 0, 1], dilatations(block, tensors, row))
                    total += [share @ part for part in parts]
                    area += share.sum()
            np.testing.assert_allclose(strain.nodal[level, :, index], total / area, rtol=1e-11, atol=1e-11)


@PLANES
def test_nodal_strains_inside_are_near_the_derivatives_of_the_displacement(paper_scene: SceneMaker, plane: str) -> None:
    # At the road and at the top only one side is averaged, so those rows lag by half a cell.
    scene = paper_scene(1.0, 5.0, plane=plane, numerics=Numerics(**fineness(1.0), refinements=0))
    solution = steady.solve(scene)
    displacement = solution.response.displacement(solution.surface)
    thickness = scene.material.thickness_ratio(solution.frequencies, plane)
    strain = harmonic_strain(solution.block, solution.response, thickness, displacement)
    stretch = 1j * scene.road.wavenumber * displacement[:, 0]
    largest = np.abs(stretch).max()
    np.testing.assert_allclose(strain.nodal[1:-1, 0], stretch[1:-1], atol=0.01 * largest)
    np.testing.assert_allclose(strain.nodal[0, 0], stretch[0], atol=0.05 * largest)


@PLANES
def test_harmonics_that_have_faded_carry_no_strain(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1e4, 5.0, plane=plane)
    solution = steady.solve(scene)
    displacement = solution.response.displacement(solution.surface)
    thickness = scene.material.thickness_ratio(solution.frequencies, plane)
    strain = harmonic_strain(solution.block, solution.response, thickness, displacement)
    assert strain.shear_square[0, -1] > 0.0
    assert strain.shear_square[-1, -1] == 0.0
    assert np.all(strain.nodal[-1, :, -1] == 0.0)


@pytest.mark.parametrize("columns", [8, 16, 30, 64])
@pytest.mark.parametrize("first", [1, 3])
def test_synthesis_equals_the_direct_sum_folded_or_not(columns: int, first: int, rng: np.random.Generator) -> None:
    harmonics = np.arange(first, first + 40)
    amplitude = rng.standard_normal((2, 3, 23)) + 1j * rng.standard_normal((2, 3, 23))
    position = 2.0 * np.pi * np.arange(columns) / columns
    direct = 2.0 * np.real(amplitude @ np.exp(1j * np.outer(harmonics[:23], position)))
    np.testing.assert_allclose(synthesise(amplitude, harmonics, columns), direct, atol=1e-12)
