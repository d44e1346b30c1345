"""A campaign at several temperatures: complete, and an added temperature runs its own scenes only."""

from __future__ import annotations

from pathlib import Path

import pytest
from project_copy import Project

from rubfric.results.campaign import read
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table
from rubfric.results.temperature import COLUMN

pytestmark = pytest.mark.thorough

WARM = """
results: results/warm
rubber: tread
rubbers:
  tread:
    {youngs_modulus: 3, poissons_ratio: 0.49, shear_fractions: [0.2, 0.6], relaxation_times: [1.0e-4, 1.0e-6],
     shift: {law: wlf, c1: 8, c2: 100, reference_temperature: 25}}
road: fine
roads:
  fine: [{amplitude: 0.01, wavelength: 0.2}, {amplitude: 0.003, wavelength: 0.05}]
grid: {velocities: [3, 30], pressures: [0.3], temperatures: [20, 60]}
kinematics: small
numerics: {preset: draft}
transient: {velocities: [30], columns: 32, steps_per_wavelength: 16, wavelengths: 2}
claims: {compare: [plane_strain]}
rig: {}
"""


@pytest.fixture(scope="module")
def warm(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The campaign at two temperatures, complete."""
    project = Project.from_source(tmp_path_factory.mktemp("warm"), options=("--configfile", "warm.yaml"))
    (project.root / "warm.yaml").write_text(WARM)
    said = project.run()
    assert "8 scenes: 2 scales at 2 speeds and 1 load at 2 temperatures, 4 of the whole road" in said
    assert "at 60 degC (a_T = 0.00843) E' is" in said
    return project


def test_tables_and_pages_know_the_temperature(warm: Project) -> None:
    campaign = read(warm.results / "campaign.nc")
    assert campaign["temperature"].values.tolist() == [20.0, 60.0]
    totals = read_table(warm.results / "tables" / "friction_total.csv", WORDS)
    assert totals[COLUMN].tolist() == [20.0, 20.0, 60.0, 60.0]
    for scale in (1, 2):
        table = read_table(warm.results / "tables" / f"friction_scale_{scale}.csv", ())
        found = campaign["friction_coefficient"].sel(scale=scale, pressure=0.3, aspect=0.75)
        assert table["friction_coefficient"].tolist() == pytest.approx(found.T.values.ravel().tolist(), rel=1e-5)
    assert "Of 2 temperatures, claims are judged at 20 degC." in (warm.results / "claims.html").read_text()
    assert '"temperatures":[20.0,60.0],"shown":20.0' in (warm.results / "explorer.html").read_text()
    figures = {path.stem for path in (warm.results / "figures").glob("*.png")}
    assert figures == {f"fig{number}" for number in (2, 4, 5, 6, 7, 8, 9, 10, 11, 12)}
    assert not warm.plan().jobs


def test_added_temperature_runs_its_own_scenes_only(warm: Project, tmp_path: Path) -> None:
    project = warm.copy(tmp_path / "project")
    before = set(project.scene_files)
    project.configure("grid.temperatures", [20, 40, 60], "warm.yaml")
    plan = project.plan()
    assert plan.scenes == set(project.campaign.scenes()) - before
    assert all("_T40_" in name for name in plan.scenes)
    assert plan.figures == {"fig6", "fig7", "fig9", "fig10", "fig12"}
    assert (plan.jobs["scene"], plan.jobs["whole_scene"]) == (4, 2)
    assert not {"march", "reading", "field_figure", "whole_figure"} & set(plan.jobs)
