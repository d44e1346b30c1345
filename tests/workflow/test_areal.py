"""Areal roads in a campaign: their scenes and figures are made once, and again where the road is another."""

from __future__ import annotations

from pathlib import Path

import pytest
from page_links import page_faults
from project_copy import Project

from rubfric.results.dataset import read
from rubfric.results.tables import read_table
from rubfric.road.self_affine import SelfAffine

SCAN = """aISO-1.0
NumPoints = 20
NumProfiles = 20
Xscale = 5e-5
Yscale = 5e-5
Zscale = 1e-9
*
"""
MINE = """
results: results/mine
areal: [runway, scanned]
road: one
roads:
  one: [{amplitude: 0.015, wavenumber: 35}]
  runway: {nodes_max: 64, areal: {self_affine: {hurst: 0.8, period: 1.0, cut_off: 0.125, rms_slope: 0.25}}}
  scanned: {nodes_max: 32, profiles: 0, areal: {scan: {file: scan.sdf, cut_off: 0.25}}}
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
    heights = SelfAffine(hurst=0.8, period=1.0, cut_off=0.25, rms_slope=0.25).spectrum.heights((20, 20))
    scan = project.root / "scan.sdf"
    scan.write_text(SCAN + "\n".join(" ".join(f"{1e6 * one:.0f}" for one in row) for row in heights) + "\n*\n")
    jobs = {"scene": 2, "areal_scene": 4, "areal_profiles": 2, "areal_table": 2, "areal_figure": 2}
    assert jobs.items() <= project.plan().jobs.items()
    project.run()
    made = project.root / "results/mine"
    found = [read(path) for path in sorted((made / "areal").rglob("runway/*.nc"))]
    assert [one.attrs["velocity"] for one in found] == [100.0, 10.0]
    assert all(one.contact_pressure.shape == (64, 64) for one in found)
    assert (made / "figures/areal_runway.png").exists()
    table = read_table(made / "tables/areal_runway.csv", ["note"])
    assert (table["profiles"] == 16).all()
    assert table["plane_over_surface"].between(0.8, 1.2).all()
    page = (made / "tables/friction_total.html").read_text(encoding="utf-8")
    assert "on the areal road runway friction of its profiles in the plane model is" in page
    assert "areal road scanned" not in page
    assert page_faults(made) == []
    assert "plane_over_surface" not in read_table(made / "tables/areal_scanned.csv", ["note"])
    assert project.plan().jobs == {}
    config.write_text(MINE.replace("hurst: 0.8", "hurst: 0.7"), encoding="utf-8")
    assert {name: count for name, count in project.plan().jobs.items() if name != "all"} == {
        "areal_scene": 2,
        "areal_profiles": 2,
        "areal_table": 1,
        "areal_figure": 1,
        "total_table": 1,
        "curve_table": 1,
        "total_figure": 2,
        "explorer": 1,
    }
    scan.rename(project.root / "moved.sdf")
    config.write_text(MINE.replace("scan.sdf", "moved.sdf"), encoding="utf-8")
    assert project.plan().jobs == {}
