"""Areal roads of the config: read, refused in one sentence with their place, and no road of a campaign."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from rubfric.config.campaign import load
from rubfric.errors import InvalidInput
from rubfric.profile.areal import scanned_road
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine
from rubfric.scene.areal import ArealScene

ROUGH = {"hurst": 0.8, "period": 1.0, "cut_off": 0.125, "rms_slope": 0.25}
CROSSED = {
    "amplitudes": [0.01, 0.01],
    "wavenumbers": [10.0, 10.0],
    "directions": [0, 90],
    "phases": [0, 0],
}


def roads(**areal: Any) -> dict[str, Any]:
    return {"roads": {"runway": {"areal": areal}}}


def test_surfaces_are_read_beside_the_roads_of_campaigns() -> None:
    campaign = load({"roads": {"runway": {"areal": {"self_affine": ROUGH}}, "crossed": {"areal": {"waves": CROSSED}}}})
    found = {name: entry.road(name) for name, entry in campaign.areal_roads.items()}
    assert found["runway"] == SelfAffine(**ROUGH)
    assert found["crossed"] == ArealWaves(**{name: tuple(values) for name, values in CROSSED.items()})
    assert campaign.road_name not in found


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({}, "roads.runway.areal must have one of self_affine, waves and scan"),
        ({"waves": CROSSED, "self_affine": ROUGH}, "roads.runway.areal must have one of self_affine, waves and scan"),
        ({"self_affine": ROUGH | {"rms_height": 1.0}}, "self_affine must have one of rms_slope and rms_height"),
        (
            {"self_affine": ROUGH | {"cut_off": 2}},
            "roads.runway.areal.self_affine.cut_off is 2 mm, but must be at most",
        ),
        ({"self_affine": ROUGH | {"hurts": 2}}, "roads.runway.areal.self_affine has the unknown key 'hurts'"),
        ({"waves": CROSSED | {"directions": [0]}}, "roads.runway.areal.waves has 2 amplitudes, 2 wavenumbers, 1 dir"),
        ({"waves": CROSSED | {"directions": [0, 33]}}, "roads.runway.areal.waves are 10 1/mm at 0 degrees, 10 1/mm at"),
    ],
)
def test_wrong_surfaces_are_refused_with_their_place(given: dict[str, Any], says: str) -> None:
    with pytest.raises(InvalidInput) as told:
        load(roads(**given))
    assert says in str(told.value)


def test_campaign_on_an_areal_road_is_refused_with_what_to_do() -> None:
    with pytest.raises(InvalidInput, match=r"road is runway, an areal road.*rubfric simulate --road runway"):
        load({"road": "runway"} | roads(self_affine=ROUGH))


def test_campaign_slides_over_areal_roads_beside_its_own() -> None:
    given = {"areal": ["runway"], "grid": {"velocities": [1, 10], "pressures": [0.3, 1.0], "aspect": 0.75}}
    surface = {"areal": {"self_affine": ROUGH}, "nodes_max": 64, "accuracy": 0.05}
    campaign = load(given | {"roads": {"runway": surface}})
    scenes = campaign.areal_scenes()
    assert list(scenes)[:2] == ["runway/areal_v1_p0.3_aspect0.75", "runway/areal_v10_p0.3_aspect0.75"]
    assert len(scenes) == 4
    scene = scenes["runway/areal_v10_p0.3_aspect0.75"]
    assert (scene.numerics.nodes_max, scene.numerics.accuracy, scene.material) == (64, 0.05, campaign.material)
    assert ArealScene.from_parameters(scene.parameters()) == scene
    with pytest.raises(InvalidInput, match=r"areal\[0\] is 'street', but must be one of runway"):
        load({"areal": ["street"], "roads": {"runway": surface}})


def sdf(side: int = 40, spacing: float = 0.025) -> str:
    """Return an areal scan of a self-affine road as text, of which a blended part goes on as the window begins."""
    heights = np.pad(SelfAffine(**ROUGH).spectrum.heights((40, 40)), ((0, 4), (0, 4)), mode="wrap")[:side, :side]
    rows = "\n".join(" ".join(f"{1e6 * one:.0f}" for one in row) for row in heights)
    names = {"NumPoints": side, "NumProfiles": side, "Xscale": 1e-3 * spacing, "Yscale": 1e-3 * spacing}
    header = "\n".join(f"{name} = {value}" for name, value in (names | {"Zscale": 1e-9, "DataType": 7}).items())
    return f"aISO-1.0\n{header}\n*\n{rows}\n*\n"


def scanned(folder: Path, held: str | None, **more: Any) -> Path:
    """Write a scan and a config beside it, and return the path of the config."""
    if held is not None:
        (folder / "runway.sdf").write_text(held, encoding="ascii")
    given = {"file": "runway.sdf", "form": "mean", "cut_off": 0.125} | more
    areal = {"scan": {name: value for name, value in given.items() if value is not None}}
    config = folder / "mine.yaml"
    config.write_text(yaml.safe_dump({"areal": ["runway"], "roads": {"runway": {"nodes_max": 64, "areal": areal}}}))
    return config


def test_scan_counts_from_its_config_and_scenes_from_its_heights(tmp_path: Path) -> None:
    config = scanned(tmp_path, sdf(44))
    campaign = load(config)
    road = campaign.areal_roads["runway"].road("runway")
    np.testing.assert_allclose(
        road.spectrum.heights((64, 64)), SelfAffine(**ROUGH).spectrum.heights((64, 64)), atol=2e-6
    )
    scene = next(iter(campaign.areal_scenes().values()))
    options = campaign.areal_scans()["runway"]
    assert options["path"].endswith("runway.sdf")
    assert ArealScene.from_parameters(scene.parameters(), scanned_road(**options)).digest == scene.digest
    moved = tmp_path / "moved"
    moved.mkdir()
    assert next(iter(load(scanned(moved, sdf(44))).areal_scenes().values())).digest == scene.digest
    other = load(scanned(moved, sdf(43)))
    assert next(iter(other.areal_scenes().values())).digest != scene.digest
    with pytest.raises(InvalidInput, match="another than the scene was planned for: run again"):
        ArealScene.from_parameters(scene.parameters(), other.areal_roads["runway"].road("runway"))


@pytest.mark.parametrize(
    ("held", "more", "says"),
    [
        (None, {}, r"roads\.runway\.areal\.scan\.file is '.*runway\.sdf', but there is no such file; a relative path"),
        ("", {}, r"roads\.runway\.areal\.scan: .*runway\.sdf is empty, but must hold an areal scan"),
        ("aISO-1.0\nNumPoints = 3\n*\n*\n", {}, r"roads\.runway\.areal\.scan: .* lacks a number in its header"),
        (
            sdf(44),
            {"cut_off": 2.0},
            r"roads\.runway\.areal\.scan: .*cut_off is 2 mm, but .* at most half of the window",
        ),
        (sdf(44), {"cut_off": None}, r"cut_off is missing, but must be at least 0\.0625 mm: nodes_max, 64, leaves 4"),
        (sdf(44), {"cut_off": 0.06}, r"cut_off is 0\.06 mm, but must be at least 0\.0625 mm"),
        (
            sdf(44),
            {"form": "plane"},
            r"roads\.runway\.areal\.scan\.form is 'plane', but must be one of mean, tilt, bow",
        ),
        (sdf(44), {"blend": 0.7}, r"roads\.runway\.areal\.scan\.blend is 0\.7, but must be at most 0\.5"),
    ],
)
def test_scans_that_are_no_road_are_refused(tmp_path: Path, held: str | None, more: dict[str, Any], says: str) -> None:
    with pytest.raises(InvalidInput, match=says):
        load(scanned(tmp_path, held, **more))
