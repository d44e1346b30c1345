from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import fig7, fig10, style
from rubfric.figures.bands import bands
from rubfric.figures.panels import sentence
from rubfric.figures.totals import WAYS

Maker = Callable[..., xr.Dataset]
TableMaker = Callable[..., pd.DataFrame]
SHARES = {"direct": 0.7, "sum": 1.0, "corrected": 0.75, "cascade": 0.9, "persson": 0.8}


def curves(panel: Axes) -> dict[str, Any]:
    """Return the heights of every line by the first words of its label."""
    return {str(line.get_label()).partition(":")[0]: np.asarray(line.get_ydata()) for line in panel.get_lines()}


def test_four_ways_at_a_light_and_a_heavy_load(make_campaign: Maker, make_totals: TableMaker) -> None:
    campaign = make_campaign()
    figure = fig10.draw(make_totals(campaign), [0.5, 5.0])
    assert [panel.get_title(loc="left") for panel in figure.axes] == ["(a) 0.5 MPa", "(b) 5 MPa"]
    for panel, pressure in zip(figure.axes, (0.5, 5.0), strict=True):
        summed = campaign["friction_coefficient"].sel(aspect=0.75, pressure=pressure).sum("scale").values
        found = curves(panel)
        for way, share in SHARES.items():
            np.testing.assert_allclose(found[sentence(WAYS[way])], share * summed, rtol=1e-12)
        assert len(bands(panel)) == 1
        assert panel.get_ylim()[1] >= summed.max()


def test_legend_says_which_road_and_how_good(
    make_campaign: Maker, make_totals: TableMaker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    said = words(fig10.draw(make_totals(campaign), [0.5, 5.0]))
    assert "All scales at once:\none road, these phases" in said
    assert "Estimated error at most 1.5\N{NO-BREAK SPACE}%: too small for bands to be seen." in said
    assert said.count("Sum of the scales") == 1
    assert "All scales at once:\nmean of random phases" in words(fig10.draw(make_totals(campaign, drawn=True), [5.0]))


def test_bands_of_a_measured_road_and_rubber_are_apart(
    make_campaign: Maker,
    make_totals: TableMaker,
    words: Callable[..., list[str]],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
) -> None:
    table = make_totals(make_campaign(), drawn=True).assign(note="mean of 3 windows of the measured road")
    table["friction_rubber_error"] = 0.2 * table["friction_direct"]
    for name in ("friction_total_error", "friction_direct_error"):
        table[name] += table["friction_rubber_error"]
    drawn = [fig10.draw(table, [0.5, 5.0]), fig10.draw(table, [5.0]), fig7.draw(make_campaign(), table, 0.75, 5.0)]
    for figure in drawn:
        said = words(figure)
        assert any("the profile itself" in one.lower() and one.endswith("mean of 3 windows") for one in said)
        assert "Sum of its sines" in said
        assert "Error: the rubber's data,\nat most 20\N{NO-BREAK SPACE}%" in said
        assert "Error from so few windows at most 0.72\N{NO-BREAK SPACE}%" in figure.get_supxlabel().replace("\n", " ")
        assert overlaps(figure) == []
    assert {len(bands(panel)) for panel in drawn[0].axes} == {3}


def test_refused_speeds_are_crossed(
    make_campaign: Maker,
    make_totals: TableMaker,
    words: Callable[..., list[str]],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    table = make_totals(make_campaign(), refused=[(5.0, 10.0), (5.0, 1000.0)])
    figure = fig10.draw(table, [0.5, 5.0])
    light, heavy = figure.axes
    (crosses,) = (line for line in heavy.get_lines() if line.get_gid() == "missing")
    assert list(crosses.get_xdata()) == [10.0, 1000.0]
    assert not [line for line in light.get_lines() if line.get_gid() == "missing"]
    assert "Whole road not solved" in words(figure)
    style.save(figure, tmp_path / "fig10.png", tmp_path / "fig10.pdf")
    assert overlaps(figure) == []


def test_without_direct_totals_the_estimates_are_drawn(
    make_campaign: Maker, make_totals: TableMaker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    table = make_totals(campaign)
    table["friction_direct"], table["way"] = np.nan, "sum"
    figure = fig10.draw(table, [5.0, 5.0])
    assert set(curves(figure.axes[0])) == {sentence(WAYS[way]) for way in ("sum", "corrected", "cascade", "persson")}
    assert not any("not solved" in one or "rror" in one for one in words(figure))
    assert len(figure.axes) == 1


def test_nothing_to_draw_is_refused(make_campaign: Maker, make_totals: TableMaker) -> None:
    table = make_totals(make_campaign())
    table[[f"friction_{way}" for way in WAYS]] = np.nan
    with pytest.raises(InvalidInput, match=r"^the table of totals has no friction at these pressures"):
        fig10.draw(table, [5.0])
