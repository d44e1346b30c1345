"""Friction from energy, by the kinematics in which a scene was solved."""

from __future__ import annotations

from rubfric.finiteenergy import evaluate_finite
from rubfric.finitesteady import FiniteSolution
from rubfric.routes import Energies
from rubfric.smallenergy import evaluate_small
from rubfric.smallsteady import SmallSolution


def evaluate(solution: SmallSolution | FiniteSolution) -> Energies:
    """Return the friction coefficient by three routes and the stored strain energy of a solved scene."""
    if isinstance(solution, FiniteSolution):
        return evaluate_finite(solution)
    return evaluate_small(solution)
