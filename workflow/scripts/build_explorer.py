"""Build the page on which the campaign is explored in a browser."""

from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset


def main(output: str, campaign: str, scenes: list[str], digests: list[str], aspect: float, road: str) -> None:
    """Write the HTML file ``output`` from the campaign's file and the results of scenes of one ratio, of these digests.

    ``road`` is the name of the road.
    """
    results = (dataset.read(path, digest) for path, digest in zip(scenes, digests, strict=True))
    write_page(page(payload(collection.read(campaign), results, aspect, road)), output)
