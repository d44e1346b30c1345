"""Measure one scene on every rung of every knob."""

from typing import Any

from rubfric.results.tables import write_table
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy.ladder import measure_ladder


def main(output: str, name: str, parameters: dict[str, Any]) -> None:
    """Write the ladder of the scene that ``parameters`` describe as a CSV table."""
    table = measure_ladder(name, Scene.from_parameters(parameters))
    write_table(table, output)
    print(table.to_string())
