"""One scene from its parameters to its dataset."""

from __future__ import annotations

import time

import xarray as xr

from rubfric import dataset
from rubfric.energy import evaluate
from rubfric.errors import NotConverged
from rubfric.resolvable import require_resolved
from rubfric.routes import most_closure
from rubfric.scene import Scene
from rubfric.steady import finer_mesh, require_solvable, solve


def simulate(scene: Scene) -> xr.Dataset:
    """Slide the rubber block of a scene steadily over its road and return all results.

    Returns
    -------
    xarray.Dataset
        See ``rubfric.dataset.build``; ``rubfric.write`` puts it into a file.

    Raises
    ------
    NotConverged
        With the scene, the step and the residual; there is no result then.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load("config/config.yaml")
    >>> result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=5))
    >>> float(result.friction_coefficient)  # doctest: +SKIP
    0.206
    """
    started = time.perf_counter()
    require_solvable(scene)
    solution = solve(scene)
    way_out = finer_mesh(solution.decision.kinematics == "finite")
    require_resolved(scene, solution.contact.touching, solution.iterations, way_out)
    energies = evaluate(solution)
    if not energies.closure <= most_closure(scene.numerics.accuracy):  # also where it is not a number
        raise NotConverged(
            scene.name,
            solution.iterations,
            energies.closure,
            "relative difference of the three friction coefficients",
            "the mesh does not resolve this scene, or Poisson's ratio is too near its bounds: raise the pressure; "
            + way_out,
        )
    return dataset.build(solution, energies, time.perf_counter() - started)
