from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from synthetic_campaign import make_campaign

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.results.selection import described, friction, friction_error, position, written


def test_line_is_picked_in_ascending_order() -> None:
    campaign = make_campaign()
    line = friction(campaign.isel(velocity=slice(None, None, -1)), scale=2, pressure=5.0, aspect=0.75)
    expected = campaign["friction_coefficient"].sel(scale=2, pressure=5.0, aspect=0.75)
    np.testing.assert_array_equal(line["velocity"].values, campaign["velocity"].values)
    np.testing.assert_array_equal(line.values, expected.values)


def test_rounding_of_coordinates_does_not_matter() -> None:
    campaign = make_campaign(pressures=(0.1 + 0.2, 1.0))
    assert friction(campaign, pressure=0.3).sizes["velocity"] == 6


@pytest.mark.parametrize(
    ("chosen", "complaint"),
    [
        ({"pressure": 2.0}, r"^pressure 2 MPa is not in the campaign, which has 0\.5, 1, 5 MPa$"),
        ({"scale": 5}, r"^scale 5 is not in the campaign, which has 1, 2, 3, 4$"),
        ({"velocity": 3.0}, r"^speed 3 mm/s is not in the campaign, which has 0\.1, 1, 10, 100, 1000, 10.000 mm/s$"),
        ({"aspect": 1.0}, r"^height-to-width ratio 1 is not in the campaign, which has 0\.25, 0\.75, 1\.5$"),
    ],
)
def test_missing_values_are_refused(chosen: dict[str, float], complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        friction(make_campaign(), **chosen)


def test_nothing_but_gaps_is_refused() -> None:
    campaign = make_campaign()
    campaign["friction_coefficient"].loc[{"scale": 1, "pressure": 5.0}] = np.nan
    with pytest.raises(InvalidInput, match=r"^the campaign holds no friction coefficient at scale 1, pressure 5 MPa$"):
        friction(campaign, scale=1, pressure=5.0)


def test_other_datasets_are_refused() -> None:
    with pytest.raises(BrokenResult, match=r"^the campaign lacks friction_coefficient: gather the results"):
        friction(xr.Dataset())
    with pytest.raises(InvalidInput, match=r"^the variable friction_coefficient of the campaign lacks the axis aspect"):
        friction(make_campaign().isel(aspect=0, drop=True))


def test_errors_are_picked_like_friction() -> None:
    campaign = make_campaign()
    place = {"scale": 2, "pressure": 5.0, "aspect": 0.75}
    error = friction_error(campaign.isel(velocity=slice(None, None, -1)), **place)
    np.testing.assert_array_equal(error["velocity"].values, friction(campaign, **place)["velocity"].values)
    np.testing.assert_array_equal(error.values, campaign["friction_coefficient_error"].sel(place).values)
    with pytest.raises(InvalidInput, match=r"^scale 5 is not in the campaign"):
        friction_error(campaign, scale=5)


def test_campaign_of_an_earlier_version_is_refused() -> None:
    older = make_campaign().drop_vars("friction_coefficient_error")
    complaint = r"^the campaign lacks friction_coefficient_error: gather the results of its scenes again$"
    with pytest.raises(BrokenResult, match=complaint):
        friction_error(older, scale=2)


def test_places_are_described_with_their_units() -> None:
    text = described(scale=1, velocity=10.0, pressure=0.5, aspect=0.75)
    assert text == "scale 1, speed 10 mm/s, pressure 0.5 MPa, height-to-width ratio 0.75"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.1, "0.1"),
        (0.30000000000000004, "0.3"),
        (10.0, "10"),
        (1000.0, "1000"),
        (10000.0, "10\N{NO-BREAK SPACE}000"),
        (1234567.5, "1\N{NO-BREAK SPACE}234\N{NO-BREAK SPACE}567.5"),
        (0.0, "0"),
        (-12000.0, "-12\N{NO-BREAK SPACE}000"),
    ],
)
def test_numbers_are_written_plainly(value: float, text: str) -> None:
    assert written(value) == text


def test_axis_is_looked_up_by_value_whatever_its_order() -> None:
    campaign = make_campaign(pressures=(5.0, 0.1 + 0.2))
    assert [position(campaign, "pressure", value) for value in (5.0, 0.3)] == [0, 1]
