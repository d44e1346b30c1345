"""Write the friction of one rubber on one road, of those that are compared."""

from typing import Any

from rubfric.results.campaign import collect
from rubfric.results.draws import mean_road
from rubfric.results.pair import COLLECTED, road_by_road
from rubfric.results.tables import write_table
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad


def main(
    output: str,
    scenes: dict[str, str],
    whole: dict[str, dict[str, str]],
    roads: dict[float | None, dict[str, Any]],
    collected: str,
) -> None:
    """Collect all scenes and write the friction of the whole road, on each of several roads or windows too.

    Parameters
    ----------
    output : str
        Path of the table (CSV).
    scenes : dict
        Paths of the results of the scales (netCDF), and the digests that they must have.
    whole : dict
        The same of the whole road, by the name of the draw or window, which is empty for one road.
    roads : dict
        The parameters of ``WholeRoad`` by temperature, degC; under None for a rubber as it is given.
    collected : str
        What all these scenes are known by.
    """
    about = {one: WholeRoad.from_parameters(road) for one, road in roads.items()}
    found = {draw: collect(paths, paths.values()) for draw, paths in whole.items()}
    table = total_tables(collect(scenes, scenes.values()), mean_road(found), about)
    several = [] if "" in found else [*found.values()]
    write_table(road_by_road(table, several).assign(**{COLLECTED: collected}), output)
