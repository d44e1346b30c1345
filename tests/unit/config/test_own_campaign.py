"""A campaign of one's own: what the paper adds is off, and speeds, loads and scales follow from the grid."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml
from bad_configs import DEFAULT, MINIMAL

from rubfric import cli
from rubfric.config.begin import begin
from rubfric.config.campaign import Campaign, load
from rubfric.config.overlay import EXTRAS
from rubfric.errors import InvalidInput

GRID = {"velocities": [1, 3, 10, 30, 100], "pressures": [0.3, 0.6, 1.2, 2.4], "aspect": 1}


def laid(folder: Path, *above: dict[str, Any]) -> Campaign:
    paths = [folder / f"{place}.yaml" for place, _ in enumerate(above)]
    for path, entry in zip(paths, above, strict=True):
        path.write_text(yaml.safe_dump(entry), encoding="utf-8")
    return load(DEFAULT, *paths)


@pytest.mark.parametrize(
    "own",
    [
        {"grid": GRID},
        {"road": "zhou2019", "grid": {"pressures": [1]}},
        {"rubbers": {"zhou2019": {"youngs_modulus": 3}}},
    ],
)
def test_own_rubber_road_or_grid_runs_the_grid_alone(tmp_path: Path, own: dict[str, Any]) -> None:
    campaign = laid(tmp_path, own)
    grid = len(campaign.road) * len(campaign.velocities) * len(campaign.pressures)
    assert len(campaign.scenes()) == grid
    assert campaign.marches() == {}
    assert (campaign.aspect_study, campaign.transient, campaign.rig, campaign.claims) == (None,) * 4
    assert campaign.field_scenes().keys() <= campaign.scenes().keys()


def test_speeds_loads_and_scales_follow_from_the_grid_unless_they_are_given(tmp_path: Path) -> None:
    named = {"aspect_study": {"aspects": [0.5, 1]}, "transient": {"columns": 32}, "rig": {"data": []}}
    campaign = laid(tmp_path, {"grid": GRID}, {**named, "figures": {"fields": {"velocities": [10]}}})
    assert campaign.figures.total_pressure == 2.4
    assert (campaign.figures.fields.velocities, campaign.figures.fields.pressures) == ((10.0,), (0.3, 1.2, 2.4))
    assert campaign.aspect_study
    assert campaign.aspect_study.pressures == (0.3, 2.4)
    assert campaign.transient
    assert (campaign.transient.columns, campaign.transient.pressure) == (32, 0.6)
    assert campaign.transient.velocities == (1.0, 3.0, 30.0, 100.0)
    assert campaign.rig
    assert (campaign.rig.pressures, campaign.rig.virtual.area) == ((0.3, 1.2, 2.4), 100.0)
    assert campaign.claims is None


def test_other_changes_leave_the_paper_and_null_switches_a_section_off(tmp_path: Path) -> None:
    paper = load(DEFAULT)
    assert laid(tmp_path, {"plane": "strain"}).claims == paper.claims
    without = laid(tmp_path, dict.fromkeys(EXTRAS))
    assert (without.aspect_study, without.transient, without.rig, without.claims) == (None,) * 4
    assert without.procedure() == paper.procedure()
    assert len(without.scenes()) == 168
    assert load(DEFAULT, MINIMAL).claims


def test_what_follows_from_the_grid_is_a_config_again() -> None:
    config = yaml.safe_load(DEFAULT.read_text(encoding="utf-8"))
    campaign = Campaign.from_config(config | dict.fromkeys(EXTRAS))
    assert Campaign.from_config(config | campaign.choices()) == campaign


def test_wavelength_stands_for_two_pi_over_it(tmp_path: Path) -> None:
    road = laid(tmp_path, {"road": "r", "roads": {"r": [{"amplitude": 0.01, "wavelength": 0.2}]}}).road
    assert road[0].wavelength == pytest.approx(0.2, rel=1e-11)
    assert road[0].wavenumber == 31.4159265359


def test_every_fault_of_a_config_is_named_at_once(tmp_path: Path) -> None:
    rubber = {"youngs_modulus": -3, "poissons_ratio": 0.49, "shear_fractions": [0.7], "relaxation_times": [1, "x"]}
    other = rubber | {"youngs_modulus": 3, "shear_fractions": [0.5, 0.3, 0.2], "relaxation_times": [1, 2, 3], "k_i": 1}
    road = [{"amplitude": 0.01}, {"amplitude": 0.01, "wavenumber": 5, "wavelength": 1}]
    with pytest.raises(InvalidInput) as caught:
        laid(
            tmp_path,
            {"rubber": "mien", "rubbers": {"mine": rubber, "other": other}, "roads": {"r": road}, "plain": 1},
            {"grid": GRID, "figures": {"total_pressure": 7, "fields": {"scale": 9}}, "numerics": {"preset": "draftt"}},
        )
    found = [
        "rubbers.mine.youngs_modulus is -3 MPa",
        "rubbers.mine.relaxation_times[1] is the text 'x'",
        "rubbers.other has the unknown key 'k_i'",
        "roads.r[0] lacks the key 'wavenumber'",
        "roads.r[1] has both wavenumber and wavelength",
        "config has the unknown key 'plain'",
        "numerics.preset is 'draftt'",
        "figures.total_pressure has 7, but must be chosen from grid.pressures",
    ]
    assert len(caught.value.faults) == len(found)
    for place, (sentence, fault) in enumerate(zip(caught.value.faults, found, strict=True), 1):
        assert sentence.startswith(fault)
        assert f"\n  {place}. {sentence}" in str(caught.value)


def test_paths_are_those_of_a_shell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("WORK", "there")
    monkeypatch.delenv("NOWHERE", raising=False)
    for given, place in (("~/a", f"{tmp_path}/a"), ("$WORK/a", "there/a"), ("${WORK}s/a", "theres/a")):
        assert laid(tmp_path, {"results": given}).results == place
    for given, says in (("$NOWHERE/a", "variable NOWHERE is not set"), ("~nobody-at-all/a", "there is no such user")):
        with pytest.raises(InvalidInput, match=says):
            laid(tmp_path, {"results": given})


@pytest.mark.parametrize("key", ["results", "rubber", "numerics", "grid", "rig"])
def test_aliases_that_grow_without_end_are_refused_at_once(tmp_path: Path, key: str) -> None:
    lines = ["a0: &a0 [x, x]", *(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12))]
    path = tmp_path / "bomb.yaml"
    path.write_text("\n".join([*lines, f"{key}: *a11"]), encoding="utf-8")
    with pytest.raises(InvalidInput) as caught:
        load(DEFAULT, path)
    assert max(map(len, caught.value.faults)) < 500


def test_config_that_is_not_in_utf8_is_named_with_the_line(tmp_path: Path) -> None:
    for content, byte in (
        (b"plane: stress\n# \xfcber\n", "line 2 has the byte 0xfc"),
        ("a: 1".encode("utf-16"), "0xff"),
    ):
        path = tmp_path / "mine.yaml"
        path.write_bytes(content)
        with pytest.raises(InvalidInput, match=rf"mine.yaml is not valid YAML: it is not in UTF-8, since .*{byte}"):
            load(DEFAULT, path)


def test_config_to_begin_with_is_a_campaign_and_replaces_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "my tread-2.yaml"
    assert cli.main(["init", str(path)]) == 0
    campaign = load(DEFAULT, path)
    assert campaign.material.name == campaign.road_name == "my_tread_2"
    assert campaign.unlikely() == []
    assert len(campaign.scenes()) == 16
    before = path.read_text()
    assert cli.main(["init", str(path)]) == 2
    assert "exists, and is left as it is" in capsys.readouterr().err
    assert path.read_text() == before
    with pytest.raises(InvalidInput, match=r"must have a name that ends in .yaml"):
        begin(tmp_path / "mine")
    with pytest.raises(InvalidInput, match=r"mine.yaml cannot be written: there is no such folder$"):
        begin(tmp_path / "nowhere" / "mine.yaml")
