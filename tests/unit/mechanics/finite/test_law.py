"""Stresses and tangents at points, against finite differences of the free energy and plain tensor algebra."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.finite.law import (
    XX,
    XY,
    YY,
    ZZ,
    Deformation,
    Inverted,
    deform,
    inverse_change,
    local_change,
    second_stress,
    stress,
    tangent,
    volumetric_energy,
    volumetric_stress,
)
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
POINTS = 6
SHEAR, BRANCH, BULK = 1.4, 3.0, 70.0  # MPa


@pytest.fixture(params=["strain", "stress"])
def unknowns(request: pytest.FixtureRequest, rng: np.random.Generator) -> Real:
    """Return F, and the logarithm of the thickness stretch in plane stress, at points strained by some 30 %."""
    size = 5 if request.param == "stress" else 4
    return np.eye(5)[[0]].T[:size] + np.eye(5)[[3]].T[:size] + 0.3 * rng.uniform(-1.0, 1.0, (size, POINTS))


@pytest.fixture
def branch(rng: np.random.Generator) -> Real:
    """Return a symmetric positive definite branch tensor at every point."""
    return np.array([1.2, 0.8, 0.3, 1.1])[:, None] + 0.1 * rng.uniform(-1.0, 1.0, (4, POINTS))


def deformed(unknowns: Real) -> Deformation:
    return deform(unknowns[:4], unknowns[4:])


def contract(one: Real, other: Real) -> Real:
    return one[XX] * other[XX] + one[YY] * other[YY] + 2.0 * one[XY] * other[XY] + one[ZZ] * other[ZZ]


def energy(unknowns: Real, branch: Real) -> Real:
    """Return W with one branch, but for what does not depend on the deformation."""
    state = deformed(unknowns)
    trace = state.isochoric_squared[[XX, YY, ZZ]].sum(axis=0)
    springs = 0.5 * SHEAR * trace + 0.5 * BRANCH * contract(branch, state.isochoric_squared)
    return volumetric_energy(BULK, state.volume) + springs


def driven(state: Deformation, branch: Real) -> tuple[Real, Real]:
    """Return Q and U'."""
    driving = BRANCH * (branch - state.inverse)
    driving[[XX, YY, ZZ]] += SHEAR
    return driving, volumetric_stress(BULK, state.volume)[0]


def slope(function: Callable[[Real], Real], unknowns: Real, number: int, step: float = 1e-5) -> Real:
    """Return the derivative of a function of the unknowns by one of them, by central differences."""
    aside = np.zeros_like(unknowns)
    aside[number] = step
    return (function(unknowns + aside) - function(unknowns - aside)) / (2.0 * step)


def full(plane: Real) -> Real:
    """Return a symmetric tensor as matrices, shape (points, 3, 3)."""
    matrix = np.zeros((POINTS, 3, 3))
    matrix[:, 0, 0], matrix[:, 1, 1], matrix[:, 2, 2] = plane[XX], plane[YY], plane[ZZ]
    matrix[:, 0, 1] = matrix[:, 1, 0] = plane[XY]
    return matrix


def full_gradient(unknowns: Real) -> Real:
    matrix = np.zeros((POINTS, 3, 3))
    matrix[:, :2, :2] = unknowns[:4].T.reshape(POINTS, 2, 2)
    matrix[:, 2, 2] = np.exp(unknowns[4]) if len(unknowns) == 5 else 1.0
    return matrix


def test_deformation_is_that_of_plain_tensor_algebra(unknowns: Real) -> None:
    state, gradient = deformed(unknowns), full_gradient(unknowns)
    squared = gradient.swapaxes(1, 2) @ gradient
    volume = np.linalg.det(gradient)
    np.testing.assert_allclose(full(state.squared), squared, atol=1e-12)
    np.testing.assert_allclose(state.volume, volume, rtol=1e-12)
    np.testing.assert_allclose(state.area, np.linalg.det(gradient[:, :2, :2]), rtol=1e-12)
    isochoric = volume[:, None, None] ** (-2.0 / 3.0) * squared
    np.testing.assert_allclose(full(state.isochoric_squared), isochoric, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(full(state.inverse), np.linalg.inv(isochoric), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(full(state.inverse)), 1.0, rtol=1e-12)


def test_growth_is_the_derivative_of_the_logarithm_of_volume(unknowns: Real) -> None:
    growth = deformed(unknowns).growth
    for number in range(len(unknowns)):
        numeric = slope(lambda moved: np.log(deformed(moved).volume), unknowns, number)
        np.testing.assert_allclose(growth[number], numeric, atol=1e-8)


def test_stress_is_the_derivative_of_the_free_energy(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    stresses = stress(state, *driven(state, branch))
    for number in range(len(unknowns)):
        numeric = slope(lambda moved: energy(moved, branch), unknowns, number)
        np.testing.assert_allclose(stresses[number], numeric, atol=1e-7 * np.abs(stresses).max())


def test_first_stress_is_the_gradient_times_the_second(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    first, second = (kind(state, *driven(state, branch)) for kind in (stress, second_stress))
    product = full_gradient(unknowns) @ full(second)
    scale = np.abs(first).max()
    np.testing.assert_allclose(first[:4].T.reshape(POINTS, 2, 2), product[:, :2, :2], atol=1e-12 * scale)
    if len(unknowns) == 5:
        np.testing.assert_allclose(first[4], state.squared[ZZ] * second[ZZ], atol=1e-12 * scale)


def test_second_stress_is_that_of_plain_tensor_algebra(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    gradient = full_gradient(unknowns)
    squared = gradient.swapaxes(1, 2) @ gradient
    inverse, volume = np.linalg.inv(squared), np.linalg.det(gradient)[:, None, None]
    # Written with A_i itself: taking Cb^-1 from it changes nothing.
    driving = SHEAR * np.eye(3) + BRANCH * full(branch)
    trace = np.einsum("pij,pij->p", driving, squared)[:, None, None]
    pressure = volumetric_stress(BULK, volume)[0]
    expected = pressure * volume * inverse + volume ** (-2.0 / 3.0) * (driving - trace / 3.0 * inverse)
    second = second_stress(state, *driven(state, branch))
    np.testing.assert_allclose(full(second), expected, atol=1e-12 * np.abs(expected).max())


def test_tangent_is_the_derivative_of_each_part(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    driving, volumetric = driven(state, branch)
    derivative = tangent(state, driving, volumetric)
    scale = np.abs(derivative.local).max()
    for number in range(len(unknowns)):
        held = slope(lambda moved: stress(deformed(moved), driving, volumetric), unknowns, number)
        np.testing.assert_allclose(derivative.local[:, number], held, atol=1e-7 * scale)
        inverse = slope(lambda moved: deformed(moved).inverse, unknowns, number)
        np.testing.assert_allclose(derivative.inverse[:, number], inverse, atol=1e-7)
        volume = slope(lambda moved: deformed(moved).volume, unknowns, number)
        np.testing.assert_allclose(derivative.volume[number], volume, atol=1e-8)


def test_a_tangent_that_is_not_held_is_the_same(unknowns: Real, branch: Real, rng: np.random.Generator) -> None:
    state = deformed(unknowns)
    driving, volumetric = driven(state, branch)
    derivative, change = tangent(state, driving, volumetric), rng.standard_normal(unknowns.shape)
    inverse, local = (np.einsum("ijp,jp->ip", part, change) for part in (derivative.inverse, derivative.local))
    np.testing.assert_allclose(inverse_change(state, change), inverse, atol=1e-13 * np.abs(inverse).max())
    held = local_change(state, driving, volumetric, change)
    np.testing.assert_allclose(held, local, atol=1e-13 * np.abs(local).max())


def test_stress_is_linear_in_what_drives_it(unknowns: Real, branch: Real, rng: np.random.Generator) -> None:
    state = deformed(unknowns)
    driving, volumetric = driven(state, branch)
    derivative = tangent(state, driving, volumetric)
    more, pressure = rng.standard_normal((4, POINTS)), rng.standard_normal(POINTS)
    change = stress(state, driving + more, volumetric + pressure) - stress(state, driving, volumetric)
    expected = np.einsum("ijp,jp->ip", derivative.by_driving, more) + derivative.volume * pressure
    np.testing.assert_allclose(change, expected, atol=1e-12 * np.abs(driving).max())


def test_tangent_adds_up_to_the_curvature_of_the_free_energy(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    derivative = tangent(state, *driven(state, branch))
    _, curvature = volumetric_stress(BULK, state.volume)
    relaxing = BRANCH * np.einsum("ijp,jkp->ikp", derivative.by_driving, derivative.inverse)
    total = derivative.local - relaxing + curvature * derivative.volume[:, None] * derivative.volume

    def stresses(moved: Real) -> Real:
        there = deformed(moved)
        return stress(there, *driven(there, branch))

    scale = np.abs(total).max()
    np.testing.assert_allclose(total, total.swapaxes(0, 1), atol=1e-12 * scale)
    for number in range(len(unknowns)):
        np.testing.assert_allclose(total[:, number], slope(stresses, unknowns, number), atol=1e-7 * scale)


def test_local_tangent_is_symmetric(unknowns: Real, branch: Real) -> None:
    state = deformed(unknowns)
    local = tangent(state, *driven(state, branch)).local
    np.testing.assert_array_equal(local, local.swapaxes(0, 1))


@pytest.mark.parametrize("angle", [0.3, 1.9])
def test_rotation_turns_the_first_stress_and_nothing_else(unknowns: Real, branch: Real, angle: float) -> None:
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = unknowns.copy()
    turned[:4] = np.einsum("ij,jkp->ikp", turn, unknowns[:4].reshape(2, 2, POINTS)).reshape(4, POINTS)
    one, other = deformed(unknowns), deformed(turned)
    first, rotated = (stress(state, *driven(state, branch)) for state in (one, other))
    scale = np.abs(first).max()
    np.testing.assert_allclose(energy(turned, branch), energy(unknowns, branch), rtol=1e-12)
    np.testing.assert_allclose(other.inverse, one.inverse, atol=1e-12)
    expected = np.einsum("ij,jkp->ikp", turn, first[:4].reshape(2, 2, POINTS)).reshape(4, POINTS)
    np.testing.assert_allclose(rotated[:4], expected, atol=1e-12 * scale)
    np.testing.assert_allclose(rotated[4:], first[4:], atol=1e-12 * scale)
    second, same = (second_stress(state, *driven(state, branch)) for state in (one, other))
    np.testing.assert_allclose(same, second, atol=1e-12 * scale)


@PLANES
def test_rest_is_free_of_stress(plane: str) -> None:
    rest = np.zeros((5 if plane == "stress" else 4, POINTS))
    rest[[0, 3]] = 1.0
    state = deformed(rest)
    identity = np.zeros((4, POINTS))
    identity[[XX, YY, ZZ]] = 1.0
    np.testing.assert_allclose(stress(state, *driven(state, identity)), 0.0, atol=1e-12 * SHEAR)


def test_small_strains_are_those_of_linear_elasticity(elastic_rubber: Material, rng: np.random.Generator) -> None:
    shear, bulk = elastic_rubber.long_term_shear_modulus, elastic_rubber.long_term_bulk_modulus
    strain, size = rng.uniform(-1.0, 1.0, (5, POINTS)), 1e-6
    unknowns = np.eye(5)[[0]].T + np.eye(5)[[3]].T + size * strain
    state = deformed(unknowns)
    driving = np.zeros((4, POINTS))
    driving[[XX, YY, ZZ]] = shear
    stresses = stress(state, driving, volumetric_stress(bulk, state.volume)[0]) / size
    xx, xy, yx, yy, zz = strain
    pressure = (bulk - 2.0 / 3.0 * shear) * (xx + yy + zz)
    shearing = shear * (xy + yx)
    normal = (2.0 * shear * part + pressure for part in (xx, yy, zz))
    along, upward, across = normal
    np.testing.assert_allclose(stresses, [along, shearing, shearing, upward, across], atol=1e-5 * bulk)


def test_relaxed_stress_does_not_feel_the_branches(unknowns: Real) -> None:
    # DEV[Cb^-1] vanishes: branches that have followed carry nothing.
    state = deformed(unknowns)
    driving = np.zeros((4, POINTS))
    driving[[XX, YY, ZZ]] = SHEAR
    volumetric = volumetric_stress(BULK, state.volume)[0]
    stresses = stress(state, driving, volumetric)
    more = stress(state, driving + 1e3 * state.inverse, volumetric)
    np.testing.assert_allclose(more, stresses, atol=1e-10 * np.abs(stresses).max())


def test_volumetric_stress_is_the_derivative_of_its_energy() -> None:
    volume, step = np.array([1e-3, 0.5, 1.0, 1.7]), 1e-6
    numeric = (volumetric_energy(BULK, volume * (1.0 + step)) - volumetric_energy(BULK, volume * (1.0 - step))) / (
        2.0 * step * volume
    )
    first, second = volumetric_stress(BULK, volume)
    np.testing.assert_allclose(first, numeric, rtol=1e-7, atol=1e-7)
    above, below = (volumetric_stress(BULK, volume * share)[0] for share in (1.0 + step, 1.0 - step))
    np.testing.assert_allclose(second, (above - below) / (2.0 * step * volume), rtol=1e-7)
    assert volumetric_energy(BULK, np.ones(1))[0] == first[2] == 0.0
    assert second[2] == BULK


def test_nothing_is_pressed_to_nothing() -> None:
    stresses, _ = volumetric_stress(BULK, np.array([1e-6, 1e-9]))
    assert np.all(stresses < -1e6 * BULK / 4.0)


@pytest.mark.parametrize("determinant", [0.0, -0.4, np.nan])
def test_points_turned_inside_out_are_refused(determinant: float) -> None:
    gradient = np.repeat(np.array([1.0, 0.0, 0.0, 1.0])[:, None], 3, axis=1)
    gradient[0, 1] = determinant
    with pytest.raises(Inverted, match=r"^smallest det F is (0|-0\.4|nan)$"):
        deform(gradient, np.zeros((1, 3)))
