"""Steady sliding of one scene, in the kinematics that it asks for or needs."""

from __future__ import annotations

from rubfric.finitesteady import FiniteSolution, solve_finite
from rubfric.kinematics import decide
from rubfric.scene import Scene
from rubfric.smallsteady import SmallSolution, solve_small


def solve(scene: Scene) -> SmallSolution | FiniteSolution:
    """Slide a block steadily over its scale of the road.

    Raises
    ------
    NotConverged
        With the scene's name, step and residual.
    """
    decision = decide(scene)
    if decision.kinematics == "finite":
        return solve_finite(scene, decision)
    return solve_small(scene, decision)
