"""Collect the scalars of all scenes."""

from rubfric.files import mark as leave
from rubfric.results.campaign import collect
from rubfric.results.dataset import write


def main(output: str, scenes: list[str], digests: list[str], mark: str) -> None:
    """Write the collection.

    Parameters
    ----------
    output : str
        Path of the collection (netCDF).
    scenes, digests : list of str
        Paths of results (netCDF), and the digests that they must have.
    mark : str
        Path of an empty file whose name represents these digests; it takes the place of such files beside it.
    """
    collected = collect(scenes, digests)
    write(collected, output)
    leave(mark)
