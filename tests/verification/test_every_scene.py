"""Every scene of the paper, and heavier loads, in finite strain from a cold start on a coarse mesh."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from rubfric.config.campaign import load
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import solve

pytestmark = pytest.mark.thorough

SceneMaker = Callable[..., Scene]
CAMPAIGN = load(Path(__file__).resolve().parents[2] / "config" / "config.yaml")
HEAVY = 10.0
# A coarse mesh from a cold start, and one as coarse from there: the way to the solution is what is tried here.
COARSE = Numerics(
    accuracy=0.5, finite_contact_nodes=4, columns_min=8, finite_columns_min=64, row_growth=1.5, refinements=0
)


@dataclass(frozen=True)
class Outcome:
    """What became of a scene.

    Friction by two routes, largest force on an inner node over that of the contact, and whether the first mesh was
    solved at once.
    """

    pressure: float
    friction: tuple[float, float]
    imbalance: float
    at_once: bool


def slide(scene: Scene) -> Outcome:
    solution = solve(scene)
    assert isinstance(solution, FiniteSolution)
    assert solution.contact.pressure.mean() == pytest.approx(scene.pressure, rel=1e-12)
    inner = solution.finite.forces(solution.correction.state.stress[:4])[:, 1:-1]
    largest = solution.contact.pressure.max() * solution.block.column_width
    friction = solution.friction
    imbalance = float(np.abs(inner).max() / largest)
    at_once = "at once: converged" in solution.history[0]
    return Outcome(scene.pressure, (friction.stress_power, friction.contact), imbalance, at_once)


@pytest.fixture(scope="module", params=["stress", "strain"])
def plane(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def outcomes(paper_scene: SceneMaker, plane: str) -> dict[int, list[Outcome]]:
    """All scenes in one plane, by scale."""
    found: dict[int, list[Outcome]] = {}
    points = {(s.scale, s.velocity, s.pressure, s.aspect) for s in CAMPAIGN.scenes().values()}
    assert len(points) == 224
    points |= set(product({point[0] for point in points}, {point[1] for point in points}, (HEAVY,), (0.75,)))
    for scale, velocity, pressure, aspect in sorted(points):
        changes = {"aspect": aspect, "plane": plane, "numerics": COARSE, "kinematics": "finite"}
        found.setdefault(scale, []).append(slide(paper_scene(velocity, pressure, scale, **changes)))
    return found


@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_every_scene_converges_and_has_friction(outcomes: dict[int, list[Outcome]], scale: int) -> None:
    assert len(outcomes[scale]) == (105 if scale == 1 else 49)
    for outcome in outcomes[scale]:
        assert 0.0 < min(outcome.friction) <= max(outcome.friction) < 0.6


@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_forces_are_in_balance(outcomes: dict[int, list[Outcome]], scale: int) -> None:
    assert max(outcome.imbalance for outcome in outcomes[scale]) < 5e-4


def test_scenes_of_the_paper_are_solved_at_once(outcomes: dict[int, list[Outcome]]) -> None:
    # All 224 in plane stress, and all but one in plane strain.
    paper = [outcome for scale in outcomes.values() for outcome in scale if outcome.pressure < HEAVY]
    assert sum(outcome.at_once for outcome in paper) >= 0.98 * len(paper)


def test_heavy_loads_are_mostly_solved_at_once(outcomes: dict[int, list[Outcome]]) -> None:
    # 23 of 28 in plane stress, all in plane strain; the others along a growing road.
    heavy = [outcome for scale in outcomes.values() for outcome in scale if outcome.pressure == HEAVY]
    assert sum(outcome.at_once for outcome in heavy) >= 0.6 * len(heavy)
