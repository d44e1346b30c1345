"""A campaign that ran: everything is there, and nothing is left to do."""

from __future__ import annotations

import re
import subprocess
import sys
from urllib.parse import unquote

import numpy as np
import pandas as pd
import pytest
from check import Page
from page_links import page_faults
from project_copy import Plan, Project

from rubfric.results.campaign import read
from rubfric.results.dataset import load
from rubfric.results.selection import refusals

FIGURES = {f"fig{number}" for number in range(1, 12)}


def test_copy_uses_its_own_package(template: Project) -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import rubfric; print(rubfric.__file__)"],
        cwd=template.root,
        env=template.environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == str(template.root / "rubfric" / "__init__.py")


def test_every_scene_has_a_result_and_nothing_else_has(template: Project) -> None:
    assert set(template.scene_files) == set(template.campaign.scenes())
    assert len(template.scene_files) == 18


def test_every_scene_of_the_whole_road_has_a_result_or_a_reason(template: Project) -> None:
    scenes = template.campaign.whole_scenes()
    folder = template.results / "whole" / "zhou2019" / "zhou2019"
    assert {path.stem for path in folder.iterdir()} == set(scenes)
    refused = {name for name in scenes if "refusal" in load(folder / f"{name}.nc").attrs}
    whole = read(template.results / "whole.nc")
    assert len(refusals(whole)) == len(refused) <= 1 < len(scenes) == 4
    assert int(whole["friction_coefficient"].notnull().sum()) == len(scenes) - len(refused)
    table = pd.read_csv(template.results / "tables" / "friction_total.csv")
    assert (table["way"] == "direct").sum() == len(scenes) - len(refused)
    assert table["refused"].sum() == len(refused)
    parts = table[["friction_numerical_error", "friction_coupling_error"]].sum(axis=1)
    np.testing.assert_allclose(table["friction_total_error"], parts, rtol=1e-5)
    for name in refused:
        assert (template.results / "logs/whole/zhou2019/zhou2019" / f"{name}.log").read_text().startswith("Refused: ")


def test_command_gives_the_friction_that_the_workflow_gives(template: Project) -> None:
    command = [sys.executable, "-m", "rubfric.cli", "friction", "--config", "config/minimal.yaml", "--csv"]
    done = subprocess.run(
        command, cwd=template.root, env=template.environment, capture_output=True, text=True, check=True
    )
    assert "solving" not in done.stderr
    assert done.stdout == (template.results / "tables" / "friction_total.csv").read_text()


def test_tables_and_figures_are_there(template: Project) -> None:
    scales = {f"friction_scale_{scale}.csv" for scale in range(1, 5)}
    assert set(template.tables) == {"friction_total.csv", *scales}
    others = {f"{name}.csv" for name in ("rig_points", "rig_rejected", "claims", "claims_evidence", "curves", "peaks")}
    assert {path.name for path in (template.results / "tables").glob("*.csv")} == set(template.tables) | others
    expected = {f"{figure}.{kind}" for figure in FIGURES for kind in ("pdf", "png")}
    assert {path.name for path in (template.results / "figures").iterdir()} == expected
    assert (template.results / "campaign.nc").is_file()
    assert 1_000_000 < (template.results / "explorer.html").stat().st_size < 10_000_000


def test_claims_are_judged_here_and_in_the_other_reading(template: Project) -> None:
    claims = pd.read_csv(template.results / "tables" / "claims.csv")
    whole = claims[claims["pressure_MPa"] == "all"]
    assert set(whole["reading"]) == {"campaign", "plane_strain"}
    assert list(whole.loc[whole["reading"] == "campaign", "claim"]) == [f"C{number}" for number in range(1, 10)]
    verdicts = {"holds", "holds in part", "does not hold", "not decided"}
    assert set(claims["verdict"].str.removesuffix(" (simulated)")) <= verdicts
    assert set(claims.loc[claims["verdict"].str.endswith(" (simulated)"), "claim"]) == {"C8"}
    page = (template.results / "claims.html").read_text()
    assert page.count('class="verdict') >= len(whole)


def test_every_job_has_a_log(template: Project) -> None:
    logs = template.results / "logs"
    assert {path.stem for path in (logs / "scenes").rglob("*.log")} == set(template.scene_files)
    assert {path.stem for path in (logs / "figures").iterdir()} == FIGURES
    assert {f"{path.stem}.csv" for path in (logs / "tables").iterdir()} == {
        *template.tables,
        "rig_points.csv",
        "curves.csv",
    }
    for path in (logs / "scenes").rglob("*.log"):
        assert "\nfriction coefficient   " in path.read_text()


def test_run_is_told_in_a_few_lines(template: Project) -> None:
    lines = (template.results / "logs" / "run.log").read_text().splitlines()
    assert "  18 of 18 scenes" in "\n".join(lines)
    (end,) = (number for number, line in enumerate(lines) if line.startswith("  Done in "))
    assert "4 of 4 scenes of the whole road" in "\n".join(lines)
    counts = "18 scenes, 4 scenes of the whole road, 1 march, 10 batches of other readings"
    made = f": {counts}, 6 tables, 10 figures, 7 other jobs"
    assert lines[end].endswith(made)
    assert re.match(r"  slowest: (march of )?(scale|all)\S+ .* s, ", lines[end + 1])
    assert lines[end + 2].startswith("  CPU time behind these results ")
    assert lines[end + 3].startswith("  largest estimated error of friction ")
    assert re.match(r"  (none|\d+) of 18 scenes carr", lines[end + 4])
    assert lines[end + 5].startswith("  largest error of the whole road's friction ")
    assert lines[-1].startswith("  open first: results/minimal/index.html, results/minimal/claims.html, ")
    assert end < 60


def test_pages_lead_to_what_there_is_and_the_first_to_all(template: Project) -> None:
    assert page_faults(template.results) == []
    linked = {(template.results / unquote(link)).resolve() for link in Page(template.results / "index.html").links}
    shown = [
        *template.results.glob("*.html"),
        *template.results.glob("tables/[!.]*"),
        *template.results.glob("figures/*"),
    ]
    assert {path.resolve() for path in shown} - linked == {(template.results / "index.html").resolve()}


def test_no_half_made_file_is_left(template: Project) -> None:
    # What `rubfric friction` has solved is kept in .cache.
    assert not [path for path in template.results.rglob(".*") if path.suffix != ".sha256" and path.name != ".cache"]
    assert not list(template.results.rglob("*.part"))


def test_nothing_is_written_outside_the_folder_of_results(template: Project) -> None:
    done = {path.name for path in template.root.iterdir()}
    source = {path.name for path in Project.from_source(template.root.parent / "untouched").root.iterdir()}
    assert done - source <= {"results", ".snakemake"}
    assert [path.name for path in (template.root / "results").glob("[!.]*")] == ["minimal"]


def test_second_run_does_nothing(project: Project) -> None:
    written = {path: path.stat().st_mtime_ns for path in project.results.rglob("*")}
    said = project.run()
    assert "Nothing to be done" in said
    assert "\n  tables are in results/minimal/tables, " in said
    assert {path: path.stat().st_mtime_ns for path in project.results.rglob("*")} == written


@pytest.mark.thorough
def test_whole_campaign_from_nothing_is_planned(empty_project: Project) -> None:
    plan = empty_project.plan()
    assert plan.jobs == {
        "scene": 18,
        "campaign": 1,
        "scale_table": 4,
        "total_table": 1,
        "curve_table": 1,
        "whole_scene": 4,
        "whole_collection": 1,
        "campaign_figure": 3,
        "total_figure": 2,
        "whole_figure": 1,
        "field_figure": 2,
        "march": 1,
        "march_figure": 1,
        "reading": 10,
        "claims": 1,
        "explorer": 1,
        "rig_points": 1,
        "rig_figure": 1,
        "rig_schematic": 1,
    }
    assert plan.scenes == set(empty_project.campaign.scenes())
    assert plan.figures == FIGURES


def test_dry_run_tells_what_would_be_made_and_is_quiet(empty_project: Project) -> None:
    done = empty_project.snakemake("-n")
    assert done.returncode == 0
    counts = "18 scenes, 4 scenes of the whole road, 1 march, 10 batches of other readings"
    would = f"{counts}, 6 tables, 10 figures, 7 other jobs"
    assert f"  Would be made: {would}; in about " in done.stdout
    assert "a campaign of your own, the grid and aspect_study, transient, rig, claims\n" in done.stdout
    assert len((done.stdout + done.stderr).splitlines()) < 44
    assert not empty_project.results.exists()


@pytest.mark.thorough
def test_targets_ask_for_a_part(empty_project: Project) -> None:
    tables = empty_project.plan("tables").jobs
    whole = {"whole_scene": 4, "whole_collection": 1}
    assert tables == {"scene": 18, "campaign": 1, **whole, "scale_table": 4, "total_table": 1, "tables": 1}
    one = "results/minimal/scenes/zhou2019/zhou2019/scale2_v1_p0.5_aspect0.75_stress.nc"
    assert empty_project.plan(one).jobs == {"scene": 1}


def test_plan_tells_nothing_from_something() -> None:
    assert Plan.read("Nothing to be done (all requested files are present and up to date).") == Plan(
        {}, set(), set(), "Nothing to be done (all requested files are present and up to date)."
    )
