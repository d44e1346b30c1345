"""Draw the friction of every rubber on every road, and which grips more."""

from rubfric.figures.fig13 import draw
from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results.comparison import NAMES, RANKED
from rubfric.results.tables import read_table
from rubfric.results.temperature import rows_at


def main(comparison: str, ranking: str, pressures: list[float], temperature: float | None, outputs: list[str]) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    comparison, ranking : str
        Paths of the tables (CSV).
    pressures : list of float
        Nominal, MPa.
    temperature : float or None
        What the figure shows of several, degC, and names.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    tables = [read_table(path, words) for path, words in ((comparison, NAMES), (ranking, RANKED))]
    shown = [table if temperature is None else rows_at(table, temperature) for table in tables]
    save(name_temperature(draw(*shown, pressures), temperature), *outputs)
