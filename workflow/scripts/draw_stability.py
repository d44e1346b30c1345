"""Draw the map of stability from its table."""

import pandas as pd

from rubfric.figures.stability import draw
from rubfric.figures.style import save


def main(table: str, outputs: list[str]) -> None:
    """Draw the CSV file ``table`` and save the map under every path of ``outputs``."""
    save(draw(pd.read_csv(table)), *outputs)
