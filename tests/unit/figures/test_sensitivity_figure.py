"""The figure of what moves friction: the longest bar on top, as long as the table says."""

from __future__ import annotations

import pandas as pd
import pytest

from rubfric.errors import InvalidInput
from rubfric.figures.sensitivity import draw

TABLE = pd.DataFrame(
    [
        ("a_1", "mm", 0.015, 0.0165, -0.066, 0.002),
        ("tau_2", "s", 2.6e-4, 2.9e-4, 0.02, 0.001),
        ("nu", "", 0.49, 0.491, 0.01, 0.001),
        ("p", "MPa", 0.5, 0.55, -0.005, 0.001),
        ("g_6", "", 0.4, 0.44, 1e-7, 1e-8),
        ("v", "mm/s", 100.0, float("nan"), float("nan"), float("nan")),
    ],
    columns=["parameter", "unit", "value", "changed_to", "friction_change", "friction_change_error"],
)


def test_bars_are_the_changes_in_the_order_of_the_table() -> None:
    axes = draw(TABLE, 0.1, "title").axes[0]
    bars = sorted(
        (bar for group in axes.containers for bar in getattr(group, "patches", [])), key=lambda bar: bar.get_y()
    )
    assert [bar.get_width() for bar in bars] == pytest.approx([-6.6, 2.0, 1.0, -0.5])
    labels = [label.get_text() for label in axes.get_yticklabels()]
    assert labels == [
        "$a_{1}$ = 0.015 mm",
        r"$\tau_{2}$ = 0.00026 s",
        r"$\nu$ = 0.49 to 0.491",
        "$p$ = 0.5 MPa",
    ]
    assert axes.get_ylim()[0] > axes.get_ylim()[1]
    assert "1 with less than 0.2% of the longest bar are left out" in axes.get_xlabel()
    assert len(axes.get_legend().get_texts()) == 3


def test_a_table_without_any_change_is_refused() -> None:
    with pytest.raises(InvalidInput, match="no change of friction is known"):
        draw(TABLE[-1:], 0.1)
