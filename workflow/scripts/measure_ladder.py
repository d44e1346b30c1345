"""Measure one scene on every rung of every knob, or a whole road by every way to its total."""

from typing import Any

from rubfric.results.tables import write_table
from rubfric.scene.scene import ALL, Scene
from rubfric.studies.accuracy.ladder import measure_ladder
from rubfric.studies.accuracy.ways import measure_ways


def main(output: str, name: str, parameters: dict[str, Any]) -> None:
    """Write the ladder of the scene that ``parameters`` describe as a CSV table."""
    scene = Scene.from_parameters(parameters)
    table = measure_ways(name, scene) if scene.scale == ALL else measure_ladder(name, scene)
    write_table(table, output)
    print(table.to_string())
