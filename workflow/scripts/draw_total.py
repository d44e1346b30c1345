"""Draw one figure of the friction of the whole road, from the table of totals."""

from importlib import import_module
from typing import Any

from rubfric.figures.style import save
from rubfric.results.campaign import read
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table


def main(figure: str, table: str, campaign: str, collected: str, choice: dict[str, Any], outputs: list[str]) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : str
        ``fig7``, which shows the scales of the campaign too, or ``fig10``.
    table, campaign : str
        Paths of the table of totals (CSV) and of the collection of all scenes (netCDF).
    collected : str
        What the collection is known by.
    choice : dict
        Further arguments of the module's ``draw``.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    draw = import_module(f"rubfric.figures.{figure}").draw
    totals = read_table(table, WORDS)
    drawn = draw(read(campaign, collected), totals, **choice) if figure == "fig7" else draw(totals, **choice)
    save(drawn, *outputs)
