"""Write friction on an areal road, beside the plane model and Persson's theory, as a table and a page."""

import os

from rubfric.pages.areal import areal_page
from rubfric.pages.render import write_page
from rubfric.results.areal_table import areal_table
from rubfric.results.dataset import read
from rubfric.results.tables import write_table


def main(output: str, page: str, road: str, results: dict[str, str], profiles: dict[str, str]) -> None:
    """Write the table and its page.

    Parameters
    ----------
    output, page : str
        Paths of the table (CSV) and the page.
    road : str
        Its name.
    results, profiles : dict of str
        Digests of the results of its scenes by their paths, and of its profiles in the same order; the latter may be
        empty.
    """
    scenes, beside = ([read(path, digest) for path, digest in each.items()] for each in (results, profiles))
    table = areal_table(scenes, beside)
    write_table(table, output)
    write_page(areal_page(scenes, table, road, os.path.basename(output), "../index.html"), page)
