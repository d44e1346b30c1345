from __future__ import annotations

import pytest

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style


@pytest.mark.parametrize(
    ("count", "rows", "columns"), [(1, 1, 1), (2, 1, 2), (3, 1, 3), (4, 2, 2), (5, 2, 3), (6, 2, 3), (7, 3, 3)]
)
def test_panels_fill_rows_of_at_most_three(count: int, rows: int, columns: int) -> None:
    figure, axes = panels.arrange(count, height=2.0)
    assert len(axes) == len(figure.axes) == count
    width = style.COLUMN if count == 1 else style.DOUBLE_COLUMN
    assert tuple(figure.get_size_inches()) == pytest.approx((width, 2.0 * rows))
    panels.label(axes, "Speed (mm/s)", "Friction coefficient")
    assert [bool(panel.get_ylabel()) for panel in axes] == [place % columns == 0 for place in range(count)]
    # The lowest of each column.
    assert [bool(panel.get_xlabel()) for panel in axes] == [place + columns >= count for place in range(count)]


def test_nothing_to_show_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^the figure has 0 panels, but must show at least one"):
        panels.arrange(0, height=2.0)


@pytest.mark.parametrize("count", [1, 2])
def test_legend_stands_beside_panels_but_above_one_alone(count: int) -> None:
    figure, axes = panels.arrange(count, height=2.0)
    handles = [axes[0].plot([0.0, 1.0], label=f"line {place}")[0] for place in range(5)]
    panels.legend_beside(figure, handles, "two\nlines")
    figure.draw_without_rendering()
    legend, panel = figure.legends[0].get_window_extent(), axes[-1].get_window_extent()
    assert (legend.x0 > panel.x1) == (count == 2)
    assert (legend.y0 > panel.y1) == (count == 1)
    assert (figure.get_figheight() > 2.0) == (count == 1)
    assert panel.height > 0.5 * 2.0 * figure.dpi
