"""Write the table of one scale."""

import os

from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.campaign import read
from rubfric.results.tables import scale_table, write_table


def main(output: str, page: str, campaign: str, collected: str, scale: int, title: str) -> None:
    """Write all scenes of one scale.

    Parameters
    ----------
    output, page : str
        Paths of the table as CSV and as HTML.
    campaign : str
        Path of the collection of all scenes (netCDF).
    collected : str
        What that is known by.
    scale : int
        The scale, 1 being the coarsest.
    title : str
        Of the campaign.
    """
    gathered = read(campaign, collected)
    table = scale_table(gathered, scale)
    write_table(table, output)
    amplitude, wavenumber = (float(gathered[name].sel(scale=scale)) for name in ("amplitude", "wavenumber"))
    words = (
        f"Every scene on the scale of {amplitude:g} mm amplitude and {wavenumber:g}/mm wavenumber, a row each. "
        "Friction by three routes, its estimated absolute error, contact and mesh; warnings is the number of warnings "
        "in the log of the scene. The largest contact pressure is given twice: vertical force per undeformed area, and "
        "normal force per deformed area."
    )
    beside = {"csv": os.path.basename(output), "home": "../index.html"}
    write_page(table_page(table, f"{title}: scale {scale}", words, "pressure_MPa", **beside), page)
