"""The pages of a made-up campaign: tables, claims and the page that joins them."""

from __future__ import annotations

import math
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from rubfric.config.models import AS_CONFIGURED
from rubfric.pages.claims import claims_page
from rubfric.pages.index import Linked, index_page
from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.tables import write_table
from rubfric.studies.paper.claims import Evidence
from rubfric.studies.paper.verdicts import claims_table, evidence_table

FIGURES = {"fig1": "friction over speed, by height-to-width ratio", "fig6": "friction over speed and pressure"}


def make_evidence() -> dict[str, list[Evidence]]:
    """Return numbers on three claims that support them, contradict them, or are open."""
    peaks = [
        Evidence("C6", "peaks over speed", scale, pressure, None, 0.4 * scale - pressure, 0.1, 0.0, "above")
        for scale in (1, 2, 3)
        for pressure in (0.1, 0.5, 1.0)
    ]
    others = [
        Evidence("C1", "hardly differs above the peak", 1, 5.0, 1e4, 0.88, 0.01, 0.05, "below"),
        Evidence("C5", "saturates", 1, 0.5, 1000.0, 0.03, math.inf, 0.01, "below"),
    ]
    return {AS_CONFIGURED: [*peaks, *others], "plane_strain": peaks[:2]}


def make_site(folder: Path, totals: pd.DataFrame) -> Path:
    """Write the pages of a campaign into a folder; return that of all results.

    Parameters
    ----------
    folder : Path
        Is made.
    totals : pandas.DataFrame
        As from ``synthetic_campaign.make_totals``.
    """
    tables = folder / "tables"
    write_table(totals, tables / "friction_total.csv")
    page = table_page(totals, "All scales", "Words.", "pressure_MPa", "friction_total.csv", "../index.html")
    write_page(page, tables / "friction_total.html")
    write_page("<!doctype html><h1>Explorer</h1>", folder / "explorer.html")
    (folder / "figures").mkdir()
    for name in FIGURES:
        for kind in ("png", "pdf"):
            Figure((6.0, 3.0), dpi=100).savefig(folder / "figures" / f"{name}.{kind}")
    claims, evidence = claims_table(make_evidence(), 5.0, {}), evidence_table(make_evidence())
    write_table(claims, tables / "claims.csv")
    write_table(evidence, tables / "claims_evidence.csv")
    about = {AS_CONFIGURED: "Rubber a on road b.", "plane_strain": "Plane strain."}
    write_page(claims_page(claims, evidence, about, FIGURES, "explorer.html", "index.html"), folder / "claims.html")
    groups = {
        "Answers": [Linked("the claims", {"page": str(folder / "claims.html"), "CSV": str(tables / "claims.csv")})],
        "Tables": [Linked("the <whole> road", {"page": str(tables / "friction_total.html")})],
        "Data": [],
    }
    text = index_page(folder, "Rubber a on road b", totals, ["rubber a_b"], ["claims: 9"], FIGURES, groups)
    write_page(text, folder / "index.html")
    return folder / "index.html"
