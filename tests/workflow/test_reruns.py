"""What reruns what: exactly the results that a change can touch, by dry runs."""

from __future__ import annotations

import os
import re
import shutil
import time
from typing import Any

import pytest
from project_copy import Project

TABLES = {"scale_table": 4, "total_table": 1}
CLAIMS = {"claims": 1}
RIG = {"rig_points": 1, "rig_figure": 1, **CLAIMS}
TOTALS = {"total_table": 1, "curve_table": 1, "total_figure": 2, **RIG, "explorer": 1}
CAMPAIGN = {"campaign": 1, **TABLES, "campaign_figure": 3, **TOTALS}
WHOLE = {"whole_scene": 4, "whole_collection": 1, "whole_figure": 1}
FIELDS = {"field_figure": 2, **CLAIMS}
MARCHES = {"march": 1, "march_figure": 1, **CLAIMS}
EVERYTHING = {"scene": 18, **CAMPAIGN, **FIELDS, **MARCHES, **WHOLE, "reading": 10}
CAMPAIGN_FIGURES = {"fig1", "fig3", "fig6"}
TOTAL_FIGURES = {"fig7", "fig10"}
FIELD_FIGURES = {"fig2", "fig4"}
DEFAULT = "config/config.yaml"


@pytest.mark.parametrize(
    ("at", "values", "count", "whole", "readings"),
    [
        ("grid.velocities", [1, 10, 100], 9, {"whole_scene": 2, "whole_collection": 1}, 5),
        pytest.param(
            *("grid.pressures", [0.2, 0.5, 1], 8, {"whole_scene": 2, "whole_collection": 1}, 10),
            marks=pytest.mark.thorough,
        ),
        pytest.param("aspect_study.aspects", [0.5, 0.75, 1.5], 2, {}, 2, marks=pytest.mark.thorough),
    ],
)
def test_another_value_runs_its_own_scenes_only(
    project: Project, at: str, values: list[float], count: int, whole: dict[str, int], readings: int
) -> None:
    before = set(project.campaign.scenes())
    project.configure(at, values)
    added = set(project.campaign.scenes()) - before
    plan = project.plan()
    assert len(added) == count
    assert plan.scenes == added
    assert plan.jobs == {"scene": count, **CAMPAIGN, **whole, "reading": readings}
    assert plan.figures == CAMPAIGN_FIGURES | TOTAL_FIGURES | {"fig9"}


@pytest.mark.thorough
def test_value_taken_away_runs_no_scene(project: Project) -> None:
    project.configure("aspect_study.aspects", [0.75])
    project.configure("grid.velocities", [100])
    project.configure("figures.fields.velocities", [100])
    plan = project.plan()
    whole = {"whole_collection": 1, "whole_figure": 1}
    assert plan.jobs == {**CAMPAIGN, **FIELDS, **whole, "reading": 1}  # a batch of the other reading is of fewer scenes


@pytest.mark.thorough
def test_other_choice_of_fields_draws_them_only(project: Project) -> None:
    project.configure("figures.fields.pressures", [0.5])
    plan = project.plan()
    assert plan.jobs == {**FIELDS, "total_figure": 1, "whole_figure": 1}
    assert plan.figures == FIELD_FIGURES | {"fig10", "fig11"}


@pytest.mark.thorough
def test_other_pressure_of_the_total_draws_its_figure_only(project: Project) -> None:
    project.configure("figures.total_pressure", 0.2)
    plan = project.plan()
    assert plan.jobs == {"total_figure": 2, **CLAIMS}
    assert plan.figures == TOTAL_FIGURES


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("at", "value"), [("rig.pressures", [1]), ("rig.virtual", {"seed": 1}), ("rig.virtual", {"sled_mass": 6})]
)
def test_other_rig_is_measured_and_drawn_alone(project: Project, at: str, value: Any) -> None:
    project.configure(at, value)
    assert project.plan().jobs == RIG


@pytest.mark.thorough
def test_measured_runs_take_the_place_of_the_virtual_rig_or_are_named_as_missing(project: Project) -> None:
    data = [f"data/run{number}.csv" for number in (1, 2)]
    for name in (*data, "data/rig.yaml", "data/pull.csv"):
        (project.root / name).parent.mkdir(exist_ok=True)
        (project.root / name).write_text("area: 100\ntraction: rope\nsled_mass: 5\nbearing: {file: pull.csv}\n")
    project.configure("rig.data", data)
    project.configure("rig.columns", "data/rig.yaml")
    assert project.plan().jobs == RIG
    # One that is not there is named before any job.
    (project.root / data[1]).unlink()
    done = project.snakemake("-n")
    assert done.returncode == 1
    assert "The config is wrong: rig.data[1] is 'data/run2.csv', but there is no such file.\n" in done.stderr


@pytest.mark.thorough
def test_order_and_spelling_of_numbers_run_nothing(project: Project) -> None:
    project.configure("grid.velocities", [100.0, 1.0])
    project.configure("grid.pressures", [0.5, 0.20])
    project.configure("grid.aspect", 0.7500000000000001)
    project.configure("aspect_study.aspects", [0.75, 0.5])
    project.configure("aspect_study.scales", [1.0])
    project.configure("figures.total_pressure", 0.5000000000000001)
    project.configure("figures.fields.velocities", [100.0, 1])
    project.edit(DEFAULT, lambda text: text.replace("youngs_modulus: 4.17", "youngs_modulus: 4.1700"))
    project.edit(DEFAULT, lambda text: text.replace("amplitude: 0.015", "amplitude: 1.5e-2"))
    project.edit(DEFAULT, lambda text: text.replace("contact_nodes: 32", "contact_nodes: 32.0"))
    assert project.plan().jobs == {}


@pytest.mark.thorough
@pytest.mark.parametrize(("figure", "rule"), [("fig1", "campaign_figure"), ("fig4", "field_figure")])
def test_edited_figure_is_drawn_again_alone(project: Project, figure: str, rule: str) -> None:
    project.comment(f"rubfric/figures/{figure}.py")
    plan = project.plan()
    assert plan.figures == {figure}
    assert plan.jobs == {rule: 1}


@pytest.mark.thorough
def test_edited_style_draws_all_figures_and_nothing_else(project: Project) -> None:
    project.comment("rubfric/figures/style.py")
    plan = project.plan()
    drawn = {"campaign_figure": 3, "total_figure": 2, "field_figure": 2, "march_figure": 1, "whole_figure": 1}
    assert plan.jobs == drawn | {"rig_figure": 1, "rig_schematic": 1}
    assert plan.figures == CAMPAIGN_FIGURES | TOTAL_FIGURES | FIELD_FIGURES | {"fig5", "fig8", "fig9", "fig11"}


def test_edited_mechanics_run_everything(project: Project) -> None:
    project.comment("rubfric/mechanics/block/contact.py")
    assert project.plan().jobs == EVERYTHING


@pytest.mark.thorough
def test_edited_script_of_scenes_runs_all_but_the_marches(project: Project) -> None:
    project.comment("workflow/scripts/simulate_scene.py")
    assert project.plan().jobs == {"scene": 18, **CAMPAIGN, "field_figure": 2}


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["rubfric/mechanics/finite/march.py", "workflow/scripts/march_scene.py"])
def test_edited_marches_run_alone(project: Project, name: str) -> None:
    project.comment(name)
    assert project.plan().jobs == MARCHES


@pytest.mark.thorough
def test_added_speed_of_the_marches_runs_its_march_alone(project: Project) -> None:
    project.configure("transient.velocities", [10, 100])
    assert project.plan().jobs == MARCHES


@pytest.mark.thorough
def test_edited_collection_runs_no_scene_and_draws_no_fields(project: Project) -> None:
    project.comment("rubfric/results/campaign.py", "workflow/scripts/collect_campaign.py")
    assert project.plan().jobs == {**CAMPAIGN, "whole_collection": 1}


@pytest.mark.thorough
def test_edited_tables_are_written_again_alone(project: Project) -> None:
    project.comment("rubfric/results/tables.py")
    assert project.plan().jobs == {**TABLES, **TOTALS}


@pytest.mark.thorough
def test_edited_sum_over_scales_reruns_what_shows_it(project: Project) -> None:
    project.comment("rubfric/results/scales.py")
    plan = project.plan()
    assert plan.jobs == {**TOTALS, "campaign_figure": 1}
    assert plan.figures == TOTAL_FIGURES | {"fig6", "fig9"}  # Fig. 6 may draw curves, whose columns are named there


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["explorer/page.py", "explorer/explorer.js", "index.html"])
def test_edited_page_is_made_again_alone_but_for_that_of_all_results(project: Project, name: str) -> None:
    project.comment(f"rubfric/pages/{name}")
    plan = project.plan()
    assert plan.jobs == ({"explorer": 1} if name.startswith("explorer") else {})
    assert re.search(r"^index_page +1$", plan.text, re.MULTILINE)


@pytest.mark.thorough
def test_what_no_number_depends_on_reruns_nothing(project: Project) -> None:
    project.comment("rubfric/config/campaign.py", "rubfric/cli.py", "rubfric/results/summary.py", "rubfric/__init__.py")
    project.comment(
        "rubfric/runner/jobs.py", "rubfric/runner/warm.py", "rubfric/runner/reruns.py", "rubfric/runner/runlog.py"
    )
    project.comment("README.md", "pyproject.toml", "tests/conftest.py", "workflow/profiles/default/config.yaml")
    project.comment(
        "Snakefile", "workflow/Snakefile", "workflow/schemas/config.schema.yaml", DEFAULT, "config/minimal.yaml"
    )
    for rules in sorted((project.root / "workflow" / "rules").glob("*.smk")):
        project.edit(str(rules.relative_to(project.root)), lambda text: f"# A remark.\n\n{text}")
    assert project.plan().jobs == {}


def test_touch_alone_reruns_nothing(project: Project) -> None:
    later = time.time() + 60.0
    touched = 0
    for folder in ("rubfric", "workflow", "config"):
        for path in (project.root / folder).rglob("*"):
            if path.suffix in (".py", ".smk", ".yaml"):
                os.utime(path, (later, later))
                touched += 1
    os.utime(project.root / "workflow" / "Snakefile", (later, later))
    assert touched > 40
    assert project.plan().jobs == {}


@pytest.mark.thorough
def test_lost_stamps_of_the_sources_rerun_nothing(project: Project) -> None:
    shutil.rmtree(project.root / ".snakemake" / "sources")
    assert project.plan().jobs == {}


@pytest.mark.parametrize(
    ("at", "value"),
    [
        ("rubbers.zhou2019.youngs_modulus", 4.2),
        pytest.param("rubbers.zhou2019.bulk", "proportional", marks=pytest.mark.thorough),
    ],
)
def test_other_rubber_runs_everything(project: Project, at: str, value: Any) -> None:
    project.configure(at, value, DEFAULT)
    assert project.plan().jobs == EVERYTHING


@pytest.mark.thorough
def test_other_numerics_run_all_but_what_has_a_preset_of_its_own(project: Project) -> None:
    project.configure("numerics.contact_nodes", 40, DEFAULT)
    assert project.plan().jobs == {rule: count for rule, count in EVERYTHING.items() if rule not in {"reading", *WHOLE}}


@pytest.mark.thorough
def test_other_preset_of_the_whole_road_runs_it_alone(project: Project) -> None:
    project.configure("multiscale_preset", "standard", DEFAULT)
    assert project.plan().jobs == {**WHOLE, **TOTALS}


def test_other_way_to_the_total_runs_no_scene(project: Project) -> None:
    project.configure("multiscale", "cascade", DEFAULT)
    assert project.plan().jobs == TOTALS


@pytest.mark.thorough
def test_other_preset_of_the_readings_runs_them_alone(project: Project) -> None:
    project.configure("claims.preset", "standard", DEFAULT)
    assert project.plan().jobs == {"reading": 10, **CLAIMS}


@pytest.mark.thorough
def test_other_difference_judges_again_alone(project: Project) -> None:
    project.configure("claims.difference", 0.1, DEFAULT)
    assert project.plan().jobs == CLAIMS


@pytest.mark.thorough
def test_other_height_of_one_scale_runs_that_scale_only(project: Project) -> None:
    project.configure("roads.zhou2019.2.amplitude", 0.004, DEFAULT)
    plan = project.plan()
    assert plan.scenes == {name for name in project.campaign.scenes() if name.startswith("scale3_")}
    # Of this scale two, and the two with the whole road.
    assert plan.jobs == {"scene": 4, **CAMPAIGN, **WHOLE, "reading": 4}


@pytest.mark.thorough
def test_spare_rubber_and_road_run_nothing(project: Project) -> None:
    spare = {"youngs_modulus": 1, "poissons_ratio": 0.3, "shear_fractions": [], "relaxation_times": []}
    project.configure("rubbers.spare", spare, DEFAULT)
    project.configure("roads.spare", [{"amplitude": 1, "wavenumber": 1}], DEFAULT)
    assert project.plan().jobs == {}


@pytest.mark.thorough
def test_optional_keys_of_the_rubber_left_out_run_nothing(project: Project) -> None:
    project.edit(DEFAULT, lambda text: re.sub(r"    (moduli|bulk|density): .*\n", "", text))
    assert project.plan().jobs == {}


@pytest.mark.thorough
def test_other_plane_runs_scenes_of_other_names(project: Project) -> None:
    project.configure("plane", "strain", DEFAULT)
    plan = project.plan()
    assert plan.scenes == {name.replace("stress", "strain") for name in project.scene_files}
    assert plan.jobs == {rule: count for rule, count in EVERYTHING.items() if rule != "reading"}


@pytest.mark.thorough
def test_deleted_table_is_written_again_alone(project: Project) -> None:
    (project.results / "tables" / "friction_scale_2.csv").unlink()
    assert project.plan().jobs == {"scale_table": 1, "curve_table": 1}


@pytest.mark.thorough
def test_deleted_scene_is_made_again(project: Project) -> None:
    name = "scale4_v1_p0.5_aspect0.75_stress"
    project.scene_files[name].unlink()
    plan = project.plan()
    assert plan.scenes == {name}
    assert plan.jobs == {"scene": 1, **CAMPAIGN}
