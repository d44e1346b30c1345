from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import fig7, style
from rubfric.figures.bands import bands
from rubfric.figures.palette import scale_colour
from rubfric.figures.peaks import rings

Maker = Callable[..., xr.Dataset]
TableMaker = Callable[..., pd.DataFrame]
Drawer = Callable[..., Figure]


@pytest.fixture
def draw(make_totals: TableMaker) -> Drawer:
    """Return a function that draws a campaign at a pressure, its totals made up."""

    def drawn(campaign: xr.Dataset, pressure: float = 5.0, **totals: Any) -> Figure:
        return fig7.draw(campaign, make_totals(campaign, **totals), 0.75, pressure)

    return drawn


def areas(panel: Axes) -> dict[str, list[np.ndarray]]:
    """Return the corners of each scale's areas."""
    found: dict[str, list[np.ndarray]] = {}
    for area in panel.collections:
        if not str(area.get_gid()).startswith("scale"):
            continue
        found.setdefault(str(area.get_gid()), []).append(area.get_paths()[0].vertices)
    return found


def thickness(corners: np.ndarray, speed: float) -> float:
    heights = corners[np.isclose(corners[:, 0], speed), 1]
    return float(heights.max() - heights.min())


def line(panel: Axes, gid: str | None) -> tuple[np.ndarray, np.ndarray]:
    """Return the data of the line of the sum, or of the total, which has no gid and is drawn first."""
    found = next(one for one in panel.get_lines() if one.get_gid() == gid)
    return np.asarray(found.get_xdata()), np.asarray(found.get_ydata())


def test_shares_add_up_to_the_sum(make_campaign: Maker, draw: Drawer) -> None:
    campaign = make_campaign()
    (panel,) = draw(campaign).axes
    speeds, total = line(panel, "sum")
    friction = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0)
    np.testing.assert_allclose(total, friction.sum("scale").values, rtol=1e-12)
    shares = areas(panel)
    assert list(shares) == ["scale 1", "scale 2", "scale 3", "scale 4"]
    for place, speed in enumerate(speeds):
        stacked = {name: thickness(corners, speed) for name, (corners,) in shares.items()}
        for scale in (1, 2, 3, 4):
            assert stacked[f"scale {scale}"] == pytest.approx(friction.sel(scale=scale, velocity=speed).item())
        assert sum(stacked.values()) == pytest.approx(total[place])


def test_areas_lie_upon_each_other(make_campaign: Maker, draw: Drawer) -> None:
    (panel,) = draw(make_campaign()).axes
    bounds = []
    for (corners,) in areas(panel).values():
        heights = corners[np.isclose(corners[:, 0], 10.0), 1]
        bounds.append((heights.min(), heights.max()))
    assert bounds[0][0] == 0.0
    for below, above in pairwise(bounds):
        assert above[0] == pytest.approx(below[1])


def test_total_is_all_scales_at_once_with_its_band_and_peak(
    make_campaign: Maker, draw: Drawer, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    figure = draw(campaign)
    (panel,) = figure.axes
    speeds, total = line(panel, None)
    summed = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0).sum("scale")
    np.testing.assert_allclose(total, 0.7 * summed, rtol=1e-12)
    for band in bands(panel):
        (corners,) = (path.vertices for path in band.get_paths())
        for speed in speeds:
            assert thickness(corners, speed) == pytest.approx(0.02 * summed.sel(velocity=speed).item())
    (ring,) = rings(panel)
    assert ring.get_xdata()[0] == speeds[np.argmax(total)]
    assert ring.get_ydata()[0] == pytest.approx(total.max())
    said = words(figure)
    assert [one for one in said if one.startswith("Scale")] == [
        f"Scale {scale}, {wavelength} mm" for scale, wavelength in enumerate(("0.2", "0.1", "0.05", "0.025"), 1)
    ]
    assert "Total: all scales at once,\none road, these phases" in said
    assert "Estimated error at most 1.5\N{NO-BREAK SPACE}%: too small for bands to be seen." in said


def test_mean_over_random_phases_is_called_so(
    make_campaign: Maker, draw: Drawer, words: Callable[..., list[str]]
) -> None:
    assert "Total: all scales at once,\nmean of random phases" in words(draw(make_campaign(), drawn=True))


def test_refused_points_are_open_with_their_whole_error(
    make_campaign: Maker,
    draw: Drawer,
    words: Callable[..., list[str]],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    campaign = make_campaign()
    figure = draw(campaign, refused=[(5.0, 100.0)])
    style.save(figure, tmp_path / "figure.png")
    (panel,) = figure.axes
    speeds, total = line(panel, None)
    assert list(speeds[np.isnan(total)]) == [100.0]
    (points,) = (one for one in panel.get_lines() if one.get_markerfacecolor() == "white" and one.get_gid() is None)
    summed = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0, velocity=100.0).sum("scale").item()
    assert list(points.get_xdata()) == [100.0]
    assert points.get_ydata() == pytest.approx([summed])
    (bar,) = (one for one in panel.collections if isinstance(one, LineCollection) and one.get_gid() is None)
    assert bar.get_segments()[0][:, 1] == pytest.approx([0.6 * summed, 1.4 * summed])
    assert "Not solved: sum of the\nscales, with all of its\nerror" in words(figure)
    assert panel.get_ylim()[1] > 1.4 * summed
    assert overlaps(figure) == []


def test_total_that_is_the_sum_says_so(
    make_campaign: Maker, make_totals: TableMaker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    table = make_totals(campaign, refused=list(product(campaign["pressure"].values, campaign["velocity"].values)))
    said = words(fig7.draw(campaign, table, 0.75, 5.0))
    assert "Total: sum of the scales,\none road, these phases" in said
    assert not any("Not solved" in one for one in said)


def test_table_that_lacks_something_is_refused(make_campaign: Maker, make_totals: TableMaker) -> None:
    campaign = make_campaign()
    table = make_totals(campaign)
    with pytest.raises(InvalidInput, match=r"^the table of totals lacks the column friction_direct$"):
        fig7.draw(campaign, table.drop(columns="friction_direct"), 0.75, 5.0)
    with pytest.raises(InvalidInput, match=r"^the table of totals has no pressure 5 MPa, but 0\.5, 1 MPa$"):
        fig7.draw(campaign, table[table["pressure_MPa"] < 5.0], 0.75, 5.0)


def test_totals_that_carry_a_warning_are_marked(
    make_campaign: Maker, make_totals: TableMaker, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    table = make_totals(campaign)
    table["warnings"] = np.where(table["velocity_mm_per_s"] == 100.0, 2, 0)
    figure = fig7.draw(campaign, table, 0.75, 5.0)
    speeds, totals = line(figure.axes[0], "warned")
    assert list(speeds) == [100.0]
    total = table.loc[(table["velocity_mm_per_s"] == 100.0) & (table["pressure_MPa"] == 5.0), "friction_total"]
    assert list(totals) == list(total)
    assert words(figure).count("Carries a warning") == 1
    assert "Carries a warning" not in words(fig7.draw(campaign, table.assign(warnings=0), 0.75, 5.0))


def test_scales_have_the_colours_of_the_explorer(make_campaign: Maker, draw: Drawer) -> None:
    # Of a campaign without scale 2 the others keep theirs.
    (panel,) = draw(make_campaign(scales=(1, 3))).axes
    found = {str(area.get_gid()): area.get_facecolor()[0][:3] for area in panel.collections if area.get_gid()}
    for scale in (1, 3):
        np.testing.assert_allclose(found[f"scale {scale}"], 0.45 * np.array(to_rgb(scale_colour(scale))) + 0.55)


def test_gap_is_bridged_by_no_area(make_campaign: Maker, draw: Drawer, tmp_path: Path) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"].loc[{"velocity": 10.0, "scale": 3}] = np.nan
    figure = draw(campaign)
    for parts in areas(figure.axes[0]).values():
        assert [(corners[:, 0].min(), corners[:, 0].max()) for corners in parts] == [(0.1, 1.0), (100.0, 10000.0)]
    style.save(figure, tmp_path / "gap.png")


def test_speed_without_neighbours_is_a_bar(make_campaign: Maker, draw: Drawer, tmp_path: Path) -> None:
    campaign = make_campaign(speeds=(10.0,))
    figure = draw(campaign)
    for scale, (corners,) in zip((1, 2, 3, 4), areas(figure.axes[0]).values(), strict=True):
        assert corners[:, 0].min() < 10.0 < corners[:, 0].max()
        share = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0, scale=scale).item()
        assert thickness(corners, corners[0, 0]) == pytest.approx(share)
    style.save(figure, tmp_path / "bar.pdf")


def test_zero_friction_is_drawn_without_a_peak(make_campaign: Maker, draw: Drawer, tmp_path: Path) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"][:] = 0.0
    figure = draw(campaign)
    assert rings(figure.axes[0]) == []
    style.save(figure, tmp_path / "zero.png")


def test_what_is_absent_is_refused(make_campaign: Maker, draw: Drawer) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"^pressure 2 MPa is not in the campaign, which has 0\.5, 1, 5 MPa$"):
        draw(campaign, pressure=2.0)
    campaign["friction_coefficient"].loc[{"scale": 2}] = np.nan
    with pytest.raises(
        InvalidInput, match=r"^the campaign has no speed at which all scales were run at pressure 5 MPa"
    ):
        draw(campaign)


def test_added_speeds_have_a_peak_with_its_error(make_campaign: Maker, make_totals: TableMaker) -> None:
    campaign = make_campaign()
    dense = make_totals(make_campaign(speeds=np.geomspace(0.15, 8e3, 20)))
    table = pd.concat([make_totals(campaign), dense], ignore_index=True)
    (panel,) = fig7.draw(campaign, table, 0.75, 5.0, refined=True).axes
    speeds, total = line(panel, None)
    assert len(speeds) == 26
    assert np.all(np.diff(speeds) > 0.0)
    (bars,) = panel.containers
    (at,), (friction,) = bars.lines[0].get_data()
    low, high = bars.lines[2][0].get_segments()[0][:, 0]
    assert low < float(speeds[np.argmax(total)]) < high
    assert friction == pytest.approx(float(np.max(total)), rel=0.02)
    assert low < at < high
    assert not rings(panel)
