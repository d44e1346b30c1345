"""The map of stability shows every case once, in the look of its outcome."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rubfric.errors import InvalidInput
from rubfric.figures.stability import _LOOKS, draw
from rubfric.figures.style import save
from rubfric.studies.stability.cases import cases
from rubfric.studies.stability.report import row
from rubfric.studies.stability.trial import Trial

ENDS = (
    Trial("converged", "", (0.1, 0.1, 0.1), 0.0, 0.0, 1.0, 100.0),
    Trial("converged", "small strain is only indicative", (0.1, 0.1, 0.1), 0.0, 0.0, 1.0, 100.0),
    Trial("refused", "too light"),
    Trial("failed", "a gap is negative"),
)


@pytest.fixture(scope="module")
def table() -> pd.DataFrame:
    return pd.DataFrame([row(case, ENDS[place % 4]) for place, case in enumerate(cases())])


@pytest.fixture(scope="module")
def figure(table: pd.DataFrame) -> Figure:
    return draw(table)


def test_every_case_has_its_mark_in_the_look_of_its_outcome(figure: Figure, table: pd.DataFrame) -> None:
    squares = [patch for axes in figure.axes for patch in axes.patches if isinstance(patch, Rectangle)]
    corners = sum(len(dots.get_offsets()) for axes in figure.axes for dots in axes.collections)
    assert len(squares) == (table["panel"] != "corners").sum()
    assert corners == (table["panel"] == "corners").sum()
    assert len({square.get_facecolor() for square in squares}) == len(_LOOKS)


@pytest.mark.thorough
def test_map_is_saved(figure: Figure, tmp_path: Path) -> None:
    save(figure, tmp_path / "map.png", tmp_path / "map.pdf")
    assert (tmp_path / "map.png").stat().st_size > 1e5


def test_panel_without_cases_is_refused(table: pd.DataFrame) -> None:
    with pytest.raises(InvalidInput, match="no case of the panel limits"):
        draw(table[table["panel"] != "limits"])
