"""The averaged block: a direct solver that is exact where the block is the same everywhere along the road."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import ELASTIC, PROPORTIONAL, RUBBER, WAVENUMBER, coarse, flat, random_step, uniform
from numpy.typing import NDArray

from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.small.response import respond
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])


def averaged(finite: FiniteBlock, fields: Fields, pressure: float = 0.0) -> Circulant:
    return Circulant(finite, finite.stiffness(fields, finite.stressed(fields)), pressure)


def response(finite: FiniteBlock, fields: Fields, step: Fields) -> tuple[Real, Real, Real]:
    """Return the nodal forces, the thickness stresses and the excess of volume of a small step about some fields."""
    change, excess = finite.change(finite.stiffness(fields, finite.stressed(fields)), step)
    return finite.forces(change[:4]), change[4:], excess


@PLANES
@DILATATIONS
@RUBBERS
@pytest.mark.parametrize("columns", [16, 18])
def test_step_of_a_pressed_and_sheared_block_is_found_exactly(
    plane: str, dilatation: str, rubber: Material, columns: int, rng: np.random.Generator
) -> None:
    finite = coarse(plane, rubber, columns, dilatation=dilatation)
    fields, step = uniform(finite, 0.6, 0.3, 1.2), random_step(finite, rng)
    circulant = averaged(finite, fields)
    found = circulant.solve(circulant.right_side(*response(finite, fields, step)), np.zeros((2, columns)))
    np.testing.assert_allclose(found.displacement, step.displacement, atol=1e-9 * np.abs(step.displacement).max())
    np.testing.assert_allclose(found.log_thickness, step.log_thickness, atol=1e-9)
    np.testing.assert_allclose(found.volume, step.volume, atol=1e-9)


@PLANES
@RUBBERS
def test_pressure_of_the_road_turns_with_the_surface(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite, pressure = coarse(plane, rubber), 2.0
    fields, step = flat(finite, pressure), random_step(finite, rng)
    forces, thickness, excess = response(finite, fields, step)
    # A side of the surface from one node to the next carries the pressure along its normal, half on either node.
    aside, lift = 0.5 * (np.roll(step.displacement[:, 0], -1, axis=-1) - np.roll(step.displacement[:, 0], 1, axis=-1))
    forces[0, 0] += pressure * lift
    forces[1, 0] -= pressure * aside
    circulant = averaged(finite, fields, pressure)
    found = circulant.solve(circulant.right_side(forces, thickness, excess), np.zeros((2, finite.block.columns)))
    np.testing.assert_allclose(found.displacement, step.displacement, atol=1e-9 * np.abs(step.displacement).max())


@PLANES
@DILATATIONS
@RUBBERS
def test_surface_is_that_of_the_solution(
    plane: str, dilatation: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = coarse(plane, rubber, dilatation=dilatation)
    fields = uniform(finite, 0.6, 0.3, 1.2).moved(random_step(finite, rng, 0.1))
    circulant = averaged(finite, fields)
    right = circulant.right_side(*response(finite, fields, random_step(finite, rng)))
    solved = circulant.solve(right, np.zeros((2, finite.block.columns))).displacement[:, 0]
    np.testing.assert_allclose(circulant.surface(right), solved, atol=1e-12 * np.abs(solved).max())


@PLANES
@RUBBERS
def test_compliance_is_the_surface_under_forces_on_it(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = coarse(plane, rubber)
    circulant = averaged(finite, uniform(finite, 0.6, 0.3, 1.2))
    rest = finite.at_rest()
    nothing = circulant.right_side(rest.displacement, rest.log_thickness, rest.volume - 1.0)
    forces = rng.standard_normal((2, finite.block.columns))
    surface = circulant.solve(nothing, forces).displacement[:, 0]
    spectrum = np.einsum("abn,bn->an", circulant.compliance, np.fft.rfft(forces))
    expected = np.fft.irfft(spectrum, finite.block.columns)
    np.testing.assert_allclose(surface, expected, atol=1e-12 * np.abs(expected).max())


@PLANES
@RUBBERS
def test_solutions_have_a_top_moved_as_a_whole_and_a_mean_surface_in_its_place(
    plane: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = coarse(plane, rubber)
    circulant = averaged(finite, flat(finite, 2.0))
    rest = finite.at_rest()
    right = circulant.right_side(rng.standard_normal(rest.displacement.shape), rest.log_thickness, rest.volume - 1.0)
    found = circulant.solve(right, rng.standard_normal((2, finite.block.columns))).displacement
    largest = np.abs(found).max()
    assert np.ptp(found[0, -1]) <= 1e-12 * largest
    np.testing.assert_allclose(found[:, 0].mean(axis=-1), 0.0, atol=1e-12 * largest)


@PLANES
@RUBBERS
def test_compliance_at_rest_tends_to_that_of_small_strain(plane: str, rubber: Material) -> None:
    errors = []
    for columns in (16, 32, 64):
        finite = coarse(plane, rubber, columns)
        circulant = averaged(finite, finite.at_rest())
        known = respond(finite.block, rubber, finite.velocity, np.arange(1, 4))
        vertical = circulant.compliance[1, 1, 1:4] * finite.block.column_width
        np.testing.assert_allclose(vertical, known.compliance, rtol=60.0 / columns**2)
        sideways = circulant.compliance[0, 1, 1:4] / circulant.compliance[1, 1, 1:4]
        np.testing.assert_allclose(sideways, -1j * known.shear_ratio, atol=60.0 / columns**2)
        errors.append(np.abs(vertical[0] / known.compliance[0] - 1.0))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.5)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.5)


@PLANES
def test_elastic_compliance_is_symmetric(plane: str) -> None:
    # Betti: what a force at one node does to another, that one does to it.
    finite = coarse(plane, ELASTIC)
    compliance = averaged(finite, uniform(finite, 0.6, 0.3, 1.2)).compliance
    kernel = np.fft.irfft(compliance, finite.block.columns)
    mirrored = np.roll(kernel[..., ::-1], 1, axis=-1).swapaxes(0, 1)
    np.testing.assert_allclose(kernel, mirrored, atol=1e-12 * np.abs(kernel).max())


@PLANES
def test_sliding_compliance_loses_energy(plane: str) -> None:
    finite = coarse(plane, RUBBER)
    compliance = averaged(finite, flat(finite, 2.0)).compliance[:, :, 1:-1].transpose(2, 0, 1)
    lossy = (compliance - compliance.conj().swapaxes(1, 2)) / 2j
    assert np.all(np.linalg.eigvalsh(lossy) < 0.0)


@PLANES
def test_rough_block_is_solved_nearly(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane, RUBBER)
    fields = flat(finite, 2.0)
    wave = 0.03 / WAVENUMBER * np.sin(WAVENUMBER * finite.block.column_positions)
    fields.displacement[1] += wave * np.exp(-WAVENUMBER * finite.block.row_positions)[:, None]
    circulant, step = averaged(finite, fields), random_step(finite, rng)
    found = circulant.solve(circulant.right_side(*response(finite, fields, step)), np.zeros((2, finite.block.columns)))
    missed = np.linalg.norm(found.displacement - step.displacement) / np.linalg.norm(step.displacement)
    assert 1e-6 < missed < 0.3
