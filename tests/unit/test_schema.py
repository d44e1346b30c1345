"""The schema of the config: closed, described, and of one mind with the code that reads the config."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from dataclasses import MISSING as NO_DEFAULT
from dataclasses import fields
from typing import Any

import jsonschema
import pytest
import yaml
from rubfric.config.choices import AspectStudy
from rubfric.config.presets import PRESET_KEYS
from rubfric.config.readings import Reading
from test_campaign import BAD_CONFIGS, DEFAULT, MINIMAL, MISSING, ROOT, Bad, Config, case_name, changed

from rubfric.config.campaign import Campaign
from rubfric.config.models import TRACTIONS, RigChoice, VirtualRig
from rubfric.errors import InvalidInput
from rubfric.rubber.material import BULK, MODULI, PLANES, Material
from rubfric.scene.numerics import DILATATIONS, Numerics
from rubfric.scene.scene import KINEMATICS

SCHEMA: dict[str, Any] = yaml.safe_load((ROOT / "workflow" / "schemas" / "config.schema.yaml").read_text())
UNITS = re.compile(r"(?<![\w/])(mm/s|MPa|1/mm|t/mm³|mm²|mm|kg|Hz|N|s)(?![\w/'])|\bdimensionless\b")
# Each mapping of the config, and where the schema describes it.
MAPPINGS = {
    "": "",
    "grid": "properties.grid",
    "aspect_study": "properties.aspect_study",
    "figures": "properties.figures",
    "figures.fields": "properties.figures.properties.fields",
    "claims": "properties.claims",
    "claims.readings.plane_strain": "properties.claims.properties.readings.additionalProperties",
    "rig": "properties.rig",
    "rig.virtual": "properties.rig.properties.virtual",
    "numerics": "properties.numerics",
    "presets.draft": "properties.presets.additionalProperties",
    "rubbers.zhou2019": "properties.rubbers.additionalProperties",
    "roads.zhou2019.0": "properties.roads.additionalProperties.items",
}


def entry(tree: Any, at: str) -> Any:
    for key in filter(None, at.split(".")):
        tree = tree[int(key) if key.isdigit() else key]
    return tree


def resolved(node: dict[str, Any]) -> dict[str, Any]:
    """Return a node with what its reference points at."""
    if "$ref" not in node:
        return node
    return SCHEMA["$defs"][node["$ref"].rpartition("/")[2]] | node


def nodes(node: Any, at: str = "config") -> Iterator[tuple[str, dict[str, Any]]]:
    """Walk over the schema's nodes: the root, all properties, free names and items."""
    yield at, node
    for name, below in node.get("properties", {}).items():
        yield from nodes(below, f"{at}.{name}")
    if isinstance(node.get("additionalProperties"), dict):
        yield from nodes(node["additionalProperties"], f"{at}.*")
    if "items" in node:
        yield from nodes(node["items"], f"{at}[]")


def properties() -> dict[str, dict[str, Any]]:
    return {f"{at}.{name}": below for at, node in nodes(SCHEMA) for name, below in node.get("properties", {}).items()}


def kind(node: dict[str, Any]) -> str:
    """Return the type of a node, or that of its items."""
    whole = resolved(node)
    return kind(whole["items"]) if whole.get("type") == "array" else str(whole.get("type"))


@pytest.fixture
def config() -> Config:
    return yaml.safe_load(DEFAULT.read_text())


def validate(config: Any) -> None:
    jsonschema.Draft202012Validator(SCHEMA).validate(config)


def test_schema_is_valid() -> None:
    assert SCHEMA["$schema"] == jsonschema.Draft202012Validator.META_SCHEMA["$id"]
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_every_object_is_closed_or_describes_its_entries() -> None:
    objects = {at: node for at, node in nodes(SCHEMA) if node.get("type") == "object"}
    assert len(objects) == 18
    assert all("additionalProperties" in node for node in objects.values())
    assert all(node["additionalProperties"] is False for node in objects.values() if "properties" in node)
    assert all(isinstance(node["additionalProperties"], dict) for node in objects.values() if "properties" not in node)


@pytest.mark.parametrize("at", properties())
def test_every_key_is_described(at: str) -> None:
    assert re.match(r"[A-Z].{10,}\.$", properties()[at].get("description", ""), re.DOTALL)


@pytest.mark.parametrize("at", [at for at, node in properties().items() if kind(node) == "number"])
def test_every_quantity_names_its_unit(at: str) -> None:
    assert UNITS.search(properties()[at]["description"])


def test_schema_has_no_defaults() -> None:
    assert not [at for at, node in nodes(SCHEMA) if "default" in node]


@pytest.mark.parametrize(("at", "described"), MAPPINGS.items())
def test_schema_and_reader_allow_the_same_keys(config: Config, at: str, described: str) -> None:
    with pytest.raises(InvalidInput, match=r"unknown key 'qqq'; allowed are ") as caught:
        Campaign.from_config(changed(config, f"{at}.qqq".lstrip("."), 1))
    allowed = str(caught.value).partition("allowed are ")[2].split(", ")
    assert allowed == list(entry(SCHEMA, described)["properties"])


@pytest.mark.parametrize(("at", "described"), MAPPINGS.items())
def test_schema_and_reader_require_the_same_keys(config: Config, at: str, described: str) -> None:
    node = entry(SCHEMA, described)
    for key in node["properties"]:
        without = copy.deepcopy(config)
        entry(without, at).pop(key, None)  # a preset's key may be missing already
        if key in node.get("required", ()):
            with pytest.raises(InvalidInput, match=f"lacks the key '{key}'$"):
                Campaign.from_config(without)
        else:
            Campaign.from_config(without)


def test_keys_are_those_of_the_classes() -> None:
    def names(data: type) -> list[str]:
        return [field.name for field in fields(data)]  # type: ignore[arg-type]

    rubber = entry(SCHEMA, MAPPINGS["rubbers.zhou2019"])
    numerics, preset = (entry(SCHEMA, MAPPINGS[at]) for at in ("numerics", "presets.draft"))
    assert tuple(preset["properties"]) == tuple(preset["required"]) == PRESET_KEYS
    assert sorted(numerics["properties"]) == sorted(["preset", *names(Numerics)])
    assert sorted(numerics["required"]) == sorted({"preset", *names(Numerics)} - set(PRESET_KEYS))
    assert {key: numerics["properties"][key] for key in PRESET_KEYS} == preset["properties"]
    assert list(entry(SCHEMA, MAPPINGS["aspect_study"])["properties"]) == names(AspectStudy)
    for at, data in (("rig", RigChoice), ("rig.virtual", VirtualRig)):
        described = entry(SCHEMA, MAPPINGS[at])
        assert list(described["properties"]) == described["required"] == names(data)
    assert ["name", *rubber["properties"]] == names(Material)
    assert ["name", *rubber["required"]] == [field.name for field in fields(Material) if field.default is NO_DEFAULT]


def test_choices_are_those_of_the_code() -> None:
    rubber = entry(SCHEMA, MAPPINGS["rubbers.zhou2019"])["properties"]
    assert tuple(SCHEMA["properties"]["plane"]["enum"]) == PLANES
    assert tuple(SCHEMA["properties"]["numerics"]["properties"]["dilatation"]["enum"]) == DILATATIONS
    reading = entry(SCHEMA, MAPPINGS["claims.readings.plane_strain"])["properties"]
    assert list(reading) == [field.name for field in fields(Reading)]
    for name, allowed in {"plane": PLANES, "kinematics": KINEMATICS, "moduli": MODULI, "bulk": BULK}.items():
        assert tuple(reading[name]["enum"]) == tuple(allowed)
    assert tuple(rubber["moduli"]["enum"]) == MODULI
    assert tuple(entry(SCHEMA, MAPPINGS["rig.virtual"])["properties"]["traction"]["enum"]) == TRACTIONS
    assert tuple(rubber["bulk"]["enum"]) == BULK


def test_what_is_said_to_be_left_out_is_what_the_code_takes() -> None:
    rubber = entry(SCHEMA, MAPPINGS["rubbers.zhou2019"])["properties"]
    defaults = {field.name: field.default for field in fields(Material)}
    assert f"{defaults['moduli']} where it is left out" in rubber["moduli"]["description"]
    assert f"({defaults['bulk']}, also where it is left out)" in rubber["bulk"]["description"]
    assert f"{defaults['density']:.1e} where it is left out".replace("e-0", "e-") in rubber["density"]["description"]


def test_shipped_configs_are_valid(config: Config) -> None:
    validate(config)
    for key, value in yaml.safe_load(MINIMAL.read_text()).items():
        config[key] = config[key] | value if isinstance(value, dict) else value
    assert config["results"] == "results/minimal"
    validate(config)


@pytest.mark.parametrize("case", [case for case in BAD_CONFIGS if case.schema], ids=case_name)
def test_bad_config_is_refused(config: Config, case: Bad) -> None:
    with pytest.raises(jsonschema.ValidationError):
        validate(changed(config, case.at, case.value))


@pytest.mark.parametrize(
    ("at", "value"),
    [
        ("roads.zhou2019.0.amplitude", 0),
        ("rubbers.zhou2019.shear_fractions", []),
        ("rubbers.zhou2019.density", MISSING),
        ("numerics.columns_min", 64.0),
        (
            "rubbers.Rubber_2-b",
            {"youngs_modulus": 1, "poissons_ratio": 0, "shear_fractions": [], "relaxation_times": []},
        ),
    ],
)
def test_legal_config_is_accepted_by_schema_and_reader(config: Config, at: str, value: Any) -> None:
    legal = changed(config, at, value)
    if at.endswith("shear_fractions"):
        legal = changed(legal, "rubbers.zhou2019.relaxation_times", [])
    validate(legal)
    Campaign.from_config(legal)
