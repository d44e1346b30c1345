"""Forces, stresses and their changes on the mesh: virtual work, finite differences, convolution along the road."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from finite_fields import ELASTIC, PROPORTIONAL, RUBBER, WAVENUMBER, WIDTH, coarse, flat, random_step, uniform
from numpy.typing import NDArray

from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.law import Inverted, volumetric_energy, volumetric_stress
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])


def deformed(finite: FiniteBlock, rng: np.random.Generator) -> Fields:
    """Return a block pressed, sheared and strained at random."""
    return uniform(finite, 0.8, 0.2, 1.1).moved(random_step(finite, rng, 0.15))


@PLANES
def test_forces_do_the_work_of_the_stresses(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane)
    displacement = random_step(finite, rng).displacement
    gradient = finite.gradient(displacement)
    stresses = rng.standard_normal(gradient.shape)
    outside = (finite.forces(stresses) * displacement).sum()
    inside = ((stresses * gradient).sum(axis=0) * finite.weights).sum()
    assert outside == pytest.approx(inside, rel=1e-12)


def test_gradient_is_that_of_the_shape_functions(rng: np.random.Generator) -> None:
    finite = coarse("strain")
    displacement = random_step(finite, rng).displacement
    shapes = finite.block.quadrature(centred=True).gradients
    right = np.roll(displacement, -1, axis=-1)
    corners = np.stack((displacement[:, :-1], right[:, :-1], displacement[:, 1:], right[:, 1:]))
    expected = np.einsum("rpnd,ncrx->cdprx", shapes, corners).reshape(4, finite.points, finite.block.rows, -1)
    np.testing.assert_allclose(finite.gradient(displacement), expected, atol=1e-12)


@PLANES
def test_gradient_of_a_uniform_block_is_exact(plane: str) -> None:
    finite = coarse(plane)
    gradient = finite.gradient(uniform(finite, 0.7, 0.3, 1.0).displacement)
    for component, value in enumerate((0.0, 0.3, 0.0, -0.3)):
        np.testing.assert_allclose(gradient[component], value, atol=1e-12)


@PLANES
def test_quadrature_fills_the_block(plane: str) -> None:
    finite = coarse(plane)
    assert finite.weights.sum() * finite.block.columns == pytest.approx(WIDTH * finite.block.height, rel=1e-12)


@PLANES
@RUBBERS
def test_rest_is_free_of_stress(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    assert np.abs(finite.stressed(finite.at_rest()).stress).max() <= 1e-13 * rubber.instantaneous_shear_modulus


@PLANES
@RUBBERS
def test_rigid_motion_strains_nothing(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    moved = finite.at_rest()
    moved.displacement[:] = np.array([0.3, -0.7])[:, None, None]
    assert np.abs(finite.stressed(moved).stress).max() <= 1e-12 * rubber.instantaneous_shear_modulus


@PLANES
@DILATATIONS
@RUBBERS
def test_pressed_block_is_in_balance_with_its_load(plane: str, dilatation: str, rubber: Material) -> None:
    finite, pressure = coarse(plane, rubber, dilatation=dilatation), 2.0
    state = finite.stressed(flat(finite, pressure))
    forces = finite.forces(state.stress[:4])
    carried = pressure * finite.block.column_width
    np.testing.assert_allclose(forces[1, -1], -carried, rtol=1e-9)
    np.testing.assert_allclose(forces[1, 0], carried, rtol=1e-9)
    np.testing.assert_allclose(forces[:, 1:-1], 0.0, atol=1e-10 * carried)
    np.testing.assert_allclose(forces[0], 0.0, atol=1e-10 * carried)
    np.testing.assert_allclose(state.stress[4:], 0.0, atol=1e-9 * pressure)


@PLANES
@DILATATIONS
@RUBBERS
def test_change_is_the_derivative_of_the_stresses_and_of_the_excess_of_volume(
    plane: str, dilatation: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = coarse(plane, rubber, dilatation=dilatation)
    fields, step, share = deformed(finite, rng), random_step(finite, rng), 1e-5
    change, excess = finite.change(finite.stiffness(fields, finite.stressed(fields)), step)
    ahead, behind = (finite.stressed(fields.moved(step, sign * share)) for sign in (1.0, -1.0))
    numeric = (ahead.stress - behind.stress) / (2.0 * share)
    np.testing.assert_allclose(change, numeric, atol=1e-6 * np.abs(change).max())
    numeric = (ahead.volume_excess - behind.volume_excess) / (2.0 * share)
    np.testing.assert_allclose(excess, numeric, atol=1e-6 * np.abs(excess).max())


@PLANES
@DILATATIONS
def test_tangent_is_the_same_whether_held_or_not(
    plane: str, dilatation: str, paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    finite = coarse(plane, paper_rubber, dilatation=dilatation)
    fields, step = deformed(finite, rng), random_step(finite, rng)
    state = finite.stressed(fields)
    held = finite.stiffness(fields, state)
    expected, averaged = finite.change(held, step), Circulant(finite, held, 1.0).compliance
    monkeypatch.setattr("rubfric.mechanics.finite.block._HELD", 0)
    monkeypatch.setattr("rubfric.mechanics.finite.block._AT_ONCE", 1)
    free = finite.stiffness(fields, state)
    assert held.held is not None
    assert free.held is None
    assert len(list(finite.row_slices())) == finite.block.rows
    for found, wanted in zip(finite.change(free, step), expected, strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-12 * np.abs(wanted).max())
    again = Circulant(finite, free, 1.0).compliance
    np.testing.assert_allclose(again, averaged, atol=1e-10 * np.abs(averaged).max())


@PLANES
@DILATATIONS
def test_elastic_forces_are_the_derivative_of_the_energy(plane: str, dilatation: str, rng: np.random.Generator) -> None:
    finite = coarse(plane, ELASTIC, dilatation=dilatation)
    fields, step, share = deformed(finite, rng), random_step(finite, rng), 1e-5

    # The derivative of the energy in which the volume follows the deformation.
    fields.volume[:] = finite.dilatation(finite.stressed(fields).deformation.volume)

    def energy(moved: Fields) -> float:
        state = finite.stressed(moved).deformation
        volume = np.broadcast_to(finite.dilatation(state.volume), state.volume.shape)
        volumetric = volumetric_energy(ELASTIC.long_term_bulk_modulus, volume)
        trace = state.isochoric_squared[[0, 1, 3]].sum(axis=0)
        return float(((volumetric + 0.5 * ELASTIC.long_term_shear_modulus * trace) * finite.weights).sum())

    state = finite.stressed(fields)
    work = (finite.forces(state.stress[:4]) * step.displacement).sum()
    work += (state.stress[4:] * step.log_thickness * finite.weights).sum()
    numeric = (energy(fields.moved(step, share)) - energy(fields.moved(step, -share))) / (2.0 * share)
    assert work == pytest.approx(numeric, rel=1e-6)


@PLANES
@RUBBERS
def test_block_is_the_same_everywhere_along_the_road(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = coarse(plane, rubber)
    fields = deformed(finite, rng)
    rolled = Fields(*(np.roll(getattr(fields, field.name), 3, axis=-1) for field in dataclasses.fields(Fields)))
    expected = np.roll(finite.stressed(fields).stress, 3, axis=-1)
    np.testing.assert_allclose(finite.stressed(rolled).stress, expected, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("harmonic", [0, 1, 3, 7])
def test_convolution_of_a_harmonic_is_the_complex_modulus(harmonic: int) -> None:
    finite = coarse("strain", PROPORTIONAL)
    frequency = harmonic * WAVENUMBER * 100.0
    wave = np.exp(1j * harmonic * WAVENUMBER * finite.block.column_positions)
    for kernel, modulus, rest in (
        (finite.shear_kernel, RUBBER.complex_shear_modulus, PROPORTIONAL.long_term_shear_modulus),
        (finite.bulk_kernel, PROPORTIONAL.complex_bulk_modulus, PROPORTIONAL.long_term_bulk_modulus),
    ):
        expected = ((modulus(frequency) - rest) * wave).real
        np.testing.assert_allclose(finite.convolve(kernel, wave.real), expected, atol=1e-12 * abs(modulus(frequency)))


def test_past_lies_upstream() -> None:
    # A branch keeps the share exp(-t / tau) / tau of what passed a time t ago; what is at x was at x - v t.
    time, velocity = 1e-4, 50.0
    finite = coarse("strain", Material("one", 4.17, 0.45, (0.5,), (time,)), columns=32, velocity=velocity)
    position, modulus = finite.block.column_positions, float(finite.material.branch_shear_moduli[0])

    def passing(place: Real) -> Real:
        return np.cos(WAVENUMBER * place) + 0.5 * np.sin(3.0 * WAVENUMBER * place)

    ago = np.linspace(0.0, 30.0 * time, 30001)
    weight = np.exp(-ago / time) * (ago[1] / time)
    weight[[0, -1]] *= 0.5
    kept = passing(position[:, None] - velocity * ago) @ weight
    stress = finite.convolve(finite.shear_kernel, passing(position))
    np.testing.assert_allclose(stress, modulus * (passing(position) - kept), atol=1e-6 * modulus)


@PLANES
def test_small_shear_wave_sees_the_complex_shear_modulus(plane: str) -> None:
    finite, size, harmonic = coarse(plane, RUBBER, columns=32), 1e-7, 2
    wave = np.exp(1j * harmonic * WAVENUMBER * (finite.block.column_positions + 0.5 * finite.block.column_width))
    fields = finite.at_rest()
    along = finite.block.column_positions
    fields.displacement[1] = size * np.cos(harmonic * WAVENUMBER * along)
    gradient = finite.gradient(fields.displacement)[2]
    amplitude = gradient[0, 0] @ wave.conj() / 16.0
    modulus = complex(RUBBER.complex_shear_modulus(harmonic * WAVENUMBER * 100.0))
    expected = (modulus * amplitude * wave).real
    stresses = finite.stressed(fields).stress
    for component in (1, 2):
        np.testing.assert_allclose(
            stresses[component, 0, 0], expected, atol=1e-5 * np.abs(expected).max() + 1e-15 * abs(modulus)
        )


@pytest.mark.parametrize(
    ("plane", "dilatation", "pointwise"),
    [
        ("stress", "auto", True),
        ("strain", "auto", False),
        ("stress", "mean", False),
        ("strain", "pointwise", True),
    ],
)
def test_dilatation_acts_point_by_point_or_by_its_mean_over_cells(
    plane: str, dilatation: str, pointwise: bool, rng: np.random.Generator
) -> None:
    finite = coarse(plane, dilatation=dilatation)
    volume = rng.random((finite.points, finite.block.rows, finite.block.columns))
    acting = finite.dilatation(volume)
    assert finite.at_rest().volume.shape == acting.shape
    if pointwise:
        np.testing.assert_array_equal(acting, volume)
    else:
        np.testing.assert_allclose(acting, volume.mean(axis=0, keepdims=True), rtol=1e-12)


@PLANES
@RUBBERS
def test_excess_of_volume_is_what_the_deformation_lacks(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = coarse(plane, rubber)
    uniformly = uniform(finite, 0.8, 0.2, 1.1)
    np.testing.assert_allclose(finite.stressed(uniformly).volume_excess, 0.0, atol=1e-12)
    fields = deformed(finite, rng)
    state = finite.stressed(fields)
    known = finite.dilatation(state.deformation.volume)
    np.testing.assert_allclose(state.volume_excess, fields.volume - known, atol=1e-12)


@PLANES
def test_pressure_follows_the_volume_and_not_the_deformation(plane: str, rng: np.random.Generator) -> None:
    finite = coarse(plane, ELASTIC)
    fields = deformed(finite, rng)
    state = finite.stressed(fields)
    expected, _ = volumetric_stress(ELASTIC.long_term_bulk_modulus, fields.volume)
    np.testing.assert_allclose(state.volumetric, expected, rtol=1e-12)


@PLANES
@RUBBERS
def test_uniform_block_takes_no_power(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    fields = uniform(finite, 0.8, 0.2, 1.1)
    state = finite.stressed(fields)
    scale = np.abs(state.stress).max() * finite.frequencies[-1]
    np.testing.assert_allclose(finite.stress_power(fields, state), 0.0, atol=1e-12 * scale)


@PLANES
@DILATATIONS
@RUBBERS
def test_power_inside_is_that_of_the_nodal_forces(
    plane: str, dilatation: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = coarse(plane, rubber, dilatation=dilatation)
    fields = deformed(finite, rng)
    state = finite.stressed(fields)
    rate = 1j * finite.frequencies.astype(complex)
    rate[-1] = 0.0
    moving = (finite.forces(state.stress[:4]) * finite.convolve(rate, fields.displacement)).sum()
    moving += (state.stress[4:] * finite.convolve(rate, fields.log_thickness) * finite.weights).sum()
    power = (finite.stress_power(fields, state) * finite.weights).sum()
    assert power == pytest.approx(moving, rel=1e-9)


@PLANES
def test_point_turned_inside_out_is_refused(plane: str) -> None:
    finite = coarse(plane)
    inverted = uniform(finite, -0.1, 0.0, 1.0)
    inverted.volume[:] = 1.0
    with pytest.raises(Inverted, match=r"^smallest det F is -0\.1$"):
        finite.stressed(inverted)


@PLANES
@pytest.mark.parametrize("volume", [0.0, -0.2])
def test_point_without_volume_is_refused(plane: str, volume: float) -> None:
    finite = coarse(plane)
    fields = finite.at_rest()
    fields.volume[..., 3] = volume
    with pytest.raises(Inverted, match=r"^smallest volume ratio is (0|-0\.2)$"):
        finite.stressed(fields)
