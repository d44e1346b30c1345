"""Build the page on which the campaign is explored in a browser."""

from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset


def main(output: str, campaign: str, scenes: list[str], digests: list[str], aspect: float, road: str) -> None:
    """Write the page.

    Parameters
    ----------
    output : str
        Path of the page (HTML).
    campaign : str
        Path of the collection of all scenes (netCDF).
    scenes, digests : list of str
        Paths of results with the height-to-width ratio ``aspect`` (netCDF), and the digests that they must have.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.
    """
    results = (dataset.read(path, digest) for path, digest in zip(scenes, digests, strict=True))
    write_page(page(payload(collection.read(campaign), results, aspect, road)), output)
