"""One scene on an areal road, from its parameters to its dataset."""

from __future__ import annotations

import time

import xarray as xr

from rubfric.mechanics.areal.steady import solve_areal
from rubfric.results.areal import build
from rubfric.scene.areal import ArealScene


def simulate_areal(scene: ArealScene) -> xr.Dataset:
    """Slide the rubber block of a scene steadily over its areal road and return all results.

    Parameters
    ----------
    scene : ArealScene

    Returns
    -------
    xarray.Dataset
        See ``rubfric.results.areal.build``; ``rubfric.write`` puts it into a file.

    Raises
    ------
    InvalidInput
        For a road whose shortest wave the nodes do not resolve.
    NotConverged
        With the scene, the step and the residual; there is no result then.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.1, rms_slope=0.25)
    >>> scene = rubfric.ArealScene(road, velocity=100.0, pressure=0.3, material=rubfric.load().material)
    >>> print(f"{float(rubfric.simulate_areal(scene).friction_coefficient):.1f}")
    0.1
    """
    started = time.perf_counter()
    solution = solve_areal(scene)
    return build(solution, time.perf_counter() - started)
