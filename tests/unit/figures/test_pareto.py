"""Error against cost: every rung where the table has it, every knob named, nothing written over anything else."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import pareto, style

Maker = Callable[..., pd.DataFrame]
KNOBS = (
    *("preset", "mesh", "surface", "rows", "first_row", "element", "kinematics", "folding", "tolerance"),
    *("steps", "wavelengths", "multiscale"),
)


def drawn(panel: Axes, gid: str) -> list[np.ndarray]:
    """Return the points of the lines of a kind, of shape (points, 2)."""
    return [np.stack(line.get_data(), axis=1) for line in panel.get_lines() if line.get_gid() == gid]


def test_large_panel_has_a_line_per_knob_and_small_ones_one_each(make_ladder: Maker) -> None:
    large, *small = pareto.draw(make_ladder()).axes
    medians = [[0.5, 4.0], [1.0, 1.0], [2.0, 0.25], [4.0, 0.0625]]
    assert len(drawn(large, "medians")) == len(small) == 3
    for line, panel in zip(drawn(large, "medians"), small, strict=True):
        np.testing.assert_allclose(line, medians[: len(line)])
        ((alone,), (first,), (scenes,)) = (drawn(panel, gid) for gid in ("medians", "coarsest", "scenes"))
        np.testing.assert_allclose(alone, line)
        np.testing.assert_allclose(first, line[:1])
        assert len(scenes) == 3 * len(line)


def test_presets_are_named_and_reach_to_the_worst_scene(make_ladder: Maker) -> None:
    large, *small = pareto.draw(make_ladder()).axes
    ((presets,),) = (drawn(large, "presets"),)
    np.testing.assert_allclose(presets, [[0.5, 4.0], [1.0, 1.0], [2.0, 0.25]])
    for whisker, median in zip(drawn(large, "worst"), presets, strict=True):
        np.testing.assert_allclose(whisker, [median, median * [1.0, 1.5]])
    assert [text.get_text() for text in large.texts] == ["draft", "standard", "reference"]
    assert all(len(drawn(panel, "presets")) == 1 for panel in small)


def test_errors_below_the_panel_lie_on_its_edge(make_ladder: Maker, tmp_path: Path) -> None:
    table = make_ladder()
    table.loc[table["rung"] == "64", "error"] = 0.0
    table.loc[(table["rung"] == "32") & (table["scene"] == "scene 0"), "error"] = 1e-15
    figure = pareto.draw(table)
    low = figure.axes[0].get_ylim()[0]
    assert low > 1e-4
    assert drawn(figure.axes[1], "medians")[0][-1, 1] == low
    assert drawn(figure.axes[1], "scenes")[0][:, 1].min() == low
    style.save(figure, tmp_path / "edge.png")


def test_panel_goes_no_deeper_than_a_tenth_of_the_reference_s_own_error(make_ladder: Maker) -> None:
    table = make_ladder()
    table.loc[table["rung"] == "64", "error"] = 1e-9
    assert pareto.draw(table).axes[0].get_ylim()[0] == pytest.approx(0.1 * 0.02)


def test_candidates_for_presets_are_no_ladder(make_ladder: Maker, words: Callable[[Figure], list[str]]) -> None:
    figure = pareto.draw(make_ladder(("preset", "start", "mesh")))
    assert len(figure.axes) == 2
    assert "start" not in words(figure)


def test_nothing_but_zeros_is_drawn(make_ladder: Maker, tmp_path: Path) -> None:
    table = make_ladder()
    table[["error", "reference_error"]] = 0.0
    style.save(pareto.draw(table), tmp_path / "zeros.pdf")


@pytest.mark.thorough
@pytest.mark.parametrize("knobs", [KNOBS, ("preset",), ("mesh", "another")])
def test_no_words_cover_each_other(
    make_ladder: Maker, knobs: tuple[str, ...], overlaps: Callable[[Figure], list[tuple[str, str]]], tmp_path: Path
) -> None:
    figure = pareto.draw(make_ladder(knobs))
    style.save(figure, tmp_path / "figure.png")
    assert overlaps(figure) == []
    assert len(figure.axes) == 1 + len(set(knobs) - {"preset"})


def test_bad_table_is_refused(make_ladder: Maker) -> None:
    with pytest.raises(InvalidInput, match=r"^the ladder lacks the column cost$"):
        pareto.draw(make_ladder().drop(columns="cost"))
