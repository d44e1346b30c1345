"""Collect the scalars of all scenes of the whole road."""

from rubfric.files import mark as leave
from rubfric.results.campaign import collect
from rubfric.results.dataset import write
from rubfric.results.draws import mean_road


def main(output: str, scenes: dict[str, dict[str, str]], mark: str) -> None:
    """Write the collection: of one road, or the mean over roads of random phases or windows of one.

    Parameters
    ----------
    output : str
        Path of the collection (netCDF).
    scenes : dict
        By the name of the draw, which is empty for a road that is not random: the paths of its results (netCDF), and
        the digests that they must have.
    mark : str
        Path of an empty file whose name represents these digests; it takes the place of such files beside it.
    """
    roads = {draw: collect(paths, paths.values()) for draw, paths in scenes.items()}
    write(mean_road(roads), output)
    leave(mark)
