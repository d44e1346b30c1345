"""Draw one figure from a table."""

from importlib import import_module

from rubfric.figures.style import save
from rubfric.results.tables import read_table

# Columns that are text, even where it looks like a number.
WORDS = ("scene", "knob", "rung", "set", "preset", "kinematics", "plane", "note", "case", "reason")


def main(figure: str, table: str, outputs: list[str]) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : str
        Module of ``rubfric.figures``.
    table : str
        Path of the table (CSV).
    outputs : list of str
        Paths; their endings choose the formats.
    """
    draw = import_module(f"rubfric.figures.{figure}").draw
    save(draw(read_table(table, WORDS)), *outputs)
