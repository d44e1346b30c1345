"""Judge the paper's claims by a campaign, its marches, other readings and the points of a test rig."""

from typing import Any

import pandas as pd

from rubfric.checksums import AGAIN
from rubfric.errors import BrokenResult
from rubfric.pages.claims import claims_page
from rubfric.pages.render import write_page
from rubfric.results import dataset
from rubfric.results.campaign import read
from rubfric.results.provenance import OTHER_SCENE
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table, write_table
from rubfric.results.temperature import at_temperature, rows_at
from rubfric.results.whole_road import WholeRoad
from rubfric.studies.paper.judge import Criteria, judge
from rubfric.studies.paper.observation import WORDS as OBSERVED
from rubfric.studies.paper.verdicts import EVERY


def main(
    outputs: dict[str, str],
    campaign: str,
    totals: str,
    profiles: list[str],
    marches: list[str],
    points: list[str],
    readings: dict[str, list[str]],
    digests: dict[str, Any],
    roads: dict[str, dict[str, Any]],
    criteria: dict[str, Any],
    about: dict[str, str],
    figures: list[str],
    temperature: float | None,
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
    digests : dict
        What the ``campaign`` is known by, and the digests of the scenes of ``profiles`` and of ``marches``, in their
        order, and of all scenes of each of the ``readings``.
    roads : dict
        The parameters of ``WholeRoad`` in each other reading.
    criteria : dict
        The parameters of ``Criteria``.
    about : dict of str to str
        Every reading in words.
    figures : list of str
        Names of the campaign's figures.
    temperature : float or None
        At which the claims are judged, degC, where there are any.
    """
    claims, evidence = judge(
        at_temperature(read(campaign, digests["campaign"]), temperature),
        rows_at(read_table(totals, WORDS), temperature),
        *(map(dataset.read, paths, digests[name]) for name, paths in (("profiles", profiles), ("marches", marches))),
        read_table(points[0], ("run", "kind", "source")) if points else None,
        {
            reading: pd.concat([observations(path, digests["readings"][reading]) for path in paths], ignore_index=True)
            for reading, paths in readings.items()
        },
        {reading: WholeRoad.from_parameters(road) for reading, road in roads.items()},
        Criteria(**criteria),
    )
    write_table(evidence, outputs["evidence"])
    write_table(claims, outputs["claims"])
    write_page(claims_page(claims, evidence, about, figures, "explorer.html", "index.html"), outputs["page"])
    print(claims[claims["pressure_MPa"] == EVERY][["claim", "reading", "verdict", "parts"]].to_string(index=False))


def observations(path: str, digests: list[str]) -> pd.DataFrame:
    """Return the table of a batch of scenes; BrokenResult where one of them is not among those of its reading."""
    table = read_table(path, OBSERVED)
    if not set(table["scene_digest"]) <= set(digests):
        raise BrokenResult(f"{path} {OTHER_SCENE}; {AGAIN}")
    return table
