"""Which claims of the paper are reproduced: verdicts of the default campaign, and the same in docs/claims.md."""

from __future__ import annotations

import re

import pandas as pd
import pytest
from project_copy import SOURCE, Project

VERDICTS = {
    "C1": "holds in part",
    "C2": "holds in part",
    "C3": "holds",
    "C4": "holds",
    "C5": "holds in part",
    "C6": "holds",
    "C7": "holds",
    "C8": "holds (simulated)",
    "C9": "holds in part",  # where sum and whole road cross, at 1000 mm/s and 0.5 MPa
}


@pytest.fixture(scope="module")
def claims(paper: Project) -> pd.DataFrame:
    return pd.read_csv(paper.results / "tables" / "claims.csv")


@pytest.fixture(scope="module")
def evidence(paper: Project) -> pd.DataFrame:
    return pd.read_csv(paper.results / "tables" / "claims_evidence.csv")


@pytest.fixture(scope="module")
def verdicts(claims: pd.DataFrame) -> pd.Series:
    return claims[claims["pressure_MPa"] == "all"].set_index(["claim", "reading"])["verdict"]


@pytest.mark.parametrize(("claim", "verdict"), VERDICTS.items())
def test_verdict_on_the_paper(verdicts: pd.Series, claim: str, verdict: str) -> None:
    assert verdicts[claim, "campaign"] == verdict


def test_readings_move_the_verdicts(verdicts: pd.Series) -> None:
    own = verdicts.xs("campaign", level="reading")
    strain = verdicts.xs("plane_strain", level="reading")
    # In plane strain sum and whole road are equal nowhere that both were simulated.
    assert strain["C9"] == "does not hold"
    assert (strain == own[strain.index]).drop("C9").all()
    assert verdicts["C7", "instantaneous_moduli"] == "does not hold"


def test_ratios_differ_above_the_peak_but_not_from_three_quarters_up(evidence: pd.DataFrame) -> None:
    own = evidence[evidence["reading"] == "campaign"]
    above = own[own["part"] == "hardly differs above the peak"]
    assert set(above["outcome"]) == {"no"}
    assert above["value"].max() > 0.8
    assert own.loc[own["claim"] == "C3", "value"].max() < 0.05


def test_every_decided_number_is_beyond_its_error(evidence: pd.DataFrame) -> None:
    decided = evidence[evidence["outcome"] != "open"]
    distance = (decided["value"] - decided["limit"]).abs()
    assert (distance >= decided["error"].fillna(0.0) * (1.0 - 1e-5)).all()


def test_page_has_the_same_verdicts(verdicts: pd.Series) -> None:
    text = (SOURCE / "docs" / "claims.md").read_text(encoding="utf-8")
    table = text.partition("<!-- claims -->\n")[2].partition("<!-- /claims -->")[0].splitlines()
    heads = [name.strip().replace(" ", "_") for name in table[0].strip("|").split("|")][2:]
    readings = ["campaign", *heads[1:]]
    for line in table[2:]:
        cells = [cell.strip(" *") for cell in line.strip("|").split("|")]
        claim = re.match(r"C\d", cells[0])
        assert claim
        page = dict(zip(readings, cells[2:], strict=True))
        assert page == {reading: verdicts.get((claim[0], reading), "") for reading in readings}
