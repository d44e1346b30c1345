"""Write the table of all scales and of the whole road."""

import os
from typing import Any

from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.areal_table import plane_words
from rubfric.results.campaign import read
from rubfric.results.scales import RUBBER_PART, WAYS
from rubfric.results.tables import read_table, write_table
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad


def main(
    output: str,
    page: str,
    campaign: str,
    whole: list[str],
    collected: list[str],
    roads: dict[float | None, dict[str, Any]],
    title: str,
    areal: dict[str, str],
) -> None:
    """Write the friction of each scale and of the whole road, by all ways.

    Parameters
    ----------
    output, page : str
        Paths of the table as CSV and as HTML.
    campaign : str
        Path of the collection of all scenes (netCDF).
    whole : list of str
        Path of the collection of the whole road's scenes (netCDF), or nothing.
    collected : list of str
        What these collections are known by.
    roads : dict
        The parameters of ``WholeRoad`` by temperature, degC; under None for a rubber as it is given.
    title : str
        Of the campaign.
    areal : dict of str
        Paths of the tables of areal roads, which say how far the plane model is off, by the names of the roads.
    """
    about = {one: WholeRoad.from_parameters(road) for one, road in roads.items()}
    table = total_tables(read(campaign, collected[0]), read(whole[0], collected[1]) if whole else None, about)
    first = next(iter(about.values()))
    aspect, windows = first.aspect, first.windows
    what = f"a block {first.height:g} mm high on the measured profile itself" if windows else "all scales at once"
    several = "windows of the measured road" if windows else "random phases, where they were drawn"
    law = "the choice of its finite-strain law"
    data = (
        f"and rubber, what the data of the measured rubber leave open. It does not cover {law}."
        if RUBBER_PART in table
        else f"it does not cover the data of the rubber or {law}."
    )
    write_table(table, output)
    words = (
        f"Friction of every scale and of the whole road, for blocks {aspect:g} times as high as the coarsest "
        f"wave is long. The total is that of the column way: direct is {what}, sum the paper's sum over "
        "the scales, corrected that sum times what coupling does in small strain, cascade a cascade of pressures from "
        "scale to scale, persson Persson's theory. Its error is absolute and the sum of its parts: numerics; coupling, "
        "by how much a model of the interaction of the scales may be off; road, the standard error of the mean over "
        f"{several}; {data} The spreadsheet has the errors of the other ways too."
    )
    for name, path in areal.items():
        off = plane_words(read_table(path, ["note"]))
        words += f" Nor does it cover that roads are no ridges: on the areal road {name} {off}." if off else ""
    shown = table.drop(columns=[f"friction_{way}_error" for way in WAYS]).dropna(axis=1, how="all")
    beside = {"csv": os.path.basename(output), "home": "../index.html"}
    write_page(table_page(shown, f"{title}: all scales", words, "pressure_MPa", **beside), page)
