"""Progress of a run: counts, the time left, the slowest, and what failed."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.progress import Progress, amounts, duration, kind


class Clock:
    """A clock that is moved by hand."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


def run(progress: Progress, clock: Clock, jobs: list[tuple[str, float]], at_once: int = 1) -> list[tuple[float, float]]:
    """Do jobs of (rule, seconds) in turn, ``at_once`` at a time; return times and the rest foreseen at them."""
    waiting = list(enumerate(jobs))
    running: list[tuple[float, int]] = []
    foreseen = []
    while waiting or running:
        while waiting and len(running) < at_once:
            number, (rule, seconds) = waiting.pop(0)
            progress.start(number, rule, f"{rule}{number}")
            running.append((clock.now + seconds, number))
        clock.now, number = min(running)
        running.remove((clock.now, number))
        progress.finish(number)
        rest = progress.remaining()
        if rest is not None:
            foreseen.append((clock.now, rest))
    return foreseen


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("scene", "scene"),
        ("march", "march"),
        ("march_figure", "figure"),
        ("total_table", "table"),
        ("campaign", "other"),
        ("marches", "other"),
        ("stability_batch", "other"),
    ],
)
def test_rules_are_of_a_kind(rule: str, expected: str) -> None:
    assert kind(rule) == expected


def test_line_tells_what_is_done_of_what_has_begun(clock: Clock) -> None:
    progress = Progress({"scene": 3, "march": 1, "scale_table": 4, "total_table": 1}, clock)
    assert progress.line() == ""
    progress.start(1, "scene", "a")
    progress.start(2, "scene", "b")
    progress.start(3, "march", "c")
    clock.now += 2.5
    progress.finish(1)
    assert progress.line() == "1 of 3 scenes, 0 of 1 march; slowest a 2.5 s"
    clock.now += 1.0
    progress.finish(2)
    assert progress.line() == "2 of 3 scenes, 0 of 1 march; slowest b 3.5 s"


def test_last_scene_and_last_march_are_distinguished_from_the_rest(clock: Clock) -> None:
    progress = Progress({"scene": 2, "march": 1, "total_table": 1}, clock)
    last = []
    for number, rule in enumerate(["scene", "march", "total_table", "scene"]):
        progress.start(number, rule, rule)
        last.append(progress.finish(number))
    assert last == [False, True, False, True]
    assert progress.done() == "2 scenes, 1 march, 1 table"


def test_time_left_is_exact_for_jobs_that_last_alike(clock: Clock) -> None:
    progress = Progress({"scene": 20}, clock)
    foreseen = run(progress, clock, [("scene", 2.0)] * 20, at_once=2)
    ends = [now + rest for now, rest in foreseen]
    assert ends[-1] == clock.now
    np.testing.assert_allclose(ends, clock.now, atol=2.0)  # a job each
    assert len(ends) == 18


def test_time_left_waits_for_some_jobs_of_every_rule_that_has_many(clock: Clock) -> None:
    progress = Progress({"scene": 40, "march": 3, "total_table": 1}, clock)
    first = run(progress, clock, [("march", 30.0)] * 3 + [("scene", 1.0)] * 2)
    assert not first
    then = run(progress, clock, [("scene", 1.0)])
    assert then[-1][1] == pytest.approx(37.0 + (3 * 30.0 + 3 * 1.0) / 6)  # a table: as long as all on average


def test_time_left_is_of_the_right_size_for_jobs_of_every_length(clock: Clock, rng: np.random.Generator) -> None:
    lengths = rng.lognormal(-1.0, 1.2, 400)
    progress = Progress({"scene": 400}, clock)
    foreseen = run(progress, clock, [("scene", float(length)) for length in lengths], at_once=4)
    half = [(now + rest - 100.0) / (clock.now - 100.0) for now, rest in foreseen[200:]]
    assert min(half) > 0.8
    assert max(half) < 1.25


def test_better_known_times_count(clock: Clock) -> None:
    progress = Progress({"scene": 1}, clock)
    progress.start(1, "scene", "a")
    clock.now += 9.0
    progress.finish(1, seconds=0.25)
    assert progress.slowest(5) == [("a", 0.25)]


def test_slowest_are_scenes_and_marches_in_order(clock: Clock) -> None:
    progress = Progress({"scene": 6, "march": 1, "campaign_figure": 1}, clock)
    run(progress, clock, [*(("scene", float(length)) for length in (3, 1, 5, 2, 4, 6)), ("march", 5.5)])
    run(progress, clock, [("campaign_figure", 100.0)])
    assert [took for _, took in progress.slowest(4)] == [6.0, 5.5, 5.0, 4.0]


def test_failures_are_kept_until_another_attempt_succeeds(clock: Clock) -> None:
    progress = Progress({"scene": 2}, clock)
    for number, name in enumerate(["a", "b"]):
        progress.start(number, "scene", name, [f"{name}.log"])
        assert progress.fail(number, [f"{name}.log", "cluster.log"]) is not None
    assert progress.fail(1) is None  # reported twice
    assert "2 failed" in progress.line()
    progress.start(0, "scene", "a", ["a.log"])
    progress.finish(0)
    assert [(failure.name, failure.logs) for failure in progress.failures] == [("b", ("b.log", "cluster.log"))]


def test_jobs_never_heard_of_change_nothing(clock: Clock) -> None:
    progress = Progress({"scene": 2}, clock)
    assert not progress.finish(7)
    assert progress.fail(7) is None
    assert progress.done() == "nothing"


@pytest.mark.parametrize(
    ("seconds", "expected"),
    [
        (0.0, "0.00 s"),
        (0.274, "0.27 s"),
        (0.97, "1.0 s"),
        (16.24, "16.2 s"),
        (59.94, "59.9 s"),
        (59.96, "1 min 0 s"),
        (125.4, "2 min 5 s"),
        (3599.6, "1 h 0 min"),
        (12000.0, "3 h 20 min"),
    ],
)
def test_durations(seconds: float, expected: str) -> None:
    assert duration(seconds) == expected


@pytest.mark.parametrize(
    ("count", "left"), [(4, "about 5 s"), (63, "about 60 s"), (183, "about 3 min"), (20003, "about 5.6 h")]
)
def test_time_left_is_given_as_roughly_as_it_is_known(clock: Clock, count: int, left: str) -> None:
    progress = Progress({"scene": count}, clock)
    run(progress, clock, [("scene", 1.0)] * 3)
    assert f"; {left} left;" in progress.line()


def test_amounts_are_in_words() -> None:
    assert amounts({"scene": 1, "march": 2, "scale_table": 4, "total_table": 1, "campaign": 1}) == (
        "1 scene, 2 marches, 5 tables, 1 other job"
    )
    assert amounts({}) == "nothing"
