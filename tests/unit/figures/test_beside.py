from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.figures.beside import write_beside


@pytest.fixture
def panel() -> Axes:
    panel = Figure(figsize=(4.0, 4.0)).subplots()
    panel.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    return panel


def side(panel: Axes, place: tuple[float, float], lines: list[np.ndarray]) -> tuple[str, str]:
    """Return on which side of its point a word ends up, and check that it covers nothing."""
    note = write_beside(panel, place, "word", lines, 6.0)
    assert [text.get_text() for text in panel.texts] == ["word"]
    box, frame = note.get_window_extent(), panel.get_window_extent()
    assert frame.x0 <= box.x0 < box.x1 <= frame.x1
    for line in lines:
        dense = np.concatenate([np.linspace(a, b, 200) for a, b in pairwise(line)])
        x, y = panel.transData.transform(dense).T
        assert not ((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1)).any()
    return note.get_ha(), note.get_va()


def test_words_stand_at_the_right_of_a_point(panel: Axes) -> None:
    assert side(panel, (0.5, 0.5), []) == ("left", "center")


def test_words_move_off_a_line(panel: Axes) -> None:
    assert side(panel, (0.5, 0.5), [np.array([[0.5, 0.5], [1.0, 0.5]])]) == ("right", "center")
    panel.texts[0].remove()
    assert side(panel, (0.5, 0.5), [np.array([[0.0, 0.5], [1.0, 0.5]])]) == ("left", "bottom")


def test_words_stay_in_the_panel(panel: Axes) -> None:
    assert side(panel, (0.98, 0.5), []) == ("right", "center")


def test_words_do_not_cover_other_words(panel: Axes) -> None:
    notes = [write_beside(panel, (0.5, 0.5), "word", [], 6.0) for _ in range(3)]
    boxes = [note.get_window_extent() for note in notes]
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
