"""Read and analyse a measured road and write it as a config of sines, with its page."""

from pathlib import Path
from typing import Any

from rubfric.commands.road import write_road
from rubfric.config.measured_road import MeasuredRoad, analysed


def main(output: str, road: str, entry: dict[str, Any]) -> None:
    """Read the road and write it.

    Parameters
    ----------
    output : str
        Path of the config (YAML); the page is beside it.
    road : str
        Its name.
    entry : dict
        Its entry in the config, with ``profile``.
    """
    chosen = MeasuredRoad.read(f"roads.{road}", entry)
    print("\n".join(write_road(analysed(chosen), road, Path(output), f"read from {chosen.profile}", "../index.html")))
