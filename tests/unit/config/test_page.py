"""The page on the config: it is of the schema and the config as they are, whole, and can be copied from."""

from __future__ import annotations

import re
from typing import Any

import pytest
import yaml
from test_schema import SCHEMA, nodes

from rubfric.config.page import CONFIG, PAGE, Key, keys, main, page

DEFAULTS: dict[str, Any] = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
KEYS = {key.name: key for key in keys(SCHEMA, DEFAULTS)}


def test_page_is_of_the_schema_and_the_config_as_they_are() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(SCHEMA, DEFAULTS), "write it anew: make docs"


def test_page_is_written_anew(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    monkeypatch.setattr("rubfric.config.page.PAGE", tmp_path / "README.md")
    main()
    assert (tmp_path / "README.md").read_text(encoding="utf-8") == PAGE.read_text(encoding="utf-8")


def test_every_key_of_the_schema_is_on_the_page() -> None:
    leaves = {
        f"{at}.{name}".removeprefix("config.").replace("[]", "")
        for at, node in nodes(SCHEMA)
        for name, below in node.get("properties", {}).items()
        if not {"properties", "additionalProperties"} & below.keys()
    }
    assert leaves == {name.replace("[]", "") for name in KEYS}
    assert len(leaves) > 35


def test_keys_come_in_the_order_of_the_config() -> None:
    def order(tree: Any, at: str = "") -> list[str]:
        if not isinstance(tree, dict):
            return [at.rstrip(".")]
        return [name for key, value in tree.items() for name in order(value, f"{at}{key}.")]

    config = order(DEFAULTS)
    told = [name for name in KEYS if "*" not in name]
    assert [name for name in config if name in told] == [name for name in told if name in config]


@pytest.mark.parametrize("name", KEYS)
def test_key_is_told_whole(name: str) -> None:
    key = KEYS[name]
    assert re.fullmatch(r"[A-Z].{8,}\.", key.meaning)
    assert re.match(r"(whole )?number|list|word|text|`\w+` or ", key.allowed)
    if key.allowed.startswith("number") or "each a number" in key.allowed:
        assert key.unit != "–"
    assert key.row.count(" | ") == 4


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        (
            "grid.pressures",
            Key(
                "grid.pressures",
                "Nominal pressures on the top of the block.",
                "MPa",
                "list, at least 1, no two alike; each a number from 1.0e-30 to 1.0e+30",
                "0.1, 0.2, 0.5, 1, 2, 5",
            ),
        ),
        (
            "rubbers.*.poissons_ratio",
            Key(
                "rubbers.*.poissons_ratio",
                "Poisson's ratio that goes with Young's modulus.",
                "dimensionless",
                "number between -1 and 0.5, both excluded",
                "zhou2019: `0.49`",
            ),
        ),
        (
            "roads.*[].amplitude",
            Key(
                "roads.*[].amplitude",
                "Peak-to-mean height; zero is a flat road.",
                "mm",
                "number from 0 to 1.0e+30",
                "zhou2019: 0.015, 0.006, 0.003, 0.002",
            ),
        ),
    ],
)
def test_some_keys(name: str, expected: Key) -> None:
    assert KEYS[name] == expected


def test_what_the_preset_gives_is_said() -> None:
    assert KEYS["numerics.accuracy"].default == "the preset's"
    assert KEYS["numerics.accuracy"].allowed.endswith("; may be left out")
    assert KEYS["presets.*.accuracy"].default == "draft: `0.05`; standard: `0.01`; reference: `0.002`"


def test_numbers_can_be_copied_into_yaml() -> None:
    numbers = re.findall(r"(?<![\w.])\d[\d.]*e[-+]?\d+", page(SCHEMA, DEFAULTS).partition("## ")[2])
    assert len(numbers) > 10
    assert all(isinstance(yaml.safe_load(number), float) for number in numbers)
