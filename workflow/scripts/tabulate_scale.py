"""Write the table of one scale."""

import xarray as xr

from rubfric.tables import scale_table, write_table


def main(output: str, campaign: str, scale: int) -> None:
    """Write all scenes of ``scale`` in the campaign's file to the CSV file ``output``."""
    with xr.open_dataset(campaign) as collected:
        write_table(scale_table(collected, scale), output)
