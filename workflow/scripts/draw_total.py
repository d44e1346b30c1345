"""Draw one figure of the friction of the whole road, from the table of totals."""

from importlib import import_module
from typing import Any

import pandas as pd

from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results.campaign import read
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table
from rubfric.results.temperature import at_temperature, rows_at


def main(
    figure: str,
    table: str,
    campaign: str,
    collected: str,
    choice: dict[str, Any],
    outputs: list[str],
    temperature: float | None,
    added: list[str],
) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : str
        ``fig7``, which shows the scales of the campaign too, ``fig10``, or ``fig12``, which shows all temperatures.
    table, campaign : str
        Paths of the table of totals (CSV) and of the collection of all scenes (netCDF).
    collected : str
        What the collection is known by.
    choice : dict
        Further arguments of the module's ``draw``.
    outputs : list of str
        Paths; their endings choose the formats.
    temperature : float or None
        What the figure shows of several, degC, and names.
    added : list of str
        Paths of the tables of added speeds (CSV), which Fig. 7 shows too.
    """
    draw = import_module(f"rubfric.figures.{figure}").draw
    totals = read_table(table, WORDS)
    if more := [one for path in added if len(one := read_table(path, WORDS))]:
        totals, choice = pd.concat([totals, *more], ignore_index=True), choice | {"refined": True}
    totals = totals if temperature is None else rows_at(totals, temperature)
    scales = [at_temperature(read(campaign, collected), temperature)] if figure == "fig7" else []
    save(name_temperature(draw(*scales, totals, **choice), temperature), *outputs)
