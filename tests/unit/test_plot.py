"""Pictures of results for notebooks and scripts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from synthetic_campaign import make_campaign, make_totals

import rubfric
from rubfric import plot
from rubfric.errors import InvalidInput
from rubfric.results.tables import by_temperature, write_table


def lines(figure: Figure) -> dict[str, list[float]]:
    return {str(line.get_color()): list(line.get_ydata()) for line in figure.axes[0].get_lines() if not line.get_gid()}


def test_friction_has_a_line_for_each_pressure_whatever_holds_it(tmp_path: Path) -> None:
    table = make_totals(make_campaign())
    write_table(table, tmp_path / "tables" / "friction_total.csv")
    figure = plot.friction(table)
    drawn = list(lines(figure).values())
    expected = [rows["friction_total"].tolist() for _, rows in table.groupby("pressure_MPa")]
    assert drawn == expected
    assert [text.get_text() for text in figure.legends[0].get_texts()][:3] == ["0.5 MPa", "1 MPa", "5 MPa"]
    assert figure._repr_png_().startswith(b"\x89PNG")
    read = list(lines(plot.friction(tmp_path)).values())
    np.testing.assert_allclose(read, expected, rtol=1e-5)


def test_friction_has_a_panel_for_each_temperature_or_one_in_a_figure_of_the_users() -> None:
    table = by_temperature({warm: make_totals(make_campaign()) for warm in (20.0, 60.0)})
    assert [axes.get_title(loc="left")[-5:] for axes in plot.friction(table).axes] == ["20 °C", "60 °C"]
    own = Figure()
    ax = own.subplots()
    with pytest.raises(InvalidInput, match=r"^there are 2 temperatures, but one ax shows only one"):
        plot.friction(table, ax=ax)
    assert plot.friction(table, [5.0], [60.0], ax=ax) is own
    assert len(lines(own)) == 1


def test_block_is_drawn_of_what_simulate_returns() -> None:
    scene = rubfric.load({"kinematics": "small"}).scene(scale=1, velocity=100, pressure=0.5)
    figure = plot.block(rubfric.simulate(scene))
    assert any("contact" in text.get_text() for text in figure.axes[0].texts)
    assert figure._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("draw", [plot.block, plot.friction])
def test_what_is_no_result_is_refused_in_a_sentence(draw: object) -> None:
    with pytest.raises(InvalidInput, match=r"lacks|has no friction_total"):
        draw(xr.Dataset())  # type: ignore[operator]
