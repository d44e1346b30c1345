"""Write the table of all scales and their sum."""

import xarray as xr

from rubfric.tables import total_table, write_table


def main(output: str, campaign: str, aspect: float) -> None:
    """Write the friction of each scale and their sum at one height-to-width ratio to the CSV file ``output``."""
    with xr.open_dataset(campaign) as collected:
        write_table(total_table(collected, aspect), output)
