"""Draw one figure from the campaign, or from the results of some scenes."""

from importlib import import_module
from typing import Any

from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results import campaign as collection
from rubfric.results import dataset
from rubfric.results.curves import WORDS
from rubfric.results.tables import read_table
from rubfric.results.temperature import at_temperature, rows_at


def main(
    figure: str,
    results: str | list[str],
    choice: dict[str, Any],
    outputs: list[str],
    digests: list[str] | None = None,
    temperature: float | None = None,
    curves: str | None = None,
) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : str
        Module of ``rubfric.figures``.
    results : str or list of str
        Path of the collection of all scenes, or paths of single results (netCDF).
    choice : dict
        Further arguments of the module's ``draw``.
    outputs : list of str
        Paths; their endings choose the formats.
    digests : list of str, optional
        Digests that single results must have, or what the collection is known by.
    temperature : float, optional
        What the figure shows of several, degC, and names.
    curves : str, optional
        Path of the table of curves (CSV), for Fig. 6 where speeds were added.
    """
    draw = import_module(f"rubfric.figures.{figure}").draw
    if curves:
        table = read_table(curves, WORDS)
        choice = choice | {"curves": table if temperature is None else rows_at(table, temperature)}
    if isinstance(results, str):
        drawn = draw(at_temperature(collection.read(results, *(digests or [])), temperature), **choice)
    else:
        read = [dataset.read(path, digest) for path, digest in zip(results, digests or [], strict=True)]
        drawn = draw(read, **choice)
    save(name_temperature(drawn, temperature), *outputs)
