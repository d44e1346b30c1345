"""Collect the scalars of all scenes."""

from rubfric.collection import collect
from rubfric.dataset import write


def main(output: str, scenes: list[str], digests: list[str]) -> None:
    """Gather the results in the files ``scenes``, of these digests, into the netCDF file ``output``."""
    write(collect(scenes, digests), output)
