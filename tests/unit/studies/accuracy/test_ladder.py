"""The ladder of knobs: every rung is there, turns its own knob, and is solved once; what is refused has a note."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest
from synthetic_meshes import FRICTION, cell_size, synthetic

import rubfric
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.steady.solution import Friction, SteadySolution
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.numerics import fineness
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy import ladder
from rubfric.studies.accuracy.converged import Converged
from rubfric.studies.accuracy.cost import Measured
from rubfric.studies.accuracy.ladder import COLUMNS, STARTS, measure_ladder, rungs

SceneMaker = Callable[..., Scene]
PRESETS = rubfric.load(Path(rubfric.__file__).resolve().parent.parent / "config" / "config.yaml").presets
REFERENCE = Converged(FRICTION, 1e-5, 1024, 100, "finite")
MESH = {"contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min"}
# What each knob may turn, beside the base: the mesh of fineness 1 without further refinement.
TURNS = {
    "start": {"accuracy", "refinements", "row_growth"} | MESH,
    "mesh": {"row_growth"} | MESH,
    "surface": MESH,
    "rows": {"row_growth"},
    "first_row": {"first_row"},
    "element": {"dilatation"},
    "kinematics": {"kinematics"},
    "folding": {"folding"},
    "tolerance": {"tolerance"},
}


class Costs:
    """Solves and marches nothing, and counts how often; each scene has a friction and a time of its own."""

    def __init__(self) -> None:
        self.solved: list[Scene] = []
        self.marched: list[Procedure] = []
        self.refused: Callable[[Scene], bool] = lambda scene: False
        self.refusal: Exception | None = None

    def solve(self, scene: Scene) -> SteadySolution:
        self.solved.append(scene)
        if self.refused(scene):
            raise NotConverged(scene.name, 7, 0.5, "something")
        numerics = scene.numerics
        resolution = Resolution(numerics.finite_columns_min, numerics.row_growth)
        value = FRICTION * (1.0 + cell_size(resolution) ** 2)
        used = "finite" if scene.kinematics == "auto" else scene.kinematics
        return synthetic(scene, resolution, Friction(value, value), decision=Decision(used, 0.0, "so"))

    def measure(self, compute: Callable[[], Any], least: float = 0.0, most: int = 1) -> Measured[Any]:
        result = compute()
        columns = result.block.columns
        return Measured(result, columns / 64.0, 100.0 + columns)

    def march(self, scene: Scene, procedure: Procedure) -> Any:
        self.marched.append(procedure)
        if self.refusal is not None:
            raise self.refusal
        steps = 10 + procedure.wavelengths * procedure.steps_per_wavelength
        one = np.ones(steps, dtype=int)
        return SimpleNamespace(
            means=lambda: FRICTION + 0.01 * np.arange(procedure.wavelengths),
            records={"time": one, "iterations": one, "krylov": 2 * one},
            seconds=0.1 * steps,
            block=SimpleNamespace(columns=procedure.columns, rows=9),
            kinematics="finite",
        )


@pytest.fixture
def costs(monkeypatch: pytest.MonkeyPatch) -> Costs:
    found = Costs()
    monkeypatch.setattr(ladder, "converge", lambda scene: REFERENCE)
    monkeypatch.setattr(ladder, "evaluate", lambda solution: None)
    for name in ("solve", "measure", "march"):
        monkeypatch.setattr(ladder, name, getattr(found, name))
    return found


@pytest.fixture
def scene(paper_scene: SceneMaker) -> Scene:
    return paper_scene(100.0, 0.5, kinematics="auto", plane="strain", numerics=PRESETS["standard"])


def of(table: pd.DataFrame, knob: str) -> pd.DataFrame:
    return table[table["knob"] == knob].set_index("rung")


def turned(scene: Scene, base: Scene) -> set[str]:
    """Return the names of what differs."""
    one, two = asdict(scene), asdict(base)
    numerics = {name for name in one["numerics"] if one["numerics"][name] != two["numerics"][name]}
    return numerics | {name for name in one if name != "numerics" and one[name] != two[name]}


def test_every_knob_has_its_rungs_from_coarse_to_fine(scene: Scene) -> None:
    found = list(rungs(scene))
    names = [(rung.knob, rung.rung) for rung in found]
    assert len(set(names)) == len(names)
    by_knob: dict[str, list[str]] = {}
    for knob, name in names:
        by_knob.setdefault(knob, []).append(name)
    starts = [f"{accuracy:g} from {start:g}" for accuracy, values in STARTS.items() for start in values]
    assert by_knob == {
        "start": starts,
        "mesh": ["0.25", "0.35", "0.5", "0.7", "1", "1.4", "2"],
        "surface": ["0.25", "0.5", "1", "2"],
        "rows": ["1.6", "1.4", "1.2", "1.1", "1.05"],
        "first_row": ["4", "2", "1", "0.5"],
        "element": ["pointwise", "mean"],
        "kinematics": ["small", "auto", "finite"],
        "folding": ["1", "0.1", "0.01", "0"],
        "tolerance": ["0.01", "0.001", "0.0001", "1e-06", "1e-08"],
    }


def test_every_knob_turns_nothing_but_its_own(scene: Scene) -> None:
    base = replace(scene, numerics=replace(PRESETS["standard"], **fineness(1.0), refinements=0))
    seen: dict[str, set[str]] = {}
    for rung in rungs(scene):
        changed = turned(rung.scene, base)
        assert changed <= TURNS[rung.knob], rung
        seen[rung.knob] = seen.get(rung.knob, set()) | changed
    assert seen == TURNS


def test_nothing_locks_in_plane_stress_so_that_elements_are_not_compared(scene: Scene) -> None:
    assert "element" not in {rung.knob for rung in rungs(replace(scene, plane="stress"))}


def test_starts_are_those_of_their_names(scene: Scene) -> None:
    found = {rung.rung: rung.scene.numerics for rung in rungs(scene) if rung.knob == "start"}
    for name, numerics in found.items():
        accuracy, start = name.split(" from ")
        assert numerics == replace(PRESETS["standard"], accuracy=float(accuracy), **fineness(float(start)))
    # Every preset is one of them, so that its first mesh can be chosen from the table.
    assert set(PRESETS.values()) <= set(found.values())


def test_table_has_every_rung_and_each_scene_is_solved_once(scene: Scene, costs: Costs) -> None:
    table = measure_ladder("some", scene)
    assert list(table.columns) == list(COLUMNS)
    wanted = list(rungs(scene))
    steady = table[~table["knob"].isin(["steps", "wavelengths"])]
    assert list(zip(steady["knob"], steady["rung"], strict=True)) == [(rung.knob, rung.rung) for rung in wanted]
    assert Counter(costs.solved) == Counter({rung.scene: 1 for rung in wanted})
    assert len(costs.solved) < len(wanted)  # several knobs share a rung
    shared = [of(table, knob).loc[rung] for knob, rung in (("mesh", "1"), ("rows", "1.1"), ("folding", "0.01"))]
    for row in shared[1:]:
        pd.testing.assert_series_equal(row.drop("knob"), shared[0].drop("knob"), check_names=False)


def test_errors_are_relative(scene: Scene, costs: Costs) -> None:
    table = measure_ladder("some", scene)
    assert set(table["scene"]) == {"some"}
    assert set(table["plane"]) == {"strain"}
    assert set(table["velocity"]) == {100.0}
    assert set(table["pressure"]) == {0.5}
    assert set(table["reference"]) == {FRICTION}
    assert set(table["reference_error"]) == {1e-5}
    mesh = of(table, "mesh")
    for value in (0.5, 1.0, 2.0):
        numerics = replace(PRESETS["standard"], **fineness(value), refinements=0)
        solution = costs.solve(replace(scene, numerics=numerics))
        row = mesh.loc[f"{value:g}"]
        assert row["error"] == pytest.approx(abs(solution.friction.stress_power / FRICTION - 1.0), rel=1e-9)
        assert row["estimate"] == pytest.approx(friction_error(solution) / FRICTION, rel=1e-12)
        assert (row["columns"], row["rows"]) == (solution.block.columns, solution.block.rows)
        assert (row["seconds"], row["memory_MB"]) == (row["columns"] / 64.0, 100.0 + row["columns"])
        assert (row["kinematics"], row["note"]) == ("finite", "")


def test_small_strain_that_is_asked_for_has_no_estimate_of_the_error(scene: Scene, costs: Costs) -> None:
    # Its estimate is to small strain, but errors are to finite strain.
    found = of(measure_ladder("some", scene), "kinematics")
    assert np.isnan(found.loc["small", "estimate"])
    assert "to small strain" in found.loc["small", "note"]
    assert found.loc[["auto", "finite"], "estimate"].notna().all()


def test_refused_rung_has_a_note_and_no_numbers(scene: Scene, costs: Costs) -> None:
    costs.refused = lambda given: given.numerics.accuracy == 0.002
    table = measure_ladder("some", scene)
    refused = table["rung"].str.startswith("0.002 from")
    assert refused.sum() == len(STARTS[0.002])
    note = f"{scene.name}: not converged after 7 steps, something is 0.5"
    assert set(table.loc[refused, "note"]) == {note}
    numbers = ["friction_coefficient", "error", "estimate", "seconds", "columns"]
    assert table.loc[refused, numbers].isna().all(axis=None)
    assert table.loc[~refused, ["friction_coefficient", "error", "seconds"]].notna().all(axis=None)
    assert Counter(costs.solved).most_common(1)[0][1] == 1  # refused once, too


def test_refusal_of_everything_is_a_table_too(scene: Scene, costs: Costs) -> None:
    costs.refused = lambda given: True
    table = measure_ladder("some", scene)
    assert len(table) == len(list(rungs(scene)))
    assert (table["note"] != "").all()
    assert table[["friction_coefficient", "error", "seconds"]].isna().all(axis=None)
    assert not costs.marched


def test_marches_are_on_half_the_columns_and_only_where_few_suffice(
    scene: Scene, costs: Costs, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = measure_ladder("some", scene)
    steps, slid = of(table, "steps"), of(table, "wavelengths")
    assert list(steps.index) == ["8", "16", "32", "64"]
    assert list(slid.index) == ["1", "2", "4", "8"]
    assert {procedure.columns for procedure in costs.marched} == {64}  # half of the 128 of fineness 1
    assert [(procedure.start, procedure.steps_per_wavelength) for procedure in costs.marched] == [
        *(("steady", number) for number in (8, 16, 32, 64)),
        ("pressed", 32),
    ]
    # The friction of the last wavelength slid, the time and the work until then.
    np.testing.assert_allclose(steps["friction_coefficient"], FRICTION + 0.01)
    np.testing.assert_allclose(slid["friction_coefficient"], FRICTION + 0.01 * np.array([0, 1, 3, 7]))
    done = 10 + 32 * np.array([1, 2, 4, 8])
    np.testing.assert_allclose(slid["seconds"].astype(float), 0.1 * done)
    np.testing.assert_array_equal(slid["iterations"], done)
    np.testing.assert_array_equal(slid["krylov"], 2 * done)
    assert slid["estimate"].isna().all()

    costs.marched.clear()
    monkeypatch.setattr(ladder, "_MARCH_COLUMNS", 120)
    assert not set(measure_ladder("some", scene)["knob"]) & {"steps", "wavelengths"}
    assert not costs.marched


@pytest.mark.parametrize("refusal", [NotConverged("some", 3, 0.5, "something"), InvalidInput("too few columns")])
def test_refused_march_has_a_note_for_each_of_its_rungs(scene: Scene, costs: Costs, refusal: Exception) -> None:
    costs.refusal = refusal
    table = measure_ladder("some", scene)
    marched = table[table["knob"].isin(["steps", "wavelengths"])]
    assert len(marched) == 8
    assert set(marched["note"]) == {str(refusal)}
    assert marched["friction_coefficient"].isna().all()
