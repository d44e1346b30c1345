"""Write the table of one scale."""

from rubfric.collection import read
from rubfric.tables import scale_table, write_table


def main(output: str, campaign: str, scale: int) -> None:
    """Write all scenes of ``scale`` in the campaign's file to the CSV file ``output``."""
    write_table(scale_table(read(campaign), scale), output)
