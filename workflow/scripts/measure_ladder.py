"""Measure one scene on every rung of every knob."""

from typing import Any

from rubfric.ladder import climb
from rubfric.scene import Scene
from rubfric.tables import write_table


def main(output: str, name: str, parameters: dict[str, Any]) -> None:
    """Write the ladder of the scene that ``parameters`` describe as a CSV table."""
    table = climb(name, Scene.from_parameters(parameters))
    write_table(table, output)
    print(table.to_string())
