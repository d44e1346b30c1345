"""Areal roads in a campaign: their scenes and figures are made once, and again where the road is another."""

from __future__ import annotations

from pathlib import Path

import pytest
from project_copy import Project

from rubfric.results.dataset import read

MINE = """
results: results/mine
areal: [runway]
road: one
roads:
  one: [{amplitude: 0.015, wavenumber: 35}]
  runway: {nodes_max: 64, areal: {self_affine: {hurst: 0.8, period: 1.0, cut_off: 0.125, rms_slope: 0.25}}}
grid: {velocities: [10, 100], pressures: [0.3], aspect: 0.75}
kinematics: small
multiscale: sum
numerics: {preset: draft}
"""


@pytest.mark.thorough
def test_areal_scenes_are_made_once_and_follow_their_road(tmp_path: Path) -> None:
    project = Project.from_source(tmp_path / "project", options=("--configfile", "mine.yaml"))
    config = project.root / "mine.yaml"
    config.write_text(MINE, encoding="utf-8")
    jobs = {"scene": 2, "areal_scene": 2, "areal_figure": 1}
    assert jobs.items() <= project.plan().jobs.items()
    project.run()
    made = project.root / "results/mine"
    found = [read(path) for path in sorted((made / "areal").rglob("*.nc"))]
    assert [one.attrs["velocity"] for one in found] == [100.0, 10.0]
    assert all(one.contact_pressure.shape == (64, 64) for one in found)
    assert (made / "figures/areal_runway.png").exists()
    assert project.plan().jobs == {}
    config.write_text(MINE.replace("hurst: 0.8", "hurst: 0.7"), encoding="utf-8")
    assert {name: count for name, count in project.plan().jobs.items() if name != "all"} == {
        "areal_scene": 2,
        "areal_figure": 1,
    }
