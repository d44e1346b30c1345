"""Simulate one scene of the whole road and write its result, or why it was refused."""

from typing import Any

from rubfric.errors import InvalidInput, NotConverged
from rubfric.results.dataset import write
from rubfric.results.provenance import refusal
from rubfric.results.summary import summary
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate


def main(output: str, parameters: dict[str, Any]) -> None:
    """Simulate the scene and write its result; a scene that is refused leaves a file that says why.

    Parameters
    ----------
    output : str
        Path of the result (netCDF).
    parameters : dict
        Those of the ``Scene``.
    """
    scene = Scene.from_parameters(parameters)
    try:
        result = simulate(scene)
    except (InvalidInput, NotConverged) as reason:
        write(refusal(scene, reason), output)
        print(f"Refused: {reason}")
    else:
        write(result, output)
        print(summary(result))
