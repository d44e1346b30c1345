"""Fit a rubber to its measured moduli and write it as a config, with its page."""

from pathlib import Path
from typing import Any

from rubfric.commands.rubber import write_fit
from rubfric.config.fitting import arguments
from rubfric.config.measured import MeasuredRubber
from rubfric.dma.bootstrap import bootstrap
from rubfric.dma.fitted import fit_file

# Samples of the bands on the page.
SAMPLES = 200


def main(output: str, rubber: str, entry: dict[str, Any]) -> None:
    """Fit the rubber and write it.

    Parameters
    ----------
    output : str
        Path of the config (YAML); the page is beside it.
    rubber : str
        Its name.
    entry : dict
        Its entry in the config, with ``measurements``.
    """
    chosen = MeasuredRubber.read(f"rubbers.{rubber}", {**entry, "uncertainty": SAMPLES})
    found, material = fit_file(*arguments(rubber, chosen))
    said = write_fit(
        found, material, bootstrap(found), Path(output), f"fit from {chosen.measurements}", "../index.html"
    )
    print("\n".join(said))
