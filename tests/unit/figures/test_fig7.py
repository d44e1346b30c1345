from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.figures import fig7, style
from rubfric.figures.bands import bands
from rubfric.figures.peaks import rings

Maker = Callable[..., xr.Dataset]


def areas(panel: Axes) -> dict[str, list[np.ndarray]]:
    """Return the corners of each scale's areas."""
    found: dict[str, list[np.ndarray]] = {}
    for area in panel.collections:
        if area.get_gid() == "error":
            continue
        found.setdefault(str(area.get_gid()), []).append(area.get_paths()[0].vertices)
    return found


def thickness(corners: np.ndarray, speed: float) -> float:
    heights = corners[np.isclose(corners[:, 0], speed), 1]
    return float(heights.max() - heights.min())


def test_shares_add_up_to_the_total(make_campaign: Maker, series: Callable[..., Any]) -> None:
    campaign = make_campaign()
    (panel,) = fig7.draw(campaign, 0.75, 5.0).axes
    ((speeds, total),) = series(panel)
    friction = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0)
    np.testing.assert_allclose(total, friction.sum("scale").values, rtol=1e-12)
    shares = areas(panel)
    assert list(shares) == ["scale 4", "scale 3", "scale 2", "scale 1"]
    for place, speed in enumerate(speeds):
        stacked = {name: thickness(corners, speed) for name, (corners,) in shares.items()}
        for scale in (1, 2, 3, 4):
            assert stacked[f"scale {scale}"] == pytest.approx(friction.sel(scale=scale, velocity=speed).item())
        assert sum(stacked.values()) == pytest.approx(total[place])


def test_areas_lie_upon_each_other(make_campaign: Maker) -> None:
    (panel,) = fig7.draw(make_campaign(), 0.75, 5.0).axes
    bounds = []
    for (corners,) in areas(panel).values():
        heights = corners[np.isclose(corners[:, 0], 10.0), 1]
        bounds.append((heights.min(), heights.max()))
    assert bounds[0][0] == 0.0
    for below, above in pairwise(bounds):
        assert above[0] == pytest.approx(below[1])


def test_peak_of_the_total_is_marked(make_campaign: Maker) -> None:
    campaign = make_campaign()
    (panel,) = fig7.draw(campaign, 0.75, 5.0).axes
    total = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0).sum("scale")
    (ring,) = rings(panel)
    assert ring.get_xdata()[0] == total["velocity"].values[np.argmax(total.values)]
    assert ring.get_ydata()[0] == pytest.approx(total.max().item())


def test_band_is_the_sum_of_the_errors_of_the_scales(make_campaign: Maker, words: Callable[..., list[str]]) -> None:
    campaign = make_campaign()
    figure = fig7.draw(campaign, 0.75, 5.0)
    (band,) = bands(figure.axes[0])
    (corners,) = (path.vertices for path in band.get_paths())
    error = campaign["friction_coefficient_error"].sel(aspect=0.75, pressure=5.0).sum("scale")
    for speed in campaign["velocity"].values:
        assert thickness(corners, speed) == pytest.approx(2.0 * error.sel(velocity=speed).item())
    assert "estimated error,\nat most 1.2\N{NO-BREAK SPACE}%" in words(figure)


def test_no_words_cover_each_other(
    make_campaign: Maker, overlaps: Callable[[Figure], list[tuple[str, str]]], tmp_path: Path
) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient_error"].loc[{"velocity": 1.0}] = np.nan
    figure = fig7.draw(campaign, 0.75, 5.0)
    style.save(figure, tmp_path / "figure.png")
    assert overlaps(figure) == []


def test_campaign_without_errors_is_refused(make_campaign: Maker) -> None:
    with pytest.raises(BrokenResult, match=r"^the campaign lacks friction_coefficient_error"):
        fig7.draw(make_campaign().drop_vars("friction_coefficient_error"), 0.75, 5.0)


def test_gap_is_bridged_by_no_area(make_campaign: Maker, tmp_path: Path) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"].loc[{"velocity": 10.0, "scale": 3}] = np.nan
    figure = fig7.draw(campaign, 0.75, 5.0)
    for parts in areas(figure.axes[0]).values():
        assert [(corners[:, 0].min(), corners[:, 0].max()) for corners in parts] == [(0.1, 1.0), (100.0, 10000.0)]
    style.save(figure, tmp_path / "gap.png")


def test_speed_without_neighbours_is_a_bar(make_campaign: Maker, tmp_path: Path) -> None:
    campaign = make_campaign(speeds=(10.0,))
    figure = fig7.draw(campaign, 0.75, 5.0)
    for scale, (corners,) in zip((4, 3, 2, 1), areas(figure.axes[0]).values(), strict=True):
        assert corners[:, 0].min() < 10.0 < corners[:, 0].max()
        share = campaign["friction_coefficient"].sel(aspect=0.75, pressure=5.0, scale=scale).item()
        assert thickness(corners, corners[0, 0]) == pytest.approx(share)
    style.save(figure, tmp_path / "bar.pdf")


def test_zero_friction_is_drawn_without_a_peak(make_campaign: Maker, tmp_path: Path) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"][:] = 0.0
    figure = fig7.draw(campaign, 0.75, 5.0)
    assert rings(figure.axes[0]) == []
    style.save(figure, tmp_path / "zero.png")


def test_what_is_absent_is_refused(make_campaign: Maker) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"^pressure 2 MPa is not in the campaign, which has 0\.5, 1, 5 MPa$"):
        fig7.draw(campaign, 0.75, 2.0)
    campaign["friction_coefficient"].loc[{"scale": 2}] = np.nan
    with pytest.raises(
        InvalidInput, match=r"^the campaign has no speed at which all scales were run at pressure 5 MPa"
    ):
        fig7.draw(campaign, 0.75, 5.0)
