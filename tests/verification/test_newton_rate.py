"""Newton's method converges superlinearly near the solution, whatever the contact."""

from __future__ import annotations

from collections.abc import Callable
from math import log

import numpy as np
import pytest

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.contact import Load, SlidingContact, measures
from rubfric.mechanics.finite.newton import Solved, newton
from rubfric.mechanics.theory.compression import pressed
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
TOLERANCE = 1e-10
# mm/s, MPa and the share of the road in contact: filled, half, and a narrow strip.
POINTS = [(10.0, 5.0, 1.0), (500.0, 5.0, 0.4), (100.0, 0.5, 0.17)]


@pytest.fixture(scope="module", params=POINTS, ids=["filled", "half", "strip"])
def point(request: pytest.FixtureRequest) -> tuple[float, float, float]:
    found: tuple[float, float, float] = request.param
    return found


@pytest.fixture(scope="module", params=["strain", "stress"])
def solved(request: pytest.FixtureRequest, paper_scene: SceneMaker, point: tuple[float, float, float]) -> Solved:
    scene = paper_scene(*point[:2], plane=request.param)
    block = Block.graded(scene.road.wavelength, scene.height, 64, scene.plane, 1.3)
    finite = FiniteBlock(block, scene.material, scene.velocity)
    stretch, thickness = pressed(scene.material, scene.pressure, scene.plane)
    fields = finite.at_rest()
    fields.displacement[1] = (stretch - 1.0) * block.row_positions[:, None]
    fields.log_thickness[:] = log(thickness)
    fields.volume[:] = stretch * thickness
    problem = SlidingContact(finite, measures(scene.road), "rate")
    return newton(problem, fields, Load(scene.road, scene.pressure), np.ones(64, dtype=bool), TOLERANCE)


def test_last_steps_leave_less_than_a_twentieth(solved: Solved, point: tuple[float, float, float]) -> None:
    assert np.mean(solved.correction.contact.touching) == pytest.approx(point[2], abs=0.1)
    ratios = np.divide(solved.residuals[1:], solved.residuals[:-1])
    assert ratios[-3:].max() < 0.05


def test_steps_gain_as_the_solution_comes_near(solved: Solved) -> None:
    ratios = np.divide(solved.residuals[1:], solved.residuals[:-1])
    assert ratios[-3:].mean() < 0.5 * ratios[:2].mean()
