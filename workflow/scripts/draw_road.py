"""Draw friction on a measured road: over speed beside Persson's theory, or over the cutoff."""

from rubfric.figures.road_friction import over_cutoff, over_speed
from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results.tables import read_table


def main(figure: str, table: str, temperature: float | None, outputs: list[str]) -> None:
    """Draw a figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : {"road_persson", "road_cutoff"}
    table : str
        Path of the table of friction on the road (CSV).
    temperature : float or None
        Of the results, degC, which the figure names.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    draw = {"road_persson": over_speed, "road_cutoff": over_cutoff}[figure]
    save(name_temperature(draw(read_table(table, ["way", "note"])), temperature), *outputs)
