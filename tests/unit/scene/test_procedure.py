"""Pressing and sliding in steps: times, loads and distances."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.scene.procedure import PHASES, Procedure
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
PRESS, HOLD, START, SLIDE = range(4)


def test_phases_follow_each_other(paper_scene: SceneMaker) -> None:
    steps = Procedure(wavelengths=2).steps(paper_scene(100.0, 0.5))
    assert PHASES == ("press", "hold", "start", "slide")
    assert np.all(np.diff(steps.phase) >= 0)
    counts = np.bincount(steps.phase)
    np.testing.assert_array_equal(counts, [32, 16, 64, 256])


def test_pressing_takes_its_time_and_ends_at_the_load(paper_scene: SceneMaker) -> None:
    steps = Procedure(loading_time=0.2, hold_time=0.1).steps(paper_scene(100.0, 0.5))
    press, hold = steps.phase == PRESS, steps.phase == HOLD
    assert steps.duration[press].sum() == pytest.approx(0.2)
    assert steps.duration[hold].sum() == pytest.approx(0.1)
    assert np.all(np.diff(steps.pressure[press]) > 0.0)
    assert steps.pressure[press][-1] == 0.5
    assert np.all(steps.pressure[~press] == 0.5)
    assert not steps.offset[press | hold].any()


def test_times_follow_the_longest_relaxation_by_default(paper_scene: SceneMaker) -> None:
    steps = Procedure().steps(paper_scene(100.0, 0.5))
    assert steps.duration[steps.phase == PRESS].sum() == pytest.approx(3.0 * 0.01134034)


def test_speed_rises_smoothly_to_that_of_the_scene(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    steps = Procedure(start="relaxed", wavelengths=1).steps(scene)
    speed = np.diff(steps.offset, prepend=0.0) / steps.duration
    rises = steps.phase == START
    assert np.all(np.diff(speed[rises]) > 0.0)
    assert np.all(speed[rises] < 100.0)
    np.testing.assert_allclose(speed[~rises], 100.0, rtol=1e-9)
    assert steps.offset[rises][-1] == pytest.approx(0.25 * scene.road.wavelength)
    assert steps.offset[-1] == pytest.approx(1.25 * scene.road.wavelength)


def test_start_from_steady_sliding_slides_at_once(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    steps = Procedure(start="steady", wavelengths=3, steps_per_wavelength=10).steps(scene)
    assert np.all(steps.phase == SLIDE)
    np.testing.assert_allclose(steps.offset, scene.road.wavelength / 10 * np.arange(1, 31))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"start": "thrown"}, "procedure.start is 'thrown'"),
        ({"columns": 12}, "procedure.columns is 12, but must be a multiple of 8"),
        ({"wavelengths": 0}, "procedure.wavelengths is 0"),
        ({"steps_per_wavelength": 3.5}, "procedure.steps_per_wavelength is 3.5"),
        ({"loading_time": 0.0}, "procedure.loading_time is 0 s"),
        ({"saturation": -0.1}, "procedure.saturation is -0.1"),
    ],
)
def test_nonsense_is_named(given: dict[str, object], message: str) -> None:
    with pytest.raises(InvalidInput, match=message):
        Procedure(**given)


def test_numbers_are_kept_in_canonical_form(paper_scene: SceneMaker) -> None:
    given = Procedure(wavelengths=2.0, columns=64.0, saturation=0.1 + 0.2)  # type: ignore[arg-type]
    assert given == Procedure(wavelengths=2, saturation=0.3)
    assert type(given.wavelengths) is type(given.columns) is int
    assert len(given.steps(paper_scene(100.0, 0.5)).phase) == 32 + 16 + 64 + 256


def test_a_march_has_ten_million_steps_at_most() -> None:
    assert Procedure(wavelengths=10**5, steps_per_wavelength=100).wavelengths == 10**5
    with pytest.raises(InvalidInput, match=r"^procedure\.wavelengths is 100001, but must be at most 100000$"):
        Procedure(wavelengths=10**5 + 1, steps_per_wavelength=100)
