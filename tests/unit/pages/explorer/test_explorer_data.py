"""What the page shows is what the campaign holds."""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.pages.explorer.data import payload
from rubfric.results.scales import total_error, total_friction

CampaignMaker = Callable[..., xr.Dataset]
ResultMaker = Callable[..., xr.Dataset]


def test_curves_are_those_of_the_campaign(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    found = payload(campaign, [], 0.75, "road")
    grid = campaign.sel(aspect=0.75).transpose("scale", "pressure", "velocity")
    friction, error = grid["friction_coefficient"], grid["friction_coefficient_error"]
    assert found["speeds"] == [1.0, 10.0, 100.0]
    assert found["pressures"] == [0.5, 5.0]
    for name, values, errors in (
        ("1", friction.sel(scale=1), error.sel(scale=1)),
        ("2", friction.sel(scale=2), error.sel(scale=2)),
        ("total", total_friction(friction), total_error(error)),
    ):
        assert np.array(found["curves"][name]["friction"]) == pytest.approx(values.values, rel=1e-7)
        assert np.array(found["curves"][name]["error"]) == pytest.approx(errors.values, rel=1e-7)
        assert [peak["kind"] for peak in found["curves"][name]["peaks"]] == ["peak", "peak"]
    assert [scale["wavelength"] for scale in found["scales"]] == pytest.approx([2 * np.pi / 35, 2 * np.pi / 70])
    assert found["about"]["accuracy"] == 0.01


def test_every_scene_has_its_numbers_reason_and_warnings(
    make_campaign: CampaignMaker, make_result: ResultMaker
) -> None:
    results = [make_result(*place) for place in product((1, 2), (1.0, 10.0, 100.0), (0.5, 5.0))]
    found = payload(make_campaign(), reversed(results), 0.75, "road")
    begins = set()
    for scale, rows in found["scenes"].items():
        for row, pressure in zip(rows, (0.5, 5.0), strict=True):
            for scene in row:
                assert (scene["contact"], scene["largest"], scene["rows"]) == (3.5, 4.5, 9.5)
                assert scene["reason"] == "it was asked for"
                assert scene["warnings"] == ["Beware.", "Of two things."]
                assert scene["picture"]["pressure"][1] == pytest.approx(3.0 * pressure, rel=0.01)
                assert scene["picture"]["x"][1] < 0.25 / int(scale)
                begins.add(scene["picture"]["begin"])
    assert len(begins) == 12
    low, high = found["energies"]
    assert high == pytest.approx(np.log10(5.0 * 2.11), abs=0.01)
    assert low <= high - 0.5


def test_pictures_are_thinned_where_there_are_many(
    make_campaign: CampaignMaker, make_result: ResultMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes = []
    for room in (400, 3):
        monkeypatch.setattr("rubfric.pages.explorer.data._ROOM", room)
        monkeypatch.setattr("rubfric.pages.explorer.data._FEWEST", (4, 8))
        monkeypatch.setattr("rubfric.pages.explorer.data._MOST", (10, 32))
        scene = payload(make_campaign(), [make_result()], 0.75, "road")["scenes"]["1"][0][1]
        sizes.append((scene["picture"]["rows"], scene["picture"]["columns"]))
    assert sizes[0][0] == 10
    assert sizes[1] == (5, 20)


def test_gaps_are_none_and_empty_axes_are_left_out(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    for name in campaign.data_vars:
        if "velocity" in campaign[name].dims:
            campaign[name].loc[{"scale": 1, "velocity": 10.0, "pressure": 0.5}] = np.nan
            campaign[name].loc[{"velocity": 100.0, "aspect": 0.75}] = np.nan
    found = payload(campaign, [], 0.75, "road")
    assert found["speeds"] == [1.0, 10.0]
    assert found["curves"]["1"]["friction"][0][1] is None
    assert found["curves"]["2"]["friction"][0][1] is not None
    assert found["curves"]["total"]["friction"][0][1] is None
    assert found["curves"]["total"]["peaks"][0]["missing"] == 1
    assert found["scenes"]["1"][0][1] is None
    json.dumps(found, allow_nan=False)


def test_one_scale_has_no_total(make_campaign: CampaignMaker) -> None:
    found = payload(make_campaign(scales=(3,), speeds=(1.0,), pressures=(2.0,)), [], 0.75, "road")
    assert set(found["curves"]) == {"3"}
    assert found["curves"]["3"]["peaks"] == [{"kind": "few", "at": 0, "between": None, "missing": 0}]
    json.dumps(found, allow_nan=False)


def test_what_does_not_fit_is_refused(make_campaign: CampaignMaker, make_result: ResultMaker) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"ratio 2 is not in the campaign, which has 0\.5, 0\.75"):
        payload(campaign, [], 2.0, "road")
    with pytest.raises(BrokenResult, match=r"lacks energy_closure"):
        payload(campaign.drop_vars("energy_closure"), [], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"scene made up is not among"):
        payload(campaign, [make_result(speed=3.0)], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"scene made up is not among"):
        payload(campaign, [make_result().assign_attrs(aspect=0.5)], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"holds no friction coefficient at the height-to-width ratio 0\.75"):
        payload(campaign.where(campaign["aspect"] < 0.6), [], 0.75, "road")
