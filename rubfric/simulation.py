"""One scene from its parameters to its dataset."""

from __future__ import annotations

import time

import xarray as xr

from rubfric import dataset
from rubfric.energy import evaluate
from rubfric.scene import Scene
from rubfric.steady import solve


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
    0.129
    """
    started = time.perf_counter()
    solution = solve(scene)
    energies = evaluate(solution)
    return dataset.build(solution, energies, time.perf_counter() - started)
