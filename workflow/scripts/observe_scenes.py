"""Simulate some scenes of another reading of the paper, and keep what claims are judged by."""

from typing import Any

from rubfric.results.tables import write_table
from rubfric.scene.scene import Scene
from rubfric.studies.paper.observation import observe, table


def main(output: str, scenes: dict[str, dict[str, Any]]) -> None:
    """Write one row per scene; a scene that is refused has its reason.

    Parameters
    ----------
    output : str
        Path of the table (CSV).
    scenes : dict
        Parameters of each ``Scene`` by its name.
    """
    rows = []
    for name, parameters in scenes.items():
        rows.append(observe(Scene.from_parameters(parameters)))
        print(name, rows[-1], flush=True)
    write_table(table(rows), output)
