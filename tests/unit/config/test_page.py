"""What is exported from the models: the JSON schema and the page, as they are in the project."""

from __future__ import annotations

import re
from typing import Any

import jsonschema
import pytest
import yaml
from bad_configs import BAD_CONFIGS, Bad, case_name, changed

from rubfric.config.overlay import overlaid
from rubfric.config.page import CONFIG, PAGE, SCHEMA, main, page, schema

DEFAULTS: dict[str, Any] = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(schema())
ROWS = [line.strip("| ").split(" | ") for line in page(DEFAULTS).splitlines() if line.startswith("| `")]


def test_schema_and_page_are_those_of_the_models(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    monkeypatch.setattr("rubfric.config.page.PAGE", tmp_path / PAGE.name)
    monkeypatch.setattr("rubfric.config.page.SCHEMA", tmp_path / SCHEMA.name)
    main()
    for path in (PAGE, SCHEMA):
        assert (tmp_path / path.name).read_text(encoding="utf-8") == path.read_text(encoding="utf-8"), "make docs"


def test_schema_is_valid_and_closed_and_admits_the_shipped_configs() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())
    objects = [node for node in (schema(), *schema()["$defs"].values()) if node["type"] == "object"]
    assert len(objects) == 22
    assert all(node["additionalProperties"] is False for node in objects)
    VALIDATOR.validate(DEFAULTS)
    VALIDATOR.validate(overlaid([CONFIG, CONFIG.with_name("minimal.yaml")], ()))


@pytest.mark.parametrize("case", [case for case in BAD_CONFIGS if case.schema], ids=case_name)
def test_schema_refuses_a_bad_config(case: Bad) -> None:
    with pytest.raises(jsonschema.ValidationError):
        VALIDATOR.validate(changed(DEFAULTS, case.at, case.value))


def test_every_key_of_the_config_is_on_the_page_in_its_order() -> None:
    def order(tree: Any, at: str = "") -> list[str]:
        if not isinstance(tree, dict):
            return [at.rstrip(".")]
        return [name for key, value in tree.items() for name in order(value, f"{at}{key}.")]

    on_page = [name.strip("`") for name, *_ in ROWS]
    named = [name for name in order(DEFAULTS) if name.split(".")[0] not in ("presets", "rubbers", "roads")]
    named = [name for name in named if not name.startswith("claims.readings")]
    assert [name for name in on_page if name in named] == named
    assert len(on_page) > 60


@pytest.mark.parametrize("row", ROWS, ids=[row[0] for row in ROWS])
def test_every_key_has_a_meaning_and_every_quantity_a_unit(row: list[str]) -> None:
    _, meaning, unit, allowed, _ = row
    assert re.fullmatch(r"[A-Z].{8,}\.", meaning)
    assert (unit != "–") == (allowed.startswith("number") or "each a number" in allowed)


@pytest.mark.parametrize(
    "row",
    [
        "| `grid.pressures` | Nominal pressures on the top of the block. | MPa | list, at least 1, no two alike; each "
        "a number from 1.0e-30 to 1.0e+30 | 0.1, 0.2, 0.5, 1, 2, 5 |",
        "| `rubbers.*.poissons_ratio` | Poisson's ratio that goes with Young's modulus. | dimensionless | number "
        "between -1 and 0.5, both excluded | zhou2019: `0.49` |",
        "| `roads.*[].amplitude` | Peak-to-mean height a; zero is a flat road. | mm | number from 0 to 1.0e+30 | "
        "zhou2019: 0.015, 0.006, 0.003, 0.002 |",
        "| `rig.virtual.seed` | Seed of the noise. | – | whole number from 0 to 2147483648; may be left out, for "
        "`2019` | `2019` |",
    ],
)
def test_some_rows(row: str) -> None:
    assert row in page(DEFAULTS).splitlines()


def test_what_may_be_left_out_is_said() -> None:
    cells = {row[0].strip("`"): row for row in ROWS}
    assert cells["numerics.accuracy"][3:] == ["number from 1.0e-6 to 0.5; may be left out", "the preset's"]
    assert cells["rubbers.*.density"][3].endswith("; may be left out, for `1.1e-9`")
    assert cells["rig.speeds"][3].endswith("; may be left out, for some of the grid's")
    assert cells["rig.data"][3].endswith("; may be left out, for none")
    assert cells["roads.*[].phase"][3].endswith("; may be left out, for `0`")


def test_numbers_can_be_copied_into_yaml() -> None:
    numbers = re.findall(r"(?<![\w.])\d[\d.]*e[-+]?\d+", page(DEFAULTS).partition("## ")[2])
    assert len(numbers) > 10
    assert all(isinstance(yaml.safe_load(number), float) for number in numbers)
