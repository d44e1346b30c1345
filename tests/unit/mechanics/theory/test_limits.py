"""Contacts too light for a mesh are refused, with the lightest pressure that is not."""

from __future__ import annotations

import re
from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

from rubfric.errors import InvalidInput, NotConverged
from rubfric.marching import march
from rubfric.mechanics.theory.limits import (
    estimated_fraction,
    fewest_nodes,
    near_crests,
    require_columns,
    require_height,
    require_resolvable,
    require_resolved,
)
from rubfric.road.profile import ProfileRoad
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

RUBBER = Material("plain", 4.17, 0.49, (0.5,), (1e-3,))
SCENE = Scene(1, SineScale(0.015, 35.0), 1.0, 0.5, 0.75, RUBBER)


def at(pressure: float, **changes: object) -> Scene:
    return replace(SCENE, pressure=pressure, **changes)  # type: ignore[arg-type]


def test_fraction_is_one_on_a_filled_and_on_a_flat_road() -> None:
    assert estimated_fraction(at(100.0)) == 1.0
    assert estimated_fraction(replace(SCENE, road=SineScale(0.0, 35.0))) == 1.0


def test_fraction_grows_as_the_root_of_a_light_load() -> None:
    assert estimated_fraction(at(1e-4)) == pytest.approx(10.0 * estimated_fraction(at(1e-6)), rel=1e-3)


@pytest.mark.parametrize("fraction", [1e-6, 0.1, 0.5, 1.0, 3.0])
def test_nodes_near_the_crest_are_where_the_road_is_highest(fraction: float) -> None:
    flags = near_crests(SCENE.road, 64, fraction)
    height = np.sin(2.0 * np.pi * np.arange(64) / 64)
    assert flags.any()
    assert flags[np.argmax(height)]
    assert flags.sum() == pytest.approx(64 * min(fraction, 1.0), abs=1.0)
    if not flags.all():
        assert height[flags].min() >= height[~flags].max() - 1e-12


def test_the_pressure_that_a_refusal_names_is_allowed_and_a_lighter_one_is_not() -> None:
    with pytest.raises(InvalidInput, match="do this instead") as refused:
        require_resolvable(at(1e-9), 4096, "do this instead")
    named = re.search(r"at least about (\S+) MPa", str(refused.value))
    assert named is not None
    require_resolvable(at(float(named[1])), 4096, "")
    with pytest.raises(InvalidInput, match="fewer than 8 surface nodes"):
        require_resolvable(at(0.1 * float(named[1])), 4096, "")


@pytest.mark.parametrize("profile", [True, False])
def test_walls_of_a_profile_do_not_refuse_a_contact_that_has_nodes(profile: bool) -> None:
    # Persson's theory gives less than 4 nodes of 4096; blocks were solved with 26 on such profiles.
    heights = 0.3 * np.sin(2.0 * np.pi * np.arange(1024) / 1024)
    heights[300:500] -= 2.0
    sines = WaveRoad((0.3, 0.09), (np.pi / 20.0, 16.0 * np.pi), (0.0, 0.0))
    road = ProfileRoad.of_heights(heights, 40.0, 0.4) if profile else sines
    scene = replace(SCENE, scale="all", road=road, aspect=0.2)
    light = replace(scene, pressure=3.0 * scene.pressure / (4096 * estimated_fraction(scene)))
    assert 4096 * estimated_fraction(light) < 4.0
    with nullcontext() if profile else pytest.raises(InvalidInput, match="fewer than 8 surface nodes"):
        require_resolvable(light, 4096, "")


def test_columns_that_a_refused_march_is_told_to_take_are_enough() -> None:
    with pytest.raises(InvalidInput, match=r"procedure\.columns is 32") as refused:
        require_columns(at(1e-5), 32, 2.0)
    named = re.search(r"at least about (\d+)", str(refused.value))
    assert named is not None
    require_columns(at(1e-5), int(named[1]), 2.0)


def test_contact_of_few_nodes_is_no_result() -> None:
    touching = np.arange(256) < 8
    require_resolved(SCENE, touching, 3, "")
    with pytest.raises(
        NotConverged, match=r"surface nodes in contact, out of 256, is 7; at least 8 make a prediction: .*do this"
    ):
        require_resolved(SCENE, touching & (np.arange(256) > 0), 3, "do this")


def test_whoever_asks_for_fewer_nodes_gets_them() -> None:
    few = replace(SCENE, numerics=Numerics(finite_contact_nodes=4))
    assert (fewest_nodes(SCENE), fewest_nodes(few)) == (8, 4)
    require_resolved(few, np.arange(256) < 4, 3, "")


@pytest.mark.parametrize(
    ("kinematics", "way"), [("finite", "kinematics: small"), ("small", "numerics.columns_max allows")]
)
def test_simulation_refuses_before_it_solves(kinematics: str, way: str) -> None:
    with pytest.raises(InvalidInput, match=f"pressure of .* is 1e-12 MPa, but must be at least .*{way}"):
        simulate(at(1e-12, kinematics=kinematics))


@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_the_pressure_that_a_flattened_block_is_told_of_is_allowed_and_a_heavier_one_is_not(plane: str) -> None:
    with pytest.raises(InvalidInput, match="of the height of the relaxed block") as refused:
        require_height(at(1e3, plane=plane))
    named = re.search(r"at most (\S+) MPa", str(refused.value))
    assert named is not None
    require_height(at(1.0 * float(named[1]), plane=plane))
    with pytest.raises(InvalidInput, match="outside the model's range"):
        require_height(at(1.01 * float(named[1]), plane=plane))


@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_flattened_block_is_refused_steady_and_in_time(plane: str) -> None:
    flattened = at(1e3, plane=plane, kinematics="finite")
    for slide in (simulate, march):
        with pytest.raises(InvalidInput, match="but must be at most"):
            slide(flattened)
