"""Small or finite strain: what is asked for is done, and the estimate is told."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rubfric.mechanics.theory.kinematics import decide, estimated_correction
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]


@pytest.mark.parametrize("kinematics", ["small", "finite"])
def test_what_is_asked_for_is_done(paper_scene: SceneMaker, kinematics: str) -> None:
    for pressure in (1e-6, 50.0):
        decision = decide(paper_scene(100.0, pressure, kinematics=kinematics))
        assert decision.kinematics == kinematics
        assert decision.reason == f"{kinematics} strain was asked for"


@pytest.mark.parametrize("kinematics", ["small", "finite", "auto"])
def test_estimate_does_not_depend_on_what_is_asked_for(paper_scene: SceneMaker, kinematics: str) -> None:
    scene = paper_scene(100.0, 0.5, kinematics=kinematics)
    assert decide(scene).correction == estimated_correction(scene) >= 0.0


def test_heavy_loads_need_finite_strain(paper_scene: SceneMaker) -> None:
    for plane in ("strain", "stress"):
        decision = decide(paper_scene(100.0, 5.0, plane=plane, kinematics="auto"))
        assert decision.kinematics == "finite"
        assert decision.correction > 0.01


def test_accuracy_asked_for_decides(paper_scene: SceneMaker) -> None:
    correction = estimated_correction(paper_scene(100.0, 0.1))
    # Small strain may use up half of it.
    for share, expected, compared in ((1.9, "finite", "more than"), (2.1, "small", "within")):
        numerics = Numerics(accuracy=share * correction)
        decision = decide(paper_scene(100.0, 0.1, kinematics="auto", numerics=numerics))
        assert decision.kinematics == expected
        assert f"{compared} half the accuracy asked for, {share * correction:.2%}" in decision.reason
