"""Real runs: a grown campaign, a damaged result, a scene without a solution, another rubber."""

from __future__ import annotations

import io
import re
import shutil

import numpy as np
import pandas as pd
import pytest
from project_copy import Project

from rubfric.results.campaign import COLLECTED
from rubfric.results.dataset import load, write
from rubfric.results.tables import write_table
from rubfric.simulation import simulate


def table(project: Project, name: str) -> pd.DataFrame:
    return pd.read_csv(io.StringIO(project.tables[name]))


@pytest.mark.thorough
def test_added_velocity_adds_its_rows_and_leaves_the_rest(template: Project, project: Project) -> None:
    written = {name: path.stat().st_mtime_ns for name, path in project.scene_files.items()}
    project.configure("grid.velocities", [1, 10, 100])
    project.run("tables")
    assert len(project.scene_files) == 27
    assert {name: project.scene_files[name].stat().st_mtime_ns for name in written} == written
    for name, text in project.tables.items():
        new, old = table(project, name), table(template, name)
        kept = new[new["velocity_mm_per_s"] != 10].reset_index(drop=True)
        pd.testing.assert_frame_equal(kept, old)
        assert text.splitlines()[0] == template.tables[name].splitlines()[0]
        assert len(new) - len(old) == (3 if name == "friction_scale_1.csv" else 2)
    total = table(project, "friction_total.csv").set_index(["velocity_mm_per_s", "pressure_MPa"])
    expected = [float(simulate(project.campaign.scene(scale, 10, 0.5)).friction_coefficient) for scale in range(1, 5)]
    columns = [*(f"friction_scale_{scale}" for scale in range(1, 5)), "friction_sum"]
    assert total.loc[(10, 0.5), columns].to_numpy() == pytest.approx([*expected, sum(expected)], rel=1e-5)
    assert project.plan("tables").jobs == {}


@pytest.mark.thorough
def test_damaged_result_is_named_and_made_again_once_deleted(project: Project, template: Project) -> None:
    name = "scale3_v1_p0.5_aspect0.75_stress"
    damaged = project.scene_files[name]
    damaged.write_bytes(damaged.read_bytes()[:2000])
    done = project.snakemake("tables")
    assert done.returncode == 1
    sentence = rf"^BrokenResult: \S*{name}.nc cannot be read: [^;]*; delete it and run again \(log: \S*campaign.log\)$"
    assert len(re.findall(sentence, done.stderr, re.MULTILINE)) == 1
    damaged.unlink()
    assert project.plan().scenes == {name}
    project.run("tables")
    assert project.tables == template.tables


@pytest.mark.thorough
def test_march_reading_and_collection_of_another_rubber_are_named(project: Project) -> None:
    march, reading = (next(project.results.rglob(f"{kind}/**/scale*")) for kind in ("marches", "readings"))
    collection = project.results / "campaign.nc"
    foreign = load(collection).assign_attrs({COLLECTED: "0" * 16})
    write(load(march).assign_attrs(scene_digest="0" * 64), march)
    write_table(pd.read_csv(reading).assign(scene_digest="0" * 64), reading)
    done = project.snakemake("--keep-going")
    assert done.returncode == 1
    said = done.stderr
    write(foreign, collection)
    said += project.snakemake("tables").stderr
    for path in (march, reading, collection):
        named = (
            f"^BrokenResult: {path.relative_to(project.root)} is the result of another scene, rubber or numerics .*; "
        )
        assert re.search(named + "delete it and run again", said, re.MULTILINE)


@pytest.mark.thorough
def test_scene_without_a_solution_fails_alone(project: Project) -> None:
    project.configure("grid.pressures", [0.5, 5])  # heavy enough for some scenes to fill the road
    project.configure("figures.fields.pressures", [0.5])
    project.configure("multiscale", "sum", "config/config.yaml")
    project.run("tables")
    fractions = {
        name: fraction for scale in range(1, 5) for name, fraction in contact_fractions(project, scale).items()
    }
    shutil.rmtree(project.results)
    full = {name for name, fraction in fractions.items() if fraction == 1.0}
    assert 0 < len(full) < len(fractions) == 18
    # Contact that may neither pivot nor be followed is found where it fills the road from the start, if anywhere.
    project.edit(
        "rubfric/mechanics/finite/contact.py",
        lambda text: re.sub(r"(?m)^_MOST_PIVOTS = \d+$", "_MOST_PIVOTS = 1", text).replace(
            "finest_waves(load.road) > 1", "finest_waves(load.road) > 0"
        ),
    )
    done = project.snakemake("tables", "--keep-going")
    assert done.returncode == 1
    solved = set(project.scene_files)
    assert solved
    assert solved <= full
    for name in set(fractions) - solved:
        left = r"distance from balance and contact, .* is \S+; every way to a solution stalls: [^()]*"
        sentence = rf"NotConverged: {name}: not converged after \d+ steps, {left}"
        said = rf"^{sentence} \(log: \S*/logs/scenes/\S*{name}.log\)$"
        assert len(re.findall(said, done.stderr, re.MULTILINE)) == 1
        log = project.results / "logs" / "scenes" / "zhou2019" / "zhou2019" / f"{name}.log"
        assert re.search(sentence + r"$", log.read_text())
    told = re.findall(r"^  failed: (scale\S+) \(log: \S+\.log\)$", done.stderr, re.MULTILINE)
    assert sorted(told) == sorted(set(fractions) - solved)
    assert re.search(rf"^  Stopped after .*: \d+ failed; done: {len(solved)} scene", done.stderr, re.MULTILINE)
    assert not list(project.results.rglob("*.part"))


def contact_fractions(project: Project, scale: int) -> dict[str, float]:
    """Return the contact fraction of each scene of a scale, by name."""
    rows = table(project, f"friction_scale_{scale}.csv")
    keys = rows[["velocity_mm_per_s", "pressure_MPa", "aspect"]].itertuples(index=False, name=None)
    scenes = [project.campaign.scene(scale, *key).name for key in keys]
    return dict(zip(scenes, rows["contact_fraction"], strict=True))


@pytest.mark.thorough
def test_another_rubber_has_its_own_folder_and_the_way_back_is_free(template: Project, project: Project) -> None:
    other = {"youngs_modulus": 8.0, "poissons_ratio": 0.4, "shear_fractions": [0.5], "relaxation_times": [1.0e-4]}
    project.configure("rubbers.other", other, "config/config.yaml")
    project.configure("rubber", "other", "config/config.yaml")
    project.run("tables")
    folder = project.results / "scenes"
    assert sorted(path.name for path in folder.iterdir()) == ["other", "zhou2019"]
    assert set(project.scene_files) == set(template.scene_files)
    assert project.scene_files["scale1_v1_p0.5_aspect0.75_stress"].parent == folder / "other" / "zhou2019"
    for name in project.tables:
        friction = "friction_total" if name == "friction_total.csv" else "friction_coefficient"
        assert not np.allclose(table(project, name)[friction], table(template, name)[friction])
    project.configure("rubber", "zhou2019", "config/config.yaml")
    again = {"campaign": 1, "whole_collection": 1, "scale_table": 4, "total_table": 1, "tables": 1}
    assert project.plan("tables").jobs == again
    project.run("tables")
    assert project.tables == template.tables
