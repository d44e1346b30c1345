"""Judge the paper's claims by a campaign, its marches, other readings and the points of a test rig."""

from typing import Any

import pandas as pd

from rubfric.pages.claims import claims_page
from rubfric.pages.render import write_page
from rubfric.results.campaign import read
from rubfric.results.dataset import load
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table, write_table
from rubfric.results.whole_road import WholeRoad
from rubfric.studies.paper.judge import Criteria, judge
from rubfric.studies.paper.verdicts import EVERY


def main(
    outputs: dict[str, str],
    campaign: str,
    totals: str,
    profiles: list[str],
    marches: list[str],
    points: list[str],
    readings: dict[str, list[str]],
    roads: dict[str, dict[str, Any]],
    criteria: dict[str, Any],
    about: dict[str, str],
) -> None:
    """Write the verdicts, the evidence and the page.

    Parameters
    ----------
    outputs : dict
        Paths of ``claims`` and ``evidence`` (CSV) and of the ``page`` (HTML).
    campaign, totals, profiles, marches, points : str or list of str
        Paths of the collection of all scenes (netCDF), of the table of totals (CSV), of scenes and marches (netCDF),
        and of the table of the test rig (CSV), or nothing.
    readings : dict of str to list of str
        Paths of the observations (CSV) of each other reading.
    roads : dict
        The parameters of ``WholeRoad`` in each other reading.
    criteria : dict
        The parameters of ``Criteria``.
    about : dict of str to str
        Every reading in words.
    """
    claims, evidence = judge(
        read(campaign),
        read_table(totals, WORDS),
        map(load, profiles),
        map(load, marches),
        read_table(points[0], ("run", "kind", "source")) if points else None,
        {
            reading: pd.concat([read_table(path, ("note",)) for path in paths], ignore_index=True)
            for reading, paths in readings.items()
        },
        {reading: WholeRoad.from_parameters(road) for reading, road in roads.items()},
        Criteria(**criteria),
    )
    write_table(evidence, outputs["evidence"])
    write_table(claims, outputs["claims"])
    write_page(claims_page(claims, evidence, about), outputs["page"])
    print(claims[claims["pressure_MPa"] == EVERY][["claim", "reading", "verdict", "parts"]].to_string(index=False))
