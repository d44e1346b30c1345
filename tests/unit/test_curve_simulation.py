"""Speeds added to a curve of friction: real scenes in small strain, solved once and kept."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import rubfric
from rubfric import curve_simulation
from rubfric.config.campaign import Campaign
from rubfric.curve_simulation import Sliding, added_points, sliding_of
from rubfric.errors import NotConverged
from rubfric.results.curves import curve_of
from rubfric.results.kept import path_of
from rubfric.results.provenance import refusal
from rubfric.scene.scene import Scene

ACCURACY = 0.05
CONFIG = {
    "kinematics": "small",
    "numerics": {"preset": "draft"},
    "grid": {"velocities": [1, 100], "pressures": [0.5], "aspect": 0.75, "refine": ACCURACY},
    "road": "fine",
    "roads": {"fine": [{"amplitude": 0.003, "wavenumber": 200}]},
}


class Ready:
    """A campaign of one scale in a folder, with its results, and which scenes were solved since."""

    def __init__(self, folder: Path, **config: Any) -> None:
        self.folder, self.solved = folder, list[Scene]()
        self.campaign: Campaign = rubfric.load(CONFIG | config)
        self.scales = self._write(self.campaign.scenes())
        roads = self.campaign.whole_roads
        scenes = self.campaign.whole_scenes()
        self.whole = {
            draw: self._write({name: one for name, one in scenes.items() if name == draw + one.name}) for draw in roads
        }

    def _write(self, scenes: Mapping[str, Scene]) -> dict[str, str]:
        for name, scene in scenes.items():
            rubfric.write(rubfric.simulate(scene), self.folder / f"{name}.nc")
        return {str(self.folder / f"{name}.nc"): scene.digest for name, scene in scenes.items()}

    @property
    def sliding(self) -> Sliding:
        """Of the whole road."""
        one = next(iter(self.campaign.whole_scenes().values()), None)
        return sliding_of(
            [self.campaign.scene(1, 1.0, 0.5).parameters()],
            {"": one.parameters()} if one else {},
            self.campaign.whole_parameters(),
        )

    def solve(self, scene: Scene) -> Any:
        self.solved.append(scene)
        return rubfric.simulate(scene)


def test_added_speeds_are_solved_until_the_curve_is_known_and_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ready = Ready(tmp_path, multiscale="sum")
    monkeypatch.setattr(curve_simulation, "simulate", ready.solve)
    one = Sliding(ready.sliding.scales, {}, None)
    lines: list[str] = []
    table = added_points(one, ready.scales, {}, ACCURACY, tmp_path / "kept", lines.append)
    assert len(table) == len(lines) == len(ready.solved) > 1
    assert lines[0].startswith("1: 10 mm/s added, where friction may be off by ")
    curve = curve_of(one.rows(ready.scales, {}))
    assert curve is not None
    assert curve.worst > ACCURACY
    assert set(table["velocity_mm_per_s"]) == {scene.velocity for scene in ready.solved}
    # What is solved is solved once: for the whole road too, and by a coarser accuracy.
    count = len(ready.solved)
    again = added_points(one, ready.scales, {}, ACCURACY, tmp_path / "kept")
    assert again.equals(table)
    whole = added_points(ready.sliding, ready.scales, {}, ACCURACY, tmp_path / "kept")
    assert len(ready.solved) == count
    assert whole["friction_total"].tolist() == pytest.approx(table["friction_coefficient"].tolist()[: len(whole)])
    # So is what the campaign solved without the workflow.
    full = tmp_path / "full"
    for scene in ready.solved:
        rubfric.write(rubfric.simulate(scene), path_of(full, scene))
    assert added_points(one, ready.scales, {}, ACCURACY, full).equals(table)
    assert len(ready.solved) == count
    # A file that was damaged is solved again.
    next((tmp_path / "kept").rglob("*.nc")).write_bytes(b"no result")
    assert added_points(one, ready.scales, {}, ACCURACY, tmp_path / "kept").equals(table)
    assert len(ready.solved) == count + 1


def test_a_speed_without_a_solution_is_left_out_and_a_refused_whole_road_has_its_stand_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ready = Ready(tmp_path, multiscale="direct")

    def fail(scene: Scene) -> Any:
        if scene.scale == "all" and scene.velocity == 10.0:
            raise NotConverged(scene.name, 1, 1.0, "nodes")
        if scene.velocity < 10.0:
            raise NotConverged("a scale", 1, 1.0, "nodes")
        return ready.solve(scene)

    monkeypatch.setattr(curve_simulation, "simulate", fail)
    lines: list[str] = []
    table = added_points(ready.sliding, ready.scales, ready.whole, ACCURACY, tmp_path / "kept", lines.append)
    ways = dict(zip(table["velocity_mm_per_s"], table["way"], strict=True))
    assert ways[10.0] == "corrected"
    assert min(ways) == 10.0
    assert "3.162 mm/s has no friction: a scale: " in "".join(lines)


def test_a_whole_road_that_is_not_needed_is_not_solved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ready = Ready(tmp_path, multiscale="auto")
    monkeypatch.setattr(curve_simulation, "simulate", ready.solve)
    table = added_points(ready.sliding, ready.scales, ready.whole, ACCURACY, tmp_path / "kept")
    assert set(table["way"]) == {"sum"}  # one scale is no coupling
    assert {scene.scale for scene in ready.solved} == {1}
    assert refusal(ready.solved[0], "x").attrs["scene_digest"] in {
        path.stem for path in (tmp_path / "kept").rglob("*.nc")
    }
