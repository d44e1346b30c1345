"""Ways to a solution: at once, along a growing road, along a growing load; every try recorded."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from finite_fields import AMPLITUDE, WAVENUMBER, coarse, everywhere, flat, load, sliding

from rubfric.errors import NotConverged
from rubfric.mechanics.finite import continuation
from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.contact import Load, SlidingContact
from rubfric.mechanics.finite.continuation import AttemptLog, Start, Way, attempt, reach
from rubfric.mechanics.finite.layers import divided
from rubfric.mechanics.finite.newton import Solved, Stalled, newton, starting_distance
from rubfric.road.waves import WaveRoad

PRESSURE, TOLERANCE = 0.5, 1e-8
LOAD = load(PRESSURE)

Stall = Callable[[Load], bool]


@pytest.fixture
def problem() -> SlidingContact:
    return sliding(coarse("strain"))


@pytest.fixture
def pressed(problem: SlidingContact) -> Start:
    return Start(flat(problem.finite, PRESSURE), everywhere(problem.finite))


@pytest.fixture
def stalling(monkeypatch: pytest.MonkeyPatch) -> Callable[[Stall], list[Load]]:
    """Return a function that lets Newton's method stall where told, and returns the list of loads that are tried."""

    def arrange(stalls: Stall) -> list[Load]:
        tried: list[Load] = []

        def sometimes(problem: SlidingContact, start: object, load: Load, *rest: object) -> Solved:
            tried.append(load)
            if stalls(load):
                raise Stalled("no luck", 2, 9, 0.5)
            return newton(problem, start, load, *rest)

        monkeypatch.setattr(continuation, "newton", sometimes)
        return tried

    return arrange


def only_the_first(number: int) -> Stall:
    left = [number]

    def stalls(_: Load) -> bool:
        left[0] -= 1
        return left[0] >= 0

    return stalls


def test_easy_contact_is_reached_at_once(problem: SlidingContact, pressed: Start) -> None:
    history = AttemptLog()
    solved = reach(problem, pressed, LOAD, TOLERANCE, history)
    assert problem.size(solved.correction.step) <= TOLERANCE
    (line,) = history.lines
    assert line == (f"16 columns, at once: converged in {solved.steps} Newton steps, {solved.krylov} Krylov iterations")
    assert (history.steps, history.krylov) == (solved.steps, solved.krylov)


def test_road_is_raised_where_newton_stalls(
    problem: SlidingContact, pressed: Start, stalling: Callable[[Stall], list[Load]]
) -> None:
    expected = newton(problem, pressed.fields, LOAD, pressed.touching, TOLERANCE)
    tried, history = stalling(only_the_first(1)), AttemptLog()
    solved = reach(problem, pressed, LOAD, TOLERANCE, history)
    np.testing.assert_allclose(solved.fields.displacement, expected.fields.displacement, atol=1e-5 * AMPLITUDE)
    shares = [load.share for load in tried[1:]]
    assert tried[0] == tried[-1] == LOAD
    assert len(shares) > 1
    assert np.all(np.diff(shares) > 0.0)
    assert {load.pressure for load in tried} == {PRESSURE}
    assert history.lines[0] == "16 columns, at once: left after 2 Newton steps, no luck"
    assert all(re.match(r"16 columns, road at [\d.]+: converged in \d+ ", line) for line in history.lines[1:])
    assert history.lines[-1].startswith("16 columns, road at 1: ")


def test_steps_are_shortened_where_they_stall(
    problem: SlidingContact, pressed: Start, stalling: Callable[[Stall], list[Load]]
) -> None:
    tried, history = stalling(only_the_first(3)), AttemptLog()
    reach(problem, pressed, LOAD, TOLERANCE, history)
    assert tried[1].share > tried[2].share > tried[3].share
    assert [" left after 2 Newton steps, no luck" in line for line in history.lines[:4]] == [True, True, True, False]
    assert tried[-1] == LOAD


def test_load_is_raised_where_the_road_cannot_be(
    problem: SlidingContact, pressed: Start, stalling: Callable[[Stall], list[Load]]
) -> None:
    expected = newton(problem, pressed.fields, LOAD, pressed.touching, TOLERANCE)
    loads: list[float] = []

    def not_before_lighter(load: Load) -> bool:
        loads.append(load.pressure)
        return load.pressure == PRESSURE and min(loads) == PRESSURE

    tried, history = stalling(not_before_lighter), AttemptLog()
    solved = reach(problem, pressed, LOAD, TOLERANCE, history)
    np.testing.assert_allclose(solved.fields.displacement, expected.fields.displacement, atol=1e-5 * AMPLITUDE)
    lighter = [load for load in tried if load.pressure < PRESSURE]
    assert lighter[0].share < 1.0
    assert any(load.share == 1.0 for load in lighter)
    assert tried[-1] == LOAD
    assert history.lines[-1].startswith("16 columns, load at 1: converged in ")


def test_all_ways_stalled_is_an_error_with_the_scenes_name(
    problem: SlidingContact, pressed: Start, stalling: Callable[[Stall], list[Load]]
) -> None:
    tried, history = stalling(lambda _: True), AttemptLog()
    sentence = (
        r"^some scene: not converged after \d+ steps, distance from .* is 0\.5; every way to a solution stalls: "
        r"no solution was found on the way; a lighter load or a less steep road is easier; "
        r"other meshes may do$"
    )
    with pytest.raises(NotConverged, match=sentence) as caught:
        reach(problem, pressed, LOAD, TOLERANCE, history)
    assert caught.value.step == history.steps == 2 * len(tried)
    assert history.krylov == 9 * len(tried)
    assert len(history.lines) == len(tried)
    assert {load.pressure == PRESSURE for load in tried} == {True, False}


def test_attempt_records_a_failure_and_passes_it_on(
    problem: SlidingContact, pressed: Start, stalling: Callable[[Stall], list[Load]]
) -> None:
    stalling(lambda _: True)
    history = AttemptLog()
    with pytest.raises(Stalled, match="no luck"):
        attempt(problem, pressed, LOAD, TOLERANCE, history, "a try")
    assert history.lines == ["a try: left after 2 Newton steps, no luck"]
    assert (history.steps, history.krylov) == (2, 9)


def test_history_adds_up(problem: SlidingContact, pressed: Start) -> None:
    history = AttemptLog()
    first, second = (attempt(problem, pressed, LOAD, tolerance, history, "a try") for tolerance in (1e-2, 1e-6))
    assert history.steps == first.steps + second.steps
    assert history.krylov == first.krylov + second.krylov
    assert len(history.lines) == 2


@pytest.fixture
def waves() -> Load:
    road = WaveRoad((AMPLITUDE, 0.2 * AMPLITUDE), (WAVENUMBER, 3.0 * WAVENUMBER), (0.0, 0.0))
    return Load(road, PRESSURE)


def test_on_many_waves_the_road_is_raised_under_a_light_load_and_then_the_load(
    problem: SlidingContact, pressed: Start, waves: Load, stalling: Callable[[Stall], list[Load]]
) -> None:
    expected = newton(problem, pressed.fields, waves, pressed.touching, TOLERANCE)
    tried, history = stalling(lambda _: False), AttemptLog()
    solved = reach(problem, pressed, waves, TOLERANCE, history)
    np.testing.assert_allclose(solved.fields.displacement, expected.fields.displacement, atol=1e-5 * AMPLITUDE)
    assert problem.size(solved.correction.step) <= TOLERANCE
    raised = [load for load in tried if load.share < 1.0]
    heavier = [load.pressure for load in tried[len(raised) + 1 :]]
    assert {load.pressure for load in tried[: len(raised) + 1]} == {0.1 * PRESSURE}
    assert len(raised) > 0
    assert np.all(np.diff(heavier) > 0.0)
    assert tried[-1] == waves
    assert history.lines[-1].startswith("16 columns, load at 1: ")


def test_step_is_shortened_until_it_starts_near(
    problem: SlidingContact,
    pressed: Start,
    stalling: Callable[[Stall], list[Load]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried, history = stalling(lambda _: False), AttemptLog()

    def distance(problem: object, fields: object, load: Load, *_: object) -> tuple[float, None]:
        return 2.0 * (load.share - (tried[-1].share if tried else 0.0)), None

    monkeypatch.setattr(continuation, "starting_distance", distance)
    solved = Way(problem, TOLERANCE, history).follow(pressed, lambda share: replace(LOAD, share=share), "at ")
    assert problem.size(solved.correction.step) <= TOLERANCE
    steps = np.diff([0.0] + [load.share for load in tried])
    assert steps.max() <= 0.15
    assert steps[0] > 0.05


def test_work_is_bounded_on_a_way_that_goes_on(
    problem: SlidingContact, pressed: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(continuation, "_MOST_WORK", 1e5)
    way = Way(problem, TOLERANCE, AttemptLog())
    measured = r"only so much work, .*: the last solution on the way was at at 0\.\d+, its smallest volume ratio 0\.\d+"
    with pytest.raises(NotConverged, match=measured):
        way.follow(pressed, lambda share: replace(LOAD, share=share), "at ")


def test_fields_without_a_contact_are_infinitely_far(problem: SlidingContact, pressed: Start) -> None:
    known, circulant = starting_distance(problem, pressed.fields, LOAD, pressed.touching)
    assert circulant is not None
    assert known == problem.size(problem.correct(circulant, pressed.fields, LOAD, pressed.touching).step)
    folded = problem.finite.at_rest()
    folded.displacement[1] = -2.0 * problem.finite.block.row_positions[:, None]
    assert starting_distance(problem, folded, LOAD, pressed.touching)[0] == np.inf


def test_work_counts_the_cells_that_are_worked_out() -> None:
    whole = coarse("strain", columns=1024)
    layered = FiniteBlock(whole.block, whole.material, whole.velocity, divided(whole.block, 1.0))
    work = []
    for finite in (whole, layered):
        log = AttemptLog()
        log.left(sliding(finite), "some way", Stalled("no luck", 2, 9, 0.5))
        work.append(log.work)
    assert work[1] < 0.8 * work[0]
