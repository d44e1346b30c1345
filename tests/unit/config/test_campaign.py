"""A config read and checked: the scenes it asks for, and one sentence for everything that can be wrong with it."""

from __future__ import annotations

import copy
import random
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import yaml
from rubfric.config.choices import AspectStudy

from rubfric.config.campaign import Campaign, load
from rubfric.errors import InvalidInput
from rubfric.scene.numerics import Numerics

ROOT = Path(__file__).resolve().parents[3]
DEFAULT = ROOT / "config" / "config.yaml"
MINIMAL = ROOT / "config" / "minimal.yaml"

Config = dict[str, Any]


class Bad(NamedTuple):
    """One wrong entry: where it stands (keys and indices by dots), what stands there, and what the error says."""

    at: str
    value: Any
    says: str
    schema: bool = True  # whether a JSON schema can refuse it too


MISSING = object()
RUBBER, ROAD = "rubbers.zhou2019", "roads.zhou2019"
NAN, INFINITE = float("nan"), float("inf")

UNKNOWN_KEYS = [
    Bad("grids", 1, r"config has the unknown key 'grids'; allowed are results, .* \(did you mean grid\?\)"),
    Bad("colour", "red", r"config has the unknown key 'colour'; allowed are results, rubber, .*, roads$"),
    Bad("grid.velocity", [1], r"grid has the unknown key 'velocity'; .* \(did you mean velocities\?\)"),
    Bad("aspect_study.aspect", [1], r"aspect_study has the unknown key 'aspect'; .* \(did you mean aspects\?\)"),
    Bad("figures.presure", 5, r"figures has the unknown key 'presure'; allowed are total_pressure, fields"),
    Bad("figures.fields.scales", 1, r"figures.fields has the unknown key 'scales'; .* \(did you mean scale\?\)"),
    Bad("numerics.column_min", 8, r"numerics has the unknown key 'column_min'; .* \(did you mean columns_min\?\)"),
    Bad("presets.draft.columns", 8, r"presets.draft has the unknown key 'columns'; .* \(did you mean columns_min\?\)"),
    Bad("presets.draft.columns_max", 512, r"presets.draft has the unknown key 'columns_max'; allowed are accuracy, "),
    Bad(f"{RUBBER}.bulks", 1, r"rubbers.zhou2019 has the unknown key 'bulks'; .* \(did you mean bulk\?\)"),
    Bad(f"{ROAD}.0.amplitud", 1, r"roads.zhou2019\[0\] has the unknown key .* \(did you mean amplitude\?\)"),
]
MISSING_KEYS = [
    Bad("plane", MISSING, "config lacks the key 'plane'"),
    Bad("kinematics", MISSING, "config lacks the key 'kinematics'"),
    Bad("numerics.preset", MISSING, "numerics lacks the key 'preset'"),
    Bad("presets", MISSING, "config lacks the key 'presets'"),
    Bad("presets.standard.accuracy", MISSING, "presets.standard lacks the key 'accuracy'"),
    Bad("grid.aspect", MISSING, "grid lacks the key 'aspect'"),
    Bad("aspect_study.scales", MISSING, "aspect_study lacks the key 'scales'"),
    Bad("figures.fields", MISSING, "figures lacks the key 'fields'"),
    Bad("figures.fields.velocities", MISSING, "figures.fields lacks the key 'velocities'"),
    Bad("numerics.tolerance", MISSING, "numerics lacks the key 'tolerance'"),
    Bad("presets.draft.row_growth", MISSING, "presets.draft lacks the key 'row_growth'"),
    Bad(f"{RUBBER}.relaxation_times", MISSING, "rubbers.zhou2019 lacks the key 'relaxation_times'"),
    Bad(f"{ROAD}.3.wavenumber", MISSING, r"roads.zhou2019\[3\] lacks the key 'wavenumber'"),
]
WRONG_KINDS = [
    Bad(
        "grid.velocities.0",
        "1e-3",
        r"grid.velocities\[0\] is the text '1e-3', but must be a number \(YAML reads it as text; write 1.0e-3\)",
    ),
    Bad(f"{RUBBER}.density", "11e-10", r"rubbers.zhou2019.density is the text '11e-10', .* write 1.1e-9\)"),
    Bad("grid.pressures.1", "low", r"grid.pressures\[1\] is the text 'low', but must be a number$"),
    Bad("grid.aspect", True, "grid.aspect is True, but must be a number"),
    Bad("grid.pressures.0", False, r"grid.pressures\[0\] is False, but must be a number"),
    Bad("grid.aspect", [0.75], r"grid.aspect is \[0.75\], but must be a number"),
    Bad("grid.aspect", None, "grid.aspect is None, but must be a number"),
    Bad("grid.velocities", 100, "grid.velocities is 100, but must be a list of numbers"),
    Bad("grid.velocities", {"from": 1}, "grid.velocities is {'from': 1}, but must be a list of numbers"),
    Bad(f"{RUBBER}.shear_fractions", 0.5, "rubbers.zhou2019.shear_fractions is 0.5, but must be a list of numbers"),
    Bad("grid", [1, 10], r"grid is \[1, 10\], but must hold the keys velocities, pressures, aspect"),
    Bad("figures.fields", None, "figures.fields is None, but must hold the keys scale, velocities, pressures"),
    Bad(RUBBER, 4.17, "rubbers.zhou2019 is 4.17, but must hold the keys youngs_modulus, "),
    Bad(ROAD, {"amplitude": 1}, r"roads.zhou2019 is {'amplitude': 1}, but must be a list of at least one scale"),
    Bad(f"{ROAD}.1", 0.006, r"roads.zhou2019\[1\] is 0.006, but must hold the keys amplitude, wavenumber"),
    Bad("numerics", "standard", r"numerics is 'standard', but must hold the keys preset, "),
    Bad("presets", [], r"presets is \[\], but must hold at least one entry by name"),
    Bad("presets", {}, r"presets is {}, but must hold at least one entry by name"),
    Bad("presets.draft", 0.05, "presets.draft is 0.05, but must hold the keys accuracy, contact_nodes, "),
    Bad("rubbers", [], r"rubbers is \[\], but must hold at least one entry by name"),
    Bad("results", 5, "results is 5, but must be the path of a folder"),
    Bad("results", "", "results is '', but must be the path of a folder"),
    Bad("results", " ", "results is ' ', but must be the path of a folder", schema=False),
]
OUT_OF_RANGE = [
    Bad("grid.velocities.2", -1, r"grid.velocities\[2\] is -1 mm/s, but must be greater than 0"),
    Bad("grid.velocities.0", 0, r"grid.velocities\[0\] is 0 mm/s, but must be greater than 0"),
    Bad("grid.pressures.0", -0.5, r"grid.pressures\[0\] is -0.5 MPa, but must be greater than 0"),
    Bad("grid.pressures.5", 0.0, r"grid.pressures\[5\] is 0 MPa, but must be greater than 0"),
    Bad("grid.aspect", 0, "grid.aspect is 0, but must be greater than 0"),
    Bad("aspect_study.aspects.0", -0.25, r"aspect_study.aspects\[0\] is -0.25, but must be greater than 0"),
    Bad("transient.scale", 5, "transient.scale is 5, but must be one of the road's scales, 1 to 4", schema=False),
    Bad("transient.velocities", [], "transient.velocities is empty, but must hold at least one number"),
    Bad("transient.pressure", 0, "transient.pressure is 0 MPa, but must be greater than 0"),
    Bad("transient.start", "press", r"transient.start is 'press', .* \(did you mean pressed\?\)"),
    Bad("transient.columns", 20, "transient.columns is 20, but must be a multiple of 8"),
    Bad("transient.steps_per_wavelength", 3, "steps_per_wavelength is 3, but must be a whole number of at least 4"),
    Bad("transient.wavelengths", 0, "transient.wavelengths is 0, but must be a whole number of at least 1"),
    Bad("transient.saturation", 0, "transient.saturation is 0, but must be at least 1e-06"),
    Bad("transient.saturation", 1, "transient.saturation is 1, but must be at most 0.5"),
    Bad("aspect_study.pressures.0", 0, r"aspect_study.pressures\[0\] is 0 MPa, but must be greater than 0"),
    Bad("rig.virtual.sampling", 10, "rig.virtual.sampling is 10, but must be at least 100"),
    Bad("rig.virtual.area", 0, "rig.virtual.area is 0 mm², but must be greater than 0"),
    Bad("rig.virtual.force_noise", -1, "rig.virtual.force_noise is -1, but must be at least 0"),
    Bad("rig.virtual.traction", "sled", "rig.virtual.traction is 'sled', but must be one of rubber, rope"),
    Bad("rig.virtual.seed", 0.5, "rig.virtual.seed is 0.5, but must be a whole number of at least 0"),
    Bad("rig.pressures", [], "rig.pressures is empty, but must hold at least one number"),
    Bad("rig.data", "run.csv", "rig.data is 'run.csv', but must be a list of files"),
    Bad("rig.data", ["a.csv", "a.csv"], "rig.data names a file twice; each may stand once"),
    Bad("rig.columns", 5, "rig.columns is 5, but must be the path of a file"),
    Bad("grid.velocities.0", NAN, r"grid.velocities\[0\] is nan, but must be a finite number", schema=False),
    Bad("grid.pressures.0", INFINITE, r"grid.pressures\[0\] is inf, but must be a finite number", schema=False),
    Bad("figures.total_pressure", NAN, "figures.total_pressure is nan, but must be a finite number", schema=False),
    Bad("grid.velocities", [], "grid.velocities is empty, but must hold at least one number"),
    Bad("grid.pressures", [], "grid.pressures is empty, but must hold at least one number"),
    Bad("aspect_study.scales", [], "aspect_study.scales is empty, but must hold at least one number"),
    Bad(
        "grid.velocities",
        [1, 0.1, 0.10],
        r"grid.velocities\[2\] is 0.1 mm/s, the same as grid.velocities\[1\]; each may stand once",
    ),
    Bad("grid.pressures", [0.3, 0.1 + 0.2], r"\[1\] is 0.3 MPa, the same as grid.pressures\[0\]", schema=False),
    Bad("aspect_study.scales", [1, 1.0], r"aspect_study.scales\[1\] is 1, the same as"),
    Bad("aspect_study.scales", [5], "is 5, but must be one of the road's scales, 1 to 4", schema=False),
    Bad("aspect_study.scales", [1.5], "aspect_study.scales is 1.5, but must be a whole number of at least 1"),
    Bad("figures.fields.scale", 9, "figures.fields.scale is 9, .* the road's scales, 1 to 4", schema=False),
    Bad("figures.fields.scale", 0, "figures.fields.scale is 0, but must be a whole number of at least 1"),
    Bad("figures.total_pressure", 3, "figures.total_pressure has 3, .* chosen from grid.pressures: 0.1, ", False),
    Bad("figures.fields.velocities", [2], "has 2, but must be chosen from grid.velocities: 0.1, 1, 10, ", False),
    Bad("figures.fields.pressures", [9], "has 9, but must be chosen from grid.pressures: 0.1, 0.2, ", False),
    Bad("numerics.contact_nodes", 3, "numerics.contact_nodes is 3, but must be a whole number of at least 4"),
    Bad("numerics.contact_nodes", 6.5, "numerics.contact_nodes is 6.5, but must be a whole number"),
    Bad("numerics.accuracy", 0, "numerics.accuracy is 0, but must be at least 1e-06"),
    Bad("numerics.accuracy", 0.6, "numerics.accuracy is 0.6, but must be at most 0.5"),
    Bad("numerics.finite_contact_nodes", 3, "numerics.finite_contact_nodes is 3, but must be a whole number of at lea"),
    Bad("numerics.finite_columns_min", 100, "numerics.finite_columns_min is 100, but must be a multiple of 8"),
    Bad("numerics.columns_min", 100, "numerics.columns_min is 100, but must be a multiple of 8"),
    Bad("numerics.columns_max", 1001, "numerics.columns_max is 1001, but must be a multiple of 8"),
    Bad("numerics.output_columns", 0, "numerics.output_columns is 0, but must be a whole number of at least 1"),
    Bad("numerics.columns_max", 120, "numerics.columns_max is 120, but must be at least 128", schema=False),
    Bad("numerics.row_growth", 1, "numerics.row_growth is 1, but must be at least 1.00001"),
    Bad("numerics.refinements", -1, "numerics.refinements is -1, but must be a whole number of at least 0"),
    Bad("numerics.refinements", 13, "numerics.refinements is 13, but must be at most 12"),
    Bad("numerics.folding", -0.1, "numerics.folding is -0.1, but must be at least 0"),
    Bad("numerics.folding", 1.1, "numerics.folding is 1.1, but must be at most 1"),
    Bad("numerics.tolerance", 0, "numerics.tolerance is 0, but must be at least 1e-12"),
    Bad("numerics.tolerance", 0.1, "numerics.tolerance is 0.1, but must be at most 0.01"),
    Bad("numerics.first_row", 101, "numerics.first_row is 101, but must be at most 100"),
    Bad("presets.draft.accuracy", 0, "presets.draft.accuracy is 0, but must be at least 1e-06"),
    Bad("presets.reference.accuracy", "1e-3", r"presets.reference.accuracy is the text '1e-3', .* write 1.0e-3\)"),
    Bad("presets.reference.contact_nodes", 3, "presets.reference.contact_nodes is 3, but must be a whole number"),
    Bad("presets.draft.columns_min", 100, "presets.draft.columns_min is 100, but must be a multiple of 8"),
    Bad("presets.draft.row_growth", 1, "presets.draft.row_growth is 1, but must be at least 1.00001"),
    Bad("numerics.first_row", 0, "numerics.first_row is 0, but must be at least 0.01"),
]
BAD_MODELS = [
    Bad("numerics.preset", "standart", r"numerics.preset is 'standart', .* .did you mean standard\?.", schema=False),
    Bad("numerics.preset", 5, "numerics.preset is 5, but must be one of draft, standard, reference$"),
    Bad("numerics.dilatation", "meen", r"numerics.dilatation is 'meen', .* auto, pointwise, mean .did you mean mean"),
    Bad("presets.a b", {}, "name in presets is 'a b', but must be a word of letters, digits, '-' and '_'"),
    Bad("plane", "stresses", r"plane is 'stresses', but must be one of stress, strain \(did you mean stress\?\)"),
    Bad("kinematics", "larg", r"kinematics is 'larg', but must be one of small, finite, auto"),
    Bad("rubber", "zhou", r"rubber is 'zhou', but must be one of zhou2019 \(did you mean zhou2019\?\)", schema=False),
    Bad("road", "gravel", "road is 'gravel', but must be one of zhou2019$", schema=False),
    Bad("rubber", ["zhou2019"], r"rubber is \['zhou2019'\], but must be one of zhou2019"),
    Bad("rubbers.a/b", {}, "name in rubbers is 'a/b', but must be a word of letters, digits, '-' and '_'"),
    Bad("roads.a b", [], "name in roads is 'a b', but must be a word"),
    Bad("roads.gummi_weiß", [{"amplitude": 1, "wavenumber": 1}], "name in roads is 'gummi_weiß', but must be a word"),
    Bad(f"{RUBBER}.youngs_modulus", 0, "rubbers.zhou2019.youngs_modulus is 0 MPa, but must be greater than 0"),
    Bad(f"{RUBBER}.poissons_ratio", 0.5, "poissons_ratio is 0.5, but must lie between -1 and 0.5, both excluded"),
    Bad(f"{RUBBER}.poissons_ratio", 0.7, "poissons_ratio is 0.7, but must lie between -1 and 0.5"),
    Bad(f"{RUBBER}.poissons_ratio", -1, "poissons_ratio is -1, but must lie between -1 and 0.5"),
    Bad(f"{RUBBER}.shear_fractions.3", 0.2, r"shear_fractions add up to 1\.0\d*, but must stay below 1", schema=False),
    Bad(f"{RUBBER}.shear_fractions.0", -0.1, r"rubbers.zhou2019.shear_fractions\[0\] is -0.1, but must be greater"),
    Bad(
        f"{RUBBER}.shear_fractions",
        [0.1, 0.2],
        "rubbers.zhou2019.relaxation_times has 6 numbers, but must have as many as shear_fractions, 2",
        schema=False,
    ),
    Bad(f"{RUBBER}.relaxation_times.5", 0, r"relaxation_times\[5\] is 0 s, but must be greater than 0"),
    Bad(f"{RUBBER}.relaxation_times.0", -1.0, r"relaxation_times\[0\] is -1 s, but must be greater than 0"),
    Bad(f"{RUBBER}.moduli", "longterm", "moduli is 'longterm', .* long_term, instantaneous .did you mean long_term"),
    Bad(f"{RUBBER}.bulk", "rigid", "bulk is 'rigid', but must be one of elastic, proportional"),
    Bad(f"{RUBBER}.density", 0, "rubbers.zhou2019.density is 0 t/mm³, but must be greater than 0"),
    Bad(ROAD, [], r"roads.zhou2019 is \[\], but must be a list of at least one scale"),
    Bad(f"{ROAD}.2.wavenumber", 0, r"roads.zhou2019\[2\].wavenumber is 0 1/mm, but must be greater than 0"),
    Bad(f"{ROAD}.2.amplitude", -0.003, r"roads.zhou2019\[2\].amplitude is -0.003 mm, but must be at least 0"),
]
BAD_CONFIGS = [*UNKNOWN_KEYS, *MISSING_KEYS, *WRONG_KINDS, *OUT_OF_RANGE, *BAD_MODELS]


def case_name(case: Any) -> str:
    return f"{case.at}={'missing' if case.value is MISSING else case.value}"


def changed(config: Config, at: str, value: Any) -> Config:
    """Return a copy of a config with another entry at a place such as ``roads.zhou2019.0.amplitude``."""
    result = copy.deepcopy(config)
    *way, last = (int(key) if key.isdigit() else key for key in at.split("."))
    place: Any = result
    for key in way:
        place = place[key]
    if value is MISSING:
        del place[last]
    else:
        place[last] = value
    return result


@pytest.fixture
def config() -> Config:
    return yaml.safe_load(DEFAULT.read_text())


def scene_names(config: Mapping[str, Any]) -> list[str]:
    return list(Campaign.from_config(config).scenes())


def test_default_config_is_the_papers_campaign() -> None:
    campaign = load(DEFAULT)
    assert len(campaign.scenes()) == 4 * 7 * 6 + 4 * 2 * 7
    assert campaign.velocities == (0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 10000.0)
    assert campaign.pressures == (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
    assert campaign.aspect_study == AspectStudy((0.25, 0.5, 0.75, 1.0, 1.5), (1,), (0.5, 5.0))
    assert campaign.material.name == "zhou2019"
    assert campaign.numerics == Numerics()
    assert list(campaign.scales) == [1, 2, 3, 4]


def test_every_scene_goes_by_its_own_name() -> None:
    scenes = load(DEFAULT).scenes()
    assert all(name == scene.name for name, scene in scenes.items())
    assert len(set(scenes.values())) == len(scenes) == 224


def test_minimal_config_is_laid_over_the_default() -> None:
    campaign = load(DEFAULT, MINIMAL)
    assert campaign.results == "results/minimal"
    assert campaign.velocities == (1.0, 100.0)
    assert campaign.material == load(DEFAULT).material
    assert len(campaign.scenes()) == 4 * 2 * 2 + 2
    assert set(campaign.scenes()) <= set(load(DEFAULT).scenes())


def test_field_scenes_are_part_of_the_campaign_pressure_by_pressure() -> None:
    campaign = load(DEFAULT)
    fields = campaign.field_scenes()
    assert set(fields) <= set(campaign.scenes())
    expected = [(p, v) for p in (0.2, 1.0, 5.0) for v in (0.1, 10.0, 100.0, 1000.0)]
    assert [(scene.pressure, scene.velocity) for scene in fields.values()] == expected


def test_scene_takes_the_configs_values_where_none_are_given() -> None:
    campaign = load(DEFAULT)
    scene = campaign.scene(4, 100, 5)
    assert scene.name == "scale4_v100_p5_aspect0.75_stress"
    assert scene.road == campaign.road[3]
    assert scene.material == campaign.material
    assert scene.numerics == campaign.numerics
    assert scene.kinematics == campaign.kinematics == "auto"


@pytest.mark.parametrize("kinematics", ["small", "finite", "auto"])
def test_kinematics_of_the_config_is_that_of_every_scene(tmp_path: Path, kinematics: str) -> None:
    overlay = tmp_path / "mine.yaml"
    overlay.write_text(f"kinematics: {kinematics}\n")
    campaign = load(DEFAULT, overlay)
    assert {scene.kinematics for scene in campaign.scenes().values()} == {kinematics}
    assert campaign.scene(1, 1, 1, kinematics="small").kinematics == "small"


def test_scene_need_not_lie_on_the_grid() -> None:
    scene = load(DEFAULT).scene(2, 3.3, 0.07, aspect=2, plane="strain")
    assert scene.name == "scale2_v3.3_p0.07_aspect2_strain"
    assert scene.name not in load(DEFAULT).scenes()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((5, 1, 1), "scale is 5, but must be one of the road's scales, 1 to 4"),
        ((0, 1, 1), "scale is 0, but must be a whole number of at least 1"),
        ((1.5, 1, 1), "scale is 1.5, but must be a whole number of at least 1"),
        ((1, -1, 1), "velocity is -1 mm/s, but must be greater than 0"),
        ((1, 1, 0), "pressure is 0 MPa, but must be greater than 0"),
        ((1, 1, 1, -1), "aspect is -1, but must be greater than 0"),
        ((1, 1, 1, 1, "flat"), "plane is 'flat', but must be one of stress, strain"),
    ],
)
def test_scene_refuses_what_no_model_can_take(arguments: tuple[Any, ...], says: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{says}$"):
        load(DEFAULT).scene(*arguments)


@pytest.mark.parametrize("case", BAD_CONFIGS, ids=case_name)
def test_bad_config_is_refused_in_one_sentence(config: Config, case: Bad) -> None:
    with pytest.raises(InvalidInput, match=case.says) as caught:
        Campaign.from_config(changed(config, case.at, case.value))
    message = str(caught.value)
    assert "\n" not in message
    assert not message.endswith(".")
    assert ". " not in message


@pytest.mark.parametrize("value", [None, [], 5, "text"])
def test_config_that_is_no_mapping_is_refused(value: Any) -> None:
    with pytest.raises(InvalidInput, match=re.escape(f"config is {value!r}, but must hold the keys results, rubber, ")):
        Campaign.from_config(value)


def test_unused_rubbers_and_roads_are_checked_too(config: Config) -> None:
    spare = config["rubbers"]["zhou2019"] | {"poissons_ratio": 0.6}
    with pytest.raises(InvalidInput, match=r"rubbers.spare.poissons_ratio is 0.6, but must lie between"):
        Campaign.from_config(changed(config, "rubbers.spare", spare))
    with pytest.raises(InvalidInput, match=r"roads.spare\[0\].wavenumber is -1 1/mm, but must be greater than 0"):
        Campaign.from_config(changed(config, "roads.spare", [{"amplitude": 0.1, "wavenumber": -1}]))


def test_number_too_large_for_a_float_is_refused(config: Config) -> None:
    with pytest.raises(InvalidInput, match=r"grid.velocities\[0\]"):
        Campaign.from_config(changed(config, "grid.velocities.0", 10**400))


def test_flat_road_and_rubber_without_branches_are_legal(config: Config) -> None:
    flat = changed(config, f"{ROAD}.0.amplitude", 0)
    assert Campaign.from_config(flat).road[0].amplitude == 0.0
    elastic = changed(changed(config, f"{RUBBER}.shear_fractions", []), f"{RUBBER}.relaxation_times", [])
    assert Campaign.from_config(elastic).material.shear_fractions == ()


def test_optional_keys_of_a_rubber_may_be_left_out(config: Config) -> None:
    whole = Campaign.from_config(config)
    for key in ("moduli", "bulk", "density"):
        config = changed(config, f"{RUBBER}.{key}", MISSING)
    assert Campaign.from_config(config) == whole


@pytest.mark.parametrize(
    ("at", "value", "mark"),
    [("grid.velocities", 33.5, "_v33.5_"), ("grid.pressures", 0.3, "_p0.3_"), ("aspect_study.aspects", 2, "_aspect2_")],
)
def test_another_value_adds_its_own_scenes_only(config: Config, at: str, value: float, mark: str) -> None:
    before = scene_names(config)
    key, entry = at.split(".")
    after = scene_names(changed(config, at, [*config[key][entry], value]))
    assert set(before) < set(after)
    assert all(mark in name for name in set(after) - set(before))


def test_order_of_lists_does_not_matter(config: Config) -> None:
    shuffled = copy.deepcopy(config)
    source = random.Random(8986)
    for key in ("velocities", "pressures"):
        source.shuffle(shuffled["grid"][key])
        source.shuffle(shuffled["figures"]["fields"][key])
    for key in ("aspects", "pressures"):
        source.shuffle(shuffled["aspect_study"][key])
    assert shuffled != config
    assert Campaign.from_config(shuffled) == Campaign.from_config(config)
    assert scene_names(shuffled) == scene_names(config)


def test_way_of_writing_a_number_does_not_matter(config: Config) -> None:
    other = changed(config, "grid.velocities", [0.10, 1.0, 10.0, 1.0e2, 500.0, 1.0e3, 1.0e4])
    other = changed(other, "grid.pressures", [0.1, 0.2, 0.5, 1.0, 2, 5.00000000000001])
    assert Campaign.from_config(other) == Campaign.from_config(config)


def test_trailing_slash_of_the_folder_is_dropped(config: Config) -> None:
    assert Campaign.from_config(changed(config, "results", "out/put//")).results == "out/put"
    assert Campaign.from_config(changed(config, "results", "/")).results == "/"


def test_reading_leaves_the_config_alone(config: Config) -> None:
    before = copy.deepcopy(config)
    Campaign.from_config(config)
    assert config == before


def test_text_that_yaml_makes_of_a_power_of_ten_is_explained(tmp_path: Path) -> None:
    overlay = tmp_path / "fast.yaml"
    overlay.write_text("grid:\n  velocities: [1e-3]\n")
    with pytest.raises(InvalidInput, match=r"the text '1e-3', but must be a number .*write 1.0e-3"):
        load(DEFAULT, overlay)


def test_overlay_replaces_lists_and_merges_mappings(tmp_path: Path) -> None:
    overlay = tmp_path / "overlay.yaml"
    overlay.write_text("numerics:\n  contact_nodes: 32\naspect_study:\n  aspects: [1]\n")
    campaign = load(DEFAULT, overlay)
    assert campaign.numerics == Numerics(contact_nodes=32)
    assert campaign.aspect_study.aspects == (1.0,)
    assert campaign.aspect_study.pressures == (0.5, 5.0)


@pytest.mark.parametrize("content", [b"grid: [1, 2", b"plane: stress\n\tgrid: 1", b"# \xfcberlagert\nplane: stress\n"])
def test_file_that_is_no_yaml_is_refused_by_name(tmp_path: Path, content: bytes) -> None:
    broken = tmp_path / "broken.yaml"
    broken.write_bytes(content)
    with pytest.raises(InvalidInput, match=r"broken.yaml is not valid YAML: "):
        load(DEFAULT, broken)


@pytest.mark.parametrize(("content", "held"), [("", "None"), ("- 1\n- 2\n", r"\[1, 2\]"), ("rubber", "'rubber'")])
def test_file_that_holds_no_mapping_is_refused_by_name(tmp_path: Path, content: str, held: str) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(content)
    with pytest.raises(InvalidInput, match=f"wrong.yaml holds {held}, but must hold the keys results, rubber, "):
        load(wrong)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"nowhere.yaml"):
        load(tmp_path / "nowhere.yaml")


def test_reading_a_config_imports_nothing_heavy() -> None:
    heavy = ("skfem", "scipy", "xarray", "netCDF4", "pandas", "matplotlib")
    code = f"import sys, rubfric.config.campaign; print([name for name in {heavy} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
