"""Build the page on which the campaign is explored in a browser."""

import netCDF4

from rubfric.checksums import check_seal
from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset
from rubfric.results.scales import WORDS
from rubfric.results.selection import REFUSAL
from rubfric.results.tables import read_table


def main(
    output: str,
    campaign: str,
    table: str,
    whole: list[str],
    scenes: list[str],
    digests: list[str],
    collected: list[str],
    aspect: float,
    road: str,
) -> None:
    """Write the page.

    Parameters
    ----------
    output : str
        Path of the page (HTML).
    campaign : str
        Path of the collection of all scenes (netCDF).
    table : str
        Path of the table of totals (CSV).
    whole : list of str
        Path of the collection of the whole road's scenes (netCDF), or nothing.
    scenes, digests : list of str
        Paths of results with the height-to-width ratio ``aspect`` (netCDF), those of the whole road among them, and the
        digests that they must have. A refusal has no picture.
    collected : list of str
        What the collections ``campaign`` and ``whole`` are known by.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.
    """
    results = (dataset.read(path, digest) for path, digest in zip(scenes, digests, strict=True) if not refused(path))
    of_road = collection.read(whole[0], collected[1]) if whole else None
    gathered = collection.read(campaign, collected[0])
    write_page(page(payload(gathered, read_table(table, WORDS), results, aspect, road, of_road)), output)


def refused(path: str) -> bool:
    """Return whether a file holds the refusal of a scene."""
    check_seal(path)
    with netCDF4.Dataset(path) as stored:
        return REFUSAL in stored.ncattrs()
