"""Draw friction over speed and pressure, simulated and measured."""

from rubfric.figures.fig9 import draw
from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table
from rubfric.results.temperature import rows_at


def main(
    totals: str,
    points: str,
    pressures: list[float],
    speeds: list[float],
    outputs: list[str],
    temperature: float | None,
) -> None:
    """Draw Fig. 9 and save it under every path of ``outputs``.

    Parameters
    ----------
    totals, points : str
        Paths of the tables of the whole road's friction and of the rig's points (CSV).
    pressures, speeds : list of float
        What the rig is run at, MPa and mm/s.
    outputs : list of str
        Paths; their endings choose the formats.
    temperature : float or None
        What the figure shows of several that were simulated, degC, and names.
    """
    table = read_table(points, ("run", "kind", "source"))
    drawn = draw(rows_at(read_table(totals, WORDS), temperature), table, pressures, speeds)
    save(name_temperature(drawn, temperature), *outputs)
