"""Marches that a test makes step by step."""

from __future__ import annotations

from rubfric.marching import STEPPERS
from rubfric.mechanics.march.march import March
from rubfric.mechanics.theory.kinematics import decide
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import MECHANICS


def begin(scene: Scene, procedure: Procedure) -> March:
    """Return a march that has made no step."""
    decision = decide(scene)
    return March(scene, procedure, decision, STEPPERS[decision.kinematics], MECHANICS[decision.kinematics].solve)
