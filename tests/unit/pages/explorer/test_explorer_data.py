"""What the page shows is what the campaign holds."""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
import xarray as xr
from synthetic_campaign import make_totals

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.scenes import SCALARS

CampaignMaker = Callable[..., xr.Dataset]
ResultMaker = Callable[..., xr.Dataset]


def test_curves_are_those_of_the_campaign(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    found = payload(campaign, make_totals(campaign), [], 0.75, "road")
    grid = campaign.sel(aspect=0.75).transpose("scale", "pressure", "velocity")
    friction, error = grid["friction_coefficient"], grid["friction_coefficient_error"]
    assert found["speeds"] == [1.0, 10.0, 100.0]
    assert found["pressures"] == [0.5, 5.0]
    for name, values, errors in (
        ("1", friction.sel(scale=1), error.sel(scale=1)),
        ("2", friction.sel(scale=2), error.sel(scale=2)),
        ("total", 0.7 * friction.sum("scale"), 0.01 * friction.sum("scale")),
    ):
        assert np.array(found["curves"][name]["friction"]) == pytest.approx(values.values, rel=1e-7)
        assert np.array(found["curves"][name]["error"]) == pytest.approx(errors.values, rel=1e-7)
        assert [peak["kind"] for peak in found["curves"][name]["peaks"]] == ["peak", "peak"]
    assert [scale["wavelength"] for scale in found["scales"]] == pytest.approx([2 * np.pi / 35, 2 * np.pi / 70])
    assert found["about"]["accuracy"] == 0.01


def test_data_of_a_measured_rubber_are_beside_every_error(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    table = make_totals(campaign)
    assert "rubber" not in payload(campaign, table, [], 0.75, "road")["totals"]["parts"]
    campaign["friction_coefficient_rubber_error"] = 0.1 * campaign["friction_coefficient"]
    found = payload(campaign, table.assign(friction_rubber_error=0.25), [], 0.75, "road")
    assert found["totals"]["parts"]["rubber"] == [[0.25] * 3] * 2
    scene = found["scenes"]["2"][1][2]
    assert scene["rubberError"] == pytest.approx(0.1 * scene["friction"])


def test_every_scene_has_its_numbers_reason_and_warnings(
    make_campaign: CampaignMaker, make_result: ResultMaker
) -> None:
    campaign = make_campaign()
    results = [make_result(*place) for place in product((1, 2), (1.0, 10.0, 100.0), (0.5, 5.0))]
    found = payload(campaign, make_totals(campaign), reversed(results), 0.75, "road")
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


def test_other_pairs_are_beside_the_total_where_they_were_run(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    table = make_totals(campaign)
    assert "others" not in payload(campaign, table, [], 0.75, "road")
    other = table.assign(friction_total=2.0 * table["friction_total"]).drop(index=1)
    found = payload(campaign, table, [], 0.75, "road", others={"b on c": other})
    (pair,) = found["others"]
    twice = 2.0 * np.array(found["curves"]["total"]["friction"])
    assert pair["name"] == "b on c"
    assert pair["friction"][0][1] is None
    assert pair["friction"][0][::2] + pair["friction"][1] == pytest.approx([*twice[0][::2], *twice[1]], rel=1e-7)
    assert pair["error"][1] == pytest.approx(found["curves"]["total"]["error"][1], rel=1e-7)
    with pytest.raises(InvalidInput, match=r"lacks the column friction_total"):
        payload(campaign, table, [], 0.75, "road", others={"b on c": table.drop(columns="friction_total")})


def test_pictures_are_thinned_where_there_are_many(
    make_campaign: CampaignMaker, make_result: ResultMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes = []
    for room in (400, 3):
        monkeypatch.setattr("rubfric.pages.explorer.data._ROOM", room)
        monkeypatch.setattr("rubfric.pages.explorer.scenes._FEWEST", (4, 8))
        monkeypatch.setattr("rubfric.pages.explorer.scenes._MOST", (10, 32))
        campaign = make_campaign()
        scene = payload(campaign, make_totals(campaign), [make_result()], 0.75, "road")["scenes"]["1"][0][1]
        sizes.append((scene["picture"]["rows"], scene["picture"]["columns"]))
    assert sizes[0][0] == 10
    assert sizes[1] == (5, 20)


def test_gaps_are_none_and_empty_axes_are_left_out(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    for name in campaign.data_vars:
        if "velocity" in campaign[name].dims:
            campaign[name].loc[{"scale": 1, "velocity": 10.0, "pressure": 0.5}] = np.nan
            campaign[name].loc[{"velocity": 100.0, "aspect": 0.75}] = np.nan
    found = payload(campaign, make_totals(campaign), [], 0.75, "road")
    assert found["speeds"] == [1.0, 10.0]
    assert found["curves"]["1"]["friction"][0][1] is None
    assert found["curves"]["2"]["friction"][0][1] is not None
    assert found["curves"]["total"]["friction"][0][1] is None
    assert found["curves"]["total"]["peaks"][0]["missing"] == 1
    assert found["scenes"]["1"][0][1] is None
    json.dumps(found, allow_nan=False)


def test_one_scale_has_no_total(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign(scales=(3,), speeds=(1.0,), pressures=(2.0,))
    found = payload(campaign, make_totals(campaign), [], 0.75, "road")
    assert "totals" not in found
    assert set(found["curves"]) == {"3"}
    assert found["curves"]["3"]["peaks"] == [{"kind": "few", "at": 0, "between": None, "missing": 0}]
    json.dumps(found, allow_nan=False)


def test_what_does_not_fit_is_refused(make_campaign: CampaignMaker, make_result: ResultMaker) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"ratio 2 is not in the campaign, which has 0\.5, 0\.75"):
        payload(campaign, make_totals(campaign), [], 2.0, "road")
    with pytest.raises(BrokenResult, match=r"lacks energy_closure"):
        payload(campaign.drop_vars("energy_closure"), make_totals(campaign), [], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"scene made up is not among"):
        payload(campaign, make_totals(campaign), [make_result(speed=3.0)], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"scene made up is not among"):
        payload(campaign, make_totals(campaign), [make_result().assign_attrs(aspect=0.5)], 0.75, "road")
    with pytest.raises(InvalidInput, match=r"holds no friction coefficient at the height-to-width ratio 0\.75"):
        payload(campaign.where(campaign["aspect"] < 0.6), make_totals(campaign), [], 0.75, "road")


def make_whole(campaign: xr.Dataset, refused: dict[tuple[float, float], str]) -> xr.Dataset:
    """Return the collection of the whole road: that of scale 1 halved, and NaN at the pressures and speeds refused."""
    whole = 0.5 * campaign.sel(scale=[1], aspect=[0.75]).assign_coords(scale=[0])
    for pressure, speed in refused:
        for name in whole.data_vars:
            if "velocity" in whole[name].dims:
                whole[name].loc[{"pressure": pressure, "velocity": speed}] = np.nan
    said = [[[0, speed, pressure, 0.75], reason] for (pressure, speed), reason in refused.items()]
    return whole.assign_attrs(refusals=json.dumps(said))


def test_totals_have_every_way_and_the_parts_of_the_error(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    found = payload(campaign, make_totals(campaign, refused=[(5.0, 10.0)]), [], 0.75, "road")
    summed = campaign["friction_coefficient"].sel(aspect=0.75).sum("scale").transpose("pressure", "velocity").values
    totals = found["totals"]
    for way, share in (("sum", 1.0), ("cascade", 0.9), ("persson", 0.8)):
        assert np.array(totals["ways"][way]["friction"]) == pytest.approx(share * summed, rel=1e-7)
        assert np.array(totals["ways"][way]["error"]) == pytest.approx(0.4 * summed, rel=1e-7)
    assert totals["ways"]["direct"]["friction"][1][1] is None
    assert found["curves"]["total"]["friction"][1][1] == pytest.approx(summed[1, 1], rel=1e-7)
    assert found["curves"]["total"]["error"][1][1] == pytest.approx(0.4 * summed[1, 1], rel=1e-7)
    assert totals["way"] == [["direct"] * 3, ["direct", "sum", "direct"]]
    assert totals["note"][1][1] == "no solution"
    assert totals["parts"]["coupling"][1] == pytest.approx([0.0, 0.39 * summed[1, 1], 0.0], rel=1e-7)
    assert totals["parts"]["road"][0][0] is None
    json.dumps(found, allow_nan=False)


def test_table_of_six_digits_finds_its_place(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign(speeds=(1.0, 123.456789, 1000.0))
    table = make_totals(campaign).round({"velocity_mm_per_s": 3})
    found = payload(campaign, table, [], 0.75, "road")
    assert None not in found["curves"]["total"]["friction"][0]
    assert found["speeds"] == [1.0, 123.45679, 1000.0]


def test_whole_road_is_a_place_of_its_own(make_campaign: CampaignMaker, make_whole_result: ResultMaker) -> None:
    campaign = make_campaign()
    whole = make_whole(campaign, {(5.0, 10.0): "all_v10_p5_aspect0.75_stress: not converged: so"})
    result = make_whole_result(speed=10.0, pressure=0.5)
    found = payload(campaign, make_totals(campaign), [result], 0.75, "road", whole)
    friction = campaign["friction_coefficient"].sel(scale=1, aspect=0.75, velocity=1.0, pressure=5.0).item()
    assert found["curves"]["whole"]["friction"][1][0] == pytest.approx(0.5 * friction, rel=1e-7)
    assert found["curves"]["whole"]["friction"][1][1] is None
    assert found["refusals"] == [[None] * 3, [None, "not converged: so", None]]
    scene = found["scenes"]["whole"][0][1]
    assert scene["warnings"] == ["Beware.", "Of two things."]
    assert scene["picture"]["x"][0] <= 0.0 < found["whole"]["period"] <= scene["picture"]["x"][1]
    road = found["whole"]
    assert len(road["waves"]) == 2
    assert road["lowest"] < 0.0 < road["highest"]
    heights = [sum(a * np.sin(k * x + phase) for a, k, phase in road["waves"]) for x in (road["crest"], 0.0)]
    assert heights[0] == pytest.approx(road["highest"])
    assert "whole" not in found["scales"]
    json.dumps(found, allow_nan=False)


def test_whole_road_without_a_picture_has_numbers(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    found = payload(campaign, make_totals(campaign), [], 0.75, "road", make_whole(campaign, {}))
    assert found["whole"] == {"number": "whole", "draws": 0, "wavelength": pytest.approx(4 * np.pi / 35), "waves": []}
    assert found["scenes"]["whole"][0][0]["rows"] == pytest.approx(4.75)


def test_mean_over_random_roads_says_over_how_many(make_campaign: CampaignMaker) -> None:
    campaign = make_campaign()
    whole = make_whole(campaign, {}).assign(draws=4)
    assert payload(campaign, make_totals(campaign), [], 0.75, "road", whole)["whole"]["draws"] == 4


def test_each_of_several_roads_has_its_scenes_beside_the_mean(
    make_campaign: CampaignMaker, make_whole_result: ResultMaker
) -> None:
    campaign = make_campaign()
    whole = make_whole(campaign, {})
    friction = whole["friction_coefficient"]
    whole["friction_road_error"] = 0.2 * friction
    whole["draws"] = xr.full_like(friction, 2.0).assign_attrs(long_name="windows of the measured road that were solved")
    numbers = dict.fromkeys(set(SCALARS) - {"finite_strain", "friction_coefficient"}, 0.5)
    results = []
    for number, value in ((1, 0.3), (2, 0.4)):
        result = make_whole_result(speed=10.0, pressure=0.5).assign(numbers | {"friction_coefficient": value})
        results.append(result.assign_attrs(road_number=number))
    bare = make_whole_result(speed=100.0, pressure=5.0).drop_vars(["finite_strain"])
    results.append(bare.assign_attrs(road_number=2, refusal="all_v100_p5_aspect0.2_stress: it folds"))
    found = payload(campaign, make_totals(campaign), results, 0.75, "road", whole)
    mean = friction.sel(scale=0, aspect=0.75, velocity=10.0, pressure=0.5).item()
    assert found["curves"]["whole"]["error"][0][1] == pytest.approx((0.01 + 0.2) * mean)
    assert found["scenes"]["whole"][0][1]["error"] == pytest.approx(0.01 * mean)
    assert [found["scenes"][place][0][1]["friction"] for place in ("whole1", "whole2")] == [0.3, 0.4]
    assert "picture" in found["scenes"]["whole2"][0][1]
    assert "picture" not in found["scenes"]["whole"][0][1]
    roads = found["whole"]["roads"]
    assert [road["number"] for road in roads] == ["whole1", "whole2"]
    assert found["whole"]["windows"] is True
    assert roads[1]["refusals"][1][2] == "it folds"
    assert roads[0]["refusals"] is None
    # The finest of two waves of 35 and 87.5 rad/mm; at most a quarter of the period is magnified, at least an eighth.
    assert roads[0]["spot"] == pytest.approx(0.25 * roads[0]["period"])
    json.dumps(found, allow_nan=False)


def test_result_of_the_whole_road_needs_its_collection(
    make_campaign: CampaignMaker, make_whole_result: ResultMaker
) -> None:
    campaign = make_campaign()
    with pytest.raises(InvalidInput, match=r"scene made up is not among"):
        payload(campaign, make_totals(campaign), [make_whole_result()], 0.75, "road")
