"""One linearised contact solve along the deformed road, and its derivative."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from finite_fields import (
    AMPLITUDE,
    ELASTIC,
    PROPORTIONAL,
    RUBBER,
    WAVENUMBER,
    coarse,
    everywhere,
    flat,
    load,
    random_step,
    sliding,
)
from numpy.typing import NDArray

from rubfric.errors import NotConverged
from rubfric.mechanics.block import contact as block_contact
from rubfric.mechanics.block.contact import Convolution, pivot
from rubfric.mechanics.finite import contact as slidingcontact
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact, SlopedSurface
from rubfric.mechanics.finite.krylov import Krylov
from rubfric.mechanics.finite.law import Inverted
from rubfric.mechanics.finite.linearised import Linearised, scaling
from rubfric.mechanics.finite.newton import Solved, newton
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])
LOADS = pytest.mark.parametrize("pressure", [0.1, 4.0])  # MPa: part of the road is touched, and all of it


def averaged(problem: SlidingContact, fields: Fields, pressure: float = 0.0) -> Circulant:
    finite = problem.finite
    return Circulant(finite, finite.stiffness(fields, finite.stressed(fields)), pressure)


@cache
def solved(plane: str, rubber: Material, pressure: float) -> tuple[SlidingContact, Solved]:
    """Return a converged contact."""
    problem = sliding(coarse(plane, rubber))
    start = flat(problem.finite, pressure)
    return problem, newton(problem, start, load(pressure), everywhere(problem.finite), 1e-10)


def sloped(rng: np.random.Generator, plane: str = "strain") -> SlopedSurface:
    problem = sliding(coarse(plane))
    compliance = averaged(problem, flat(problem.finite, 1.0)).compliance
    return SlopedSurface(compliance, 0.5 * rng.standard_normal(16), problem.finite.block.column_width)


@pytest.mark.parametrize("inside", [range(16), (0, 1, 5, 15), (7,)])
def test_matrix_is_the_deflection_among_nodes(inside: tuple[int, ...], rng: np.random.Generator) -> None:
    surface, nodes = sloped(rng), np.array(inside)
    pressure = np.zeros(16)
    pressure[nodes] = rng.random(len(nodes))
    expected = surface.deflection(pressure)
    np.testing.assert_allclose(
        surface.matrix(nodes) @ pressure[nodes], expected[nodes], atol=1e-12 * np.abs(expected).max()
    )


def test_level_surface_is_a_convolution(rng: np.random.Generator) -> None:
    problem = sliding(coarse("strain"))
    compliance, width = averaged(problem, flat(problem.finite, 1.0)).compliance, problem.finite.block.column_width
    level, known = SlopedSurface(compliance, np.zeros(16), width), Convolution(width * compliance[1, 1], 16)
    pressure = rng.random(16)
    largest = np.abs(known.deflection(pressure)).max()
    np.testing.assert_allclose(level.deflection(pressure), known.deflection(pressure), atol=1e-12 * largest)
    np.testing.assert_allclose(level.matrix(np.arange(16)), known.matrix(np.arange(16)), atol=1e-12 * largest)


def test_sloped_surface_yields_along_its_normals(rng: np.random.Generator) -> None:
    problem = sliding(coarse("strain"))
    circulant, slope = averaged(problem, flat(problem.finite, 1.0)), 0.5 * rng.standard_normal(16)
    width, pressure, rest = problem.finite.block.column_width, rng.random(16), problem.finite.at_rest()
    normal = np.stack((-slope, np.ones(16)))
    nothing = circulant.right_side(rest.displacement, rest.log_thickness, rest.volume - 1.0)
    moved = circulant.solve(nothing, normal * pressure * width).displacement[:, 0]
    expected = SlopedSurface(circulant.compliance, slope, width).deflection(pressure)
    np.testing.assert_allclose((normal * moved).sum(axis=0), expected, atol=1e-12 * np.abs(expected).max())


def test_road_goes_past_and_may_be_raised_in_part() -> None:
    place, road = np.linspace(0.0, 0.2, 7), SineScale(AMPLITUDE, WAVENUMBER)
    moved = Load(road, 1.0, offset=0.03, share=0.25)
    np.testing.assert_array_equal(moved.height(place), 0.25 * road.height(place + 0.03))
    np.testing.assert_array_equal(moved.slope(place), 0.25 * road.slope(place + 0.03))
    np.testing.assert_array_equal(moved.curvature(place), 0.25 * road.curvature(place + 0.03))


@PLANES
@RUBBERS
def test_block_pressed_on_a_flat_road_stays(plane: str, rubber: Material) -> None:
    problem = sliding(coarse(plane, rubber))
    fields = flat(problem.finite, 2.0)
    correction = problem.correct(averaged(problem, fields), fields, load(2.0, 0.0), everywhere(problem.finite))
    assert problem.size(correction.step) < 1e-9
    np.testing.assert_allclose(correction.contact.pressure, 2.0, rtol=1e-9)


@PLANES
@LOADS
def test_each_correction_is_complementary_and_carries_the_load(plane: str, pressure: float) -> None:
    problem = sliding(coarse(plane))
    fields = flat(problem.finite, pressure)
    correction = problem.correct(averaged(problem, fields), fields, load(pressure), everywhere(problem.finite))
    contact = correction.contact
    assert contact.pressure.min() >= 0.0
    assert contact.gap.min() >= 0.0
    assert np.all(contact.gap[contact.touching] == 0.0)
    assert contact.pressure.mean() == pytest.approx(pressure, rel=1e-10)


@PLANES
def test_correction_steps_onto_the_linearised_road(plane: str) -> None:
    problem = sliding(coarse(plane))
    fields, waves = flat(problem.finite, 0.5), load(0.5)
    correction = problem.correct(averaged(problem, fields), fields, waves, everywhere(problem.finite))
    moved = fields.moved(correction.step).displacement[:, 0]
    tangent = waves.height(correction.position) + correction.slope * correction.step.displacement[0, 0]
    np.testing.assert_allclose(moved[1] - tangent, correction.contact.gap, atol=1e-10 * AMPLITUDE)
    np.testing.assert_allclose(correction.slope, waves.slope(correction.position), rtol=1e-12)


@PLANES
@RUBBERS
@LOADS
def test_fixed_point_is_in_balance_and_in_contact(plane: str, rubber: Material, pressure: float) -> None:
    problem, found = solved(plane, rubber, pressure)
    finite, correction = problem.finite, found.correction
    contact, waves = correction.contact, load(pressure)
    assert contact.touching.all() == (pressure > 1.0)
    np.testing.assert_allclose(correction.state.volume_excess, 0.0, atol=1e-8)
    carried = pressure * finite.block.column_width
    forces = finite.forces(finite.stressed(found.fields).stress[:4])
    np.testing.assert_allclose(forces[:, 1:-1], 0.0, atol=1e-7 * carried)
    np.testing.assert_allclose(forces[1, -1], -carried, rtol=1e-7)
    pushed = contact.pressure * finite.block.column_width
    np.testing.assert_allclose(forces[1, 0], pushed, atol=1e-7 * carried)
    np.testing.assert_allclose(forces[0, 0], -correction.slope * pushed, atol=1e-7 * carried)
    position = finite.block.column_positions + found.fields.displacement[0, 0]
    height = found.fields.displacement[1, 0] - waves.height(position)
    np.testing.assert_allclose(height, contact.gap, atol=1e-7 * AMPLITUDE)


def even(finite: FiniteBlock) -> Fields:
    """Return the scale with which the balance is preconditioned by T."""
    rest = finite.at_rest()
    shape = rest.displacement.shape[1:]
    return Fields(np.ones(shape), np.ones_like(rest.log_thickness), np.ones_like(rest.volume))


@PLANES
@RUBBERS
@LOADS
def test_linearised_is_the_derivative_at_fixed_contact(
    plane: str, rubber: Material, pressure: float, rng: np.random.Generator
) -> None:
    problem, found = solved(plane, rubber, pressure)
    finite, share = problem.finite, 1e-6
    circulant = averaged(problem, found.fields, pressure)
    correction = problem.correct(circulant, found.fields, load(pressure), found.correction.contact.touching)
    stiffness = finite.stiffness(found.fields, correction.state)
    touching = correction.contact.touching
    linear = Linearised(
        problem, problem.finite, circulant, stiffness, correction, load(pressure), touching, even(finite)
    )
    step = random_step(finite, rng)

    def left(sign: float) -> Correction:
        moved = found.fields.moved(step, sign * share)
        there = problem.correct(circulant, moved, load(pressure), correction.contact.touching)
        np.testing.assert_array_equal(there.contact.touching, correction.contact.touching)
        return there

    one, other = left(1.0), left(-1.0)
    change, pressure_change = linear.change(step)
    pushed = (one.contact.pressure - other.contact.pressure) / (2.0 * share)
    np.testing.assert_allclose(pressure_change, pushed, atol=1e-4 * np.abs(pushed).max())
    ahead, behind = one.step, other.step
    numeric = (behind.displacement - ahead.displacement) / (2.0 * share)
    np.testing.assert_allclose(change.displacement, numeric, atol=1e-4 * np.abs(numeric).max())
    numeric = (behind.log_thickness - ahead.log_thickness) / (2.0 * share)
    np.testing.assert_allclose(change.log_thickness, numeric, atol=1e-4)
    numeric = (behind.volume - ahead.volume) / (2.0 * share)
    np.testing.assert_allclose(change.volume, numeric, atol=1e-4)


@PLANES
def test_rest_is_the_correction_at_given_contact_nodes(plane: str) -> None:
    problem = sliding(coarse(plane))
    fields = flat(problem.finite, 0.5)
    circulant = averaged(problem, fields, 0.5)
    correction = problem.correct(circulant, fields, load(0.5), everywhere(problem.finite))
    stiffness = problem.finite.stiffness(fields, correction.state)
    chosen = correction.contact.touching
    scale = even(problem.finite)
    step, pressure = Linearised(
        problem, problem.finite, circulant, stiffness, correction, load(0.5), chosen, scale
    ).rest()
    np.testing.assert_allclose(problem.pack(step), problem.pack(correction.step), atol=1e-10)
    np.testing.assert_allclose(pressure, correction.contact.pressure, atol=1e-10)
    others = chosen ^ (np.arange(len(chosen)) == np.flatnonzero(chosen)[0])
    linear = Linearised(problem, problem.finite, circulant, stiffness, correction, load(0.5), others, scale)
    step, pressure = linear.rest()
    np.testing.assert_allclose((correction.above + linear.along_normals(step))[others], 0.0, atol=1e-12 * AMPLITUDE)
    assert pressure.mean() == pytest.approx(0.5, rel=1e-12)
    assert np.array_equal(pressure != 0.0, others)


@PLANES
@RUBBERS
def test_scale_changes_the_way_to_a_direction_but_not_the_direction(plane: str, rubber: Material) -> None:
    problem, found = solved(plane, rubber, 4.0)
    finite, more = problem.finite, load(4.4)
    circulant = averaged(problem, found.fields, 4.4)
    touching = found.correction.contact.touching
    correction = problem.correct(circulant, found.fields, more, touching)
    stiffness = finite.stiffness(found.fields, correction.state)
    local = scaling(finite, stiffness, 1)
    assert np.ptp(local.displacement[0]) > 0.02
    np.testing.assert_array_equal(local.displacement[-1], 1.0)
    steps, pressures = [], []
    for scale in (even(finite), local):
        linear = Linearised(problem, problem.finite, circulant, stiffness, correction, more, touching, scale)
        rest, held = linear.rest()
        krylov = Krylov(lambda packed, by=linear: applied(problem, by, packed), problem.pack(rest), None, 80)
        while krylov.residual > 1e-10:
            krylov.grow()
        steps.append(krylov.vector())
        pressures.append(held + krylov.beside())
    np.testing.assert_allclose(steps[1], steps[0], atol=1e-7 * np.abs(steps[0]).max())
    np.testing.assert_allclose(pressures[1], pressures[0], atol=1e-7 * pressures[0].max())


def applied(problem: SlidingContact, linear: Linearised, packed: Real) -> tuple[Real, Real]:
    change, pressure = linear.change(problem.unpack(packed))
    return problem.pack(change), pressure


@PLANES
def test_pack_and_unpack_are_inverse_and_size_is_the_root_mean_square(plane: str, rng: np.random.Generator) -> None:
    problem = sliding(coarse(plane))
    step = random_step(problem.finite, rng)
    vector = problem.pack(step)
    again = problem.unpack(vector)
    np.testing.assert_allclose(again.displacement, step.displacement, rtol=1e-12)
    np.testing.assert_allclose(again.log_thickness, step.log_thickness, rtol=1e-12)
    np.testing.assert_allclose(again.volume, step.volume, rtol=1e-12)
    assert problem.size(step) == pytest.approx(float(np.sqrt(np.mean(vector**2))), rel=1e-12)
    assert vector[0] == pytest.approx(step.displacement.flat[0] / AMPLITUDE, rel=1e-12)


def test_fields_turned_inside_out_are_refused() -> None:
    problem = sliding(coarse("strain"))
    circulant, inverted = averaged(problem, problem.finite.at_rest()), problem.finite.at_rest()
    inverted.displacement[1] = -2.0 * problem.finite.block.row_positions[:, None]
    with pytest.raises(Inverted):
        problem.correct(circulant, inverted, load(1.0), everywhere(problem.finite))


def test_contact_without_a_solution_carries_the_label(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = sliding(coarse("strain"))
    fields = flat(problem.finite, 0.1)
    circulant, every = averaged(problem, fields), everywhere(problem.finite)
    known = problem.correct(circulant, fields, load(0.1), every).contact
    monkeypatch.setattr(slidingcontact, "pivot", lambda *given: pivot(*given[:5], most_steps=1))
    found = problem.correct(circulant, fields, load(0.1), every).contact  # from an even contact, step by step
    assert found.iterations > 1
    np.testing.assert_allclose(found.pressure, known.pressure, rtol=1e-8, atol=1e-9 * known.pressure.max())
    monkeypatch.setattr(slidingcontact, "_MOST_PIVOTS_ALONG", 0)
    monkeypatch.setattr(block_contact, "_STEPS_AT_ONCE", 1)
    with pytest.raises(NotConverged, match=r"^some scene: not converged after 1 steps, number of surface nodes"):
        problem.correct(circulant, fields, load(0.1), every)
