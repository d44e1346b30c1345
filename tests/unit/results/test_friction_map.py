"""Friction between the scenes of a campaign."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.results.friction_map import FrictionMap

SPEEDS, PRESSURES = (0.1, 1.0, 10.0, 100.0), (0.5, 1.0, 5.0)


@pytest.fixture
def campaign() -> xr.Dataset:
    axes = {"scale": [1, 2], "velocity": list(SPEEDS), "pressure": list(PRESSURES), "aspect": [0.5, 0.75]}
    scale, speed, pressure, _ = np.meshgrid(*axes.values(), indexing="ij")
    friction = 0.1 * scale * (1.0 - 0.1 * (np.log10(speed) - 1.0) ** 2) * (1.0 + 0.1 * np.log(pressure))
    fields = {"friction_coefficient": friction, "friction_coefficient_error": 0.01 * friction}
    return xr.Dataset({name: (tuple(axes), field) for name, field in fields.items()}, coords=axes)


def test_scenes_are_met(campaign: xr.Dataset) -> None:
    one = FrictionMap.from_campaign(campaign, 0.75, scale=2)
    for pressure in PRESSURES:
        expected = campaign["friction_coefficient"].sel(aspect=0.75, pressure=pressure, scale=2)
        np.testing.assert_allclose(one.at(pressure)(np.array(SPEEDS)), expected, rtol=1e-12)
        np.testing.assert_allclose(one.at(pressure).error_at(np.array(SPEEDS)), 0.01 * expected)


def test_total_that_counts_is_met_with_its_whole_error() -> None:
    points = [(speed, pressure) for speed in SPEEDS for pressure in reversed(PRESSURES)]
    table = pd.DataFrame(points, columns=["velocity_mm_per_s", "pressure_MPa"])
    table["friction_total"] = np.log10(table["velocity_mm_per_s"] * 20.0) * table["pressure_MPa"]
    table["friction_total_error"] = 0.1 * table["friction_total"]
    total = FrictionMap.from_totals(table)
    assert total.pressures.tolist() == list(PRESSURES)
    np.testing.assert_allclose(total.at(5.0)(np.array(SPEEDS)), 5.0 * np.log10(20.0 * np.array(SPEEDS)), rtol=1e-12)
    np.testing.assert_allclose(total.at(1.0).error_at(np.array(SPEEDS)), 0.1 * np.log10(20.0 * np.array(SPEEDS)))
    with pytest.raises(BrokenResult, match="the table of totals lacks friction_total_error: make it again"):
        FrictionMap.from_totals(table.drop(columns="friction_total_error"))
    with pytest.raises(InvalidInput, match="has no friction at some of its speeds and pressures"):
        FrictionMap.from_totals(table.iloc[1:])


def test_in_between_friction_stays_between_its_neighbours(campaign: xr.Dataset) -> None:
    friction = FrictionMap.from_campaign(campaign, 0.75, 1)
    curve = friction.at(2.0)
    corners = curve(np.array(SPEEDS))
    for low, high, ends in zip(SPEEDS, SPEEDS[1:], np.sort(np.column_stack((corners[:-1], corners[1:]))), strict=False):
        inside = curve(np.geomspace(low, high, 30))
        assert np.all(inside >= ends[0] - 1e-12)
        assert np.all(inside <= ends[1] + 1e-12)
    below, here, above = (friction.at(pressure)(10.0) for pressure in (1.0, 2.0, 5.0))
    assert below < here < above


def test_below_the_slowest_speed_friction_vanishes_with_speed(campaign: xr.Dataset) -> None:
    curve = FrictionMap.from_campaign(campaign, 0.75, 1).at(1.0)
    assert curve(0.0) == 0.0
    assert curve(0.05) == pytest.approx(0.5 * float(curve(0.1)))
    assert curve(1e5) == curve(100.0)


def test_other_pressures_are_refused(campaign: xr.Dataset) -> None:
    friction = FrictionMap.from_campaign(campaign, 0.75, 1)
    with pytest.raises(InvalidInput, match=r"^pressure is 6 MPa, but must lie within those simulated, 0.5 to 5 MPa$"):
        friction.at(6.0)


def test_gaps_ratios_and_older_campaigns_are_refused(campaign: xr.Dataset) -> None:
    with pytest.raises(InvalidInput, match=r"^height-to-width ratio 1 is not in the campaign, which has 0.5, 0.75$"):
        FrictionMap.from_campaign(campaign, 1.0, 1)
    with pytest.raises(InvalidInput, match=r"^scale 3 is not in the campaign, which has 1, 2$"):
        FrictionMap.from_campaign(campaign, 0.75, scale=3)
    with pytest.raises(BrokenResult, match="lacks friction_coefficient_error: gather"):
        FrictionMap.from_campaign(campaign.drop_vars("friction_coefficient_error"), 0.75, 1)
    campaign["friction_coefficient"][0, 1, 1, 1] = np.nan
    with pytest.raises(InvalidInput, match="has no friction at some of its speeds and pressures: run it whole"):
        FrictionMap.from_campaign(campaign, 0.75, 1)


def test_what_was_run_nowhere_is_left_out(campaign: xr.Dataset) -> None:
    campaign["friction_coefficient"][:, :, 1] = np.nan
    assert FrictionMap.from_campaign(campaign, 0.75, 1).pressures.tolist() == [0.5, 5.0]


def test_one_speed_and_one_pressure_suffice(campaign: xr.Dataset) -> None:
    friction = FrictionMap.from_campaign(campaign.isel(velocity=[1], pressure=[0]), 0.75, 1)
    expected = campaign["friction_coefficient"].sel(aspect=0.75, velocity=1.0, pressure=0.5, scale=1)
    assert float(friction.at(0.5)(1.0)) == pytest.approx(float(expected))
    assert friction.at(0.5)(np.array([0.5, 2.0])).shape == (2,)
