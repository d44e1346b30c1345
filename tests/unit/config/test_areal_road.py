"""Areal roads of the config: read, refused in one sentence with their place, and no road of a campaign."""

from __future__ import annotations

from typing import Any

import pytest

from rubfric.config.campaign import load
from rubfric.errors import InvalidInput
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
    found = {name: entry.road() for name, entry in campaign.areal_roads.items()}
    assert found["runway"] == SelfAffine(**ROUGH)
    assert found["crossed"] == ArealWaves(**{name: tuple(values) for name, values in CROSSED.items()})
    assert campaign.road_name not in found


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({}, "roads.runway.areal must have one of self_affine and waves"),
        ({"waves": CROSSED, "self_affine": ROUGH}, "roads.runway.areal must have one of self_affine and waves"),
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
