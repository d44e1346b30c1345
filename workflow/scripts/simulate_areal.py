"""Simulate one scene on an areal road and write its result."""

from typing import Any

from rubfric.areal_simulation import simulate_areal
from rubfric.results.dataset import write
from rubfric.scene.areal import ArealScene


def main(output: str, parameters: dict[str, Any]) -> None:
    """Simulate the scene and write its result.

    Parameters
    ----------
    output : str
        Path of the result (netCDF).
    parameters : dict
        Those of the ``ArealScene``.
    """
    result = simulate_areal(ArealScene.from_parameters(parameters))
    write(result, output)
    print(f"friction coefficient {float(result.friction_coefficient):.5g} +- {float(result.friction_error):.2g}")
