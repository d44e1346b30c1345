"""Curves of friction with added speeds: each is a job of its own, and what was solved once is not solved again."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from project_copy import Project

from rubfric.results.curves import ADDED, WORDS
from rubfric.results.limits import WHOLE
from rubfric.results.tables import read_table
from rubfric.results.temperature import COLUMN

pytestmark = pytest.mark.thorough

CURVES = """
results: results/curves
rubber: tread
rubbers:
  tread:
    {youngs_modulus: 3, poissons_ratio: 0.49, shear_fractions: [0.2, 0.6], relaxation_times: [1.0e-4, 1.0e-6],
     shift: {law: wlf, c1: 8, c2: 100, reference_temperature: 25}}
road: fine
roads:
  fine: [{amplitude: 0.01, wavelength: 0.2}, {amplitude: 0.003, wavelength: 0.05}]
grid: {velocities: [1, 30, 1000], pressures: [0.3], temperatures: [20], refine: 0.1}
kinematics: small
numerics: {preset: draft}
"""
NAMES = {"scale1_p0.3_T20", "scale2_p0.3_T20", "all_p0.3_T20"}


@pytest.fixture(scope="module")
def refined(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The campaign with added speeds, complete."""
    project = Project.from_source(tmp_path_factory.mktemp("refined"), options=("--configfile", "curves.yaml"))
    (project.root / "curves.yaml").write_text(CURVES)
    said = project.run()
    assert "grid.refine 0.1 adds 24 speeds at most to each of 3 curves of friction: 96 scenes and 24 of the" in said
    assert "3 refined curves" in said
    return project


def kept(project: Project) -> dict[str, int]:
    """Return the kept results by name, with their times."""
    return {path.stem: path.stat().st_mtime_ns for path in (project.results / ".cache").rglob("*.nc")}


def curves_of(text: str) -> set[str]:
    """Return the curves to which a run would add speeds."""
    return set(re.findall(r"Adding speeds to ([\w.]+)", text))


def test_curves_are_known_to_the_accuracy_and_peaks_carry_errors(refined: Project) -> None:
    tables = refined.results / "tables"
    points, peaks = (read_table(tables / f"{name}.csv", WORDS) for name in ("curves", "peaks"))
    assert peaks["curve"].tolist() == ["scale 1", "scale 2", WHOLE]
    assert set(peaks[COLUMN]) == {20.0}
    assert (peaks["interpolation_error"] <= 0.1).all() or peaks["note"].str.contains("known no better").any()
    assert (peaks["added"] >= 2).all()
    assert (points["point"] == ADDED).sum() == peaks["added"].sum()
    top = points.groupby("curve")["friction_coefficient"].max()[peaks["curve"]].to_numpy()
    assert (np.abs(peaks["peak_friction"] - top) <= peaks["peak_friction_error"]).all()
    assert "peaks" in (tables / "peaks.html").read_text()
    assert not refined.plan().jobs


def test_added_pressure_runs_its_own_curves_only(refined: Project, tmp_path: Path) -> None:
    project = refined.copy(tmp_path / "project")
    project.configure("grid.pressures", [0.3, 0.6], "curves.yaml")
    plan = project.plan()
    assert curves_of(plan.text) == {name.replace("0.3", "0.6") for name in NAMES}
    assert (plan.jobs["scene"], plan.jobs["whole_scene"], plan.jobs["refined_curve"]) == (6, 3, 3)


def test_edited_figure_and_table_add_no_speeds(refined: Project, tmp_path: Path) -> None:
    project = refined.copy(tmp_path / "project")
    project.comment("rubfric/figures/fig6.py", "workflow/rules/refine.smk")
    assert project.plan().jobs == {"campaign_figure": 1}
    project.comment("rubfric/results/peaks.py")
    plan = project.plan()
    assert not curves_of(plan.text)
    assert plan.jobs == {"curve_table": 1, "campaign_figure": 1, "total_figure": 1}


def test_added_speed_and_finer_accuracy_solve_what_is_new_only(refined: Project, tmp_path: Path) -> None:
    project = refined.copy(tmp_path / "project")
    before = kept(project)
    project.configure("grid.velocities", [1, 30, 300, 1000], "curves.yaml")
    project.configure("grid.refine", 0.05, "curves.yaml")
    assert curves_of(project.plan().text) == NAMES
    project.run("curve_table")
    after = kept(project)
    assert before.items() < after.items()
    used = read_table(project.results / "tables" / "curves.csv", WORDS)
    assert (used["point"] == ADDED).sum() > 0


def test_without_refine_the_added_speeds_go_and_peaks_stay(refined: Project, tmp_path: Path) -> None:
    project = refined.copy(tmp_path / "project")
    project.edit("curves.yaml", lambda text: text.replace(", refine: 0.1", ""))
    assert project.plan().jobs == {"curve_table": 1, "campaign_figure": 1, "total_figure": 1}
    project.run()
    assert not [*(project.results / "refined").rglob("*.csv")]
    peaks = read_table(project.results / "tables" / "peaks.csv", WORDS)
    assert set(peaks["added"]) == {0}
    assert (peaks["interpolation_error"] > 0.1).all()
