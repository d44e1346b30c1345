"""The direction of a Newton step: the linearised contact solved for its contact nodes, whatever they are at first."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import AMPLITUDE, PROPORTIONAL, coarse, everywhere, flat, load, sliding

from rubfric.arrays import Flags
from rubfric.mechanics.finite.block import Fields, Stiffness
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, SlidingContact
from rubfric.mechanics.finite.direction import Direction, newton_direction
from rubfric.mechanics.finite.linearised import Linearised, scaling
from rubfric.mechanics.finite.newton import newton

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
PRESSURE, FORCING = 0.5, 1e-9


class Point:
    """Fields about which is linearised, and what belongs to them."""

    def __init__(self, plane: str) -> None:
        self.problem: SlidingContact = sliding(coarse(plane))
        finite = self.problem.finite
        fields: Fields = flat(finite, PRESSURE)
        self.stiffness: Stiffness = finite.stiffness(fields, finite.stressed(fields))
        self.circulant = Circulant(finite, self.stiffness, PRESSURE)
        self.correction: Correction = self.problem.correct(self.circulant, fields, load(PRESSURE), everywhere(finite))

    def direction(self, touching: Flags) -> Direction:
        known = self.problem, self.circulant, self.stiffness, self.correction, load(PRESSURE)
        return newton_direction(*known, touching, FORCING)

    def linear(self, touching: Flags) -> Linearised:
        return Linearised(
            self.problem,
            self.problem.finite,
            self.circulant,
            self.stiffness,
            self.correction,
            load(PRESSURE),
            touching,
            scaling(self.problem.finite, self.stiffness, 1),
        )


@PLANES
def test_direction_solves_the_linearised_contact(plane: str) -> None:
    point = Point(plane)
    found = point.direction(point.correction.contact.touching)
    linear = point.linear(found.touching)
    (rest, held), (left, change) = linear.rest(), linear.change(found.step)
    size = point.problem.size
    assert size(rest.moved(left, -1.0)) <= 10.0 * FORCING * size(rest)
    pressure, gap = held + change, point.correction.above + linear.along_normals(found.step)
    assert 0 < np.count_nonzero(found.touching) < len(found.touching)
    assert pressure[found.touching].min() > 0.0
    assert gap[~found.touching].min() > 0.0
    np.testing.assert_allclose(gap[found.touching], 0.0, atol=1e-6 * AMPLITUDE)
    np.testing.assert_allclose(pressure[~found.touching], 0.0, atol=1e-12)
    assert pressure.mean() == pytest.approx(PRESSURE, rel=1e-9)


@PLANES
def test_first_guess_of_the_contact_nodes_does_not_matter(plane: str) -> None:
    point = Point(plane)
    expected = point.direction(point.correction.contact.touching)
    columns = np.arange(len(expected.touching))
    for guess in (columns >= 0, columns == 4, ~expected.touching):
        first = point.direction(guess)
        assert first.passes > 1
        assert first.krylov >= first.most + first.passes - 1
        found = point.direction(first.touching)
        np.testing.assert_array_equal(found.touching, expected.touching)
        distance = found.step.displacement - expected.step.displacement
        assert np.abs(distance).max() < 1e-6 * AMPLITUDE


@PLANES
def test_solved_guess_takes_one_pass(plane: str) -> None:
    point = Point(plane)
    found = point.direction(point.direction(everywhere(point.problem.finite)).touching)
    assert found.passes == 1
    assert found.krylov == found.most


@PLANES
@pytest.mark.parametrize("scaled", [True, False])
def test_single_precision_gives_the_direction_as_exactly_as_is_asked(plane: str, scaled: bool) -> None:
    problem = sliding(coarse(plane, PROPORTIONAL))
    near = newton(problem, flat(problem.finite, 4.0), load(4.0), everywhere(problem.finite), 1e-5)
    stiffness = problem.finite.stiffness(near.fields, near.correction.state)
    known = problem, near.circulant, stiffness, near.correction, load(4.0), near.correction.contact.touching
    exact = newton_direction(*known, 1e-9, scaled)
    # The residual is a hundred thousandth of a step from the flat road: cancellation must not eat what is left.
    rough = newton_direction(*known, 1e-3, scaled)
    assert rough.step.displacement.dtype == np.float64
    size = problem.size
    assert size(rough.step.moved(exact.step, -1.0)) < 0.02 * size(exact.step)


@PLANES
def test_scale_is_even_on_a_flat_road_and_lower_where_rubber_is_compressed(plane: str) -> None:
    finite = sliding(coarse(plane, dilatation="pointwise")).finite
    fields = flat(finite, PRESSURE)

    def scale(fields: Fields) -> Fields:
        return scaling(finite, finite.stiffness(fields, finite.stressed(fields)), 1)

    even = scale(fields)
    for part in (even.displacement, even.log_thickness, even.volume):
        np.testing.assert_allclose(part, 1.0, rtol=1e-12)
    rows, columns = fields.displacement.shape[1:]
    along = 2.0 * np.pi * np.arange(columns) / columns
    fields.displacement[1] += (
        0.1 * finite.block.row_positions[-1] * np.linspace(1.0, 0.0, rows)[:, None] * np.cos(along)
    )
    found = scale(fields)
    # Pushed up at column 0, pulled down half a wavelength on.
    assert found.displacement[0].argmin() in (0, 1, columns - 1)
    assert found.displacement[0].argmax() == pytest.approx(columns / 2, abs=1)
    np.testing.assert_array_equal(found.displacement[-1], 1.0)
    np.testing.assert_allclose(found.log_thickness * found.volume, 1.0, rtol=1e-12)
