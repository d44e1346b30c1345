"""Write the table of all scales and their sum."""

from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.campaign import read
from rubfric.results.tables import total_table, write_table


def main(output: str, page: str, campaign: str, aspect: float) -> None:
    """Write the friction of each scale and their sum.

    Parameters
    ----------
    output, page : str
        Paths of the table as CSV and as HTML.
    campaign : str
        Path of the collection of all scenes (netCDF).
    aspect : float
        Height over width of the blocks.
    """
    table = total_table(read(campaign), aspect)
    write_table(table, output)
    words = (
        f"Friction of every scale and their sum, for blocks {aspect:g} times as high as wide. The error of the sum "
        "adds those of the scales, since one rule makes all their meshes; it is absolute."
    )
    write_page(table_page(table, "Friction of all scales", words, group="pressure_MPa"), page)
