"""One scene from its parameters to its dataset: the one place that knows the steady driver and both kinematics."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import xarray as xr

from rubfric.errors import NotConverged
from rubfric.mechanics.finite.energy import evaluate_finite
from rubfric.mechanics.finite.steady import FiniteSolver
from rubfric.mechanics.small.energy import evaluate_small
from rubfric.mechanics.small.steady import SmallSolver
from rubfric.mechanics.steady.energies import Energies, most_closure
from rubfric.mechanics.steady.refinement import Solver, refined, solve_on
from rubfric.mechanics.steady.resolution import Resolution, most_columns
from rubfric.mechanics.steady.solution import OnMesh, SteadySolution
from rubfric.mechanics.theory.kinematics import Decision, decide
from rubfric.mechanics.theory.limits import require_digits, require_height, require_resolvable, require_resolved
from rubfric.results import dataset
from rubfric.scene.scene import Scene


@dataclass(frozen=True)
class Mechanics:
    """One kinematics, as the drivers need it.

    Attributes
    ----------
    solver : callable
        Solves a scene, steadily sliding, on one mesh after the other; takes the scene, the decision on its kinematics
        and, optionally, the solution of a scene nearly the same to start from.
    evaluate : callable
        Returns the friction coefficient by three routes and the stored strain energy of what ``solver`` has solved.
    """

    solver: Callable[..., Solver[Any]]
    evaluate: Callable[[Any], Energies]

    def solve(self, scene: Scene, decision: Decision) -> SteadySolution:
        """Slide a block steadily over its road, on meshes that follow from the contact and the accuracy.

        Parameters
        ----------
        scene : Scene
        decision : Decision

        Raises
        ------
        NotConverged
            With the scene's name, step and residual.
        """
        solution: SteadySolution = refined(scene, self.solver(scene, decision))
        return solution


MECHANICS = {
    "small": Mechanics(SmallSolver, evaluate_small),
    "finite": Mechanics(FiniteSolver, evaluate_finite),
}


def simulate(scene: Scene, *, accuracy: float | None = None) -> xr.Dataset:
    """Slide the rubber block of a scene steadily over its road and return all results.

    Parameters
    ----------
    scene : Scene
    accuracy : float, optional
        Relative accuracy of friction, instead of that of the scene's numerics.

    Returns
    -------
    xarray.Dataset
        See ``rubfric.results.dataset.build``; ``rubfric.write`` puts it into a file.

    Raises
    ------
    InvalidInput
        Where the contact is too light for any mesh that the scene may have, the load leaves hardly anything of the
        block, or the rubber is too nearly incompressible.
    NotConverged
        With the scene, the step and the residual; there is no result then.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load()
    >>> result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=5))
    >>> print(f"{float(result.friction_coefficient):.1f}")
    0.2
    """
    started = time.perf_counter()
    if accuracy is not None:
        scene = replace(scene, numerics=replace(scene.numerics, accuracy=accuracy))
    decision = decide_solvable(scene)
    finite = decision.kinematics == "finite"
    remedy = finer_mesh(scene, finite)
    require_resolvable(scene, most_columns(scene, finite), remedy)
    mechanics = MECHANICS[decision.kinematics]
    solution = mechanics.solve(scene, decision)
    require_resolved(scene, solution.contact.touching, solution.iterations, remedy)
    energies = mechanics.evaluate(solution)
    if not energies.closure <= most_closure(scene.numerics.accuracy):  # also where it is not a number
        raise NotConverged(
            scene.name,
            solution.iterations,
            energies.closure,
            "relative difference of the three friction coefficients",
            _unresolved(solution, remedy),
        )
    return dataset.build(solution, energies, time.perf_counter() - started)


def _unresolved(solution: SteadySolution, remedy: str) -> str:
    """Return why the routes to friction differ, and what may help."""
    if solution.unsolved:
        return (
            f"the mesh, of {solution.block.columns} columns, does not resolve this scene, and a finer one, of "
            f"{solution.unsolved}, has no solution: a lighter load, a longer cutoff or a less steep road is easier"
        )
    return f"the mesh does not resolve this scene, or Poisson's ratio is too near -1: raise the pressure; {remedy}"


def decide_solvable(scene: Scene) -> Decision:
    """Return the kinematics in which to solve a scene, steadily sliding or in time, and why.

    Raises
    ------
    InvalidInput
        Where the rubber is too nearly incompressible, or the load leaves hardly anything of the block.
    """
    decision = decide(scene)
    require_digits(scene, decision.kinematics == "finite")
    if decision.kinematics == "finite":
        require_height(scene)
    return decision


def solve(scene: Scene) -> SteadySolution:
    """Slide a block steadily over its road, in the kinematics that the scene asks for or needs; no energies.

    Raises
    ------
    NotConverged
        With the scene's name, step and residual.
    """
    decision = decide(scene)
    return MECHANICS[decision.kinematics].solve(scene, decision)


def solve_near(scene: Scene, solution: SteadySolution, mesh: Resolution) -> SteadySolution:
    """Slide the block of a scene that is nearly one solved before, in its kinematics, on one given mesh.

    Parameters
    ----------
    scene : Scene
    solution : SteadySolution
        Of the scene solved before, to start from.
    mesh : Resolution
        Such as ``rubfric.mechanics.steady.same_mesh.SameMesh``.

    Raises
    ------
    NotConverged
        With the scene's name, step and residual.
    """
    meshes: list[OnMesh] = []
    solver = MECHANICS[solution.decision.kinematics].solver(scene, solution.decision, solution)
    found: SteadySolution = solve_on(scene, solver, mesh, meshes)
    return replace(found, meshes=tuple(meshes))


def evaluate(solution: SteadySolution) -> Energies:
    """Return the friction coefficient by three routes and the stored strain energy of a solved scene."""
    return MECHANICS[solution.decision.kinematics].evaluate(solution)


def finer_mesh(scene: Scene, finite: bool) -> str:
    """Return how a scene can have a finer mesh than it has had, in words.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain.
    """
    if finite:
        return (
            f"finite strain has at most {most_columns(scene, True)} columns, small strain (kinematics: small) up to "
            "numerics.columns_max"
        )
    return "numerics.columns_max allows for more"
