"""Friction of every rubber on every road, above strips of who grips more."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import fig13, style
from rubfric.figures.bands import bands
from rubfric.results.comparison import comparison_table, ranking_table

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)


def tables(rubbers: Sequence[str], roads: Sequence[str]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return both tables: each rubber grips 0.05 more than the one before, but for the second at the slowest speeds."""
    found = {}
    for (place, rubber), (number, road) in product(enumerate(rubbers), enumerate(roads)):
        points = [
            dict(zip(("pressure_MPa", "velocity_mm_per_s"), at, strict=True)) for at in product((0.1, 5.0), SPEEDS)
        ]
        table = pd.DataFrame(points)
        log = np.log10(table["velocity_mm_per_s"])
        table["friction_total"] = 0.3 + 0.1 * number + 0.05 * place * ((place != 1) | (log > 0.5)) - 0.01 * log**2
        table["friction_numerical_error"], table["friction_total_error"] = 0.01, 0.01
        table["friction_coupling_error"], table["way"], table["note"] = 0.0, "direct", ""
        found[rubber, road] = table
    nothing = dict.fromkeys(found, ())
    return comparison_table(found, nothing), ranking_table(found, nothing)


@pytest.mark.parametrize(
    ("rubbers", "roads", "panels"),
    [
        (("soft", "hard"), ("street",), 2),
        (("soft",), ("street", "track", "race"), 2),
        pytest.param(
            ("soft", "hard", "a_name_that_is_too_long_to_be_drawn", "d"),
            ("street", "track", "fine", "a_very_long_road_"),
            8,
            marks=pytest.mark.thorough,
        ),
    ],
)
def test_who_grips_more_is_marked_below_friction(
    rubbers: tuple[str, ...],
    roads: tuple[str, ...],
    panels: int,
    words: Callable[..., list[str]],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    figure = fig13.draw(*tables(rubbers, roads), [0.1, 5.0])
    style.save(figure, tmp_path / "fig13.png")
    assert overlaps(figure) == []
    lines = rubbers if len(rubbers) > 1 else roads
    above, below = figure.axes[::2], figure.axes[1::2]
    assert len(above) == len(below) == panels
    assert all(len(bands(panel)) == len(lines) for panel in above)
    count = len(lines) * (len(lines) - 1) // 2
    for strip in below:
        marks = [line.get_gid() for line in strip.get_lines()]
        # The second is equal to the first at the two slowest speeds.
        assert marks.count("equal") == (2 if len(rubbers) > 1 else 0)
        assert len(marks) == count * len(SPEEDS)
    fastest = [line for line in below[0].get_lines() if line.get_gid() == "more" and line.get_ydata()[0] == 0]
    assert {line.get_marker() for line in fastest} == {above[0].get_lines()[1].get_marker()}
    assert any("95 % interval" in one for one in words(figure))


def test_pressure_without_friction_is_refused() -> None:
    comparison, ranking = tables(("soft", "hard"), ("street",))
    with pytest.raises(InvalidInput, match="no friction at these pressures"):
        fig13.draw(comparison, ranking, [2.0])
    with pytest.raises(InvalidInput, match="the ranking lacks the column verdict"):
        fig13.draw(comparison, ranking.drop(columns="verdict"), [0.1])
