"""Readings of the paper out of a config."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from rubfric.config.readings import Reading, read_claims

import rubfric
from rubfric.errors import InvalidInput

CONFIG = Path(rubfric.__file__).resolve().parents[1] / "config" / "config.yaml"
ENTRY = {"difference": 0.05, "preset": "draft", "compare": ["strain"], "readings": {"strain": {"plane": "strain"}}}


def test_readings_are_read() -> None:
    choice = read_claims(ENTRY, ("draft",))
    assert choice.readings == {"strain": Reading(plane="strain")}
    assert choice.compare == ("strain",)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"difference": 0}, "claims.difference is 0, but must be at least 0.001"),
        ({"difference": 0.6}, "claims.difference is 0.6, but must be at most 0.5"),
        ({"preset": "rough"}, "claims.preset is 'rough'"),
        ({"readings": []}, r"claims.readings is \[\], but must hold readings by name, or {} for none"),
        ({"readings": {"campaign": {}}}, "stands for the campaign itself"),
        ({"readings": {"a b": {}}}, "name in claims.readings is 'a b'"),
        ({"readings": {"x": {"plane": "flat"}}}, "claims.readings.x.plane is 'flat'"),
        ({"readings": {"x": {"pressure": 1}}}, "claims.readings.x has the unknown key 'pressure'"),
        ({"compare": "strain"}, "claims.compare is 'strain', but must be a list of names"),
        ({"compare": ["stress"]}, "claims.compare is 'stress'"),
    ],
)
def test_bad_readings_are_refused(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        read_claims(ENTRY | change, ("draft",))


def test_reading_changes_what_it_names_and_nothing_else() -> None:
    campaign = rubfric.load(CONFIG)
    strain = campaign.reading("plane_strain")
    assert strain.plane == "strain"
    assert replace(strain, plane=campaign.plane, numerics=campaign.numerics) == campaign
    assert strain.numerics == campaign.presets["draft"]


def test_reading_of_the_moduli_makes_another_rubber() -> None:
    campaign = rubfric.load(CONFIG)
    other = campaign.reading("instantaneous_moduli").material
    assert other == replace(campaign.material, moduli="instantaneous")
    assert other.instantaneous_shear_modulus == pytest.approx(campaign.material.long_term_shear_modulus)
    assert Reading().rubber(campaign.material) == campaign.material


def test_unknown_reading_is_refused() -> None:
    with pytest.raises(InvalidInput, match="reading is 'strian'"):
        rubfric.load(CONFIG).reading("strian")
