"""A config read and checked: the scenes it asks for, and one sentence for everything that can be wrong with it."""

from __future__ import annotations

import copy
import random
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from bad_configs import BAD_CONFIGS, DEFAULT, MINIMAL, MISSING, ROAD, RUBBER, Bad, Config, case_name, changed

from rubfric.config.campaign import Campaign, load
from rubfric.config.models import AspectStudy
from rubfric.errors import InvalidInput
from rubfric.road.waves import WaveRoad
from rubfric.scene.numerics import Numerics


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
    assert campaign.aspect_study == AspectStudy(aspects=(0.25, 0.5, 0.75, 1.0, 1.5), scales=(1,), pressures=(0.5, 5.0))
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


@pytest.mark.parametrize("content", [b"grid: [1, 2", b"plane: stress\n\tgrid: 1", b"# \xfcberlagert\nplane: stress\n"])
def test_file_that_is_no_yaml_is_refused_by_name(tmp_path: Path, content: bytes) -> None:
    broken = tmp_path / "broken.yaml"
    broken.write_bytes(content)
    with pytest.raises(InvalidInput, match=r"broken.yaml is not valid YAML: "):
        load(DEFAULT, broken)


@pytest.mark.parametrize(("content", "held"), [("", "nothing"), ("- 1\n- 2\n", r"\[1, 2\]"), ("rubber", "'rubber'")])
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


def test_whole_road_is_simulated_over_the_grid_with_a_preset_of_its_own() -> None:
    campaign = load(DEFAULT)
    whole = campaign.whole_scenes()
    assert len(whole) == len(campaign.velocities) * len(campaign.pressures)
    scene = whole["all_v100_p5_aspect0.75_stress"]
    assert scene.road == campaign.whole_road
    assert scene.numerics == campaign.presets["draft"]
    assert scene.digest not in {other.digest for other in campaign.scenes().values()}


@pytest.mark.parametrize("way", ["sum", "cascade", "persson"])
def test_other_ways_simulate_no_whole_road_and_need_no_period(config: Config, way: str) -> None:
    config = changed(changed(config, "multiscale", way), "roads.zhou2019.1.wavenumber", 81.1234567)
    assert Campaign.from_config(config).whole_scenes() == {}


def test_random_phases_are_those_of_the_seed_and_more_draws_keep_the_first(config: Config) -> None:
    def roads(draws: int, seed: int) -> dict[str, WaveRoad]:
        return Campaign.from_config(changed(config, "phases", {"draws": draws, "seed": seed})).whole_roads

    few, more, others = roads(2, 1), roads(3, 1), roads(2, 2)
    assert list(few) == ["draw1/", "draw2/"]
    assert {name: more[name] for name in few} == few
    assert len({road.phases for road in (*more.values(), *others.values())}) == 5
    names = list(Campaign.from_config(changed(config, "phases", {"draws": 2, "seed": 1})).whole_scenes())
    assert len(names) == 84
    assert names[42] == "draw2/all_v0.1_p0.1_aspect0.75_stress"
