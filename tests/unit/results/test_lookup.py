"""Friction as a lookup table: sorted, complete in its errors, monotone between the points of the campaign."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from synthetic_campaign import make_campaign, make_totals

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.results.lookup import astray, lookup_dataset, lookup_table, notes
from rubfric.results.tables import by_temperature, write_table
from rubfric.results.totals_file import read_totals

TOTALS = make_totals(make_campaign(), refused=[(1.0, 100.0)], drawn=True)
AXES = ["pressure_MPa", "velocity_mm_per_s"]


def warm() -> pd.DataFrame:
    return by_temperature({one: TOTALS.assign(friction_total=TOTALS["friction_total"] * one) for one in (20.0, 60.0)})


def test_errors_are_the_sum_of_their_parts_and_points_are_kept() -> None:
    table = lookup_table(TOTALS.sample(frac=1.0, random_state=1), per_decade=7)
    parts = [name for name in table if name.endswith("_error") and name != "friction_total_error"]
    assert len(parts) == 4
    np.testing.assert_allclose(table[parts].sum(axis=1), table["friction_total_error"], rtol=1e-12)
    known = table[table["way"] != "interpolated"].merge(TOTALS, on=AXES, suffixes=("", "_given"))
    assert len(known) == len(TOTALS)
    assert (known["friction_total"] == known["friction_total_given"]).all()
    assert table.equals(table.sort_values(AXES, ignore_index=True))
    assert all(len(curve) == 5 * 7 + 1 for _, curve in table.groupby("pressure_MPa"))


def test_curve_between_the_points_has_no_peak_of_its_own_and_follows_friction() -> None:
    table = lookup_table(TOTALS, per_decade=20)
    for pressure, curve in table.groupby("pressure_MPa"):
        given = TOTALS[TOTALS["pressure_MPa"] == pressure]["friction_total"]
        turns = np.diff(np.sign(np.diff(curve["friction_total"])))
        assert np.count_nonzero(turns) <= np.count_nonzero(np.diff(np.sign(np.diff(given))))
        assert given.min() <= curve["friction_total"].min() <= curve["friction_total"].max() <= given.max()
    # The made-up friction is smooth in the logarithm of speed: between its points the stated error covers it.
    truth = make_totals(make_campaign(speeds=(0.1, 0.31622776601683794, 1.0)))
    at = table[np.isclose(table["velocity_mm_per_s"], 0.3162, rtol=1e-4)].reset_index(drop=True)
    real = truth[truth["velocity_mm_per_s"].between(0.3, 0.4)]["friction_total"].to_numpy()
    assert (np.abs(at["friction_total"] - real) < at["friction_total_error"]).all()


def test_linear_interpolation_is_said_to_be_off_until_there_are_enough_speeds() -> None:
    sparse, dense = lookup_table(TOTALS), lookup_table(TOTALS, per_decade=30)
    assert astray(dense) < 0.005 < 0.1 < astray(sparse)
    assert f"up to {astray(sparse):.1%} off" in notes(sparse)[-1]
    assert not any("linear interpolation in speed" in line for line in notes(dense))
    assert "range: slip speed 0.1 to 10000 mm/s, contact pressure 0.5 to 5 MPa" in notes(dense)


def test_temperatures_are_all_there_or_one_of_them() -> None:
    assert lookup_table(warm())["temperature_degC"].is_monotonic_increasing
    one = lookup_table(warm(), 60.0)
    assert set(one["temperature_degC"]) == {60.0}
    assert len(one) == len(TOTALS)
    with pytest.raises(InvalidInput, match="temperature is 40 degC, but the table has 20, 60 degC"):
        lookup_table(warm(), 40.0)


def test_dataset_has_every_point_in_its_place_and_gaps_where_there_is_none() -> None:
    table = lookup_table(warm()).drop(index=3)
    data = lookup_dataset(table, ["made by hand"])
    assert data["friction_coefficient"].dims == ("temperature", "pressure", "velocity")
    assert int(data["friction_coefficient"].isnull().sum()) == int((data["way"] == -1).sum()) == 1
    row = table.iloc[10]
    place = {"temperature": row["temperature_degC"], "pressure": row["pressure_MPa"], "velocity": row[AXES[1]]}
    there = data.sel(place)
    assert float(there["friction_coefficient"]) == row["friction_total"]
    assert data["way"].attrs["flag_meanings"].split()[int(there["way"])] == row["way"]
    assert data.attrs["history"] == "made by hand"


def test_what_is_no_table_of_totals_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="give the folder of a campaign's results"):
        read_totals(tmp_path / "none")
    with pytest.raises(InvalidInput, match=r"has no tables.friction_total.csv: run snakemake first"):
        read_totals(tmp_path)
    (tmp_path / "other.csv").write_text("velocity_mm_per_s,friction\n1,0.5\n")
    with pytest.raises(InvalidInput, match="it lacks pressure_MPa, friction_total, friction_total_error, way"):
        read_totals(tmp_path / "other.csv")
    write_table(TOTALS, tmp_path / "tables" / "friction_total.csv")
    changed = tmp_path / "tables" / "friction_total.csv"
    changed.write_text(changed.read_text().replace("0.1,", "0.2,", 1))
    with pytest.raises(BrokenResult, match="changed after it was written"):
        read_totals(tmp_path)
    with pytest.raises(InvalidInput, match=r"has 0.1 mm/s, 0.5 MPa twice: keep one row of each point"):
        lookup_table(pd.concat([TOTALS, TOTALS.iloc[:1]]))
