"""Newton's method on one contact: it converges fast, and says why where it does not."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from finite_fields import AMPLITUDE, ELASTIC, PROPORTIONAL, RUBBER, coarse, everywhere, flat, load, sliding

from rubfric.errors import NotConverged
from rubfric.mechanics.finite import newton as newtonmodule
from rubfric.mechanics.finite.contact import SlidingContact
from rubfric.mechanics.finite.direction import Direction, newton_direction
from rubfric.mechanics.finite.newton import Solved, Stalled, newton
from rubfric.rubber.material import Material

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])


def solve(problem: SlidingContact, pressure: float = 0.5, tolerance: float = 1e-9) -> Solved:
    start = flat(problem.finite, pressure)
    return newton(problem, start, load(pressure), everywhere(problem.finite), tolerance)


@PLANES
@RUBBERS
def test_easy_contact_converges_fast(plane: str, rubber: Material) -> None:
    solved = solve(sliding(coarse(plane, rubber)))
    sizes = np.array(solved.residuals)
    assert sizes[-1] <= 1e-9
    assert solved.steps == len(sizes) - 1 <= 10
    # Once the contact nodes are found, a step is worth more than a digit, as good as its direction.
    assert np.all(sizes[-2:] < 0.1 * sizes[-3:-1])
    assert solved.krylov >= solved.steps


@PLANES
def test_residual_soon_falls_with_every_step(plane: str) -> None:
    sizes = np.array(solve(sliding(coarse(plane)), 4.0).residuals)
    assert sizes.argmin() == len(sizes) - 1
    assert np.all(np.diff(sizes[-4:]) < 0.0)


@PLANES
def test_residuals_are_those_of_the_correction(plane: str) -> None:
    problem = sliding(coarse(plane))
    solved = solve(problem, tolerance=1e-3)
    assert problem.size(solved.correction.step) == pytest.approx(solved.residuals[-1], rel=1e-12)
    assert solved.residuals[-1] <= 1e-3


@PLANES
def test_solution_is_its_own_start(plane: str) -> None:
    problem = sliding(coarse(plane))
    solved = solve(problem)
    again = newton(problem, solved.fields, load(0.5), solved.correction.contact.touching, 1e-8)
    assert again.steps == again.krylov == 0
    assert again.fields is solved.fields


@PLANES
def test_tolerance_bounds_the_error(plane: str) -> None:
    problem = sliding(coarse(plane))
    exact, near = solve(problem, tolerance=1e-10), solve(problem, tolerance=1e-4)
    assert near.steps < exact.steps
    difference = near.fields.displacement - exact.fields.displacement
    assert np.abs(difference).max() < 1e-3 * AMPLITUDE


@PLANES
def test_first_guess_of_the_contact_does_not_matter(plane: str) -> None:
    problem = sliding(coarse(plane))
    expected = solve(problem)
    one = np.arange(problem.finite.block.columns) == 4  # the crest
    found = newton(problem, flat(problem.finite, 0.5), load(0.5), one, 1e-9)
    np.testing.assert_allclose(found.fields.displacement, expected.fields.displacement, atol=1e-7 * AMPLITUDE)


@PLANES
def test_start_is_left_alone(plane: str) -> None:
    problem = sliding(coarse(plane))
    start, touching = flat(problem.finite, 0.5), everywhere(problem.finite)
    before = start.displacement.copy(), start.log_thickness.copy(), start.volume.copy()
    newton(problem, start, load(0.5), touching, 1e-6)
    np.testing.assert_array_equal(start.displacement, before[0])
    np.testing.assert_array_equal(start.log_thickness, before[1])
    np.testing.assert_array_equal(start.volume, before[2])
    assert touching.all()


def test_tolerance_below_round_off_stalls_and_tells_how_far_it_came() -> None:
    problem = sliding(coarse("strain"))
    with pytest.raises(Stalled) as caught:
        solve(problem, tolerance=0.0)
    stalled = caught.value
    assert stalled.reason
    assert stalled.krylov >= stalled.steps >= 3
    assert 0.0 < stalled.residual < 1e-8


def test_start_turned_inside_out_stalls_at_once() -> None:
    problem = sliding(coarse("strain"))
    start = problem.finite.at_rest()
    start.displacement[1] = -2.0 * problem.finite.block.row_positions[:, None]
    with pytest.raises(Stalled, match="smallest det F is -1") as caught:
        newton(problem, start, load(1.0), everywhere(problem.finite), 1e-6)
    assert caught.value.steps == caught.value.krylov == 0


def test_contact_without_a_solution_stalls(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise NotConverged("some scene", 3, 7, "number of surface nodes")

    problem = sliding(coarse("strain"))
    monkeypatch.setattr(problem, "correct", fail)
    with pytest.raises(Stalled, match="some scene: not converged after 3 steps") as caught:
        solve(problem)
    assert isinstance(caught.value.__cause__, NotConverged)


def test_residual_that_falls_too_slowly_stalls(monkeypatch: pytest.MonkeyPatch) -> None:
    def hesitating(*given: Any) -> Direction:
        found = newton_direction(*given)
        rest = problem.finite.at_rest()
        return replace(found, step=rest.moved(rest, -1.0).moved(found.step, 0.15))

    problem = sliding(coarse("strain"))
    monkeypatch.setattr(newtonmodule, "newton_direction", hesitating)
    with pytest.raises(Stalled, match="the residual falls too slowly") as caught:
        solve(problem)
    assert caught.value.steps == 3


def test_step_at_the_first_guess_is_taken_where_it_is_better(monkeypatch: pytest.MonkeyPatch) -> None:
    def unsettled(*given: Any) -> Direction:
        found = newton_direction(*given)
        rest = problem.finite.at_rest()
        return replace(found, step=rest.moved(rest, -1.0), plain=(found.step, found.touching))

    problem = sliding(coarse("strain"))
    expected = solve(problem)
    monkeypatch.setattr(newtonmodule, "newton_direction", unsettled)
    found = solve(problem)
    assert found.residuals == expected.residuals


def test_stalled_survives_pickling() -> None:
    stalled = pickle.loads(pickle.dumps(Stalled("too many steps", 16, 300, 0.25)))
    known = (stalled.reason, stalled.steps, stalled.krylov, stalled.residual)
    assert known == ("too many steps", 16, 300, 0.25)
