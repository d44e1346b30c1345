from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd
import pytest

from rubfric.errors import InvalidInput
from rubfric.figures.ladders import by_knob, known_runs, own_error

Maker = Callable[..., pd.DataFrame]


def test_rungs_are_medians_over_the_scenes(make_ladder: Maker) -> None:
    ladders = by_knob(make_ladder())
    assert list(ladders) == ["preset", "mesh", "surface", "kinematics"]
    mesh = ladders["mesh"]
    assert mesh.rungs == ("8", "16", "32", "64")
    np.testing.assert_allclose(mesh.cost, [0.5, 1.0, 2.0, 4.0])
    np.testing.assert_allclose(mesh.error, [4.0, 1.0, 0.25, 0.0625])
    np.testing.assert_allclose(mesh.worst, 1.5 * mesh.error)
    assert mesh.costs.shape == mesh.errors.shape == (12,)


def test_rungs_keep_the_order_of_the_table(make_ladder: Maker) -> None:
    # Neither of the alphabet nor of the numbers: 16 comes before 8, finite before small.
    ladders = by_knob(make_ladder().iloc[::-1])
    assert ladders["mesh"].rungs == ("64", "32", "16", "8")
    assert ladders["kinematics"].rungs == ("auto", "finite", "small")


def test_runs_without_error_or_cost_do_not_count(make_ladder: Maker) -> None:
    table = make_ladder(knobs=("mesh",))
    table.loc[table["rung"] == "16", "error"] = [np.nan, 0.03, 0.05]
    table.loc[table["rung"] == "32", "cost"] = [1.0, np.inf, 0.0]
    mesh = by_knob(table)["mesh"]
    np.testing.assert_allclose(mesh.error[1], 4.0)
    np.testing.assert_allclose(mesh.cost[2], 1.0)
    assert mesh.errors.size == 9


def test_order_of_rungs_is_that_of_the_scene_with_most_of_them(make_ladder: Maker) -> None:
    table = make_ladder(knobs=("mesh",))
    table = table.drop(index=table.index[(table["scene"] == "scene 0") & (table["rung"] == "16")])
    table.loc[table["rung"] == "8", "error"] = [np.nan, 0.04, np.nan]
    table.loc[table["rung"] == "64", "error"] = np.nan
    assert by_knob(table)["mesh"].rungs == ("8", "16", "32")


def test_reference_s_own_error_is_relative(make_ladder: Maker) -> None:
    table = make_ladder()
    assert own_error(known_runs(table)) == pytest.approx(0.02)
    table["reference"] = 0.0
    assert own_error(known_runs(table)) == 0.0


@pytest.mark.parametrize("column", ["scene", "knob", "rung", "error", "cost", "reference", "reference_error"])
def test_lacking_column_is_named(make_ladder: Maker, column: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^the ladder lacks the column {column}$"):
        known_runs(make_ladder().drop(columns=column))


def test_ladder_without_a_run_is_refused(make_ladder: Maker) -> None:
    table = make_ladder()
    table["error"] = np.nan
    with pytest.raises(InvalidInput, match=r"^the ladder has no run with both an error and a cost, but at least one"):
        known_runs(table)
