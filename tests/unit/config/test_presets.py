"""Presets of accuracy and first mesh: each is checked, one is chosen, and any of its keys may be laid over it."""

from __future__ import annotations

import copy
import re
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest
import yaml
from rubfric.config.presets import PRESET_KEYS, fineness, read_numerics

from rubfric.errors import InvalidInput
from rubfric.scene.numerics import Numerics

CONFIG = yaml.safe_load((Path(__file__).resolve().parents[3] / "config" / "config.yaml").read_text(encoding="utf-8"))
NUMERICS: dict[str, Any] = CONFIG["numerics"]
PRESETS: dict[str, Any] = CONFIG["presets"]
NAMES = pytest.mark.parametrize("name", PRESETS)


def without(entry: dict[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in entry.items() if name != key}


def with_preset(name: str, **changes: Any) -> dict[str, Any]:
    """Return the presets of the config, one of them changed."""
    return PRESETS | {name: PRESETS[name] | changes}


def chosen(entry: Any, presets: Any) -> Numerics:
    """Return the preset in use."""
    return read_numerics(entry, presets)[0]


@NAMES
def test_every_preset_of_the_config_may_be_chosen(name: str) -> None:
    numerics = chosen(NUMERICS | {"preset": name}, PRESETS)
    assert {key: getattr(numerics, key) for key in PRESET_KEYS} == PRESETS[name]
    kept = {key: value for key, value in asdict(numerics).items() if key not in PRESET_KEYS}
    assert kept == without(NUMERICS, "preset")


def test_every_preset_is_read() -> None:
    bound = NUMERICS | {"columns_max": 128}
    every = read_numerics(bound, PRESETS)[1]
    assert list(every) == list(PRESETS)
    for name, numerics in every.items():
        assert {key: getattr(numerics, key) for key in PRESET_KEYS} == PRESETS[name]
        assert numerics.columns_max == max(128, numerics.columns_min, numerics.finite_columns_min)


@pytest.mark.parametrize("value", [0.25, 0.5, 1.0, 2.0])
def test_fineness_scales_the_first_mesh(value: float) -> None:
    first, whole = fineness(value), fineness(1.0)
    assert set(first) | {"accuracy"} == set(PRESET_KEYS)
    for key in set(first) - {"row_growth"}:
        assert first[key] == pytest.approx(value * whole[key])
    assert first["row_growth"] - 1.0 == pytest.approx((whole["row_growth"] - 1.0) / value, rel=1e-2)


def test_config_has_what_the_code_has_by_default() -> None:
    assert chosen(NUMERICS, PRESETS) == Numerics()


def test_presets_of_the_config_go_from_loose_to_tight() -> None:
    draft, standard, reference = (chosen(NUMERICS | {"preset": name}, PRESETS) for name in PRESETS)
    for loose, tight in ((draft, standard), (standard, reference)):
        assert loose.accuracy > tight.accuracy
        assert loose.row_growth >= tight.row_growth
        for key in ("contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min"):
            assert getattr(loose, key) <= getattr(tight, key)


@NAMES
@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("accuracy", 0.003),
        ("contact_nodes", 99),
        ("finite_contact_nodes", 77),
        ("columns_min", 320),
        ("finite_columns_min", 168),
        ("row_growth", 1.234),
    ],
)
def test_one_key_may_be_laid_over_a_preset(name: str, key: str, value: float) -> None:
    plain = chosen(NUMERICS | {"preset": name}, PRESETS)
    laid = chosen(NUMERICS | {"preset": name, key: value}, PRESETS)
    assert laid == replace(plain, **{key: value}) != plain


def test_presets_of_ones_own_may_be_chosen() -> None:
    mine = {"mine": PRESETS["standard"] | {"accuracy": 0.03}}
    assert chosen(NUMERICS | {"preset": "mine"}, mine) == Numerics(accuracy=0.03)


def test_reading_leaves_its_arguments_alone() -> None:
    numerics, presets = copy.deepcopy(NUMERICS), copy.deepcopy(PRESETS)
    chosen(NUMERICS, PRESETS)
    assert (numerics, presets) == (NUMERICS, PRESETS)


def test_unknown_preset_is_refused_with_a_suggestion() -> None:
    says = (
        r"^numerics\.preset is 'standart', but must be one of draft, standard, reference \(did you mean standard\?\)$"
    )
    with pytest.raises(InvalidInput, match=says):
        chosen(NUMERICS | {"preset": "standart"}, PRESETS)


@NAMES
@pytest.mark.parametrize(
    ("key", "value", "says"),
    [
        ("accuracy", 0.6, "is 0.6, but must be at most 0.5"),
        ("accuracy", "1e-3", "is the text '1e-3', but must be a number (YAML reads it as text; write 1.0e-3)"),
        ("contact_nodes", 3, "is 3, but must be a whole number of at least 4"),
        ("finite_contact_nodes", 5000, "is 5000, but must be at most 4096"),
        ("columns_min", 100, "is 100, but must be a multiple of 8"),
        ("finite_columns_min", 0, "is 0, but must be a whole number of at least 1"),
        ("row_growth", 1.0, "is 1, but must be at least 1.00001"),
    ],
)
def test_wrong_value_is_refused_by_the_name_of_its_preset(name: str, key: str, value: Any, says: str) -> None:
    # Whichever preset is chosen.
    with pytest.raises(InvalidInput, match=f"^{re.escape(f'presets.{name}.{key} {says}')}$"):
        chosen(NUMERICS, with_preset(name, **{key: value}))


@NAMES
def test_wrong_key_is_refused_by_the_name_of_its_preset(name: str) -> None:
    says = rf"^presets\.{name} has the unknown key 'acuracy'; allowed are .* \(did you mean accuracy\?\)$"
    with pytest.raises(InvalidInput, match=says):
        chosen(NUMERICS, with_preset(name, acuracy=0.1))


@NAMES
@pytest.mark.parametrize("key", PRESET_KEYS)
def test_preset_lacks_no_key(name: str, key: str) -> None:
    presets = PRESETS | {name: without(PRESETS[name], key)}
    with pytest.raises(InvalidInput, match=rf"^presets\.{name} lacks the key '{key}'$"):
        chosen(NUMERICS | {key: PRESETS[name][key]}, presets)


@pytest.mark.parametrize("key", NUMERICS)
def test_numerics_lack_no_key(key: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^numerics lacks the key '{key}'$"):
        chosen(without(NUMERICS, key), PRESETS)


@pytest.mark.parametrize(
    ("key", "value", "says"),
    [
        ("accuracy", 0.0, "numerics.accuracy is 0, but must be at least 1e-06"),
        ("tolerance", 1.0, "numerics.tolerance is 1, but must be at most 0.01"),
        ("refinements", -1, "numerics.refinements is -1, but must be a whole number of at least 0"),
        ("dilatation", "mena", "numerics.dilatation is 'mena', but must be one of auto, pointwise, mean"),
        ("columns_max", 8, "numerics.columns_max is 8, but must be at least "),
    ],
)
def test_wrong_value_of_numerics_is_refused_by_its_own_name(key: str, value: Any, says: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(says)}"):
        chosen(NUMERICS | {key: value}, PRESETS)


def test_bound_on_columns_concerns_the_chosen_preset_only() -> None:
    bound = NUMERICS | {"columns_max": 128}
    assert chosen(bound, PRESETS) == Numerics(columns_max=128)
    fine = with_preset("reference", columns_min=176)
    assert chosen(bound, fine) == Numerics(columns_max=128)
    with pytest.raises(InvalidInput, match=r"^numerics\.columns_max is 128, but must be at least 176$"):
        chosen(bound | {"preset": "reference"}, fine)
    tiny = bound | {"columns_min": 64, "finite_columns_min": 64, "columns_max": 64}
    assert chosen(tiny, PRESETS) == Numerics(columns_min=64, finite_columns_min=64, columns_max=64)


@pytest.mark.parametrize("presets", [None, {}, [], "standard"])
def test_presets_that_are_none_are_refused(presets: Any) -> None:
    with pytest.raises(InvalidInput, match=r"^presets is .*, but must hold at least one entry by name$"):
        chosen(NUMERICS, presets)


@pytest.mark.parametrize("value", [None, 0.01, []])
def test_preset_that_is_no_mapping_is_refused(value: Any) -> None:
    with pytest.raises(InvalidInput, match=r"^presets\.draft is .*, but must hold the keys accuracy, contact_nodes, "):
        chosen(NUMERICS, PRESETS | {"draft": value})


def test_name_of_a_preset_is_a_word() -> None:
    with pytest.raises(InvalidInput, match=r"^name in presets is 'a b', but must be a word of letters"):
        chosen(NUMERICS, PRESETS | {"a b": PRESETS["draft"]})
