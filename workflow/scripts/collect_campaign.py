"""Collect the scalars of all scenes."""

from pathlib import Path

from rubfric.results.campaign import collect
from rubfric.results.dataset import write


def main(output: str, scenes: list[str], digests: list[str], mark: str) -> None:
    """Gather the results in the files ``scenes``, of these digests, into the netCDF file ``output``.

    The empty file ``mark``, alone in its folder, says which scenes those were.
    """
    collected = collect(scenes, digests)
    for other in Path(mark).parent.iterdir():
        other.unlink()
    write(collected, output)
    Path(mark).touch()
