"""Collect the scalars of all scenes."""

from pathlib import Path

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
        Path of an empty file, alone in its folder, whose name represents these digests.
    """
    collected = collect(scenes, digests)
    for other in Path(mark).parent.iterdir():
        other.unlink()
    write(collected, output)
    Path(mark).touch()
