"""Draw one figure from a table."""

from importlib import import_module

from rubfric.figures.style import save
from rubfric.results.tables import read_table

# Rungs and names are words, whatever they look like.
WORDS = ("scene", "knob", "rung", "set", "preset", "kinematics", "plane", "note")


def main(figure: str, table: str, outputs: list[str]) -> None:
    """Draw ``rubfric.figures.<figure>`` from the CSV file ``table`` and save it under every path of ``outputs``."""
    draw = import_module(f"rubfric.figures.{figure}").draw
    save(draw(read_table(table, WORDS)), *outputs)
