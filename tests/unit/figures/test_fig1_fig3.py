"""Friction over speed and over the height-to-width ratio: the same campaign seen from two sides."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.figures import fig1, fig3, style
from rubfric.figures.bands import bands

Maker = Callable[..., xr.Dataset]
ASPECTS = (0.25, 0.75, 1.5)


def test_fig1_has_a_panel_per_pressure_and_a_line_per_ratio(make_campaign: Maker, series: Callable[..., Any]) -> None:
    campaign = make_campaign()
    figure = fig1.draw(campaign, [1], [0.5, 5.0], ASPECTS)
    assert len(figure.axes) == 2
    for panel, pressure in zip(figure.axes, (0.5, 5.0), strict=True):
        lines = series(panel)
        assert len(lines) == 3
        for (speeds, values), aspect in zip(lines, ASPECTS, strict=True):
            chosen = campaign["friction_coefficient"].sel(scale=1, pressure=pressure, aspect=aspect)
            assert speeds == list(campaign["velocity"].values)
            assert values == list(chosen.values)


def test_fig3_has_a_panel_per_pressure_and_a_line_per_speed(make_campaign: Maker, series: Callable[..., Any]) -> None:
    campaign = make_campaign()
    # Ratios in any order.
    figure = fig3.draw(campaign, [2], [0.5, 5.0], ASPECTS[::-1])
    for panel, pressure in zip(figure.axes, (0.5, 5.0), strict=True):
        lines = series(panel)
        assert len(lines) == campaign.sizes["velocity"]
        for (ratios, values), speed in zip(lines, campaign["velocity"].values, strict=True):
            assert ratios == list(ASPECTS)
            chosen = campaign["friction_coefficient"].sel(scale=2, pressure=pressure, velocity=speed)
            assert values == list(chosen.values)


@pytest.mark.parametrize(("module", "count"), [(fig1, 3), (fig3, 6)])
def test_every_line_has_its_band(
    make_campaign: Maker, module: ModuleType, count: int, words: Callable[..., list[str]]
) -> None:
    campaign = make_campaign()
    figure = module.draw(campaign, [1], [0.5, 5.0], ASPECTS)
    for panel, pressure in zip(figure.axes, (0.5, 5.0), strict=True):
        one = campaign.sel(scale=1, pressure=pressure)
        upper = (one["friction_coefficient"] + one["friction_coefficient_error"]).values
        corners = np.concatenate([band.get_paths()[0].vertices for band in bands(panel)])
        assert len(bands(panel)) == count
        assert all(np.isclose(corners[:, 1], value, rtol=1e-12).any() for value in upper.flat)
        assert panel.get_ylim()[1] > upper.max()
    assert "Estimated error at most 1.2\N{NO-BREAK SPACE}%: too small for bands to be seen." in words(figure)


@pytest.mark.parametrize("module", [fig1, fig3])
def test_campaign_without_errors_is_refused(make_campaign: Maker, module: ModuleType) -> None:
    with pytest.raises(BrokenResult, match=r"^the campaign lacks friction_coefficient_error: gather"):
        module.draw(make_campaign().drop_vars("friction_coefficient_error"), [1], [5.0], ASPECTS)


@pytest.mark.parametrize("module", [fig1, fig3])
@pytest.mark.parametrize("pressures", [(5.0,), (0.5, 5.0)])
def test_no_words_cover_each_other(
    make_campaign: Maker,
    module: ModuleType,
    pressures: tuple[float, ...],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient_error"].loc[{"velocity": 1.0}] = np.nan
    figure = module.draw(campaign, [1], pressures, ASPECTS)
    style.save(figure, tmp_path / "figure.png")
    assert overlaps(figure) == []


@pytest.mark.parametrize("module", [fig1, fig3])
def test_unknown_and_huge_errors_are_drawn(
    make_campaign: Maker, module: ModuleType, words: Callable[..., list[str]], tmp_path: Path
) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient_error"].loc[{"velocity": 100.0}] = np.inf
    campaign["friction_coefficient_error"].loc[{"velocity": 1.0}] = np.nan
    campaign["friction_coefficient_error"].loc[{"velocity": 0.1}] = 2.0 * campaign["friction_coefficient"].sel(
        velocity=0.1
    )
    figure = module.draw(campaign, [1], [5.0], ASPECTS)
    assert "Estimated error,\nat most 200\N{NO-BREAK SPACE}%,\nunknown at 6 of 18 points" in words(figure)
    assert np.isfinite(figure.axes[0].get_ylim()).all()
    style.save(figure, tmp_path / "unknown.png")


def test_fig3_is_logarithmic_unless_a_friction_is_zero(make_campaign: Maker) -> None:
    campaign = make_campaign()
    assert fig3.draw(campaign, [1], [5.0], ASPECTS).axes[0].get_yscale() == "log"
    campaign["friction_coefficient"].loc[{"velocity": 0.1}] = 0.0
    assert fig3.draw(campaign, [1], [5.0], ASPECTS).axes[0].get_yscale() == "linear"


@pytest.mark.parametrize("module", [fig1, fig3])
@pytest.mark.parametrize(
    ("asked", "complaint"),
    [
        (([5], [5.0], ASPECTS), r"^scale 5 is not in the campaign"),
        (([1], [2.0], ASPECTS), r"^pressure 2 MPa is not in the campaign"),
        (([1], [5.0], (0.25, 1.0)), r"^height-to-width ratio 1 is not in the campaign"),
        (([], [5.0], ASPECTS), r"^the figure has 0 panels"),
    ],
)
def test_what_is_absent_is_refused(
    make_campaign: Maker, module: ModuleType, asked: tuple[Any, ...], complaint: str
) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        module.draw(make_campaign(), *asked)


@pytest.mark.parametrize("module", [fig1, fig3])
def test_block_that_was_not_run_is_refused(make_campaign: Maker, module: ModuleType) -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"].loc[{"scale": 1, "pressure": 5.0, "aspect": 1.5}] = np.nan
    with pytest.raises(InvalidInput, match=r"^the campaign holds no friction coefficient at scale 1, pressure 5 MPa, "):
        module.draw(campaign, [1], [5.0], ASPECTS)


@pytest.mark.parametrize("module", [fig1, fig3])
def test_gaps_zeros_and_single_points_are_drawn(make_campaign: Maker, module: ModuleType, tmp_path: Path) -> None:
    gaps, zeros = make_campaign(), make_campaign()
    gaps["friction_coefficient"].loc[{"velocity": [1.0, 100.0]}] = np.nan
    zeros["friction_coefficient"][:] = 0.0
    style.save(module.draw(gaps, [1], [5.0], ASPECTS), tmp_path / "gaps.png")
    style.save(module.draw(zeros, [1], [5.0], ASPECTS), tmp_path / "zeros.pdf")
    style.save(module.draw(make_campaign(speeds=(10.0,)), [1], [5.0], [0.75]), tmp_path / "single.png")
