"""The whole road, told in another way, has the same friction; one wave is a scale, and filled waves do not interact."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from whole_road import CAMPAIGN, ROAD, mirrored, pinned, scaled, shifted, whole_scene, with_wave

from rubfric.mechanics.block.contact import solve_contact
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.theory.layer import full_contact_friction, full_contact_pressure
from rubfric.road.waves import WaveRoad
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

COLUMNS = 1024
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
LOADS = pytest.mark.parametrize(("velocity", "pressure"), [(1.0, 0.5), (10.0, 5.0), (1000.0, 0.5), (1000.0, 5.0)])
ROUTES = ("stress_power", "dissipation", "contact")


def routes(scene: Scene) -> list[float]:
    found = evaluate(solve(scene))
    return [getattr(found, route) for route in ROUTES]


@PLANES
@pytest.mark.parametrize(("scale", "velocity", "pressure"), [(1, 10.0, 5.0), (2, 1.0, 8.0), (3, 100.0, 0.5)])
def test_one_wave_is_the_scene_of_its_scale(plane: str, scale: int, velocity: float, pressure: float) -> None:
    scene = CAMPAIGN.scene(scale, velocity, pressure, plane=plane, kinematics="small")
    alone = WaveRoad((scene.road.waves.amplitudes[0],), (scene.road.waves.wavenumbers[0],), (0.0,))
    expected, found = solve(scene), solve(dataclasses.replace(scene, scale="all", road=alone))
    assert [(mesh.columns, mesh.rows) for mesh in found.meshes] == [
        (mesh.columns, mesh.rows) for mesh in expected.meshes
    ]
    np.testing.assert_array_equal(found.contact.touching, expected.contact.touching)
    np.testing.assert_allclose(
        found.contact.pressure, expected.contact.pressure, atol=1e-9 * expected.contact.pressure.max()
    )
    for route in ROUTES:
        assert getattr(evaluate(found), route) == pytest.approx(getattr(evaluate(expected), route), rel=1e-9)


@PLANES
@pytest.mark.parametrize("velocity", [1.0, 1000.0])
def test_filled_the_whole_road_is_the_sum_of_its_scales(plane: str, velocity: float) -> None:
    low = scaled(ROAD, heights=0.05)
    scene = whole_scene(velocity, 1.0, plane=plane, road=low)
    pressure = 1.05 * full_contact_pressure(scene.material, low, velocity, scene.height, plane) * len(low.amplitudes)
    scene = dataclasses.replace(scene, pressure=pressure, numerics=pinned(4096, 1.03))
    solution = solve(scene)
    assert solution.contact.touching.all()
    total, closed = 0.0, 0.0
    for scale, amplitude in zip(CAMPAIGN.road, low.amplitudes, strict=True):
        one = dataclasses.replace(scale, amplitude=amplitude)
        # The block of the whole road, as high and as finely meshed.
        aspect = scene.height / one.wavelength
        numerics = pinned(2048 if scale is CAMPAIGN.road[0] else 1024, 1.03)
        part = dataclasses.replace(scene, scale=1, road=one, aspect=aspect, numerics=numerics)
        total += evaluate(solve(part)).stress_power
        closed += full_contact_friction(scene.material, one, velocity, pressure, scene.height, plane)
    assert evaluate(solution).stress_power == pytest.approx(total, rel=1e-3)
    assert evaluate(solution).stress_power == pytest.approx(closed, rel=1e-3)


@LOADS
def test_shifted_by_whole_columns_nothing_changes(velocity: float, pressure: float) -> None:
    scene = whole_scene(velocity, pressure, numerics=pinned(COLUMNS))
    moved = dataclasses.replace(scene, road=shifted(ROAD, 77 * ROAD.period / COLUMNS))
    assert routes(moved) == pytest.approx(routes(scene), rel=1e-8)


@LOADS
def test_shifted_anyhow_friction_stays_within_its_stated_errors(velocity: float, pressure: float) -> None:
    one = solve(whole_scene(velocity, pressure))
    for distance in (0.0137, 0.3777):
        two = solve(whole_scene(velocity, pressure, road=shifted(ROAD, distance)))
        difference = abs(two.friction.stress_power - one.friction.stress_power)
        assert 0.0 < difference <= friction_error(one) + friction_error(two)


@LOADS
def test_described_with_twice_its_period_nothing_changes(velocity: float, pressure: float) -> None:
    twice = with_wave(ROAD, 0.0, 37.5)
    assert twice.period == pytest.approx(2.0 * ROAD.period, rel=1e-12)
    scene = whole_scene(velocity, pressure, numerics=pinned(COLUMNS))
    doubled = dataclasses.replace(scene, road=twice, numerics=pinned(2 * COLUMNS))
    assert routes(doubled) == pytest.approx(routes(scene), rel=1e-8)


def test_described_with_twice_its_period_it_gets_cells_as_small() -> None:
    one, two = solve(whole_scene(1000.0, 0.5)), solve(whole_scene(1000.0, 0.5, road=with_wave(ROAD, 0.0, 37.5)))
    assert two.block.columns == pytest.approx(2 * one.block.columns, rel=0.5)  # one refinement more or less
    difference = abs(two.friction.stress_power - one.friction.stress_power)
    assert difference <= friction_error(one) + friction_error(two)


@LOADS
@pytest.mark.parametrize("factor", [8.0, 1e-3])
def test_lengths_and_speed_scaled_together_nothing_changes(velocity: float, pressure: float, factor: float) -> None:
    scene = whole_scene(velocity, pressure, numerics=pinned(COLUMNS))
    larger = dataclasses.replace(scene, road=scaled(ROAD, factor), velocity=factor * velocity)
    assert routes(larger) == pytest.approx(routes(scene), rel=1e-8)


@LOADS
def test_waves_in_another_order_or_in_two_parts_are_the_same_road(velocity: float, pressure: float) -> None:
    scene = whole_scene(velocity, pressure, numerics=pinned(COLUMNS))
    first, *others = zip(ROAD.amplitudes, ROAD.wavenumbers, ROAD.phases, strict=True)
    parts = [*reversed(others), (0.25 * first[0], *first[1:]), (0.75 * first[0], *first[1:])]
    cut = WaveRoad(*(tuple(column) for column in zip(*parts, strict=True)))
    assert routes(dataclasses.replace(scene, road=cut)) == pytest.approx(routes(scene), rel=1e-8)


def slide(scene: Scene, velocity: float) -> float:
    """Return friction by contact of a block that may slide either way."""
    block, road = Resolution(COLUMNS, 1.15).block(scene), scene.road
    response = respond(block, scene.material, velocity, block.harmonics[1:])
    everywhere = np.ones(block.columns, dtype=bool)
    profile = road.height(block.column_positions)
    contact = solve_contact(np.append(0.0, response.compliance), profile, scene.pressure, everywhere)
    return float(np.mean(contact.pressure * road.slope(block.column_positions)) / scene.pressure)


@LOADS
def test_mirrored_and_slid_the_other_way_friction_is_the_opposite(velocity: float, pressure: float) -> None:
    road = dataclasses.replace(ROAD, phases=(0.3, 1.1, 4.0, 5.2))
    there = whole_scene(velocity, pressure, road=road)
    back = dataclasses.replace(there, road=mirrored(road))
    friction = slide(there, velocity)
    assert friction > 0.1
    assert slide(back, -velocity) == pytest.approx(-friction, rel=1e-8)
    # It is the mirror and the direction together: such a road has friction of its own either way.
    assert abs(slide(back, velocity) / friction - 1.0) > 1e-3
    scene = dataclasses.replace(there, numerics=pinned(COLUMNS))
    twice = dataclasses.replace(scene, road=mirrored(mirrored(road)))
    assert routes(twice) == pytest.approx(routes(scene), rel=1e-8)
