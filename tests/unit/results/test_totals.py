"""The table of totals: which way counts, and an error that says all it is made of."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from bad_configs import DEFAULT

from rubfric.config.campaign import load
from rubfric.errors import BrokenResult, NotConverged
from rubfric.mechanics.theory.coupling import Coupling
from rubfric.results.scales import WAYS
from rubfric.results.selection import NOT_NEEDED, RUBBER_ERROR
from rubfric.results.totals import total_table
from rubfric.results.whole_road import WholeRoad
from rubfric.road.waves import WaveRoad

VELOCITIES, PRESSURES = (1.0, 100.0), (0.5, 5.0)
AXES = ("scale", "velocity", "pressure", "aspect")
# A coupling that makes the whole road 0.8 times the sum, and one scale of two.
COUPLING = Coupling(sum=1.0, cascade=0.9, persson=0.7, direct=0.8, margin=0.05)
SHARE = COUPLING.direct / COUPLING.sum


@pytest.fixture(autouse=True)
def known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(WholeRoad, "couplings", lambda self, velocity, pressure: [COUPLING] * len(self.roads))


def gathered(scales: tuple[int, ...], friction: float, **attributes: Any) -> xr.Dataset:
    shape = (len(scales), 2, 2, 1)
    values = {
        "friction_coefficient": friction,
        "friction_coefficient_error": 0.01 * friction,
        "nominal_compression": 0.3,
    }
    fields = {name: (AXES, np.full(shape, value)) for name, value in values.items()}
    coordinates = dict(zip(AXES, map(list, (scales, VELOCITIES, PRESSURES, (0.75,))), strict=True))
    return xr.Dataset(fields, coords=coordinates, attrs=attributes)


@pytest.fixture
def campaign() -> xr.Dataset:
    """Two scales of friction 0.2 each."""
    return gathered((1, 2), 0.2)


def road(way: str, **changes: Any) -> WholeRoad:
    return replace(WholeRoad.from_parameters(load(DEFAULT).whole_parameters()), way=way, **changes)


def at(table: pd.DataFrame, velocity: float, pressure: float) -> pd.Series:
    return table.set_index(["velocity_mm_per_s", "pressure_MPa"]).loc[(velocity, pressure)]


def test_columns_and_rows_are_in_order(campaign: xr.Dataset) -> None:
    table = total_table(campaign, gathered((0,), 0.3), road("direct"))
    assert list(table.columns) == [
        *("velocity_mm_per_s", "pressure_MPa", "friction_total", "friction_total_error", "way"),
        *("friction_numerical_error", "friction_coupling_error", "friction_road_error"),
        *(f"friction_{way}" for way in WAYS),
        *(f"friction_{way}_error" for way in WAYS),
        *("friction_scale_1", "friction_scale_2", "nominal_compression", "refused", "warnings", "note"),
    ]
    points = list(table[["pressure_MPa", "velocity_mm_per_s"]].itertuples(index=False, name=None))
    assert points == list(product(PRESSURES, VELOCITIES))


def test_warnings_are_those_of_all_scenes_at_the_point(campaign: xr.Dataset) -> None:
    def warned(found: xr.Dataset, **at: float) -> xr.Dataset:
        found = found.assign(warnings=xr.zeros_like(found["friction_coefficient"]))
        found["warnings"].loc[{"velocity": 100.0, **at}] = 2.0
        return found

    whole = warned(gathered((0,), 0.3))
    whole["warnings"].loc[{"velocity": 1.0}] = np.nan  # refused
    table = total_table(warned(campaign, scale=2), whole, road("direct"))
    assert table["warnings"].tolist() == [0, 4, 0, 4]
    assert total_table(warned(campaign, scale=2), None, road("sum"))["warnings"].tolist() == [0, 2, 0, 2]


def test_direct_total_has_no_coupling_error(campaign: xr.Dataset) -> None:
    row = at(total_table(campaign, gathered((0,), 0.3), road("direct")), 1.0, 5.0)
    assert row["friction_total"] == row["friction_direct"] == 0.3
    assert row["friction_total_error"] == row["friction_numerical_error"] == pytest.approx(0.003)
    assert row["friction_coupling_error"] == 0.0
    assert np.isnan(row["friction_road_error"])
    assert (row["way"], row["note"], row["refused"]) == ("direct", "one road with these phases", 0)


def test_data_of_a_measured_rubber_are_a_part_of_the_error(campaign: xr.Dataset) -> None:
    def measured(found: xr.Dataset, error: float) -> xr.Dataset:
        return found.assign({RUBBER_ERROR: xr.full_like(found["friction_coefficient"], error)})

    whole = measured(gathered((0,), 0.3), 0.02)
    table = total_table(measured(campaign, 0.01), whole, road("direct"))
    assert list(table.columns)[5:9] == [
        f"friction_{part}_error" for part in ("numerical", "coupling", "road", "rubber")
    ]
    row = at(table, 1.0, 5.0)
    assert (row["friction_rubber_error"], row["friction_total_error"]) == (0.02, pytest.approx(0.023))
    row = at(total_table(measured(campaign, 0.01), None, road("corrected")), 1.0, 5.0)
    assert row["friction_rubber_error"] == pytest.approx(0.02 * SHARE)
    assert row["friction_total_error"] == pytest.approx(
        row["friction_numerical_error"] + row["friction_coupling_error"] + row["friction_rubber_error"]
    )


@pytest.mark.parametrize(("way", "share"), [("sum", 1.0), ("corrected", SHARE), ("cascade", 0.9), ("persson", 0.7)])
def test_model_of_the_coupling_has_its_error(campaign: xr.Dataset, way: str, share: float) -> None:
    row = at(total_table(campaign, None, road(way)), 1.0, 5.0)
    assert row["friction_total"] == pytest.approx(0.4 * share)
    coupling = COUPLING.error(way) * 0.4 * share
    assert coupling >= 0.4 * share * COUPLING.margin * COUPLING.direct / max(share, COUPLING.direct) * (1.0 - 1e-12)
    assert row["friction_coupling_error"] == pytest.approx(coupling)
    assert row["friction_total_error"] == pytest.approx(0.004 * share + coupling)
    assert row["friction_total_error"] == row[f"friction_{way}_error"]
    assert np.isnan(row["friction_direct"])
    assert row["way"] == way


def test_corrected_sum_stands_in_for_what_was_refused(campaign: xr.Dataset) -> None:
    reasons = json.dumps([[[0.0, 1.0, 5.0, 0.75], "It was too heavy."]])
    whole = gathered((0,), 0.3, refusals=reasons)
    whole["friction_coefficient"].loc[{"velocity": 1.0, "pressure": 5.0}] = np.nan
    table = total_table(campaign, whole, road("direct"))
    row = at(table, 1.0, 5.0)
    assert row["friction_total"] == row["friction_corrected"] == pytest.approx(0.4 * SHARE)
    assert row["friction_total_error"] == pytest.approx((0.004 + COUPLING.error("corrected") * 0.4) * SHARE)
    assert row["way"] == "corrected"
    assert row["note"] == "the corrected sum stands in for the whole road, which was refused: It was too heavy."
    assert table["refused"].sum() == row["refused"] == 1


def test_random_phases_add_their_standard_error(campaign: xr.Dataset) -> None:
    whole = gathered((0,), 0.3, refusals=json.dumps([[[0.0, 1.0, 5.0, 0.75], "It folds."]]))
    whole["friction_road_error"] = (AXES, np.full((1, 2, 2, 1), 0.02))
    whole["draws"] = (AXES, np.full((1, 2, 2, 1), 3))
    whole["draws"].loc[{"velocity": 1.0, "pressure": 5.0}] = 2
    roads = road("direct").roads * 3
    table = total_table(campaign, whole, road("direct", roads=roads))
    row = at(table, 100.0, 5.0)
    assert row["friction_road_error"] == 0.02
    assert row["friction_total_error"] == pytest.approx(0.023)
    assert row["note"] == "mean of 3 roads with random phases"
    windows = at(total_table(campaign, whole, road("direct", windows=3)), 1.0, 5.0)
    assert windows["note"] == "mean of 2 windows of the measured road; 1 more refused: It folds."
    short = at(table, 1.0, 5.0)
    assert short["refused"] == 1
    assert short["note"] == "mean of 2 roads with random phases; 1 more refused: It folds."


def test_auto_takes_the_way_that_was_found_accurate_enough(campaign: xr.Dataset) -> None:
    reasons = json.dumps([[[0.0, 1.0, 5.0, 0.75], NOT_NEEDED + "cascade"]])
    whole = gathered((0,), 0.3, refusals=reasons)
    whole["friction_coefficient"].loc[{"velocity": 1.0, "pressure": 5.0}] = np.nan
    table = total_table(campaign, whole, road("auto"))
    assert at(table, 1.0, 5.0)["way"] == "cascade"
    assert at(table, 1.0, 5.0)["friction_total"] == pytest.approx(0.36)
    assert at(table, 100.0, 5.0)["way"] == "direct"
    assert table["refused"].sum() == 0


@pytest.mark.parametrize(
    ("kinematics", "accuracy", "words"),
    [("finite", 0.01, "would take minutes"), ("finite", 0.07, "accurate enough"), ("small", 0.07, "accurate enough")],
)
def test_note_says_minutes_only_where_the_corrected_sum_is_not_accurate_enough(
    campaign: xr.Dataset, kinematics: str, accuracy: float, words: str
) -> None:
    whole = gathered((0,), np.nan, refusals=json.dumps([[[0.0, 1.0, 5.0, 0.75], NOT_NEEDED + "corrected"]]))
    row = at(total_table(campaign, whole, road("auto", kinematics=kinematics, accuracy=accuracy)), 1.0, 5.0)
    assert row["way"] == "corrected"
    assert words in row["note"]


@pytest.mark.parametrize(("accuracy", "way"), [(0.01, "direct"), (0.07, "corrected"), (0.25, "sum")])
def test_cheapest_way_meets_the_accuracy(accuracy: float, way: str) -> None:
    assert road("auto", accuracy=accuracy).cheapest(1000.0, 0.5) == way


@pytest.mark.parametrize(
    ("kinematics", "velocity", "pressure", "way"),
    [
        ("finite", 1.0, 5.0, "corrected"),
        ("finite", 1.0, 0.1, "direct"),
        ("small", 1.0, 5.0, "direct"),
        # Less of the road is in contact, but the load is heavy.
        ("finite", 1.0, 1.0, "direct"),
        ("finite", 100.0, 5.0, "corrected"),
    ],
)
def test_whole_road_is_left_out_where_it_would_take_minutes(
    kinematics: str, velocity: float, pressure: float, way: str
) -> None:
    assert road("auto", accuracy=0.01, kinematics=kinematics).cheapest(velocity, pressure) == way


def test_road_of_few_waves_is_solved_at_once_also_where_much_of_it_is_in_contact() -> None:
    few = WaveRoad((0.015, 0.003), (35.0, 210.0), (0.0, 0.0))
    assert road("auto", accuracy=0.01, kinematics="finite", roads=(few,)).cheapest(1.0, 2.0) == "direct"


def test_coupling_that_cannot_be_estimated_leaves_the_error_unknown(
    campaign: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(self: WholeRoad, velocity: float, pressure: float) -> list[Coupling]:
        raise NotConverged("layer", 1, 1.0, "nodes")

    monkeypatch.setattr(WholeRoad, "couplings", fail)
    row = at(total_table(campaign, None, road("sum")), 1.0, 5.0)
    assert row["friction_total"] == pytest.approx(0.4)
    assert np.isnan(row["friction_total_error"])
    assert road("auto").cheapest(1.0, 5.0) == "direct"


def test_missing_scale_leaves_its_point_out(campaign: xr.Dataset) -> None:
    campaign["friction_coefficient"].loc[{"scale": 2, "velocity": 100.0, "pressure": 5.0}] = np.nan
    assert len(total_table(campaign, None, road("sum"))) == 3
    with pytest.raises(BrokenResult, match="the campaign lacks nominal_compression: gather"):
        total_table(campaign.drop_vars("nominal_compression"), None, road("sum"))


def test_scales_without_a_period_are_judged_by_the_nearest_that_have_one() -> None:
    config = load(DEFAULT)
    scales = (config.road[0], replace(config.road[1], wavenumber=81.1234567))
    other = replace(config, road=scales, phases=(0.0, 0.0), multiscale=replace(config.multiscale, way="sum"))
    (only,) = WholeRoad.from_parameters(other.whole_parameters()).roads
    assert only.wavenumbers == pytest.approx((35.0, 81.1234567), rel=1e-3)
    assert only.wavenumbers[1] != 81.1234567
