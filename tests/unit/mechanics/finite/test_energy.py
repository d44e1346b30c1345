"""Energies in finite strain: what the branches dissipate and store, at the points and at the nodes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from finite_fields import ELASTIC, PROPORTIONAL, RUBBER, WAVENUMBER, WIDTH, coarse, flat, random_step, uniform
from numpy.typing import NDArray

from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.energy import (
    branch_tensors,
    dissipated_and_stored,
    evaluate_finite,
    nodal_density,
)
from rubfric.mechanics.finite.law import Deformation, excess
from rubfric.mechanics.finite.steady import FiniteSolution, solve_finite
from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.theory.compression import pressed, stored_energy
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])
VISCOUS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL], ids=["elastic bulk", "both"])
COARSE = Numerics(accuracy=0.02, finite_contact_nodes=12, finite_columns_min=64, row_growth=1.3, output_columns=32)
SCENE = Scene(1, SineScale(0.015, WAVENUMBER), 100.0, 0.5, 0.75, RUBBER, "stress", COARSE, "finite")


@cache
def solved(scene: Scene) -> tuple[FiniteSolution, Energies]:
    solution = solve_finite(scene, Decision("finite", 0.0, "finite strain was asked for"))
    return solution, evaluate_finite(solution)


def strained(finite: FiniteBlock, rng: np.random.Generator, size: float = 0.1) -> Fields:
    return uniform(finite, 0.8, 0.2, 1.1).moved(random_step(finite, rng, size))


def deformation(finite: FiniteBlock, fields: Fields) -> Deformation:
    return finite.stressed(fields).deformation


def full(tensor: Real) -> Real:
    """Return symmetric tensors as matrices, shape (..., 3, 3)."""
    matrix = np.zeros((*tensor.shape[1:], 3, 3))
    matrix[..., 0, 0], matrix[..., 1, 1], matrix[..., 2, 2] = tensor[0], tensor[1], tensor[3]
    matrix[..., 0, 1] = matrix[..., 1, 0] = tensor[2]
    return matrix


@PLANES
def test_branch_tensors_are_positive_definite(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane)
    smooth = uniform(finite, 0.8, 0.2, 1.1)
    smooth.displacement[1] += 0.2 / WAVENUMBER * np.sin(WAVENUMBER * finite.block.column_positions)
    branches = branch_tensors(finite, deformation(finite, smooth))
    assert branches.shape[:2] == (2, 4)
    for branch in branches:
        assert np.linalg.eigvalsh(full(branch)).min() > 0.0


@PLANES
def test_branch_tensors_have_followed_where_nothing_changes_along_the_road(plane: str) -> None:
    finite = coarse(plane)
    state = deformation(finite, uniform(finite, 0.8, 0.2, 1.1))
    for branch in branch_tensors(finite, state):
        np.testing.assert_allclose(branch, state.inverse, atol=1e-12)
        np.testing.assert_allclose(np.linalg.det(full(branch)), 1.0, rtol=1e-12)
    rest = deformation(finite, finite.at_rest())
    identity = np.array([1.0, 1.0, 0.0, 1.0])[:, None, None, None]
    for branch in branch_tensors(finite, rest):
        np.testing.assert_allclose(branch, np.broadcast_to(identity, branch.shape), atol=1e-12)


@PLANES
def test_branch_tensors_keep_the_mean_of_what_they_follow(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane)
    state = deformation(finite, strained(finite, rng))
    for branch in branch_tensors(finite, state):
        np.testing.assert_allclose(branch.mean(axis=-1), state.inverse.mean(axis=-1), atol=1e-12)


@PLANES
@RUBBERS
def test_block_that_is_the_same_everywhere_dissipates_nothing(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    lost, stored = dissipated_and_stored(finite, deformation(finite, uniform(finite, 0.8, 0.0, 1.1)))
    rate = rubber.instantaneous_shear_modulus / min(rubber.relaxation_times, default=1.0)
    np.testing.assert_allclose(lost, 0.0, atol=1e-12 * rate)
    known = stored_energy(rubber, 0.8, 1.1 if plane == "stress" else 1.0)
    np.testing.assert_allclose(stored, known, rtol=1e-11)


@PLANES
def test_elastic_rubber_dissipates_nothing(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane, ELASTIC)
    lost, stored = dissipated_and_stored(finite, deformation(finite, strained(finite, rng)))
    np.testing.assert_array_equal(lost, 0.0)
    assert stored.min() > 0.0


@PLANES
@VISCOUS
def test_dissipation_is_never_negative(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = coarse(plane, rubber)
    for size in (1e-6, 1e-3, 0.1):
        lost, stored = dissipated_and_stored(finite, deformation(finite, strained(finite, rng, size)))
        assert lost.min() >= 0.0
        assert lost.max() > 0.0
        assert stored.min() > 0.0


@PLANES
@VISCOUS
def test_dissipation_is_that_of_the_definition(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = coarse(plane, rubber)
    state = deformation(finite, strained(finite, rng))
    squared, inverse = full(state.isochoric_squared), full(state.inverse)
    expected = np.zeros_like(state.volume)
    volume = np.broadcast_to(finite.dilatation(state.volume), state.volume.shape)
    transfer = finite.material.branch_transfer(finite.frequencies)
    transfer[:, -1] = transfer[:, -1].real
    for index, branch in enumerate(branch_tensors(finite, state)):
        tensor = full(branch)
        work = (
            np.einsum("...ij,...ij", tensor, squared) + np.einsum("...ij,...ij", np.linalg.inv(tensor), inverse) - 6.0
        )
        time = rubber.relaxation_times[index]
        expected += rubber.branch_shear_moduli[index] / (2.0 * time) * work
        stretched = np.fft.irfft(np.fft.rfft(volume) * transfer[index], finite.block.columns)
        expected += rubber.branch_bulk_moduli[index] / time * stretched**2
    lost, _ = dissipated_and_stored(finite, state)
    np.testing.assert_allclose(lost, expected, rtol=1e-6, atol=1e-9 * lost.max())


def test_excess_is_that_of_the_definition_where_that_does_not_cancel(rng: np.random.Generator) -> None:
    squared = np.array([1.3, 0.8, 0.2, 1.1])[:, None] + 0.2 * rng.uniform(-1.0, 1.0, (4, 50))
    branch = np.array([0.7, 1.3, -0.3, 1.0])[:, None] + 0.2 * rng.uniform(-1.0, 1.0, (4, 50))
    inverse = np.linalg.inv(full(squared))
    behind = branch - np.stack([inverse[..., 0, 0], inverse[..., 1, 1], inverse[..., 0, 1], inverse[..., 2, 2]])
    tensor = full(branch)
    expected = np.einsum("...ij,...ij", tensor, full(squared)) - 6.0
    expected += np.einsum("...ij,...ij", np.linalg.inv(tensor), inverse)
    np.testing.assert_allclose(excess(behind, squared, branch - behind), expected, rtol=1e-11)
    assert expected.min() > 0.0


def test_excess_does_not_cancel_where_a_branch_has_all_but_followed(rng: np.random.Generator) -> None:
    identity = np.array([1.0, 1.0, 0.0, 1.0])[:, None]
    behind = 1e-12 * rng.standard_normal((4, 50))
    square = np.einsum("...ij,...ij", full(behind), full(behind))
    squared = np.repeat(identity, 50, axis=1)
    np.testing.assert_allclose(excess(behind, squared, identity), square, rtol=1e-9)


@PLANES
def test_dissipation_tends_to_that_of_small_strain(plane: str) -> None:
    # sum of 2 G_i |e - e_i|² / tau_i
    finite, size = coarse(plane, RUBBER, columns=32), 1e-6
    fields = finite.at_rest()
    fields.displacement[1] = size / WAVENUMBER * np.sin(WAVENUMBER * finite.block.column_positions)
    shear = 0.5 * finite.gradient(fields.displacement)[2]
    lost, _ = dissipated_and_stored(finite, deformation(finite, fields))
    expected = np.zeros_like(lost)
    for modulus, time in zip(RUBBER.branch_shear_moduli, RUBBER.relaxation_times, strict=True):
        turn = 1j * finite.frequencies * time
        carried = np.fft.irfft(np.fft.rfft(shear) * turn / (1.0 + turn), 32)
        expected += 2.0 * modulus / time * 2.0 * carried**2
    np.testing.assert_allclose(lost, expected, atol=1e-4 * expected.max())


@PLANES
def test_nodal_density_of_a_constant_is_that_constant(plane: str) -> None:
    finite = coarse(plane)
    density = nodal_density(finite, np.full((finite.points, finite.block.rows, finite.block.columns), 0.7))
    np.testing.assert_allclose(density, 0.7, rtol=1e-12)
    assert density.shape == (finite.block.rows + 1, finite.block.columns)


@PLANES
def test_nodal_density_keeps_its_place_along_the_road(plane: str) -> None:
    # Points stand half a column beside the nodes: the average of both sides does not shift a wave.
    finite = coarse(plane, columns=64)
    middle = finite.block.column_positions + 0.5 * finite.block.column_width
    wave = np.broadcast_to(np.cos(WAVENUMBER * middle), (finite.points, finite.block.rows, 64))
    expected = np.cos(WAVENUMBER * finite.block.column_positions)
    np.testing.assert_allclose(nodal_density(finite, wave)[3], expected, atol=2e-3)


@PLANES
@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
@pytest.mark.parametrize("pressure", [0.5, 5.0])
def test_three_routes_agree(plane: str, bulk: str, pressure: float) -> None:
    rubber = replace(RUBBER, bulk=bulk)
    solution, energies = solved(replace(SCENE, plane=plane, material=rubber, pressure=pressure))
    assert energies.stress_power > 0.01
    assert energies.dissipation == pytest.approx(energies.stress_power, rel=5e-3)
    assert energies.contact == pytest.approx(energies.stress_power, rel=0.02)
    assert energies.closure <= 0.025
    assert (energies.stress_power, energies.contact) == (solution.friction.stress_power, solution.friction.contact)


@PLANES
def test_contact_route_is_the_horizontal_force_of_the_road(plane: str) -> None:
    scene = replace(SCENE, plane=plane)
    solution, energies = solved(scene)
    forces = solution.contact.pressure * solution.block.column_width
    pushed = forces @ (0.525 * np.cos(WAVENUMBER * solution.surface_position))
    assert energies.contact == pytest.approx(pushed / (0.5 * WIDTH), rel=1e-12)


@PLANES
@pytest.mark.parametrize("pressure", [0.5, 5.0])
def test_elastic_rubber_slides_without_friction(plane: str, pressure: float) -> None:
    # The three routes miss zero by what the solver's tolerance leaves.
    _, energies = solved(replace(SCENE, plane=plane, material=ELASTIC, pressure=pressure))
    assert energies.dissipation == 0.0
    assert abs(energies.stress_power) < energies.resolution
    assert abs(energies.contact) < energies.resolution


@PLANES
def test_mean_of_the_nodal_density_is_the_depth_profile(plane: str) -> None:
    numerics = replace(COARSE, output_columns=4096)
    solution, energies = solved(replace(SCENE, plane=plane, numerics=numerics))
    assert energies.density.shape == (solution.block.rows + 1, solution.block.columns)
    # Not exactly: of the two points of a cell the nearer one counts more.
    np.testing.assert_allclose(energies.density.mean(axis=1), energies.depth_profile, rtol=6e-2)
    assert energies.density.min() > 0.0


@PLANES
def test_density_of_a_pressed_block_is_the_work_of_its_load(plane: str) -> None:
    scene = replace(SCENE, plane=plane, road=SineScale(0.0, WAVENUMBER), pressure=3.0)
    solution, energies = solved(scene)
    np.testing.assert_allclose(energies.density, solution.pressed_energy, rtol=1e-6)
    np.testing.assert_allclose(energies.depth_profile, solution.pressed_energy, rtol=1e-6)
    assert abs(energies.dissipation) < 1e-9
    assert energies.closure < 0.01


def test_fields_keep_at_most_the_columns_asked_for() -> None:
    solution, every = solved(replace(SCENE, numerics=replace(COARSE, output_columns=4096)))
    _, thinned = solved(SCENE)
    columns = thinned.density.shape[1]
    assert columns <= 32
    stride = solution.block.columns // columns
    np.testing.assert_array_equal(thinned.density, every.density[:, ::stride])
    np.testing.assert_array_equal(thinned.displacement, every.displacement[..., ::stride])


def test_displacement_is_that_of_the_nodes() -> None:
    solution, energies = solved(replace(SCENE, numerics=replace(COARSE, output_columns=4096)))
    np.testing.assert_array_equal(energies.displacement, solution.fields.displacement.swapaxes(0, 1))


@PLANES
def test_pressed_block_stores_the_same_by_points_and_in_closed_form(plane: str) -> None:
    finite = coarse(plane)
    _, stored = dissipated_and_stored(finite, deformation(finite, flat(finite, 2.0)))
    np.testing.assert_allclose(stored, stored_energy(RUBBER, *pressed(RUBBER, 2.0, plane)), rtol=1e-9)
