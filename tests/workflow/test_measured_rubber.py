"""A campaign of a measured rubber: its fit is repeated with new data or code, and scenes follow the rubber."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
import yaml
from page_links import page_faults
from project_copy import Project

from rubfric import load, simulate
from rubfric.results.dataset import read
from rubfric.results.selection import RUBBER_ERROR

MINE = """
results: results/mine
rubber: tread
rubbers: {tread: {measurements: dma.csv, law: wlf, uncertainty: 20}}
road: fine
roads: {fine: [{amplitude: 0.01, wavelength: 0.2}]}
grid: {velocities: [3.0, 1.0e+9], pressures: [0.3], aspect: 0.75}
kinematics: small
multiscale: sum
numerics: {preset: draft}
"""
SCENES = {"scene": 2, "campaign": 1, "scale_table": 1, "total_table": 1, "explorer": 1}


@pytest.mark.thorough
def test_fit_reruns_with_its_data_and_code_and_scenes_with_the_rubber(tmp_path: Path) -> None:
    project = Project.from_source(tmp_path / "project", options=("--configfile", "own/mine.yaml"))
    own = project.root / "own"
    own.mkdir()
    data, config = own / "dma.csv", own / "mine.yaml"
    text = (project.root / "examples/own_rubber/dma.csv").read_text(encoding="utf-8")
    data.write_text(text, encoding="utf-8")
    config.write_text(MINE)
    plan = project.plan()
    assert SCENES.items() <= plan.jobs.items()
    assert plan.jobs["rubber_fit"] == 1
    assert "rubber tread is fitted to own/dma.csv: 6 branches, WLF shifts" in plan.text
    assert "up to 3.14e+10 rad/s, beyond that" not in plan.text
    said = project.run()
    assert "from the data of the rubber" in said

    results = project.root / "results/mine"
    table = pd.read_csv(results / "tables/friction_scale_1.csv")
    assert (table["friction_beyond_window"] > 0.01).tolist() == [False, True]
    assert (table[RUBBER_ERROR] > 0.0).all()
    assert "Residual of E&#39;&#39;, rms" in (results / "rubbers/tread.html").read_text(encoding="utf-8")
    assert page_faults(results) == []
    fitted = load(project.root / "config/config.yaml", results / "rubbers/tread.yaml").material
    campaign = load(project.root / "config/config.yaml", config)
    assert fitted == campaign.material  # to the digits of a config
    scene = campaign.scene(1, 3.0, 0.3)
    held = read(results / f"scenes/tread/fine/{scene.name}.nc", scene.digest)
    assert float(held[RUBBER_ERROR]) == pytest.approx(float(simulate(scene)[RUBBER_ERROR]), rel=1e-6)

    assert project.plan().jobs == {}
    data.write_text(text.replace("not a measurement", "no measurement"), encoding="utf-8")
    project.comment("rubfric/dma/fit.py")
    assert project.plan().jobs == {"rubber_fit": 1}  # the rubber is the same
    config.write_text(MINE.replace("law: wlf", "law: wlf, seed: 1"))
    assert project.plan().jobs == {"rubber_fit": 1}
    lines = text.splitlines()
    data.write_text("\n".join([*lines[:8], *lines[20:]]) + "\n", encoding="utf-8")
    plan = project.plan()
    assert SCENES.items() <= plan.jobs.items()
    assert plan.jobs["rubber_fit"] == 1
    config.write_text(yaml.safe_dump(yaml.safe_load(MINE) | {"rubbers": {"tread": {"measurements": "none.csv"}}}))
    assert "The config is wrong: rubbers.tread.measurements is 'own/none.csv', but" in project.snakemake("-n").stderr
