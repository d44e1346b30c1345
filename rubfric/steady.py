"""Steady sliding of one scene, in the kinematics that it asks for or needs."""

from __future__ import annotations

from rubfric.finitesteady import FiniteSolution, solve_finite
from rubfric.kinematics import decide
from rubfric.resolution import MOST_FINITE, most_columns
from rubfric.resolvable import require_height, require_resolvable
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


def require_solvable(scene: Scene) -> None:
    """Refuse a scene whose contact is too light for any mesh that it may have, or whose load is too heavy.

    Raises
    ------
    InvalidInput
        With the pressure that is possible.
    """
    finite = decide(scene).kinematics == "finite"
    if finite:
        require_height(scene)
    require_resolvable(scene, most_columns(scene, finite), finer_mesh(finite))


def finer_mesh(finite: bool) -> str:
    """Return how a scene can have a finer mesh than it has had, in words."""
    if finite:
        return (
            f"finite strain has at most {MOST_FINITE} columns, small strain (kinematics: small) up to "
            "numerics.columns_max"
        )
    return "numerics.columns_max allows for more"
