"""Friction over speed at each temperature, and the points as a master curve."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import fig7, fig12, style
from rubfric.figures.bands import bands
from rubfric.figures.temperature import name_temperature
from rubfric.results.tables import by_temperature

Maker = Callable[..., xr.Dataset]
TableMaker = Callable[..., pd.DataFrame]
FACTORS = {0.0: (100.0, 1.0), 20.0: (1.0, 1.0), 60.0: (0.01, 1.0)}


@pytest.fixture
def table(make_campaign: Maker, make_totals: TableMaker) -> pd.DataFrame:
    """Totals at three temperatures: friction of the reference, at the speed times a_T."""
    tables = {}
    for temperature, (shift, _) in FACTORS.items():
        tables[temperature] = make_totals(make_campaign(speeds=[1.0, 10.0, 100.0, 1000.0]))
        reduced = shift * tables[temperature]["velocity_mm_per_s"]
        tables[temperature]["friction_total"] = 0.1 + 0.01 * np.log10(reduced)
    return by_temperature(tables)


def test_points_shifted_by_a_t_are_one_curve(
    table: pd.DataFrame,
    words: Callable[..., list[str]],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    figure = fig12.draw(table, 0.5, FACTORS, 20.0)
    left, right = figure.axes
    lines = [line for line in left.get_lines() if len(line.get_xdata()) == 4]
    shifted = [line for line in right.get_lines() if line.get_marker() not in ("None", "|", "_", None)]
    assert len(lines) == len(shifted) == len(bands(left)) == 3
    for line, point, (shift, _) in zip(lines, shifted, FACTORS.values(), strict=True):
        np.testing.assert_allclose(point.get_xdata(), shift * np.asarray(line.get_xdata()), rtol=1e-12)
        np.testing.assert_array_equal(point.get_ydata(), line.get_ydata())
        np.testing.assert_allclose(point.get_ydata(), 0.1 + 0.01 * np.log10(np.asarray(point.get_xdata())), rtol=1e-12)
    assert [panel.get_title(loc="left") for panel in figure.axes] == ["(a) At each temperature", "(b) Shifted to 20 °C"]
    said = words(figure)
    assert [one for one in said if one in ("0", "20", "60")] == ["0", "20", "60"]
    assert not any("b_T" in one for one in said)
    style.save(figure, tmp_path / "fig12.png")
    assert overlaps(figure) == []


def test_vertical_shift_is_said(table: pd.DataFrame, words: Callable[..., list[str]]) -> None:
    factors = {one: (shift, (one + 273.15) / 293.15) for one, (shift, _) in FACTORS.items()}
    assert any("0.932 to 1.14" in one and "0.5 MPa" in one for one in words(fig12.draw(table, 0.5, factors, 20.0)))


def test_temperature_that_the_table_lacks_is_refused(table: pd.DataFrame) -> None:
    with pytest.raises(InvalidInput, match="temperature is 80 degC, but the table has 0, 20, 60 degC"):
        fig12.draw(table, 0.5, {80.0: (1.0, 1.0)}, 20.0)


def test_other_figures_name_their_temperature(
    make_campaign: Maker, make_totals: TableMaker, overlaps: Callable[[Figure], list[tuple[str, str]]], tmp_path: Path
) -> None:
    campaign = make_campaign()
    plain, warm = (fig7.draw(campaign, make_totals(campaign), 0.75, 0.5) for _ in range(2))
    note = name_temperature(plain, None).get_supxlabel()
    assert name_temperature(warm, -5.0).get_supxlabel() == f"{note}\nRubber at \N{MINUS SIGN}5 °C."
    style.save(warm, tmp_path / "fig7.png")
    assert overlaps(warm) == []
