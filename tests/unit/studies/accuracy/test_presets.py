"""What the ladders say: a row for every rung, the cheapest first mesh that keeps an accuracy, presets that differ."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import rubfric
from rubfric.errors import BrokenResult
from rubfric.scene.numerics import fineness
from rubfric.studies.accuracy.ladder import STARTS
from rubfric.studies.accuracy.presets import knob_table, presets_that_differ, start_table, with_costs

CONFIG = Path(rubfric.__file__).resolve().parent.parent / "config" / "config.yaml"
SCENES = ("a", "b", "c")
PRESET_ACCURACIES = {"draft": 0.05, "standard": 0.01, "reference": 0.002}


def rung(knob: str, name: str, errors: list[float], seconds: float, **more: Any) -> list[dict[str, Any]]:
    """Return the rows of a rung, one per scene."""
    return [
        {
            "scene": scene,
            "knob": knob,
            "rung": name,
            "error": error,
            "estimate": 2.0 * error,
            "seconds": seconds,
            "cost": 10.0 * seconds,
            "memory_MB": 100.0 + number,
            **more,
        }
        for number, (scene, error) in enumerate(zip(SCENES, errors, strict=True))
    ]


def starts(**changes: tuple[list[float], float]) -> pd.DataFrame:
    """Return a ladder of first meshes, all of which keep their accuracy, finer ones being dearer.

    ``changes`` gives errors and seconds of a scene by the rung's name, with _ for blanks and dots.
    """
    rows = []
    for accuracy, values in STARTS.items():
        for start in values:
            name = f"{accuracy:g} from {start:g}"
            errors, seconds = [0.1 * accuracy, 0.2 * accuracy, 0.9 * accuracy], start
            given = changes.get("at_" + name.replace(" ", "_").replace(".", "_"))
            rows += rung("start", name, *(given or (errors, seconds)))
    return pd.DataFrame(rows)


def chosen(table: pd.DataFrame) -> dict[float, float]:
    found = table[table["chosen"]]
    assert len(found) == len(STARTS)
    return dict(zip(found["accuracy"], found["fineness"], strict=True))


def test_knob_table_is_over_the_scenes_in_the_order_of_the_ladder() -> None:
    rows = rung("rows", "1.6", [0.3, 0.1, 0.2], 2.0) + rung("rows", "1.05", [0.03, 0.01, np.nan], 4.0)
    rows += rung("mesh", "1", [0.1, 0.1, 0.1], 1.0)
    found = knob_table(pd.DataFrame(rows))
    assert list(zip(found["knob"], found["rung"], strict=True)) == [("rows", "1.6"), ("rows", "1.05"), ("mesh", "1")]
    coarse, fine, _ = (row for _, row in found.iterrows())
    assert (coarse["scenes"], coarse["refused"]) == (3, 0)
    assert (coarse["typical_error"], coarse["worst_error"], coarse["typical_estimate"]) == (0.2, 0.3, 0.4)
    assert (coarse["cost"], coarse["seconds"], coarse["memory_MB"]) == (20.0, 6.0, 102.0)
    # What was refused counts as such, and for nothing else.
    assert (fine["scenes"], fine["refused"]) == (2, 1)
    assert (fine["typical_error"], fine["worst_error"], fine["seconds"]) == (0.02, 0.03, 8.0)


def test_knob_that_every_scene_refused_has_no_numbers() -> None:
    (row,) = knob_table(pd.DataFrame(rung("rows", "1.6", [np.nan] * 3, np.nan))).to_dict("records")
    assert (row["scenes"], row["refused"]) == (0, 3)
    assert np.isnan([row["typical_error"], row["worst_error"], row["cost"]]).all()


def test_cheapest_first_mesh_is_chosen_for_each_accuracy() -> None:
    table = start_table(starts())
    assert chosen(table) == {accuracy: values[0] for accuracy, values in STARTS.items()}
    assert list(zip(table["accuracy"], table["fineness"], strict=True)) == [
        (accuracy, start) for accuracy, values in STARTS.items() for start in values
    ]
    row = table.iloc[0]
    np.testing.assert_allclose(
        row[["typical_error", "worst_error", "cost", "seconds"]].astype(float), [0.01, 0.045, 2.5, 0.75]
    )
    # A coarse mesh that is refined again and again may cost more than a finer one.
    dear = starts(at_0_01_from_0_35=([1e-3] * 3, 0.6))
    assert chosen(start_table(dear))[0.01] == 0.5


def test_cheap_first_mesh_that_misses_the_accuracy_on_one_scene_is_not_chosen() -> None:
    for errors in ([1e-3, 1e-3, 0.0101], [1e-3, np.nan, 1e-3]):  # off, or refused
        assert chosen(start_table(starts(at_0_01_from_0_35=(errors, 0.35))))[0.01] == 0.5
    # Nor where it costs the same as the one that is; of two that keep it at the same cost, it is the finer one.
    same = starts(at_0_01_from_0_35=([0.02] * 3, 0.5), at_0_01_from_0_7=([1e-3] * 3, 0.5))
    assert chosen(start_table(same))[0.01] == 0.7


def test_presets_are_priced_out_of_the_ladder() -> None:
    ladder = starts().drop(columns="cost")
    found = with_costs(ladder, PRESET_ACCURACIES)
    presets = found[found["knob"] == "preset"]
    assert list(dict.fromkeys(presets["rung"])) == list(PRESET_ACCURACIES)
    best = {accuracy: values[0] for accuracy, values in STARTS.items()}
    for name, accuracy in PRESET_ACCURACIES.items():
        rows = ladder[ladder["rung"] == f"{accuracy:g} from {best[accuracy]:g}"]
        one = presets[presets["rung"] == name]
        np.testing.assert_array_equal(one["seconds"], rows["seconds"])
    assert (found[found["rung"] == "standard"]["cost"] == 1.0).all()
    assert len(found) == len(ladder) + len(presets)
    with pytest.raises(BrokenResult, match=r"^the ladder has no accuracy of 0\.3, that of the preset rough$"):
        with_costs(ladder, {"rough": 0.3})


def test_accuracy_that_is_just_kept_is_kept() -> None:
    assert chosen(start_table(starts(at_0_01_from_0_35=([0.01] * 3, 0.35))))[0.01] == 0.35


def test_accuracy_that_no_first_mesh_keeps_is_an_error() -> None:
    off = {f"at_0_002_from_{start:g}".replace(".", "_"): ([0.003] * 3, start) for start in STARTS[0.002]}
    with pytest.raises(BrokenResult, match=r"^no first mesh of the ladder keeps an accuracy of 0\.002 on every scene$"):
        start_table(starts(**off))


def test_presets_that_are_the_chosen_ones_do_not_differ() -> None:
    presets = rubfric.load(CONFIG).presets
    table = pd.DataFrame(
        {"accuracy": accuracy, "fineness": start, "chosen": start == best}
        for accuracy, best in ((0.05, 0.35), (0.01, 0.5), (0.002, 0.5))
        for start in STARTS[accuracy]
    )
    assert {name: numerics.accuracy for name, numerics in presets.items()} == PRESET_ACCURACIES
    assert presets_that_differ(table, presets) == []


@pytest.mark.parametrize("name", PRESET_ACCURACIES)
def test_preset_that_is_not_the_chosen_one_is_told(name: str) -> None:
    best = {accuracy: values[0] for accuracy, values in STARTS.items()}
    table = start_table(starts())
    base = rubfric.load(CONFIG).presets["standard"]
    presets = {
        preset: replace(base, accuracy=accuracy, **fineness(best[accuracy]))
        for preset, accuracy in PRESET_ACCURACIES.items()
    }
    assert presets_that_differ(table, presets) == []
    for change in ({"row_growth": 1.123}, {"contact_nodes": 77}, {"accuracy": 0.03}):  # the last is on no ladder
        assert presets_that_differ(table, presets | {name: replace(presets[name], **change)}) == [name]
    # What a preset does not set does not matter.
    assert presets_that_differ(table, presets | {name: replace(presets[name], refinements=7)}) == []


def test_costs_of_ways_to_the_total_are_over_that_of_all_waves_at_once() -> None:
    ways = [
        rung("multiscale", way, [0.1] * 3, seconds, plane="strain") for way, seconds in (("sum", 2.0), ("direct", 4.0))
    ]
    whole = pd.DataFrame([row for rows in ways for row in rows]).assign(scene=lambda table: "whole " + table["scene"])
    found = with_costs(pd.concat([starts(), whole], ignore_index=True), PRESET_ACCURACIES)
    costs = found[found["knob"] == "multiscale"].groupby("rung")["cost"].agg(list)
    assert (costs["sum"], costs["direct"]) == ([0.5] * 3, [1.0] * 3)
