"""Homogeneous states are exact on any mesh."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.small.response import stiffness_moduli
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
COMPRESSION, SHEAR = -0.07, 0.03


def uniform_forces(block: Block, moduli: tuple[float, float], displacement: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the forces on the nodes, N/mm, of displacements (i u_x, u_y) that do not vary along x."""
    forces = np.zeros_like(displacement)
    for operator, modulus in zip(block.operators(), moduli, strict=True):
        diagonal, upward = modulus * operator.diagonal[0], modulus * operator.upward[0]
        forces += np.einsum("rij,rj->ri", diagonal, displacement)
        forces[:-1] += np.einsum("rij,rj->ri", upward, displacement[1:])
        forces[1:] += np.einsum("rji,rj->ri", upward, displacement[:-1])
    return forces


@PLANES
@DILATATIONS
@pytest.mark.parametrize("growth", [1.05, 1.5])
def test_pressed_and_sheared_block_pushes_at_its_ends_only(
    paper_rubber: Material, plane: str, dilatation: str, growth: float
) -> None:
    block = Block.graded(0.18, 0.13, 64, plane, growth=growth, dilatation=dilatation)
    moduli = tuple(float(part[0].real) for part in stiffness_moduli(paper_rubber, np.zeros(1), plane))
    affine = np.outer(block.row_positions, (SHEAR, COMPRESSION))
    forces = uniform_forces(block, moduli, affine)
    stress = np.array(
        [paper_rubber.long_term_shear_modulus * SHEAR, paper_rubber.confined_modulus(plane) * COMPRESSION]
    )
    largest = np.abs(stress).max() * block.column_width
    np.testing.assert_allclose(forces[1:-1], 0.0, atol=1e-12 * largest)
    np.testing.assert_allclose(forces[-1], stress * block.column_width, rtol=1e-10)
    np.testing.assert_allclose(forces[0], -stress * block.column_width, rtol=1e-10)


@PLANES
@DILATATIONS
@pytest.mark.parametrize(("velocity", "pressure", "aspect"), [(0.1, 5.0, 0.75), (1e4, 0.01, 0.05), (10.0, 20.0, 4.0)])
def test_flat_road_gives_one_energy_density_everywhere(
    paper_scene: SceneMaker, plane: str, dilatation: str, velocity: float, pressure: float, aspect: float
) -> None:
    flat, numerics = SineScale(0.0, 35.0), Numerics(dilatation=dilatation)
    scene = paper_scene(velocity, pressure, plane=plane, road=flat, aspect=aspect, numerics=numerics)
    solution = solve(scene)
    result = evaluate(solution)
    modulus = {"strain": 69.5 + 4.0 / 3.0 * 4.17 / 2.98, "stress": 4.17 / (1.0 - 0.49**2)}[plane]
    np.testing.assert_allclose(result.density, pressure**2 / (2.0 * modulus), rtol=1e-12)
    np.testing.assert_allclose(result.depth_profile, pressure**2 / (2.0 * modulus), rtol=1e-12)
    np.testing.assert_allclose(solution.contact.pressure, pressure, rtol=1e-12)


@PLANES
def test_steep_growth_keeps_the_homogeneous_state(paper_scene: SceneMaker, plane: str) -> None:
    numerics = Numerics(row_growth=2.9, first_row=0.1)
    scene = paper_scene(1.0, 5.0, plane=plane, road=SineScale(0.0, 35.0), numerics=numerics)
    result = evaluate(solve(scene))
    np.testing.assert_allclose(result.density, result.density[0, 0], rtol=1e-12)
