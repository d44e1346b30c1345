from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.figures import fig6, style
from rubfric.figures.bands import bands
from rubfric.figures.peaks import rings
from rubfric.results.curves import curve_table, scale_name

Maker = Callable[..., xr.Dataset]


def lines(panel: Axes) -> list[Line2D]:
    return [line for line in panel.get_lines() if line.get_gid() is None]


def test_panels_run_from_the_coarsest_scale_to_the_finest(make_campaign: Maker) -> None:
    figure = fig6.draw(make_campaign(), 0.75)
    titles = [panel.get_title(loc="left") for panel in figure.axes]
    assert titles == [
        "(a) Scale 1, 0.2 mm",
        "(b) Scale 2, 0.1 mm",
        "(c) Scale 3, 0.05 mm",
        "(d) Scale 4, 0.025 mm (micro-scale)",
    ]


def test_lines_are_the_campaign_s(make_campaign: Maker, series: Callable[..., Any]) -> None:
    campaign = make_campaign()
    for panel, scale in zip(fig6.draw(campaign, 0.75).axes, (1, 2, 3, 4), strict=True):
        lines = series(panel)
        assert len(lines) == 3
        for (_, values), pressure in zip(lines, (0.5, 1.0, 5.0), strict=True):
            chosen = campaign["friction_coefficient"].sel(scale=scale, pressure=pressure, aspect=0.75)
            assert values == list(chosen.values)


def test_peak_of_every_line_is_marked(make_campaign: Maker) -> None:
    campaign = make_campaign()
    figure = fig6.draw(campaign, 0.75)
    for panel, scale, speed in zip(figure.axes, (1, 2, 3, 4), (1000.0, 100.0, 10.0, 1.0), strict=True):
        marks = [(ring.get_xdata()[0], ring.get_ydata()[0]) for ring in rings(panel)]
        highest = campaign["friction_coefficient"].sel(scale=scale, aspect=0.75).max("velocity").values
        assert marks == [(speed, value) for value in highest]


def test_bands_hold_what_the_data_of_a_measured_rubber_leave(
    make_campaign: Maker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    plain = fig6.draw(campaign, 0.75)
    campaign["friction_coefficient_rubber_error"] = 0.1 * campaign["friction_coefficient"]
    campaign["friction_beyond_window"] = (campaign["friction_coefficient"] * 0.0).where(campaign["velocity"] < 1e3, 0.5)
    figure = fig6.draw(campaign, 0.75)
    assert any("the rubber's data alone\nat most 10" in text for text in words(figure))
    assert not any("rubber" in text or "Beyond" in text for text in words(plain))
    assert sum("Beyond the measured" in text for text in words(figure)) == 1
    crosses = [line for line in figure.axes[0].get_lines() if line.get_gid() == "beyond"]
    assert [list(cross.get_xdata()) for cross in crosses] == [[1e3] * 3 + [1e4] * 3]
    heights = [bands(one.axes[0])[0].get_paths()[0].get_extents().height for one in (plain, figure)]
    assert heights[0] < heights[1]


def test_points_that_carry_a_warning_are_marked_but_once_in_a_crowd(
    make_campaign: Maker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    campaign["warnings"] = xr.zeros_like(campaign["friction_coefficient"])
    assert "Carries a warning" not in words(fig6.draw(campaign, 0.75))
    campaign["warnings"].loc[{"scale": 2, "velocity": 100.0}] = 1.0
    # Friction at the three pressures is 1.05, 1.1 and 1.5 times as high as without pressure.
    figure = fig6.draw(campaign, 0.75)
    friction = campaign["friction_coefficient"].sel(scale=2, velocity=100.0, aspect=0.75)
    marks = [[one for one in panel.get_lines() if one.get_gid() == "warned"] for panel in figure.axes]
    assert [len(found) for found in marks] == [0, 1, 0, 0]
    assert list(marks[1][0].get_xdata()) == [100.0, 100.0]
    assert sorted(marks[1][0].get_ydata()) == [float(friction.sel(pressure=one)) for one in (1.0, 5.0)]
    assert words(figure).count("Carries a warning") == 1


def test_every_line_has_its_band(make_campaign: Maker, words: Callable[..., list[str]]) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient_error"].loc[{"scale": 2, "pressure": 1.0, "velocity": 100.0, "aspect": 0.75}] = 0.5
    figure = fig6.draw(campaign, 0.75)
    for panel, scale in zip(figure.axes, (1, 2, 3, 4), strict=True):
        drawn = bands(panel)
        colours = [to_rgb(line.get_color()) for line in lines(panel)]
        np.testing.assert_allclose([band.get_facecolor()[0][:3] for band in drawn], colours)
        for band, pressure in zip(drawn, (0.5, 1.0, 5.0), strict=True):
            corners = band.get_paths()[0].vertices
            one = campaign.sel(scale=scale, pressure=pressure, aspect=0.75)
            value, error = one["friction_coefficient"], one["friction_coefficient_error"]
            for edge in (value - error, value + error):
                wanted = np.stack((edge["velocity"].values, edge.values), axis=1)
                assert all(np.isclose(corners, point).all(axis=1).any() for point in wanted)
    # The largest error is told, and fits into the panel.
    friction = campaign["friction_coefficient"].sel(scale=2, pressure=1.0, velocity=100.0, aspect=0.75).item()
    assert f"Estimated error,\nat most {style.percent(0.5 / friction)}" in words(figure)
    assert figure.axes[0].get_ylim()[1] > friction + 0.5


def test_no_words_cover_each_other(
    make_campaign: Maker, overlaps: Callable[[Figure], list[tuple[str, str]]], tmp_path: Path
) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient_error"].loc[{"velocity": 1.0}] = np.nan
    figure = fig6.draw(campaign, 0.75)
    style.save(figure, tmp_path / "figure.png")
    assert overlaps(figure) == []


def test_campaign_without_errors_is_refused(make_campaign: Maker) -> None:
    with pytest.raises(BrokenResult, match=r"^the campaign lacks friction_coefficient_error"):
        fig6.draw(make_campaign().drop_vars("friction_coefficient_error"), 0.75)


def test_figure_says_what_it_shows(make_campaign: Maker, words: Callable[..., list[str]]) -> None:
    said = words(fig6.draw(make_campaign(), 0.75))
    for text in ("Sliding speed (mm/s)", "Friction coefficient", "Nominal pressure\n(MPa)", "0.5", "Sampled peak"):
        assert text in said


def test_pressures_of_other_blocks_are_left_out(make_campaign: Maker) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"].loc[{"pressure": 1.0, "aspect": 0.75}] = np.nan
    figure = fig6.draw(campaign, 0.75)
    assert all(len(rings(panel)) == 2 for panel in figure.axes)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "0.5",
        "5",
        "Sampled peak",
        "Carries a warning",
    ]
    assert figure.get_supxlabel() == "Estimated error at most 1.2\N{NO-BREAK SPACE}%: too small for bands to be seen."


def test_what_is_absent_is_refused(make_campaign: Maker) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"^height-to-width ratio 1 is not in the campaign, which has 0\.25"):
        fig6.draw(campaign, 1.0)
    campaign["friction_coefficient"].loc[{"scale": 2}] = np.nan
    with pytest.raises(InvalidInput, match=r"^the campaign holds no friction coefficient at height-to-width ratio 0"):
        fig6.draw(campaign, 0.75)


def test_gaps_zeros_and_single_points_are_drawn(make_campaign: Maker, tmp_path: Path) -> None:
    gaps, zeros = make_campaign(scales=(1, 2)), make_campaign(scales=(1, 2))
    single = make_campaign(scales=(1,), speeds=(10.0,), pressures=(5.0,))
    gaps["friction_coefficient"].loc[{"velocity": 10.0, "scale": 1}] = np.nan
    gaps["friction_coefficient"].loc[{"pressure": 5.0, "scale": 2}] = np.nan
    zeros["friction_coefficient"][:] = 0.0
    for name, campaign in {"gaps": gaps, "zeros": zeros, "single": single}.items():
        style.save(fig6.draw(campaign, 0.75), tmp_path / f"{name}.png")
    assert not any(rings(panel) for panel in fig6.draw(zeros, 0.75).axes)


def points(campaign: xr.Dataset, scale: int) -> pd.DataFrame:
    """Return what the table of a scale has of its curves."""
    names = {"velocity": "velocity_mm_per_s", "pressure": "pressure_MPa"}
    return campaign.sel(scale=scale, drop=True).to_dataframe().reset_index().rename(columns=names)


def test_curves_with_added_speeds_are_drawn_as_they_are_known_with_their_peaks(
    make_campaign: Maker, words: Callable[[Figure], list[str]]
) -> None:
    campaign, dense = make_campaign(), make_campaign(speeds=np.geomspace(0.13, 9e3, 24))
    scales = (1, 2, 3, 4)
    curves = curve_table(
        {scale_name(scale): points(campaign, scale) for scale in scales},
        {scale_name(scale): [points(dense.sel(aspect=[0.75]), scale)] for scale in scales},
        0.75,
    )
    plain, found = fig6.draw(campaign, 0.75), fig6.draw(campaign, 0.75, curves=curves)
    for coarse, fine, scale in zip(plain.axes, found.axes, (1, 2, 3, 4), strict=True):
        before, after = coarse.get_lines()[0], fine.get_lines()[0]
        speeds, marked = np.asarray(after.get_xdata()), after.get_markevery()
        assert speeds[marked] == pytest.approx(before.get_xdata())
        assert np.asarray(after.get_ydata())[marked] == pytest.approx(before.get_ydata())
        peaks = [float(bars.lines[0].get_xdata()[0]) for bars in fine.containers]
        assert peaks == pytest.approx([10.0 ** (4 - scale)] * 3, rel=0.05)
        assert not rings(fine)
    assert "Peak, with its error" in words(found)
    assert "Sampled peak" not in words(found)
