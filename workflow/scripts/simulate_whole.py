"""Simulate one scene of the whole road and write its result, or why it was refused."""

from typing import Any

from rubfric.errors import InvalidInput, NotConverged
from rubfric.results.dataset import read, write
from rubfric.results.kept import take_up
from rubfric.results.provenance import refusal
from rubfric.results.selection import NOT_NEEDED, REFUSAL
from rubfric.results.summary import summary
from rubfric.results.whole_road import WholeRoad
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate


def main(output: str, parameters: dict[str, Any], road: dict[str, Any]) -> None:
    """Simulate the scene and write its result; a scene that is refused, or not needed, leaves a file that says why.

    Parameters
    ----------
    output : str
        Path of the result (netCDF).
    parameters : dict
        Those of the ``Scene``.
    road : dict
        Those of ``WholeRoad``, where a cheaper way may be accurate enough; else nothing.
    """
    scene = Scene.from_parameters(parameters)
    way = WholeRoad.from_parameters(road).cheapest(scene.velocity, scene.pressure) if road else "direct"
    if way != "direct":
        write(refusal(scene, NOT_NEEDED + way), output)
        print(NOT_NEEDED + way)
        return
    if take_up(output, scene):
        result = read(output, refusals=True)
    else:
        try:
            result = simulate(scene)
        except (InvalidInput, NotConverged) as reason:
            result = refusal(scene, reason)
        write(result, output)
    print(f"Refused: {result.attrs[REFUSAL]}" if REFUSAL in result.attrs else summary(result))
