"""Draw one figure from the campaign, or from the results of some scenes."""

from importlib import import_module
from typing import Any

import xarray as xr

from rubfric.dataset import read
from rubfric.figures.style import save


def main(figure: str, results: str | list[str], choice: dict[str, Any], outputs: list[str]) -> None:
    """Draw ``rubfric.figures.<figure>`` with the arguments ``choice`` and save it under every path of ``outputs``."""
    draw = import_module(f"rubfric.figures.{figure}").draw
    if isinstance(results, str):
        with xr.open_dataset(results) as campaign:
            drawn = draw(campaign.load(), **choice)
    else:
        drawn = draw([read(path) for path in results], **choice)
    save(drawn, *outputs)
