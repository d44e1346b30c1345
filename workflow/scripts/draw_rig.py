"""Draw friction over speed and pressure, simulated and measured."""

from rubfric.figures.fig9 import draw
from rubfric.figures.style import save
from rubfric.results.campaign import read
from rubfric.results.tables import read_table


def main(
    campaign: str, points: str, aspect: float, pressures: list[float], speeds: list[float], outputs: list[str]
) -> None:
    """Draw Fig. 9 and save it under every path of ``outputs``.

    Parameters
    ----------
    campaign : str
        Path of the collection of all scenes (netCDF).
    points : str
        Path of the table of the rig's points (CSV).
    aspect : float
        Height over width of the blocks.
    pressures, speeds : list of float
        What the rig is run at, MPa and mm/s.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    table = read_table(points, ("run", "kind", "source"))
    save(draw(read(campaign), table, aspect, pressures, speeds), *outputs)
