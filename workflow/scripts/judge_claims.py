"""Judge the paper's claims by a campaign, its marches, other readings and the points of a test rig."""

from typing import Any

import pandas as pd

from rubfric.config.readings import AS_CONFIGURED
from rubfric.pages.claims import claims_page
from rubfric.pages.table import write_page
from rubfric.results.campaign import read
from rubfric.results.dataset import load
from rubfric.results.tables import read_table, write_table
from rubfric.studies.paper.claims import CLAIMS
from rubfric.studies.paper.evidence import (
    depth_evidence,
    gather,
    march_evidence,
    march_note,
    rig_evidence,
    rig_note,
)
from rubfric.studies.paper.observation import among, over_axes, profile_row, refusals, table
from rubfric.studies.paper.verdicts import EVERY, claims_table, evidence_table


def main(
    outputs: dict[str, str],
    campaign: str,
    profiles: list[str],
    marches: list[str],
    points: str,
    readings: dict[str, list[str]],
    choice: dict[str, Any],
    about: dict[str, str],
) -> None:
    """Write the verdicts, the evidence and the page.

    Parameters
    ----------
    outputs : dict
        Paths of ``claims`` and ``evidence`` (CSV) and of the ``page`` (HTML).
    campaign, profiles, marches : str and lists of str
        The collection of all scenes, results of those whose depth is looked at, and marches.
    points : str
        Table of the points of the test rig.
    readings : dict of str to list of str
        Observations of each other reading.
    choice : dict
        ``aspect``, ``studied``, ``profiled``, ``difference``, ``saturation``, ``total_pressure``.
    about : dict of str to str
        Every reading in words.
    """
    difference, profiled = choice["difference"], choice["profiled"]
    common = {name: choice[name] for name in ("aspect", "studied", "difference")}
    rig = read_table(points, ("run", "kind", "source"))
    evidence = {
        AS_CONFIGURED: [
            *gather(read(campaign), **common),
            *depth_evidence(table(profile_row(load(path)) for path in profiles), difference),
            *(march_evidence(load(path), choice["saturation"]) for path in marches),
            *rig_evidence(rig),
        ]
    }
    notes = {AS_CONFIGURED: {"C5": march_note(evidence[AS_CONFIGURED]), "C8": rig_note(rig)}}
    for reading, paths in readings.items():
        rows = pd.concat([read_table(path, ("note",)) for path in paths], ignore_index=True)
        evidence[reading] = [
            *gather(over_axes(rows), **common),
            *depth_evidence(rows[among(rows, profiled)], difference),
        ]
        notes[reading] = dict.fromkeys(CLAIMS, refusals(rows))
    claims = claims_table(evidence, choice["total_pressure"], notes)
    numbers = evidence_table(evidence)
    write_table(numbers, outputs["evidence"])
    write_table(claims, outputs["claims"])
    write_page(claims_page(claims, numbers, about), outputs["page"])
    print(claims[claims["pressure_MPa"] == EVERY][["claim", "reading", "verdict", "parts"]].to_string(index=False))
