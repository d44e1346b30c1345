"""Scenes on which accuracy is measured: the fixed set has everything in it, drawn ones are seeded and in range."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import rubfric
from rubfric.config.campaign import Campaign
from rubfric.mechanics.theory.limits import estimated_fraction
from rubfric.road.road import finest_waves
from rubfric.scene.scene import ALL, Scene
from rubfric.studies.accuracy.scenes import SETS, batches, drawn_scenes, finite_scenes, fixed_scenes, whole_scenes

CONFIG = Path(rubfric.__file__).resolve().parent.parent / "config" / "config.yaml"
COUNT, SEED = 60, 7


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    return rubfric.load(CONFIG)


@pytest.fixture(scope="module")
def drawn(campaign: Campaign) -> dict[str, Scene]:
    return drawn_scenes(campaign, COUNT, SEED)


def of(drawn: dict[str, Scene], kind: str) -> list[Scene]:
    return [scene for name, scene in drawn.items() if name.startswith(f"{kind}_")]


def test_fixed_set_has_every_scale_plane_and_kind_of_speed_and_load(campaign: Campaign) -> None:
    scenes = fixed_scenes(campaign)
    assert len(scenes) >= 16
    assert all(name == scene.name for name, scene in scenes.items())
    found = list(scenes.values())
    assert {scene.scale for scene in found} == {1, 2, 3, 4}
    for scale in (1, 2, 3, 4):
        own = [scene for scene in found if scene.scale == scale]
        assert {scene.plane for scene in own} == {"stress", "strain"}
        assert any(scene.velocity <= 1.0 for scene in own)  # slow
        assert any(10.0 <= scene.velocity <= 1000.0 for scene in own)  # near the peak
        assert any(scene.velocity == 1e4 for scene in own)  # fast
        assert any(scene.pressure <= 0.5 for scene in own)
        assert any(scene.pressure >= 5.0 for scene in own)
    assert min(scene.pressure for scene in found) == 0.1
    assert {0.25, 0.75, 1.5} <= {scene.aspect for scene in found}
    assert {scene.kinematics for scene in found} == {"auto"}


def test_fixed_set_lies_in_the_papers_grid(campaign: Campaign) -> None:
    for scene in fixed_scenes(campaign).values():
        assert 0.1 <= scene.velocity <= 1e4
        assert 0.1 <= scene.pressure <= 5.0
        assert scene.road == campaign.road[scene.scale - 1]
        assert scene.material == campaign.material
        assert scene.numerics == campaign.numerics


def test_drawn_scenes_have_names_of_their_own(drawn: dict[str, Scene]) -> None:
    assert list(drawn) == [f"{kind}_{number}" for kind in SETS for number in range(COUNT)]
    assert len(set(drawn.values())) == 2 * COUNT


def test_same_seed_draws_the_same_scenes(campaign: Campaign, drawn: dict[str, Scene]) -> None:
    assert drawn_scenes(campaign, COUNT, SEED) == drawn
    others = drawn_scenes(campaign, COUNT, SEED + 1)
    assert not set(others.values()) & set(drawn.values())


@pytest.mark.parametrize(
    ("kind", "velocities", "pressures", "aspects"),
    [
        ("inside", (0.1, 1e4), (0.1, 5.0), (0.25, 1.5)),
        ("outside", (1e-3, 1e6), (0.01, 10.0), (0.1, 3.0)),
    ],
)
def test_drawn_scenes_fill_their_range(
    drawn: dict[str, Scene],
    kind: str,
    velocities: tuple[float, float],
    pressures: tuple[float, float],
    aspects: tuple[float, float],
) -> None:
    for name, (low, high) in {"velocity": velocities, "pressure": pressures, "aspect": aspects}.items():
        shares = [math.log(getattr(scene, name) / low) / math.log(high / low) for scene in of(drawn, kind)]
        assert min(shares) >= 0.0
        assert max(shares) <= 1.0
        # Evenly over the logarithm: each fifth has some, and the mean is in the middle.
        assert {min(int(5.0 * share), 4) for share in shares} == {0, 1, 2, 3, 4}
        assert sum(shares) / COUNT == pytest.approx(0.5, abs=4.0 / math.sqrt(12.0 * COUNT))


def test_drawn_inside_is_the_papers_rubber_and_road(campaign: Campaign, drawn: dict[str, Scene]) -> None:
    scenes = of(drawn, "inside")
    assert {scene.scale for scene in scenes} == {1, 2, 3, 4}
    assert all(scene.road == campaign.road[scene.scale - 1] for scene in scenes)
    assert {scene.material for scene in scenes} == {campaign.material}


def test_drawn_outside_are_other_roads_and_often_other_rubbers(campaign: Campaign, drawn: dict[str, Scene]) -> None:
    scenes = of(drawn, "outside")
    assert all(0.03 <= scene.road.steepest_slope <= 1.0 for scene in scenes)
    assert all(2e-3 <= scene.road.wavelength <= 5.0 for scene in scenes)
    rubbers = [scene.material for scene in scenes if scene.material != campaign.material]
    assert COUNT / 4 < len(rubbers) < 3 * COUNT / 4
    for rubber in rubbers:
        assert 1 <= len(rubber.shear_fractions) <= 8
        assert 0.3 <= sum(rubber.shear_fractions) <= 0.99
        assert list(rubber.relaxation_times) == sorted(rubber.relaxation_times, reverse=True)
    assert {rubber.bulk for rubber in rubbers} == {"elastic", "proportional"}
    assert {rubber.poissons_ratio for rubber in rubbers} == {0.3, 0.45, 0.49, 0.499}


@pytest.mark.parametrize("kind", SETS)
def test_a_third_asks_for_small_strain_in_both_planes(drawn: dict[str, Scene], kind: str) -> None:
    scenes = of(drawn, kind)
    small = [scene for scene in scenes if scene.kinematics == "small"]
    assert len(small) == COUNT // 3
    assert {scene.kinematics for scene in scenes} == {"small", "auto"}
    assert {scene.plane for scene in small} == {scene.plane for scene in scenes} == {"stress", "strain"}


def test_whole_roads_are_the_papers_with_random_phases_and_others(campaign: Campaign) -> None:
    drawn = whole_scenes(campaign, COUNT, SEED)
    assert list(drawn) == [f"whole_{number}" for number in range(COUNT)]
    assert drawn == whole_scenes(campaign, COUNT, SEED)
    assert {scene.scale for scene in drawn.values()} == {ALL}
    papers, others = (list(drawn.values())[first::2] for first in (0, 1))
    whole = campaign.whole_road
    assert all((scene.road.amplitudes, scene.road.period) == (whole.amplitudes, whole.period) for scene in papers)
    assert len({scene.road.phases for scene in papers}) == len(papers)
    assert all(0.1 <= scene.velocity <= 1e4 and 0.1 <= scene.pressure <= 5.0 for scene in papers)
    waves = [len(scene.road.amplitudes) for scene in others]
    assert 2 <= min(waves) < 8 < 32 < max(waves) <= 64
    assert all(0.1 * (1.0 - 1e-9) <= scene.road.steepest_slope <= 3.0 * (1.0 + 1e-9) for scene in others)
    assert all(finest_waves(scene.road) <= 128 for scene in others)
    for scenes in (papers, others):
        assert {scene.kinematics for scene in scenes} == {"small"}
        assert {scene.plane for scene in scenes} == {"stress", "strain"}


@pytest.mark.parametrize("size", [1, 4, 5, 20])
def test_batches_hold_every_name_once_in_order(size: int) -> None:
    names = [f"inside_{number}" for number in range(10)]
    groups = list(batches(names, size))
    assert [name for group in groups for name in group] == names
    assert all(len(group) == size for group in groups[:-1])
    assert 1 <= len(groups[-1]) <= size


def test_whole_roads_in_finite_strain_are_light_and_fast_with_random_phases(campaign: Campaign) -> None:
    drawn = finite_scenes(campaign, COUNT, SEED)
    assert drawn == finite_scenes(campaign, COUNT, SEED)
    assert list(drawn) == [f"finite_{number}" for number in range(COUNT)]
    assert {(scene.scale, scene.kinematics, scene.plane) for scene in drawn.values()} == {
        (ALL, "finite", "stress"),
        (ALL, "finite", "strain"),
    }
    assert len({scene.road.phases for scene in drawn.values()}) == COUNT
    assert all(scene.velocity >= 50.0 and scene.pressure <= 0.6 for scene in drawn.values())
    assert max(estimated_fraction(scene) for scene in drawn.values()) < 0.1
