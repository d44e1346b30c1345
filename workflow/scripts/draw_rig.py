"""Draw friction over speed and pressure, simulated and measured."""

from rubfric.figures.fig9 import draw
from rubfric.figures.style import save
from rubfric.results.campaign import read
from rubfric.results.tables import read_table


def main(
    campaign: str, points: str, aspect: float, pressures: list[float], speeds: list[float], outputs: list[str]
) -> None:
    """Draw Fig. 9 from the campaign's file and the CSV table ``points`` and save it under every path of ``outputs``."""
    table = read_table(points, ("run", "kind", "source"))
    save(draw(read(campaign), table, aspect, pressures, speeds), *outputs)
