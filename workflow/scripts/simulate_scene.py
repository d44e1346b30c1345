"""Simulate one scene and write its result."""

from typing import Any

from rubfric.results.dataset import read, write
from rubfric.results.kept import take_up
from rubfric.results.summary import summary
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate


def main(output: str, parameters: dict[str, Any]) -> None:
    """Simulate the scene and write its result.

    Parameters
    ----------
    output : str
        Path of the result (netCDF).
    parameters : dict
        Those of the ``Scene``.
    """
    scene = Scene.from_parameters(parameters)
    if take_up(output, scene):
        result = read(output)
    else:
        result = simulate(scene)
        write(result, output)
    print(summary(result))
