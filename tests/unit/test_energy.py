"""Energies of a solved scene, by the kinematics in which it was solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pytest

from rubfric.mechanics.finite.energy import evaluate_finite
from rubfric.mechanics.finite.steady import solve_finite
from rubfric.mechanics.small.energy import evaluate_small
from rubfric.mechanics.small.steady import solve_small
from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate

SceneMaker = Callable[..., Scene]
COARSE = Numerics(finite_contact_nodes=4, finite_columns_min=32, row_growth=1.4)


@pytest.mark.parametrize(
    ("kinematics", "solve", "own"), [("small", solve_small, evaluate_small), ("finite", solve_finite, evaluate_finite)]
)
def test_energies_are_those_of_the_kinematics_used(
    paper_scene: SceneMaker, kinematics: str, solve: Callable, own: Callable
) -> None:
    # What the scene asks for does not count.
    solution = solve(paper_scene(100.0, 0.5, kinematics="auto", numerics=COARSE), Decision(kinematics, 0.0, ""))
    ours, theirs = evaluate(solution), own(solution)
    for field in fields(Energies):
        np.testing.assert_array_equal(getattr(ours, field.name), getattr(theirs, field.name))


def test_finite_strain_tends_to_small_strain_at_small_slopes_and_loads(paper_scene: SceneMaker) -> None:
    numerics = Numerics(columns_min=64, finite_columns_min=64, row_growth=1.3)
    road = paper_scene(100.0, 1.0).road
    flat = type(road)(1e-3 * road.amplitude, road.wavenumber)
    for plane in ("strain", "stress"):
        scene = paper_scene(100.0, 1e-2, road=flat, plane=plane, numerics=numerics)
        small = evaluate(solve_small(scene, Decision("small", 0.0, "")))
        finite = evaluate(solve_finite(scene, Decision("finite", 0.0, "")))
        assert finite.stress_power == pytest.approx(small.stress_power, rel=5e-3)
        assert finite.contact == pytest.approx(small.contact, rel=5e-3)
