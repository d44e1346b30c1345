"""A campaign that ran: everything is there, and nothing is left to do."""

from __future__ import annotations

import subprocess
import sys

from project_copy import Plan, Project

FIGURES = {"fig1", "fig2", "fig3", "fig4", "fig5", "fig6", "fig7", "fig8", "fig9"}


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


def test_tables_and_figures_are_there(template: Project) -> None:
    scales = {f"friction_scale_{scale}.csv" for scale in range(1, 5)}
    assert set(template.tables) == {"friction_total.csv", "rig_points.csv", "rig_rejected.csv", *scales}
    expected = {f"{figure}.{kind}" for figure in FIGURES for kind in ("pdf", "png")}
    assert {path.name for path in (template.results / "figures").iterdir()} == expected
    assert (template.results / "campaign.nc").is_file()


def test_every_job_has_a_log(template: Project) -> None:
    logs = template.results / "logs"
    assert {path.stem for path in (logs / "scenes").rglob("*.log")} == set(template.scene_files)
    assert {path.stem for path in (logs / "figures").iterdir()} == FIGURES
    # One job writes two tables of the rig.
    assert {f"{path.stem}.csv" for path in (logs / "tables").iterdir()} == set(template.tables) - {"rig_rejected.csv"}
    for path in (logs / "scenes").rglob("*.log"):
        assert "\nfriction coefficient   " in path.read_text()


def test_no_half_made_file_is_left(template: Project) -> None:
    assert not list(template.results.rglob(".*"))
    assert not list(template.results.rglob("*.part"))


def test_nothing_is_written_outside_the_folder_of_results(template: Project) -> None:
    done = {path.name for path in template.root.iterdir()}
    source = {path.name for path in Project.from_source(template.root.parent / "untouched").root.iterdir()}
    assert done - source <= {"results", ".snakemake"}
    assert [path.name for path in (template.root / "results").glob("[!.]*")] == ["minimal"]


def test_second_run_does_nothing(project: Project) -> None:
    written = {path: path.stat().st_mtime_ns for path in project.results.rglob("*")}
    assert "Nothing to be done" in project.run()
    assert {path: path.stat().st_mtime_ns for path in project.results.rglob("*")} == written


def test_whole_campaign_from_nothing_is_planned(empty_project: Project) -> None:
    plan = empty_project.plan()
    assert plan.jobs == {
        "scene": 18,
        "campaign": 1,
        "scale_table": 4,
        "total_table": 1,
        "campaign_figure": 4,
        "field_figure": 2,
        "march": 1,
        "march_figure": 1,
        "rig_points": 1,
        "rig_figure": 1,
        "rig_schematic": 1,
    }
    assert plan.scenes == set(empty_project.campaign.scenes())
    assert plan.figures == FIGURES


def test_targets_ask_for_a_part(empty_project: Project) -> None:
    tables = empty_project.plan("tables").jobs
    assert tables == {"scene": 18, "campaign": 1, "scale_table": 4, "total_table": 1, "tables": 1}
    one = "results/minimal/scenes/zhou2019/zhou2019/scale2_v1_p5_aspect0.75_stress.nc"
    assert empty_project.plan(one).jobs == {"scene": 1}


def test_plan_tells_nothing_from_something() -> None:
    assert Plan.read("Nothing to be done (all requested files are present and up to date).") == Plan(
        {}, set(), set(), "Nothing to be done (all requested files are present and up to date)."
    )
