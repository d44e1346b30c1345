"""One scene, solved in the kinematics that was decided on."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric import simulation as steady
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.mechanics.small.steady import SmallSolution, solve_small
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
COARSE = Numerics(finite_contact_nodes=4, finite_columns_min=32, row_growth=1.4)


@pytest.mark.parametrize(("kinematics", "kind"), [("small", SmallSolution), ("finite", FiniteSolution)])
def test_scene_is_solved_as_it_asks(paper_scene: SceneMaker, kinematics: str, kind: type) -> None:
    solution = steady.solve(paper_scene(100.0, 0.5, kinematics=kinematics, numerics=COARSE))
    assert type(solution) is kind
    assert solution.decision.kinematics == kinematics


@pytest.mark.parametrize(("kinematics", "kind"), [("small", SmallSolution), ("finite", FiniteSolution)])
def test_decision_decides_and_is_kept(
    paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch, kinematics: str, kind: type
) -> None:
    decision = Decision(kinematics, 0.1, "a coin was tossed")
    monkeypatch.setattr(steady, "decide", lambda _: decision)
    solution = steady.solve(paper_scene(100.0, 0.5, kinematics="auto", numerics=COARSE))
    assert type(solution) is kind
    assert solution.decision is decision


def test_solution_is_that_of_the_solver(paper_scene: SceneMaker) -> None:
    scene = paper_scene(1000.0, 0.5)
    ours, theirs = steady.solve(scene), solve_small(scene, Decision("small", 0.0, ""))
    np.testing.assert_array_equal(ours.contact.pressure, theirs.contact.pressure)
