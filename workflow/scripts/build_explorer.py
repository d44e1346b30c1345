"""Build the page on which the campaign is explored in a browser."""

from collections.abc import Iterator

import netCDF4
import xarray as xr

from rubfric.checksums import check_seal
from rubfric.pages.explorer.data import payload, together
from rubfric.pages.explorer.page import page
from rubfric.pages.explorer.roads import NUMBER
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset
from rubfric.results.pair import read_pair
from rubfric.results.scales import WORDS
from rubfric.results.selection import REFUSAL
from rubfric.results.tables import read_table
from rubfric.results.temperature import at_temperature, rows_at


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
    temperatures: list[float | None],
    roads: list[int],
    shown: float | None,
    others: list[tuple[str, str, str, str]],
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
    roads : list of int
        On which of several roads each of them is, from 1; else 0.
    collected : list of str
        What the collections ``campaign`` and ``whole`` are known by.
    aspect : float
        Height over width of the blocks.
    road : str
        Name of the road.
    temperatures : list of float or None
        Of each result, degC; a rubber as it is given has none.
    shown : float or None
        The temperature with which the page begins.
    others : list
        Rubber, road, path of the table of totals (CSV), and what its scenes are known by, of the other pairs of a
        comparison.
    """
    pairs = {f"{rubber} on {way}": read_pair(path, known) for rubber, way, path, known in others}
    table_of_all = read_table(table, WORDS)
    of_road = collection.read(whole[0], collected[1]) if whole else None
    gathered = collection.read(campaign, collected[0])
    payloads = {}
    for one in dict.fromkeys(temperatures):
        results = (
            result
            for path, digest, warm, number in zip(scenes, digests, temperatures, roads, strict=True)
            if warm == one
            for result in read(path, digest, number)
        )
        payloads[one] = payload(
            at_temperature(gathered, one),
            rows_at(table_of_all, one),
            results,
            aspect,
            road,
            None if of_road is None else at_temperature(of_road, one),
            1.0 / len(set(temperatures)),
            {name: rows_at(pair, one) for name, pair in pairs.items()},
        )
    write_page(page(together(payloads, shown), "index.html"), output)


def read(path: str, digest: str, number: int) -> Iterator[xr.Dataset]:
    """Yield a result that was not refused; of several roads a refused one too, and on which of them it is."""
    check_seal(path)
    with netCDF4.Dataset(path) as stored:
        refused = REFUSAL in stored.ncattrs()
    if number:
        yield dataset.read(path, digest, refusals=True).assign_attrs({NUMBER: number})
    elif not refused:
        yield dataset.read(path, digest)
