"""The rig's scheme, and friction simulated and measured: what is drawn, and what is said of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.container import ErrorbarContainer
from matplotlib.text import Text

from rubfric.errors import InvalidInput
from rubfric.figures import fig8, fig9, style
from rubfric.figures.bands import bands
from rubfric.results.friction_map import FrictionMap

Maker = Callable[..., xr.Dataset]
PRESSURES, SPEEDS = [0.5, 5.0], [10.0, 1000.0]


def points(source: str = "measured", count: int = 3) -> pd.DataFrame:
    rows = {
        "run": ["run.csv"] * 4,
        "speed_mm_per_s": [1.0, 10.2, 700.0, 50.0],
        "speed_ci95_mm_per_s": [0.01, 0.1, 5.0, 0.2],
        "pressure_MPa": [0.51, 4.9, 5.1, 2.0],
        "pressure_ci95_MPa": [0.01, 0.05, 0.05, 0.02],
        "friction_coefficient": [0.5, 0.9, 0.7, 0.8],
        "friction_coefficient_ci95": [0.02, 0.03, 0.02, 0.01],
        "source": [source] * 4,
    }
    return pd.DataFrame(rows).iloc[:count]


def totals(campaign: xr.Dataset) -> pd.DataFrame:
    """Return a table of totals with the friction of one scale."""
    rows = campaign.sel(scale=1, aspect=0.75)[["friction_coefficient", "friction_coefficient_error"]].to_dataframe()
    names = {"velocity": "velocity_mm_per_s", "pressure": "pressure_MPa", "friction_coefficient": "friction_total"}
    return rows.reset_index().rename(columns=names | {"friction_coefficient_error": "friction_total_error"})


def drawn(panel: object) -> np.ndarray:
    """Return the points of a panel, sorted."""
    found = [bar.lines[0].get_xydata() for bar in panel.containers if isinstance(bar, ErrorbarContainer)]  # type: ignore[attr-defined]
    return np.array(sorted(map(tuple, np.concatenate(found)))) if found else np.empty((0, 2))


def test_points_stand_where_they_were_measured(make_campaign: Maker) -> None:
    over_speed, over_pressure = fig9.draw(totals(make_campaign()), points(), PRESSURES, SPEEDS).axes
    np.testing.assert_allclose(drawn(over_speed), [(1.0, 0.5), (10.2, 0.9), (700.0, 0.7)])
    np.testing.assert_allclose(drawn(over_pressure), [(4.9, 0.9)])


def test_lines_are_the_simulated_friction_with_its_band(make_campaign: Maker) -> None:
    table = totals(make_campaign())
    over_speed, over_pressure = fig9.draw(table, points(), PRESSURES, SPEEDS).axes
    friction = FrictionMap.from_totals(table)
    lines = [line for line in over_speed.get_lines() if line.get_xdata().size > 100]
    for line, pressure in zip(lines, PRESSURES, strict=True):
        np.testing.assert_allclose(line.get_ydata(), friction.at(pressure)(line.get_xdata()))
    assert len(bands(over_speed)) == len(PRESSURES)
    assert len(bands(over_pressure)) == len(SPEEDS)


def test_no_point_and_no_line_are_drawn_too(make_campaign: Maker, tmp_path: Path) -> None:
    figure = fig9.draw(totals(make_campaign()), points(count=0), [50.0], [1e6])
    assert figure.get_supxlabel() == "No point could be measured."
    assert not bands(figure.axes[0])
    style.save(figure, tmp_path / "fig9.png")


def test_table_without_its_columns_is_refused(make_campaign: Maker) -> None:
    with pytest.raises(InvalidInput, match="the table of the rig lacks the column pressure_ci95_MPa"):
        fig9.draw(totals(make_campaign()), points().drop(columns="pressure_ci95_MPa"), PRESSURES, SPEEDS)


def test_no_words_of_the_scheme_overlap() -> None:
    figure = fig8.draw()
    style.lay_out(figure)
    figure.canvas.draw()
    boxes = [Text.get_window_extent(text) for text in figure.axes[0].texts]  # without the lines to the parts
    texts = [text.get_text() for text in figure.axes[0].texts]
    for place, box in enumerate(boxes):
        others = [texts[other] for other in range(place) if box.overlaps(boxes[other])]
        assert not others, (texts[place], others)
