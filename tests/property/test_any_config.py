"""Whatever is admitted is read; whatever is not is refused in one sentence that names its key."""

from __future__ import annotations

import contextlib
import copy
import json
import re
from collections.abc import Callable, Iterator
from typing import Any, get_args

import jsonschema
import pytest
import yaml
from admissible import ROOT, SHIPPED, configs, scenes
from admissible import Config as Tree
from hypothesis import given, settings
from hypothesis import strategies as st

from rubfric import checks
from rubfric.config.campaign import Campaign, load
from rubfric.config.models import Config
from rubfric.config.overlay import overlaid
from rubfric.errors import InvalidInput, RubfricError
from rubfric.scene.scene import COLUMNS_PER_HEIGHT, Scene

SCHEMA = jsonschema.Draft202012Validator(
    yaml.safe_load((ROOT / "workflow" / "schemas" / "config.schema.yaml").read_text(encoding="utf-8"))
)
Way = tuple[str | int, ...]

# Where a number belongs, none of these does.
NO_NUMBERS = (
    None,
    True,
    "1e-3",
    "text",
    "",
    [],
    [1],
    {},
    {"a": 1},
    float("nan"),
    float("inf"),
    -1,
    -(10**400),
    10**400,
)
NO_WORDS = (None, True, 5, 0.5, float("nan"), "", " ", "no such", "a\nb", "\ud800", [], ["stress"], {}, {"stress": 1})
NO_LISTS = (None, 5, "text", {}, {"0": 1}, float("nan"))
NO_MAPPINGS = (None, 5, "text", [], [1, 2])
NO_FOLDERS = (None, True, 5, float("nan"), "", " ", "a\nb", "{x}", "\ud800", "\0", [], ["results"], {}, "x" * 5000)
# No quantity and no count is so large.
HUGE = (1e31, 1e300, 10**31)
EMPTY_ALLOWED = ("shear_fractions", "relaxation_times", "data", "compare")
OPTIONAL = ("moduli", "bulk", "density")
READINGS = ("claims", "readings")
CATALOGUES = (("rubbers",), ("roads",), ("presets",), READINGS)


def ways(tree: Any, way: Way = ()) -> Iterator[Way]:
    """Yield the way to every entry of a config, to mappings and lists as well."""
    for key, entry in tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ():
        yield (*way, key)
        yield from ways(entry, (*way, key))


def at(tree: Any, way: Way) -> Any:
    for key in way:
        tree = tree[key]
    return tree


def replaced(config: Any, way: Way, value: Any) -> Any:
    """Return a copy of a config with another entry; the rest is shared."""
    if not way:
        return value
    changed = copy.copy(config)
    below = changed[way[0]] if len(way) > 1 else None
    changed[way[0]] = replaced(below, way[1:], value)
    return changed


def named(way: Way) -> str:
    """Return the last name on a way, which stands in every message about what is there."""
    return next(str(key) for key in reversed(way) if isinstance(key, str))


def refusal(config: Any) -> str:
    """Return the sentences with which a config is refused: one, or one for each of a name that is missed."""
    with pytest.raises(InvalidInput) as caught:
        Campaign.from_config(config)
    assert all("\n" not in sentence and len(sentence) < 2000 for sentence in caught.value.faults)
    return " ".join(caught.value.faults)


@given(configs())
@settings(max_examples=60)
def test_any_admissible_config_is_read_by_reader_and_schema(config: Tree) -> None:
    campaign = Campaign.from_config(config)
    SCHEMA.validate(config)
    assert campaign.velocities == tuple(sorted(checks.number("", value) for value in config["grid"]["velocities"]))
    assert campaign.material.name == config["rubber"]
    assert len(campaign.road) == len(config["roads"][config["road"]])
    assert campaign == Campaign.from_config(copy.deepcopy(config))


@given(configs(), st.data())
@settings(max_examples=20)
def test_order_of_keys_and_lists_is_free(config: Tree, data: st.DataObject) -> None:
    shuffled = {key: config[key] for key in data.draw(st.permutations(sorted(config)))}
    for way in (("grid", "velocities"), ("aspect_study", "aspects"), ("transient", "velocities")):
        shuffled = replaced(shuffled, way, data.draw(st.permutations(at(config, way))))
    assert Campaign.from_config(shuffled) == Campaign.from_config(config)


@given(configs(), st.booleans())
@settings(max_examples=15)
def test_config_survives_yaml_and_its_overlay(
    tmp_path_factory: pytest.TempPathFactory, config: Tree, split: bool
) -> None:
    folder = tmp_path_factory.mktemp("config")
    below, above = folder / "below.yaml", folder / "above.yaml"
    below.write_text(yaml.safe_dump(SHIPPED | {"rubbers": {}, "roads": {}} if split else config), encoding="utf-8")
    above.write_text(yaml.safe_dump(config), encoding="utf-8")
    assert Campaign.from_config(overlaid([below, above], config)) == Campaign.from_config(config)


@given(configs())
@settings(max_examples=15)
def test_scenes_of_any_config_have_names_fit_for_files(config: Tree) -> None:
    campaign = Campaign.from_config(config)
    flattest = COLUMNS_PER_HEIGHT / campaign.numerics.columns_max
    if min(campaign.aspect, *campaign.aspect_study.aspects) < flattest:
        with pytest.raises(InvalidInput, match=r"^aspect is .*: so flat a block needs more columns"):
            campaign.scenes()
        return
    found = campaign.scenes()
    for name, scene in found.items():
        assert re.fullmatch(r"scale\d+_v[0-9.e-]+_p[0-9.e-]+_aspect[0-9.e-]+_(stress|strain)", name)
        assert Scene.from_parameters(json.loads(json.dumps(scene.parameters()))) == scene
    assert len({scene.digest for scene in found.values()}) == len(found)


def cases(config: Tree) -> Iterator[tuple[Way, Any]]:
    """Yield all that is wrong in one place: where, and what stands there."""
    for way in ways(config):
        entry = at(config, way)
        if isinstance(entry, dict):
            values: tuple[Any, ...] = NO_MAPPINGS[1:] if may_be_left_out(way) else NO_MAPPINGS
        elif isinstance(entry, list):
            values = NO_LISTS if way[-1] in EMPTY_ALLOWED else (*NO_LISTS, [])
        elif isinstance(entry, str):
            values = NO_FOLDERS if way[-1] == "results" else NO_WORDS
        elif entry is None:  # a file may be named there
            values = tuple(value for value in NO_FOLDERS if value is not None)
        else:
            values = (*NO_NUMBERS, *HUGE)
        yield from ((way, value) for value in values)


def may_be_left_out(way: Way) -> bool:
    """Return whether a key that is no entry of a catalogue has a default."""
    model: Any = Config
    for key in way:
        field = getattr(model, "model_fields", {}).get(key)
        if field is None:
            return False
        model = next((kind for kind in get_args(field.annotation) if kind is not type(None)), field.annotation)
    return not field.is_required()


def unnamed(config: Tree, read: Callable[[Tree], Any]) -> list[tuple[Way, Any, str]]:
    """Return what is wrong in one place and not refused in one sentence that names the key."""
    found = []
    for way, value in cases(config):
        try:
            read(replaced(config, way, value))
        except InvalidInput as error:
            if named(way) in str(error) and "\n" not in str(error):
                continue
            found.append((way, value, str(error)))
        except Exception as error:
            found.append((way, value, repr(error)))
        else:
            found.append((way, value, "read"))
    return found


@pytest.mark.thorough
def test_anything_wrong_in_any_place_of_the_shipped_config_is_refused_by_name() -> None:
    assert len([*cases(SHIPPED)]) > 1000
    assert unnamed(SHIPPED, Campaign.from_config) == []


@given(configs())
@settings(max_examples=2)
def test_anything_wrong_in_any_place_of_any_config_is_refused_by_name(config: Tree) -> None:
    assert unnamed(config, Campaign.from_config) == []


@given(scenes(most_branches=2))
@settings(max_examples=3)
def test_anything_wrong_in_the_parameters_of_a_scene_is_refused_by_name(scene: Scene) -> None:
    assert unnamed(scene.parameters(), Scene.from_parameters) == []


@given(configs())
@settings(max_examples=5)
def test_any_key_taken_away_is_missed_by_name(config: Tree) -> None:
    for way in ways(config):
        if not isinstance(way[-1], str):
            continue
        without = copy.deepcopy(config)
        del at(without, way[:-1])[way[-1]]
        spare = way[:-1] in CATALOGUES and way[-1] not in in_use(config, way[:-1])
        optional = (way[0] == "rubbers" and way[-1] in OPTIONAL and len(way) == 3) or way[:-2] == READINGS
        optional |= may_be_left_out(way)
        if spare or optional:
            Campaign.from_config(without)
        else:
            entry = way[:-1] in CATALOGUES and way[:-1] != READINGS
            assert (str(way[0]).removesuffix("s") if entry else way[-1]) in refusal(without)


def in_use(config: Tree, catalogue: Way) -> list[str]:
    """Return the names of the entries of a catalogue that the config uses."""
    if catalogue == READINGS:
        return list(config["claims"]["compare"])
    if catalogue == ("presets",):
        return [config["numerics"]["preset"], config["claims"]["preset"], config["multiscale_preset"]]
    return [config[str(catalogue[0])[:-1]]]


@given(
    configs(),
    st.one_of(st.sampled_from(["velocitys", "", "x" * 5000, "ü", "a\nb", "\ud800"]), st.integers(), st.none()),
)
@settings(max_examples=10)
def test_any_unknown_key_is_refused_by_name(config: Tree, key: Any) -> None:
    closed = [way for way in [(), *ways(config)] if isinstance(at(config, way), dict) and way not in CATALOGUES]
    for way in closed:
        assert repr(key)[:20] in refusal(replaced(config, (*way, key), 1))


@given(configs(), st.data())
@settings(max_examples=20)
def test_number_given_twice_in_a_grid_is_refused_by_name(config: Tree, data: st.DataObject) -> None:
    places = [("grid", "velocities"), ("grid", "pressures"), ("aspect_study", "aspects"), ("transient", "velocities")]
    way = data.draw(st.sampled_from(places))
    values = at(config, way)
    # Other last digits, the same number: a factor of 1 + 1e-14 may cross the middle between two of 12 digits.
    again = checks.number("", data.draw(st.sampled_from(values)))
    assert f"{way[0]}.{way[1]}[{len(values)}]" in refusal(replaced(config, way, [*values, again]))


json_trees = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=8)),
    lambda below: st.one_of(
        st.lists(below, max_size=4), st.dictionaries(st.one_of(st.text(max_size=8), st.integers()), below, max_size=4)
    ),
    max_leaves=8,
)


@given(configs(), st.data(), json_trees)
@settings(max_examples=60)
def test_anything_at_all_is_read_or_refused(config: Tree, data: st.DataObject, tree: Any) -> None:
    way = data.draw(st.sampled_from([(), *ways(config)]))
    changed = replaced(config, way, tree)
    with contextlib.suppress(InvalidInput):
        assert Campaign.from_config(changed).scales


@given(scenes())
@settings(max_examples=40)
def test_scene_comes_back_from_its_parameters(scene: Scene) -> None:
    again = Scene.from_parameters(json.loads(json.dumps(scene.parameters())))
    assert again == scene
    assert hash(again) == hash(scene)
    assert (again.name, again.digest) == (scene.name, scene.digest)


@given(st.binary(max_size=60))
@settings(max_examples=50)
def test_any_bytes_for_a_config_are_read_or_refused(tmp_path_factory: pytest.TempPathFactory, content: bytes) -> None:
    path = tmp_path_factory.mktemp("bytes") / "config.yaml"
    path.write_bytes(content)
    with pytest.raises(RubfricError, match=r"config\.yaml|config"):
        load(path)


def test_examples_are_the_same_every_time() -> None:
    assert settings().derandomize
    assert settings().database is None
    assert settings().deadline is None
