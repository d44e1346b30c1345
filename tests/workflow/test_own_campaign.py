"""A config with nothing but rubber, road and grid: the grid alone is run, under its own title."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from page_links import page_faults
from project_copy import Project

MINE = """
results: results/mine
rubber: tread
rubbers:
  tread: {youngs_modulus: 3, poissons_ratio: 0.49, shear_fractions: [0.2, 0.6], relaxation_times: [1.0e-4, 1.0e-6]}
road: fine
roads:
  fine: [{amplitude: 0.01, wavelength: 0.2}, {amplitude: 0.003, wavelength: 0.04}]
grid: {velocities: [3, 30], pressures: [0.3]}
numerics: {preset: draft}
"""
OF_THE_PAPER = {"march", "march_figure", "reading", "claims", "rig_points", "rig_figure", "rig_schematic"}


@pytest.fixture(scope="module")
def mine(tmp_path_factory: pytest.TempPathFactory) -> Project:
    project = Project.from_source(tmp_path_factory.mktemp("mine"), options=("--configfile", "mine.yaml"))
    (project.root / "mine.yaml").write_text(MINE)
    return project


def pages(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in folder.rglob("*.html")}


def test_grid_alone_is_planned_and_the_run_says_what_it_understood(mine: Project) -> None:
    plan = mine.plan()
    assert {name: plan.jobs.get(name, 0) for name in ("scene", "whole_scene", "scale_table")} == {
        "scene": 4,
        "whole_scene": 2,
        "scale_table": 2,
    }
    assert not OF_THE_PAPER & set(plan.jobs)
    assert plan.figures == {"fig2", "fig4", "fig6", "fig7", "fig10", "fig11"}
    for said in (
        "a campaign of your own, the grid only",
        "scale 2: wavelength 0.04 mm, amplitude 0.003 mm, steepest slope 0.471",
        "4 scenes: 2 scales at 2 speeds and 1 load, 2 of the whole road",
    ):
        assert said in plan.text
    assert re.search(r"Would be made: 4 scenes, .*; in about \d+ s\n", plan.text)


@pytest.mark.thorough
def test_slips_and_all_faults_stop_it_before_any_job(mine: Project) -> None:
    (mine.root / "pascal.yaml").write_text("rubbers: {tread: {youngs_modulus: 3.0e+6}}")
    done = Project(mine.root, (*mine.options, "pascal.yaml")).snakemake("-n")
    assert "The config is wrong: rubbers.tread.youngs_modulus is 3e+06 MPa, " in done.stderr
    assert "probably in Pa, 3 MPa." in done.stderr
    assert done.returncode == 1
    done = mine.snakemake("-n", "--config", "plane=flat", "rubber=thread")
    assert "there are 2 faults\n  1. plane is 'flat', " in done.stderr
    assert "\n  2. rubber is 'thread', " in done.stderr


@pytest.mark.thorough
def test_pages_are_those_of_the_grid_and_nothing_of_an_earlier_road_stays(mine: Project) -> None:
    mine.run()
    found = pages(mine.results)
    tables = {"friction_scale_1.html", "friction_scale_2.html", "friction_total.html", "peaks.html"}
    assert found.keys() == {"index.html", "explorer.html", *tables}
    assert all("<title>Friction of rubber tread on road fine" in page for page in found.values())
    payload = json.loads(re.findall(r'<script id="payload".*?>(.*?)</script>', found["explorer.html"], re.DOTALL)[0])
    assert (payload["speeds"], payload["pressures"]) == ([3.0, 30.0], [0.3])
    assert [scale["number"] for scale in payload["scales"]] == [1, 2]
    users = mine.results / "tables" / "friction_scale_9.csv"
    users.write_text("of the user\n")
    mine.edit("mine.yaml", lambda text: text.replace(", {amplitude: 0.003, wavelength: 0.04}", ""))
    assert re.search(r"removed, since an earlier config .*friction_scale_2.csv, .*friction_scale_2.html\n", mine.run())
    assert users.exists()
    assert pages(mine.results).keys() == {"index.html", "explorer.html", *tables} - {"friction_scale_2.html"}
    assert page_faults(mine.results) == []
