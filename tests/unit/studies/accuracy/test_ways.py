"""The knob multiscale: totals add scenes of scales, with the coupling's bound, and are judged by all waves at once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import rubfric
from rubfric.errors import NotConverged
from rubfric.mechanics.theory.coupling import WAYS, estimate
from rubfric.scene.scene import ALL, Scene
from rubfric.studies.accuracy import ways
from rubfric.studies.accuracy.converged import Converged
from rubfric.studies.accuracy.ladder import COLUMNS
from rubfric.studies.accuracy.scenes import total_scenes
from rubfric.studies.accuracy.ways import measure_ways, single_scales

CAMPAIGN = rubfric.load(Path(rubfric.__file__).resolve().parent.parent / "config" / "config.yaml")
NUMBERS = ["friction_coefficient", "error", "estimate", "seconds"]


@pytest.fixture
def scene() -> Scene:
    return CAMPAIGN.scene(ALL, 100.0, 0.5, plane="strain", kinematics="small")


@pytest.fixture
def solved(monkeypatch: pytest.MonkeyPatch, scene: Scene) -> Callable[..., None]:
    """Let every scene have a known friction, each scale a tenth of its number, and all at once what is given."""

    def install(direct: float = 0.8, refused: int = 0) -> None:
        def row(given: Scene) -> dict[str, Any]:
            number = 0 if given.scale == ALL else int(given.scale)
            if number and number == refused:
                return {"note": "too light"}
            friction = 0.1 * number or direct
            numbers = dict.fromkeys(("iterations", "krylov", "memory_MB", "columns", "rows"), number)
            cost = {"estimate": 0.01 * friction, "seconds": 2.0 if number else 4.0, "kinematics": "small"}
            return numbers | cost | {"friction_coefficient": friction, "note": ""}

        monkeypatch.setattr(ways, "measure_steady", row)
        monkeypatch.setattr(ways, "converge", lambda given: Converged(0.8, 1e-4, 1024, 100, "small"))

    return install


def test_single_scales_are_those_of_the_campaign(scene: Scene) -> None:
    wanted = [CAMPAIGN.scene(number, 100.0, 0.5, plane="strain", kinematics="small") for number in (1, 2, 3, 4)]
    for found, single in zip(single_scales(scene), wanted, strict=True):
        assert found.name == single.name
        assert found.height == pytest.approx(single.height, rel=1e-9)
        assert found.road.steepest_slope == pytest.approx(single.road.steepest_slope, rel=1e-9)


def test_every_way_is_judged_by_all_waves_at_once(scene: Scene, solved: Callable[..., None]) -> None:
    solved()
    table = measure_ways("some", scene)
    assert list(table.columns) == list(COLUMNS)
    assert set(table["knob"]) == {ways.KNOB}
    found = table.set_index("rung")
    assert list(found.index) == [*WAYS, ways.DIRECT]
    coupling = estimate(scene.material, scene.road, 100.0, 0.5, scene.height, "strain", "small")
    single = 0.1 + 0.2 + 0.3 + 0.4
    for way in WAYS:
        row, total = found.loc[way], coupling.total(way, single)
        assert row["friction_coefficient"] == pytest.approx(total, rel=1e-9)
        assert row["error"] == pytest.approx(abs(total / 0.8 - 1.0), rel=1e-9)
        bound = 0.01 * total + coupling.error(way) * total
        assert row["estimate"] == pytest.approx(bound / 0.8, rel=1e-9)
        assert row["seconds"] > 8.0  # four scenes and the estimate
        assert (row["columns"], row["iterations"]) == (4, 10)
    assert found.loc["sum", "friction_coefficient"] == pytest.approx(single)
    assert (found.loc["direct", "error"], found.loc["direct", "estimate"]) == pytest.approx((0.0, 0.01))


@pytest.mark.parametrize("refused", [1, 4])
def test_total_without_one_of_its_scales_has_a_note_and_no_numbers(
    scene: Scene, solved: Callable[..., None], refused: int
) -> None:
    solved(refused=refused)
    found = measure_ways("some", scene).set_index("rung")
    assert set(found.loc[list(WAYS), "note"]) == {"too light"}
    assert found.loc[list(WAYS), NUMBERS].isna().all(axis=None)
    assert found.loc["direct", NUMBERS].notna().all()


def test_coupling_that_is_not_found_leaves_the_direct_way(
    scene: Scene, solved: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    solved()

    def refuse(given: Scene) -> None:
        raise NotConverged(given.name, 3, 0.5, "something")

    monkeypatch.setattr(ways, "_coupling", refuse)
    found = measure_ways("some", scene).set_index("rung")
    assert found.loc[list(WAYS), "note"].str.contains("something is 0.5").all()
    assert found.loc["direct", NUMBERS].notna().all()


def test_scenes_are_of_the_whole_road_in_both_kinematics_and_planes() -> None:
    scenes = total_scenes(CAMPAIGN)
    for kinematics in ("small", "finite"):
        own = [scene for name, scene in scenes.items() if name == f"{kinematics}_{scene.name}"]
        assert {scene.kinematics for scene in own} == {kinematics}
        assert {scene.plane for scene in own} == {"stress", "strain"}
    assert all(scene.road == CAMPAIGN.whole_road for scene in scenes.values())
