"""Several rubbers on several roads: every pair is run and compared, and a further one runs its own scenes only."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pytest
from page_links import page_faults
from project_copy import Project

from rubfric.results.comparison import NAMES, RANKED
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table

pytestmark = pytest.mark.thorough

MINE = """
results: results/mine
rubber: [tread, hard]
road: [fine, coarse]
rubbers:
  tread: {youngs_modulus: 3, poissons_ratio: 0.49, shear_fractions: [0.2, 0.6], relaxation_times: [1.0e-4, 1.0e-6]}
  hard: {youngs_modulus: 5, poissons_ratio: 0.49, shear_fractions: [0.1, 0.3], relaxation_times: [1.0e-4, 1.0e-6]}
  third: {youngs_modulus: 4, poissons_ratio: 0.49, shear_fractions: [0.2, 0.5], relaxation_times: [1.0e-4, 1.0e-6]}
roads:
  fine: [{amplitude: 0.01, wavelength: 0.2}, {amplitude: 0.003, wavelength: 0.05}]
  coarse: [{amplitude: 0.02, wavelength: 0.4}]
grid: {velocities: [3, 300], pressures: [0.3]}
kinematics: small
multiscale: direct
phases: {draws: 3}
numerics: {preset: draft}
"""
COMPARISON = {"comparison_table": 1, "comparison_figure": 1, "explorer": 1}
Change = Callable[[str], str]


@pytest.fixture(scope="module")
def pairs(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The campaign of two rubbers on two roads, complete."""
    project = Project.from_source(tmp_path_factory.mktemp("pairs"), options=("--configfile", "mine.yaml"))
    (project.root / "mine.yaml").write_text(MINE)
    said = project.run()
    assert "3 other pairs: 8 scenes, 18 of the whole road" in said
    assert "tread grips more than hard on fine at 2 of 2 points" in said
    return project


def test_tables_and_figure_are_of_all_pairs(pairs: Project) -> None:
    tables = pairs.results / "tables"
    totals = read_table(tables / "friction_total.csv", WORDS)
    compared, ranked = (
        read_table(tables / f"{name}.csv", words) for name, words in (("comparison", NAMES), ("ranking", RANKED))
    )
    first = compared[(compared["rubber"] == "tread") & (compared["road"] == "fine")]
    assert first["friction_total"].tolist() == totals["friction_total"].tolist()
    assert len(compared) == 4 * 2
    assert len(ranked) == (2 + 2) * 2
    assert set(ranked["draws"]) == {3}
    row = ranked[(ranked["on"] == "fine") & (ranked["velocity_mm_per_s"] == 300.0)].iloc[0]
    each = {
        rubber: pd.read_csv(pairs.results / f"totals/{rubber}/fine/friction_total.csv").iloc[1]
        for rubber in ("tread", "hard")
    }
    differences = [each["tread"][f"friction_direct_{n}"] - each["hard"][f"friction_direct_{n}"] for n in (1, 2, 3)]
    # 4.303: Student's t at 97.5 % of two degrees of freedom.
    assert row["road_ci95"] == pytest.approx(4.303 * pd.Series(differences).std() / 3**0.5, rel=1e-3)
    assert row["difference"] == pytest.approx(
        each["tread"]["friction_total"] - each["hard"]["friction_total"], rel=1e-4
    )
    assert "tread grips more than hard on fine at 300 mm/s" in (tables / "ranking.html").read_text(encoding="utf-8")
    assert (pairs.results / "figures/fig13.pdf").exists()
    assert page_faults(pairs.results) == []
    assert pairs.plan().jobs == {}


@pytest.mark.parametrize(
    ("change", "scenes", "whole", "others"),
    [
        (lambda text: text.replace("[tread, hard]", "[tread, hard, third]"), 6, 12, {"pair_table": 2, **COMPARISON}),
        (lambda text: text.replace("[fine, coarse]", "[fine]"), 0, 0, COMPARISON),
        (lambda text: text.replace("youngs_modulus: 5", "youngs_modulus: 6"), 6, 12, {"pair_table": 2, **COMPARISON}),
    ],
    ids=["third", "one road", "another modulus"],
)
def test_only_what_is_new_runs(
    pairs: Project, tmp_path: Path, change: Change, scenes: int, whole: int, others: dict[str, int]
) -> None:
    project = pairs.copy(tmp_path / "project")
    project.edit("mine.yaml", change)
    plan = project.plan()
    assert plan.jobs == {
        **({"scene": scenes} if scenes else {}),
        **({"whole_scene": whole} if whole else {}),
        **others,
    }


def test_another_first_draws_its_own_of_the_same_scenes(pairs: Project, tmp_path: Path) -> None:
    project = pairs.copy(tmp_path / "project")
    project.edit("mine.yaml", lambda text: text.replace("[tread, hard]", "[hard, tread]"))
    jobs = project.plan().jobs
    assert not {"scene", "whole_scene", "pair_table"} & set(jobs)
    assert {"total_table": 1, "campaign": 1, **COMPARISON}.items() <= jobs.items()
    project.edit("mine.yaml", lambda text: text.replace("[hard, tread]", "hard").replace("[fine, coarse]", "fine"))
    said = project.run("tables")
    assert "comparison_table" not in said
    assert "ranking.csv" in said.partition("removed, since an earlier config made them")[2].partition("\n")[0]
    assert "Friction of rubber hard on road fine" in (project.results / "tables/friction_total.html").read_text()
