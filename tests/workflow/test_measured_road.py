"""A campaign on a measured road: its page is made, and scenes follow the profile."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from page_links import page_faults
from project_copy import Project

from rubfric import load
from rubfric.results.tables import read_table
from rubfric.total_simulation import friction as friction_of

MINE = """
results: results/mine
road: street
roads: {street: {profile: street.csv, scales: 2, cutoff: 4, cutoffs: [8], windows: 2}}
grid: {velocities: [10], pressures: [0.3], aspect: 0.75}
kinematics: small
multiscale: direct
numerics: {preset: draft}
"""


@pytest.mark.thorough
def test_page_and_scenes_follow_the_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project = Project.from_source(tmp_path / "project", options=("--configfile", "own/mine.yaml"))
    own = project.root / "own"
    own.mkdir()
    text = (project.root / "examples/own_road/street.csv").read_text(encoding="utf-8")
    data, config = own / "street.csv", own / "mine.yaml"
    data.write_text(text, encoding="utf-8")
    config.write_text(MINE)
    plan = project.plan()
    # Two windows, the same down to a longer cutoff, and the sines.
    jobs = {"scene": 2, "whole_scene": 5, "road_read": 1, "road_friction": 1, "road_figure": 2}
    assert jobs.items() <= plan.jobs.items()
    assert "road street is 500 mm of own/street.csv" in plan.text
    project.run()
    made = project.root / "results/mine/roads"
    assert "Mean profile depth, ISO 13473-1" in (made / "street.html").read_text(encoding="utf-8")
    row = pd.read_csv(made.parent / "tables/friction_total.csv").iloc[0]
    assert (row["way"], row["note"]) == ("direct", "mean of 2 windows of the measured road")
    assert row["friction_road_error"] > 0.0
    monkeypatch.chdir(project.root)
    again = friction_of(load(config), progress=pytest.fail)  # all results are there
    assert again["friction_total"][0] == pytest.approx(row["friction_total"], rel=1e-5)
    assert again["friction_road_error"][0] == pytest.approx(row["friction_road_error"], rel=1e-5)
    friction = read_table(made / "street_friction.csv", ["way", "note"])
    ways = ["direct", "direct", *["persson"] * 4, "sines", "sum"]
    assert (friction["way"].tolist(), friction["cutoff_mm"].tolist()) == (ways, [8, 4, 2, 1, 0.5, 0.25, 4, 4])
    direct, total = friction.iloc[1], friction.iloc[-1]
    assert direct["friction_coefficient"] == pytest.approx(row["friction_total"], rel=1e-5)
    assert direct["friction_road_error"] == pytest.approx(row["friction_road_error"], rel=1e-5)
    assert total["friction_coefficient"] == pytest.approx(row["friction_sum"], rel=1e-5)
    assert page_faults(made.parent) == []
    page = (made / "street_friction.html").read_text(encoding="utf-8")
    assert "waves of 8 mm and longer carry" in page
    assert "Which waves carry friction" in page
    assert "Sines instead of the profile" in page
    assert (made.parent / "figures/road_cutoff.pdf").stat().st_size > 5000
    base = project.root / "config/config.yaml"
    assert load(base, made / "street.yaml").road == load(base, config).road
    assert project.plan().jobs == {}
    # Another comment is another file, of the same road: its pages and tables alone.
    data.write_text(text.replace("not a measurement", "no measurement"), encoding="utf-8")
    assert project.plan().jobs == {"road_read": 1, "road_friction": 1, "road_figure": 2}
    data.write_text("\n".join(text.splitlines()[:6000]), encoding="utf-8")
    assert jobs.items() <= project.plan().jobs.items()
