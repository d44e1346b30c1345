"""The paper's claims judged by a campaign, its marches, other readings of the paper and the points of a test rig."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.config.models import AS_CONFIGURED
from rubfric.results.scales import TOTAL
from rubfric.results.totals import total_table
from rubfric.results.whole_road import WholeRoad
from rubfric.studies.paper.claims import CLAIMS
from rubfric.studies.paper.evidence import depth_evidence, gather, march_evidence, march_note, rig_evidence, rig_note
from rubfric.studies.paper.observation import WHOLE, among, over_axes, profile_row, refusals, table
from rubfric.studies.paper.totals import reading_note, total_evidence, total_note
from rubfric.studies.paper.verdicts import claims_table, evidence_table


@dataclass(frozen=True)
class Criteria:
    """What the verdicts depend on besides results.

    Parameters
    ----------
    aspect : float
        Height over width of the blocks on the campaign's grid.
    studied : sequence of float
        Pressures of the study of the height-to-width ratio, MPa.
    profiled : mapping of str to sequence of float
        ``scale``, ``velocity`` (mm/s), ``pressure`` (MPa) and ``aspect`` of the scenes whose depth is looked at.
    difference : float
        Relative difference below which two frictions count as equal.
    saturation : float
        Relative tolerance of a march that counts as saturated.
    total_pressure : float
        Pressure at which the total over the scales is judged, MPa.
    """

    aspect: float
    studied: Iterable[float]
    profiled: Mapping[str, Iterable[float]]
    difference: float
    saturation: float
    total_pressure: float


def judge(
    campaign: xr.Dataset,
    totals: pd.DataFrame,
    profiles: Iterable[xr.Dataset],
    marches: Iterable[xr.Dataset],
    points: pd.DataFrame | None,
    readings: Mapping[str, pd.DataFrame],
    roads: Mapping[str, WholeRoad],
    criteria: Criteria,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the verdicts and the numbers that they rest on.

    Parameters
    ----------
    campaign : xarray.Dataset
        As from ``rubfric.results.campaign.collect``.
    totals : pandas.DataFrame
        Of the campaign, as from ``rubfric.results.totals.total_table``.
    profiles, marches : iterables of xarray.Dataset
        Results of the scenes whose depth is looked at, and of marches.
    points : pandas.DataFrame, optional
        Points of the test rig, where there is one.
    readings : mapping of str to pandas.DataFrame
        Observations in each other reading of the paper, a row per scene.
    roads : mapping of str to WholeRoad
        The whole road in each other reading.
    criteria : Criteria

    Returns
    -------
    claims, evidence : pandas.DataFrame
        As from ``claims_table`` and ``evidence_table`` of ``rubfric.studies.paper.verdicts``.
    """
    own = [
        *gather(campaign, criteria.aspect, criteria.studied, criteria.difference),
        *total_evidence(totals, campaign.sel(aspect=criteria.aspect), criteria.difference),
        *depth_evidence(table(map(profile_row, profiles)), criteria.difference),
        *(march_evidence(march, criteria.saturation) for march in marches),
        *(rig_evidence(points) if points is not None else ()),
    ]
    evidence = {AS_CONFIGURED: own}
    notes = {
        AS_CONFIGURED: {
            "C5": march_note(own),
            "C8": rig_note(points) if points is not None else "",
            "C9": total_note(totals),
        }
    }
    for reading, found in readings.items():
        rows, whole = found[found["scale"] != WHOLE], found[found["scale"] == WHOLE]
        observed = over_axes(rows)
        direct = over_axes(whole).reindex(velocity=observed["velocity"], pressure=observed["pressure"])
        sums = total_table(observed, direct if len(whole) else None, roads[reading])
        # C7 asks for every speed, of which only some are light enough.
        sums = sums.assign(**dict.fromkeys(TOTAL, np.nan))
        evidence[reading] = [
            *gather(observed, criteria.aspect, criteria.studied, criteria.difference),
            *total_evidence(sums, observed.sel(aspect=criteria.aspect), criteria.difference),
            *depth_evidence(rows[among(rows, criteria.profiled)], criteria.difference),
        ]
        notes[reading] = dict.fromkeys(CLAIMS, refusals(rows)) | {"C9": reading_note(sums, whole)}
    return claims_table(evidence, criteria.total_pressure, notes), evidence_table(evidence)
