"""Write the table of all scales and their sum."""

from rubfric.collection import read
from rubfric.tables import total_table, write_table


def main(output: str, campaign: str, aspect: float) -> None:
    """Write the friction of each scale and their sum at one height-to-width ratio to the CSV file ``output``."""
    write_table(total_table(read(campaign), aspect), output)
