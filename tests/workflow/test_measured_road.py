"""A campaign on a measured road: its page is made, and scenes follow the profile."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from project_copy import Project

from rubfric import load

MINE = """
results: results/mine
road: street
roads: {street: {profile: street.csv, scales: 2, cutoff: 4, windows: 2}}
grid: {velocities: [10], pressures: [0.3], aspect: 0.75}
kinematics: small
multiscale: direct
numerics: {preset: draft}
"""


@pytest.mark.thorough
def test_page_and_scenes_follow_the_profile(tmp_path: Path) -> None:
    project = Project.from_source(tmp_path / "project", options=("--configfile", "own/mine.yaml"))
    own = project.root / "own"
    own.mkdir()
    text = (project.root / "examples/own_road/street.csv").read_text(encoding="utf-8")
    data, config = own / "street.csv", own / "mine.yaml"
    data.write_text(text, encoding="utf-8")
    config.write_text(MINE)
    plan = project.plan()
    assert {"scene": 2, "whole_scene": 2, "road_read": 1}.items() <= plan.jobs.items()
    assert "road street is 500 mm of own/street.csv" in plan.text
    project.run()
    made = project.root / "results/mine/roads"
    assert "Mean profile depth, ISO 13473-1" in (made / "street.html").read_text(encoding="utf-8")
    row = pd.read_csv(made.parent / "tables/friction_total.csv").iloc[0]
    assert (row["way"], row["note"]) == ("direct", "mean of 2 windows of the measured road")
    assert row["friction_road_error"] > 0.0
    base = project.root / "config/config.yaml"
    assert load(base, made / "street.yaml").road == load(base, config).road
    assert project.plan().jobs == {}
    # Another comment is another file, of the same road: its page alone.
    data.write_text(text.replace("not a measurement", "no measurement"), encoding="utf-8")
    assert project.plan().jobs == {"road_read": 1}
    data.write_text("\n".join(text.splitlines()[:6000]), encoding="utf-8")
    assert {"scene": 2, "whole_scene": 2, "road_read": 1}.items() <= project.plan().jobs.items()
