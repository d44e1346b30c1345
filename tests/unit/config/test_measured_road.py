"""A road of the config of which a profile was measured: what it is made into, and what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from rubfric import Scene, load
from rubfric.config.cutoffs import cutoff_scenes
from rubfric.config.overlay import placed, read_yaml
from rubfric.errors import InvalidInput
from rubfric.results.whole_road import WholeRoad
from rubfric.road.sine import SineScale
from rubfric.runner.opening import understood

STREET = Path(__file__).resolve().parents[3] / "examples/own_road/street.csv"


def road(entry: Any) -> dict[str, Any]:
    return {"road": "street", "roads": {"street": entry}}


def measured(**keys: Any) -> dict[str, Any]:
    return road({"profile": str(STREET), "cutoff": 0.5} | keys)


def test_profile_becomes_the_scales_of_the_road() -> None:
    campaign = load(measured(scales=3))
    assert campaign.survey is not None
    assert campaign.road == tuple(SineScale(*scale) for scale in campaign.survey.scales)
    assert len(campaign.road) == 3
    assert campaign.phases == (0.0, 0.0, 0.0)
    assert campaign.whole_road.period <= 4.0 * campaign.whole_road.wavelength
    assert "500 mm of" in campaign.survey.words
    assert load(measured(scales=3, window=30)).road != campaign.road
    # The same campaign as by the scales that it was made into.
    scales = [{"amplitude": one.amplitude, "wavenumber": one.wavenumber} for one in campaign.road]
    assert load(road(scales)).scene("all", 100.0, 0.3) == campaign.scene("all", 100.0, 0.3)
    assert load(road(scales)).survey is None


def test_path_counts_from_the_folder_of_the_config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "mine").mkdir()
    shutil.copy(STREET, tmp_path / "mine/street.csv")
    config = tmp_path / "mine/mine.yaml"
    config.write_text("road: street\nroads: {street: {profile: street.csv, cutoff: 0.5}}\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    campaign = load("mine/mine.yaml")
    assert campaign.survey is not None
    assert campaign.survey.source == "mine/street.csv"
    assert campaign.road == load(measured()).road
    # As Snakemake has read it.
    written = {"road": "street", "roads": {"street": {"profile": "street.csv"}}}
    assert placed(written, ["mine/mine.yaml"])["roads"]["street"]["profile"] == "mine/street.csv"
    assert read_yaml(config)["roads"] == {"street": {"profile": "mine/street.csv", "cutoff": 0.5}}


def test_windows_of_the_profile_take_the_place_of_the_sines_where_the_whole_road_is_simulated() -> None:
    campaign = load(measured(windows=3, cutoff=4, block_height=6, scales=2) | {"multiscale": "auto"})
    assert campaign.survey is not None
    assert list(campaign.whole_roads) == ["window1/", "window2/", "window3/"]
    assert campaign.multiscale.way == "direct"
    scenes = campaign.whole_scenes()
    assert len(scenes) == 3 * len(campaign.velocities) * len(campaign.pressures)
    assert all(scene.height == pytest.approx(6.0, rel=1e-5) for scene in scenes.values())
    assert {scene.road for scene in scenes.values()} == set(campaign.survey.windows)
    name, scene = next(iter(scenes.items()))
    assert name == f"window1/{scene.name}"
    # A file of results holds the road as its waves.
    assert Scene.from_parameters(scene.parameters()).digest == scene.digest
    # Models of the coupling are judged by the sines, under a block of that height.
    road = WholeRoad.from_parameters(campaign.whole_parameters())
    assert (road.count, len(road.roads), road.height) == (3, 1, 6.0)
    sines = load(measured(scales=2, cutoff=4) | {"multiscale": "direct"})
    assert list(sines.whole_roads) == [""]
    assert "windows" not in sines.whole_parameters()
    summed = load(measured(windows=3) | {"multiscale": "sum"})
    assert not summed.whole_roads
    assert any("and itself over 3 windows" in line for line in understood(campaign, False))
    assert not any("itself over" in line for line in understood(summed, False))


def test_windows_slide_down_to_longer_cutoffs_too_at_one_pressure() -> None:
    campaign = load(measured(windows=2, cutoff=2, cutoffs=[2, 8]) | {"multiscale": "direct"})
    scenes, speeds = cutoff_scenes(campaign), campaign.velocities
    assert len(scenes) == (2 + 1) * len(speeds)
    assert {scene.pressure for scene in scenes.values()} == {campaign.figures.total_pressure}
    assert [scene.height for scene in scenes.values()] == pytest.approx([8.0] * len(scenes), rel=1e-5)
    name, scene = next(iter(scenes.items()))
    assert name == f"cutoff8/window1/{scene.name}"
    assert campaign.survey is not None
    # The same window without its finer waves.
    assert scene.road.amplitudes == campaign.survey.windows[0].amplitudes[:5]
    assert [one.road for one in scenes.values()][-1] == campaign.whole_road
    # By default twice and four times the cutoff, as far as windows are twice as long.
    for cutoff, found in ((2, [8, 4]), (8, [16]), (15, [])):
        survey = load(measured(windows=1, cutoff=cutoff)).survey
        assert survey is not None
        assert list(survey.coarser) == found
    for entry in ({"windows": 0}, {"windows": 2}):
        assert not cutoff_scenes(load(measured(cutoff=2, **entry) | {"multiscale": "sum"}))


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        ({"profile": "none.csv"}, "roads.street.profile is 'none.csv', but there is no such file; a relative path"),
        (
            {"profile": str(STREET), "window": 600},
            "roads.street: the window is 600 mm long, .* longest window is 454 mm",
        ),
        (
            {"profile": str(STREET), "cutoff": 0.01},
            "roads.street: cutoff is 0.01 mm, but must be at least 0.1 mm, twice",
        ),
        ({"profile": str(STREET), "window": 10, "cutoff": 8}, "roads.street.cutoff is 8 mm, .* half of window, 5 mm"),
        ({"profile": str(STREET), "unit": "furlong"}, "roads.street: unit is 'furlong', but must be one of mm, m,"),
        ({"profile": str(STREET), "unit": "km"}, r"roads.street: .* a road of 500 km .* say it with unit$"),
        (
            {"profile": str(STREET), "amplitude": 1.0},
            "roads.street has both profile and amplitude: a road is a profile",
        ),
        ({"profile": str(STREET), "cutof": 1.0}, r"unknown key 'cutof'; .*\(did you mean cutoff\?\)"),
        ({"profile": str(STREET), "scales": 0}, "roads.street.scales is 0, but must be a whole number of at least 1"),
        ({"profile": str(STREET), "windows": 99}, "roads.street: windows is 99, but the profile has 12 of 40 mm"),
        (
            {"profile": str(STREET), "cutoff": 2, "cutoffs": [4, 1]},
            "roads.street: cutoffs has 1 mm, but each must be from cutoff, 2 mm, to half of window, 20 mm",
        ),
        ({"profile": str(STREET), "cutoffs": [4, -1]}, r"roads.street.cutoffs\[1\] is -1 mm"),
        (
            {"profile": str(STREET), "windows": 2, "block_height": 0.001},
            "roads.street: block_height is 0.001 mm, but on windows of 40 mm must be from 0.4 to 400 mm",
        ),
        ({"scales": 3}, "roads.street lacks the key 'profile'"),
        ([], r"roads.street is \[\], but must be a list of at least one scale"),
        ([{"amplitude": 1.0}], r"roads.street\[0\] lacks the key 'wavenumber'"),
    ],
)
def test_what_is_refused(entry: Any, words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        load(road(entry))


def test_windows_have_no_random_phases() -> None:
    with pytest.raises(InvalidInput, match=r"^phases.draws is 4, but must be 0 where roads.street has windows"):
        load(measured(windows=2) | {"phases": {"draws": 4}})


def test_a_scale_beyond_those_of_the_profile_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"aspect_study.scales is 4, but must be one of the road's scales, 1 to 3"):
        load(measured(scales=3) | {"aspect_study": {"aspects": [0.5], "scales": [4], "pressures": [1.0]}})
