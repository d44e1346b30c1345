from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from periodic_block import PeriodicBlock
from scipy.sparse import csr_matrix, identity
from scipy.sparse.linalg import spsolve

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.small.response import respond, stiffness_moduli
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

Complex = NDArray[np.complex128]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
COLUMNS = 16
HARMONICS = np.arange(1, COLUMNS // 2 + 1)
VELOCITY = 50.0  # mm/s


@pytest.fixture
def road() -> SineScale:
    return SineScale(0.015, 35.0)


def small_block(road: SineScale, plane: str, dilatation: str = "auto") -> Block:
    return Block.graded(
        road.wavelength, 0.4 * road.wavelength, COLUMNS, plane, growth=1.3, first_row=0.7, dilatation=dilatation
    )


def full_stiffness(block: Block, material: Material, frequency: float) -> csr_matrix:
    full = PeriodicBlock(block.column_positions, block.width, block.row_positions)
    shear, dilatation = full.forms(block.plane, block.pointwise)
    weights = stiffness_moduli(material, np.array([frequency]), block.plane)
    return weights[0][0] * shear + weights[1][0] * dilatation


def solve_directly(block: Block, stiffness: csr_matrix, load: Complex) -> Complex:
    """Solve the whole block under vertical forces on its surface; rows, components, columns.

    The top is one rigid unknown sideways, held; so is one corner vertically, which takes no force.
    """
    shape = (block.rows + 1, 2, block.columns)
    unknown = np.arange(np.prod(shape)).reshape(shape)
    held = np.concatenate((unknown[-1, 0], unknown[0, 1, :1]))
    free = np.setdiff1d(unknown, held)
    select = identity(unknown.size, format="csr")[free]
    forces = np.zeros(shape, dtype=complex)
    forces[0, 1] = load
    solution = spsolve((select @ stiffness @ select.T).tocsc(), select @ forces.ravel())
    return np.asarray(select.T @ solution).reshape(shape)


@PLANES
@pytest.mark.parametrize("harmonic", [1, 3, COLUMNS // 2])
@pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
@pytest.mark.parametrize("poissons_ratio", [-0.3, 0.0, 0.49])  # at 0 the modulus of dilatation vanishes in plane stress
def test_response_equals_a_direct_solution_of_the_whole_block(
    paper_rubber: Material, road: SineScale, plane: str, harmonic: int, dilatation: str, poissons_ratio: float
) -> None:
    block = small_block(road, plane, dilatation)
    rubber = replace(paper_rubber, poissons_ratio=poissons_ratio, bulk="proportional")
    response = respond(block, rubber, VELOCITY, HARMONICS)
    wave = np.exp(2j * np.pi * harmonic * np.arange(COLUMNS) / COLUMNS)
    stiffness = full_stiffness(block, rubber, harmonic * road.wavenumber * VELOCITY)
    direct = solve_directly(block, stiffness, wave * block.column_width)
    direct[:, 1] -= direct[:, 1].mean(axis=-1, keepdims=True)  # where the held corner floats is of no meaning
    surface = np.where(response.harmonics == harmonic, response.compliance, 0.0)
    rows = response.displacement(surface)[:, :, harmonic - 1]
    largest = np.abs(rows).max()
    np.testing.assert_allclose(direct, rows[:, :, None] * wave, atol=1e-11 * largest)


@PLANES
def test_displacements_satisfy_the_equations_of_the_whole_block(
    paper_rubber: Material, road: SineScale, plane: str, rng: np.random.Generator
) -> None:
    block = small_block(road, plane)
    response = respond(block, paper_rubber, VELOCITY, HARMONICS)
    pressure = rng.standard_normal(len(HARMONICS)) + 1j * rng.standard_normal(len(HARMONICS))
    displacement = response.displacement(response.compliance * pressure)
    for index, harmonic in enumerate(HARMONICS):
        wave = np.exp(2j * np.pi * harmonic * np.arange(COLUMNS) / COLUMNS)
        field = displacement[:, :, index, None] * wave
        stiffness = full_stiffness(block, paper_rubber, harmonic * road.wavenumber * VELOCITY)
        forces = (stiffness @ field.ravel()).reshape(field.shape)
        load = np.zeros_like(forces)
        load[0, 1] = pressure[index] * wave * block.column_width
        free = np.ones(forces.shape, dtype=bool)
        free[-1, 0] = False  # the top is held sideways
        np.testing.assert_allclose(forces[free], load[free], atol=1e-11 * np.abs(load).max())
        assert np.all(field[-1, 0] == 0.0)


@PLANES
def test_surface_is_prescribed_by_what_is_asked_for(paper_rubber: Material, road: SineScale, plane: str) -> None:
    response = respond(small_block(road, plane), paper_rubber, VELOCITY, HARMONICS)
    surface = np.linspace(1.0, 2.0, len(HARMONICS)) * np.exp(1j * HARMONICS)
    np.testing.assert_array_equal(response.displacement(surface)[0, 1], surface)


@PLANES
def test_single_harmonics_are_those_of_the_whole_set(paper_rubber: Material, road: SineScale, plane: str) -> None:
    block = small_block(road, plane)
    together = respond(block, paper_rubber, VELOCITY, HARMONICS)
    for index in (0, 4, 7):
        alone = respond(block, paper_rubber, VELOCITY, HARMONICS[index : index + 1])
        assert alone.compliance[0] == pytest.approx(together.compliance[index], rel=1e-12)
        assert alone.shear_ratio[0] == pytest.approx(together.shear_ratio[index], rel=1e-12)


@PLANES
def test_sliding_the_other_way_conjugates_the_response(paper_rubber: Material, road: SineScale, plane: str) -> None:
    block = small_block(road, plane)
    forth, back = (respond(block, paper_rubber, velocity, HARMONICS) for velocity in (VELOCITY, -VELOCITY))
    np.testing.assert_allclose(back.compliance, np.conj(forth.compliance), rtol=1e-12)
    np.testing.assert_allclose(back.shear_ratio, np.conj(forth.shear_ratio), rtol=1e-12)
    assert np.all(forth.compliance.imag < 0.0)


@PLANES
def test_elastic_response_is_in_phase(elastic_rubber: Material, road: SineScale, plane: str) -> None:
    response = respond(small_block(road, plane), elastic_rubber, VELOCITY, HARMONICS)
    assert np.all(response.compliance.imag == 0.0)
    assert np.all(response.shear_ratio.imag == 0.0)


@PLANES
def test_low_harmonics_follow_the_closed_form_of_the_layer(paper_rubber: Material, road: SineScale, plane: str) -> None:
    block = Block.graded(road.wavelength, 0.75 * road.wavelength, 512, plane, growth=1.05)
    harmonics = np.arange(1, 9)
    response = respond(block, paper_rubber, VELOCITY, harmonics)
    expected = layer_compliance(paper_rubber, road.wavenumber * harmonics, VELOCITY, block.height, plane)
    np.testing.assert_allclose(response.compliance, expected, rtol=2e-3)


@PLANES
def test_faded_harmonics_are_left_out_and_bands_cover_the_rest(
    paper_rubber: Material, road: SineScale, plane: str
) -> None:
    block = Block.graded(road.wavelength, 0.75 * road.wavelength, 256, plane)
    response = respond(block, paper_rubber, VELOCITY, block.harmonics[1:])
    reach = np.array([len(response.harmonics)] + [step.shape[-1] for step in response.transfer[:-1]])
    wavenumber = road.wavenumber * response.harmonics
    for row, count in enumerate(reach[1:], 1):
        assert np.all(wavenumber[:count] * block.row_positions[row] <= 40.0 * (1.0 + 1e-12))
        assert np.all(wavenumber[count:] * block.row_positions[row] > 40.0)
    assert reach[-1] < reach[0]
    covered = np.zeros(block.rows, dtype=int)
    for rows, count in response.bands():
        covered[rows] += 1
        assert count == reach[rows].max()
        assert reach[rows].min() > count // 2
    assert np.all(covered == 1)


def test_moduli_of_plane_strain_are_shear_and_bulk(paper_rubber: Material) -> None:
    frequency = np.array([0.0, 1e3, 1e6])
    shear, dilatation = stiffness_moduli(paper_rubber, frequency, "strain")
    np.testing.assert_array_equal(shear, paper_rubber.complex_shear_modulus(frequency))
    np.testing.assert_array_equal(dilatation, paper_rubber.complex_bulk_modulus(frequency))


@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
def test_moduli_of_plane_stress_relax_the_thickness(paper_rubber: Material, bulk: str) -> None:
    # In-plane stress for in-plane strain: sigma = 2 G eps + L tr 1; from 3-D with the thickness strain put in.
    rubber, frequency = replace(paper_rubber, bulk=bulk), np.logspace(-3, 9, 13)
    shear, dilatation = stiffness_moduli(rubber, frequency, "stress")
    trace = 1.0 + rubber.thickness_ratio(frequency, "stress")
    expected = (rubber.complex_bulk_modulus(frequency) - 2.0 / 3.0 * rubber.complex_shear_modulus(frequency)) * trace
    np.testing.assert_allclose(dilatation, expected, rtol=1e-11, atol=1e-11 * np.abs(shear).max())
    np.testing.assert_allclose(shear, rubber.complex_shear_modulus(frequency), rtol=1e-12)


@pytest.mark.parametrize("columns", [32, 1024])
def test_bulk_modulus_costs_no_digits(columns: int) -> None:
    block = Block.graded(0.18, 0.13, columns, "strain", 1.3)
    one, other = (
        respond(block, Material("elastic", 4.17, ratio, (), ()), VELOCITY, block.harmonics[1:])
        for ratio in (0.5 - 5e-9, 0.5 - 5e-12)
    )
    np.testing.assert_allclose(one.compliance, other.compliance, rtol=1e-6)
    np.testing.assert_allclose(one.shear_ratio, other.shear_ratio, rtol=1e-6, atol=1e-6)
