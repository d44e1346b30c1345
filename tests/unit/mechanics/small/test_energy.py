from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.small import energy as smallenergy
from rubfric.mechanics.small.energy import evaluate_small
from rubfric.mechanics.small.steady import SmallSolution, solve_small
from rubfric.mechanics.small.strain import StrainHarmonics, harmonic_strain
from rubfric.mechanics.steady.energies import output_stride
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
BULK = pytest.mark.parametrize("bulk", ["elastic", "proportional"])
FINE = Numerics(**fineness(1.0))
EVERY_COLUMN = replace(FINE, output_columns=4096)


def solve(scene: Scene) -> SmallSolution:
    return solve_small(scene, Decision("small", 0.0, "small strain was asked for"))


@pytest.fixture
def random_strain(rng: np.random.Generator) -> StrainHarmonics:
    return StrainHarmonics(
        np.arange(1, 7), rng.random((3, 6)), rng.random((3, 6)), np.zeros((4, 4, 6), dtype=np.complex128)
    )


@BULK
def test_stress_power_equals_viscous_dissipation_harmonic_by_harmonic(
    paper_rubber: Material, bulk: str, random_strain: StrainHarmonics
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    for frequency in (1e-3, 1e2, 1e5, 1e9):
        frequencies = frequency * random_strain.harmonics
        power = smallenergy.stress_power(rubber, frequencies, random_strain)
        lost = smallenergy.viscous_dissipation(rubber, frequencies, random_strain)
        assert np.all(power > 0.0)
        np.testing.assert_allclose(power, lost, rtol=1e-11)


def test_stress_power_is_frequency_times_loss_modulus_times_strain(random_strain: StrainHarmonics) -> None:
    rubber = Material("one", 3.0, 0.25, (0.8,), (2.0,), "instantaneous", "proportional")
    frequencies = 0.7 * random_strain.harmonics
    turns = 2.0 * frequencies
    loss = turns / (1.0 + turns**2)
    shear, bulk = 1.2 * 0.8 * loss, 2.0 * 0.8 * loss  # G_0 = 1.2 MPa and K_0 = 2 MPa
    expected = frequencies * (2.0 * shear * random_strain.shear_square + bulk * random_strain.volume_square)
    np.testing.assert_allclose(smallenergy.stress_power(rubber, frequencies, random_strain), expected, rtol=1e-12)


def test_stored_energy_weighs_strains_by_storage_moduli(random_strain: StrainHarmonics) -> None:
    rubber = Material("one", 3.0, 0.25, (0.8,), (2.0,), "instantaneous", "proportional")
    frequencies = 0.7 * random_strain.harmonics
    turns = 2.0 * frequencies
    storage = 0.2 + 0.8 * turns**2 / (1.0 + turns**2)
    expected = storage * (1.2 * random_strain.shear_square + 0.5 * 2.0 * random_strain.volume_square)
    np.testing.assert_allclose(smallenergy.stored_energy(rubber, frequencies, random_strain), expected, rtol=1e-12)


@PLANES
def test_contact_route_is_the_horizontal_force_of_the_road(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1000.0, 5.0, plane=plane)
    solution = solve(scene)
    forces = solution.contact.pressure * solution.block.column_width  # N per mm of thickness
    pushed = sum(
        force * 0.525 * np.cos(35.0 * position)
        for force, position in zip(forces, solution.block.column_positions, strict=True)
    )
    assert evaluate_small(solution).contact == pytest.approx(pushed / (5.0 * scene.road.wavelength), rel=1e-12)


@PLANES
@BULK
def test_three_routes_agree(paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str) -> None:
    scene = paper_scene(1000.0, 5.0, plane=plane, material=replace(paper_rubber, bulk=bulk), numerics=FINE)
    result = evaluate_small(solve(scene))
    assert result.stress_power > 0.1
    assert result.stress_power == pytest.approx(result.dissipation, rel=1e-11)
    assert result.contact == pytest.approx(result.stress_power, rel=2e-3)


@PLANES
@pytest.mark.parametrize(("velocity", "pressure"), [(100.0, 5.0), (1000.0, 5.0), (1e4, 0.5)])
def test_mean_of_the_nodal_density_follows_the_depth_profile(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float
) -> None:
    # Not exactly: nodal strains are smoothed over the cells around.
    result = evaluate_small(solve(paper_scene(velocity, pressure, plane=plane, numerics=EVERY_COLUMN)))
    np.testing.assert_allclose(result.density.mean(axis=1), result.depth_profile, rtol=6e-3)


@PLANES
@pytest.mark.parametrize(("velocity", "pressure"), [(1.0, 5.0), (1000.0, 5.0), (1000.0, 0.1)])
def test_density_is_never_negative(paper_scene: SceneMaker, plane: str, velocity: float, pressure: float) -> None:
    result = evaluate_small(solve(paper_scene(velocity, pressure, plane=plane)))
    assert np.all(result.density >= 0.0)
    assert np.all(result.depth_profile > 0.0)


@PLANES
@pytest.mark.parametrize("pressure", [0.1, 1.0, 5.0])
def test_density_of_partial_contact_falls_with_distance_from_the_road(
    paper_scene: SceneMaker, plane: str, pressure: float
) -> None:
    solution = solve(paper_scene(1000.0, pressure, plane=plane))
    assert solution.contact_fraction < 0.5
    assert np.all(np.diff(evaluate_small(solution).depth_profile) < 0.0)


@PLANES
def test_density_far_from_the_road_is_that_of_the_pressed_block(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1000.0, 5.0, plane=plane, aspect=3.0)
    result = evaluate_small(solve(scene))
    rest = 25.0 / (2.0 * scene.material.confined_modulus(plane))
    assert result.depth_profile[-1] == pytest.approx(rest, rel=1e-6)
    np.testing.assert_allclose(result.density[-1], rest, rtol=1e-3)


@PLANES
@BULK
def test_density_is_the_energy_of_the_springs(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    scene = paper_scene(10.0, 30.0, plane=plane, material=rubber)
    solution = solve(scene)
    assert solution.contact_fraction == 1.0
    density = evaluate_small(solution).density
    thickness = complex(rubber.thickness_ratio(350.0, plane))
    displacement = solution.response.displacement(solution.surface)
    nodal = harmonic_strain(solution.block, solution.response, np.array([thickness]), displacement).nodal[..., 0]
    pressed = -30.0 / rubber.confined_modulus(plane)
    pressed_across = float(rubber.thickness_ratio(0.0, plane).real) * pressed
    shear_moduli, bulk_moduli = rubber.branch_shear_moduli, rubber.branch_bulk_moduli
    for row in (0, 3, solution.block.rows):
        xx, yy, xy, dilatation = nodal[row]
        for column in (0, 17, 90):
            wave = np.exp(2j * np.pi * column / density.shape[1])

            def spring(share: complex, rest: float, turn: complex = wave) -> tuple[float, float]:
                """Return |e|² and tr² of a spring with a share of the wave and one of the rest."""
                sizes = (xx, yy, thickness * dilatation, xy, (1.0 + thickness) * dilatation)  # noqa: B023
                moved = np.array([2.0 * (share * turn * size).real for size in sizes])
                moved += rest * np.array([0.0, pressed, pressed_across, 0.0, pressed + pressed_across])
                tensor = np.diag(moved[:3])
                tensor[0, 1] = tensor[1, 0] = moved[3]
                deviator = tensor - np.trace(tensor) / 3.0 * np.eye(3)
                return float(np.sum(deviator**2)), float(moved[4] ** 2)

            square, volume = spring(1.0, 1.0)
            expected = rubber.long_term_shear_modulus * square + 0.5 * rubber.long_term_bulk_modulus * volume
            for index, time in enumerate(rubber.relaxation_times):
                square, volume = spring(350j * time / (1.0 + 350j * time), 0.0)
                expected += shear_moduli[index] * square + 0.5 * bulk_moduli[index] * volume
            assert density[row, column] == pytest.approx(expected, rel=1e-9)


@PLANES
def test_flat_road_leaves_the_pressed_block(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(10.0, 5.0, plane=plane, road=SineScale(0.0, 35.0))
    solution = solve(scene)
    result = evaluate_small(solution)
    modulus = scene.material.confined_modulus(plane)
    np.testing.assert_allclose(result.density, 25.0 / (2.0 * modulus), rtol=1e-12)
    np.testing.assert_allclose(result.depth_profile, 25.0 / (2.0 * modulus), rtol=1e-12)
    assert np.all(result.displacement[:, 0] == 0.0)
    settled = -5.0 / modulus * solution.block.row_positions[:, None]
    np.testing.assert_allclose(result.displacement[:, 1], settled + 0.0 * result.displacement[:, 1], atol=1e-12)


@PLANES
def test_displacement_follows_the_road_in_full_contact(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1.0, 5.0, plane=plane)
    displacement = evaluate_small(solve(scene)).displacement
    columns = scene.road.wavelength * np.arange(displacement.shape[2]) / displacement.shape[2]
    np.testing.assert_allclose(displacement[0, 1], scene.road.height(columns), atol=1e-12)


@PLANES
def test_displacement_stays_above_the_road_by_the_gap_to_round_off(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1000.0, 5.0, plane=plane, numerics=EVERY_COLUMN)
    solution = solve(scene)
    surface = evaluate_small(solution).displacement[0, 1]
    expected = scene.road.height(solution.block.column_positions) + solution.contact.gap
    np.testing.assert_allclose(surface, expected, atol=1e-9 * scene.road.amplitude)


@PLANES
def test_displacement_settles_evenly_on_the_mean(paper_scene: SceneMaker, plane: str) -> None:
    solution = solve(paper_scene(1000.0, 5.0, plane=plane))
    displacement = evaluate_small(solution).displacement
    pressed = -5.0 / solution.scene.material.confined_modulus(plane)
    expected = solution.contact.offset + pressed * solution.block.row_positions
    np.testing.assert_allclose(displacement[:, 1].mean(axis=1), expected, atol=1e-6)
    assert np.abs(displacement[-1, 0]).max() == 0.0


def test_fields_keep_at_most_the_columns_asked_for(paper_scene: SceneMaker) -> None:
    solution = solve(paper_scene(1e4, 5.0, numerics=replace(FINE, output_columns=64)))
    fine = evaluate_small(solve(paper_scene(1e4, 5.0, numerics=EVERY_COLUMN)))
    coarse = evaluate_small(solution)
    stride = output_stride(solution.scene, solution.block.columns, solution.block.rows + 1)
    assert coarse.density.shape == (solution.block.rows + 1, solution.block.columns // stride)
    np.testing.assert_allclose(coarse.density, fine.density[:, ::stride], rtol=1e-9)
    largest = np.abs(fine.displacement).max()
    np.testing.assert_allclose(coarse.displacement, fine.displacement[..., ::stride], atol=1e-12 * largest)
