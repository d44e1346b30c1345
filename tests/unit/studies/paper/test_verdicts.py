"""Verdicts on the paper's claims, and the page that tells them."""

from __future__ import annotations

import math

import pytest

from rubfric.config.models import AS_CONFIGURED
from rubfric.pages.claims import claims_page, claims_text
from rubfric.studies.paper.claims import CLAIMS, Evidence
from rubfric.studies.paper.verdicts import (
    EVERY,
    FAILS,
    HOLDS,
    IN_PART,
    UNDECIDED,
    claims_table,
    evidence_table,
    verdict,
)


def peak(value: float, pressure: float, claim: str = "C7", error: float = 0.01) -> Evidence:
    scale, part = (None, "the whole road peaks") if claim == "C7" else (2, "peaks over speed")
    return Evidence(claim, part, scale, pressure, None, value, error, 0.0, "above")


EVIDENCE = {
    AS_CONFIGURED: [
        *(peak(0.5, 5.0), peak(-0.2, 0.5)),
        *(peak(0.4, 5.0, "C6"), peak(-0.3, 0.5, "C6"), peak(0.001, 1.0, "C6")),
        Evidence("C2", "settles", 1, 1.0, 10.0, 0.02, math.nan, 0.05, "below"),
        Evidence("C5", "saturates", 1, 0.5, 1000.0, 0.03, math.inf, 0.01, "below"),
    ],
    "other_plane": [peak(-0.5, 5.0)],
}
ABOUT = {AS_CONFIGURED: "Rubber <a&b>.", "other_plane": "Plane strain."}
NOTES = {"other_plane": {"C7": "2 of 9 scenes were refused."}}


@pytest.mark.parametrize(
    ("outcomes", "expected"),
    [
        ([], UNDECIDED),
        (["open"], UNDECIDED),
        (["yes", "yes"], HOLDS),
        (["yes", "yes", "open"], HOLDS),
        (["yes", "open"], IN_PART),
        (["yes", "yes", "no"], IN_PART),
        (["no", "open"], FAILS),
    ],
)
def test_verdict(outcomes: list[str], expected: str) -> None:
    assert verdict(outcomes) == expected


def test_every_claim_has_a_verdict_and_its_pressures_theirs() -> None:
    claims = claims_table(EVIDENCE, 5.0, NOTES)
    own = claims[claims["reading"] == AS_CONFIGURED].set_index(["claim", "pressure_MPa"])["verdict"]
    assert set(own.index.get_level_values("claim")) == set(CLAIMS)
    assert own["C6", EVERY] == IN_PART
    assert own["C6", 5.0] == HOLDS
    assert own["C6", 0.5] == FAILS
    assert own["C6", 1.0] == UNDECIDED
    assert own["C1", EVERY] == own["C5", EVERY] == UNDECIDED


def test_total_is_judged_at_the_pressure_of_the_claim() -> None:
    claims = claims_table(EVIDENCE, 5.0, NOTES).set_index(["claim", "reading", "pressure_MPa"])["verdict"]
    assert claims["C7", AS_CONFIGURED, EVERY] == HOLDS
    assert claims["C7", AS_CONFIGURED, 0.5] == FAILS
    assert claims["C7", "other_plane", EVERY] == FAILS


def test_deciding_number_is_the_farthest_on_the_wrong_side() -> None:
    claims = claims_table(EVIDENCE, 5.0, NOTES)
    row = claims[(claims["claim"] == "C6") & (claims["pressure_MPa"] == EVERY)].iloc[0]
    assert (row["value"], row["error"], row["limit"], row["where"]) == (-0.3, 0.01, "above 0", "scale 2, 0.5 MPa")
    assert row["parts"] == "peaks over speed: 1 of 2 (1 more undecided)"


def test_where_nothing_contradicts_the_undecided_number_is_told() -> None:
    yes, open_ = peak(0.5, 5.0, "C6"), peak(0.001, 1.0, "C6")
    varies = Evidence("C6", "varies with pressure", 1, None, 10.0, 0.9, 0.01, 0.05, "above")
    row = claims_table({AS_CONFIGURED: [yes, open_]}, 5.0, {}).set_index(["claim", "pressure_MPa"]).loc["C6", EVERY]
    assert (row["verdict"], row["value"]) == (IN_PART, 0.001)
    claims = claims_table({AS_CONFIGURED: [yes, yes, open_, varies]}, 5.0, {})
    row = claims.set_index(["claim", "pressure_MPa"]).loc["C6", EVERY]
    assert (row["verdict"], row["value"]) == (HOLDS, 0.5)


def test_verdict_on_a_virtual_rig_says_that_it_is_simulated() -> None:
    rises, falls = (
        Evidence("C8", part, None, 5.0, 100.0, 0.5, 0.01, 0.0, "above", simulated=True) for part in CLAIMS["C8"].parts
    )
    claims = claims_table({AS_CONFIGURED: [rises, falls]}, 5.0, {})
    assert claims.set_index(["claim", "pressure_MPa"]).loc[("C8", EVERY), "verdict"] == "holds (simulated)"
    assert "● holds (simulated)" in claims_page(claims, evidence_table({AS_CONFIGURED: [rises, falls]}), ABOUT)


def test_claim_without_any_number_on_one_of_its_parts_holds_in_part() -> None:
    varies = Evidence("C6", "varies with pressure", 1, None, 10.0, 0.9, 0.01, 0.05, "above")
    for found, expected in (([varies], IN_PART), ([varies, peak(0.5, 5.0, "C6")], HOLDS)):
        claims = claims_table({AS_CONFIGURED: found}, 5.0, {}).set_index(["claim", "pressure_MPa"])
        assert claims.loc[("C6", EVERY), "verdict"] == expected


def test_evidence_names_its_quantity() -> None:
    table = evidence_table(EVIDENCE)
    assert len(table) == 8
    assert set(table["quantity"]) <= {words for claim in CLAIMS.values() for words in claim.parts.values()}


def test_page_tells_every_claim_verdict_and_reading() -> None:
    claims = claims_table(EVIDENCE, 5.0, NOTES)
    page = claims_page(claims, evidence_table(EVIDENCE), ABOUT)
    for name, claim in CLAIMS.items():
        assert f"<b>{name}</b></a> {claim.says}" in page
    assert "Rubber &lt;a&amp;b&gt;." in page
    assert "−30.0 ± 1.0 % (has to be above 0 %), scale 2, 0.5 MPa" in page
    assert "2 of 9 scenes were refused." in page
    assert "not estimated" in page
    assert "src=" not in page
    assert "nan" not in page


def test_page_without_other_readings_does_not_speak_of_them() -> None:
    alone = {AS_CONFIGURED: EVIDENCE[AS_CONFIGURED]}
    page = claims_page(claims_table(alone, 5.0, {}), evidence_table(alone), ABOUT)
    assert "other readings" not in page
    assert "not run" not in page


def test_table_for_the_readme_has_a_line_for_each_claim() -> None:
    lines = claims_text(claims_table(EVIDENCE, 5.0, NOTES)).splitlines()
    assert lines[0] == "| the paper's claim | decided by | here | other plane |"
    assert len(lines) == 2 + len(CLAIMS)
    assert lines[8].endswith(f"| **{HOLDS}** | {FAILS} |")
