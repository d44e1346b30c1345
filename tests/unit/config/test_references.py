"""Presets and readings: each is checked, one is chosen, and what is laid over it changes that and nothing else."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import pytest
import yaml
from bad_configs import DEFAULT, changed

from rubfric.config.campaign import Campaign
from rubfric.config.models import Reading
from rubfric.errors import InvalidInput
from rubfric.scene.numerics import PRESET_KEYS, Numerics, fineness

CONFIG: dict[str, Any] = yaml.safe_load(DEFAULT.read_text(encoding="utf-8"))
PRESETS: dict[str, Any] = CONFIG["presets"]
NAMES = pytest.mark.parametrize("name", PRESETS)


def chosen(**numerics: Any) -> Numerics:
    """Return the numerics of the config with some of its entries changed."""
    return Campaign.from_config(CONFIG | {"numerics": CONFIG["numerics"] | numerics}).numerics


def test_config_has_what_the_code_has_by_default() -> None:
    assert chosen() == Campaign.from_config(CONFIG).presets["standard"] == Numerics()


@NAMES
def test_every_preset_may_be_chosen_and_changed(name: str) -> None:
    plain = chosen(preset=name)
    assert {key: getattr(plain, key) for key in PRESET_KEYS} == PRESETS[name]
    assert {key: value for key, value in asdict(plain).items() if key not in PRESET_KEYS} == {
        key: value for key, value in CONFIG["numerics"].items() if key != "preset"
    }
    for key, value in dict(zip(PRESET_KEYS, (0.003, 99, 77, 320, 168, 1.234), strict=True)).items():
        assert chosen(preset=name, **{key: value}) == replace(plain, **{key: value}) != plain


def test_presets_go_from_loose_to_tight() -> None:
    draft, standard, reference = (chosen(preset=name) for name in PRESETS)
    for loose, tight in ((draft, standard), (standard, reference)):
        assert loose.accuracy > tight.accuracy
        assert loose.row_growth >= tight.row_growth
        for key in ("contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min"):
            assert getattr(loose, key) <= getattr(tight, key)


@pytest.mark.parametrize("value", [0.25, 0.5, 1.0, 2.0])
def test_fineness_scales_the_first_mesh(value: float) -> None:
    first, full = fineness(value), fineness(1.0)
    assert set(first) | {"accuracy"} == set(PRESET_KEYS)
    for key in set(first) - {"row_growth"}:
        assert first[key] == pytest.approx(value * full[key])
    assert first["row_growth"] - 1.0 == pytest.approx((full["row_growth"] - 1.0) / value, rel=1e-2)


@NAMES
def test_wrong_preset_is_refused_by_its_name_whichever_is_chosen(name: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^presets\.{name}\.accuracy is 0\.6, but must be at most 0\.5$"):
        Campaign.from_config(changed(CONFIG, f"presets.{name}.accuracy", 0.6))


def test_bound_on_columns_concerns_the_chosen_preset_only() -> None:
    assert chosen(columns_max=128) == Numerics(columns_max=128)
    fine = changed(CONFIG, "presets.reference.columns_min", 176)
    fine = changed(fine, "numerics.columns_max", 128)
    campaign = Campaign.from_config(fine)
    assert (campaign.numerics.columns_max, campaign.presets["reference"].columns_max) == (128, 176)
    with pytest.raises(InvalidInput, match=r"^numerics\.columns_max is 128, but must be .* at least 176$"):
        Campaign.from_config(changed(fine, "numerics.preset", "reference"))


def test_reading_changes_what_it_names_and_nothing_else() -> None:
    campaign = Campaign.from_config(CONFIG)
    strain, other = campaign.reading("plane_strain"), campaign.reading("instantaneous_moduli").material
    assert (strain.plane, strain.numerics) == ("strain", campaign.presets["draft"])
    assert replace(strain, plane=campaign.plane, numerics=campaign.numerics) == campaign
    assert other == replace(campaign.material, moduli="instantaneous")
    assert Reading().rubber(campaign.material) == campaign.material
    with pytest.raises(InvalidInput, match=r"^reading is 'strian', but must be one of plane_strain, "):
        campaign.reading("strian")
