"""Which of two rubbers grips more, and on which of two roads, with errors at 95 %."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.errors import BrokenResult
from rubfric.results.comparison import EQUAL, FIRST, SECOND, UNKNOWN, comparison_table, headlines, ranking_table
from rubfric.results.difference import Friction, difference, interval
from rubfric.results.pair import read_pair, road_by_road
from rubfric.results.tables import write_table

# Student's t at 97.5 % of five degrees of freedom, from tables.
T_5 = 2.5706


def over(roads: np.ndarray, numerical: float = 0.0, rubber: float = np.nan) -> Friction:
    return Friction(float(np.nanmean(roads)), numerical, 0.0, rubber, roads)


def test_scatter_that_two_rubbers_share_drops_out(rng: np.random.Generator) -> None:
    """Each band is wider than the difference; window by window the difference is certain."""
    windows, own = 0.1 * rng.normal(size=6), 0.002 * rng.normal(size=(2, 6))
    first, second = over(0.52 + windows + own[0]), over(0.5 + windows + own[1])
    found = difference(first, second, same_road=True)
    assert interval(first).half > 0.04
    assert found.value == pytest.approx(first.value - second.value, abs=1e-12)
    assert found.half == pytest.approx(T_5 * np.std(own[0] - own[1], ddof=1) / math.sqrt(6), rel=1e-4)
    assert found.half < 0.5 * found.value
    assert found.roads == 6
    apart = difference(first, second, same_road=False)
    assert apart.half > 2.0 * apart.value


@pytest.mark.parametrize(
    ("same_road", "windows", "scatter", "least"),
    [(True, (3, 3), 1.0, 0.05), (False, (3, 3), 1.0, 0.0), (False, (2, 6), 9.0, 0.0)],
)
def test_equals_are_told_apart_at_most_at_the_stated_rate(
    same_road: bool, windows: tuple[int, int], scatter: float, least: float, rng: np.random.Generator
) -> None:
    """In 5 % of 4000 draws of a few windows, to three standard errors of that; of two roads in fewer."""
    count = 4000
    wrong = 0
    for _ in range(count):
        common = rng.normal(size=windows[0]) if same_road else 0.0
        first, second = (scale * rng.normal(size=size) for scale, size in zip((scatter, 1.0), windows, strict=True))
        found = difference(over(common + first), over(common + second), same_road)
        wrong += abs(found.value) > found.half
    slack = 3.0 * math.sqrt(0.05 * 0.95 / count)
    assert least - slack < wrong / count < 0.05 + slack


def test_parts_are_added_in_squares_and_one_rubber_on_two_roads_in_full() -> None:
    none = np.empty(0)
    first, second = Friction(0.5, 0.03, 0.0, 0.02, none), Friction(0.4, 0.04, 0.12, 0.01, none)
    two_rubbers, two_roads = (difference(first, second, same_road) for same_road in (True, False))
    assert two_rubbers.half == pytest.approx(math.sqrt(0.05**2 + 0.12**2 + 0.02**2 + 0.01**2))
    assert two_roads.half == pytest.approx(math.sqrt(0.05**2 + 0.12**2 + 0.03**2))
    unknown = Friction(0.4, math.nan, 0.0, 0.0, none)
    assert math.isnan(difference(first, unknown, same_road=True).half)


def test_two_roads_are_independent_of_one_another() -> None:
    roads = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    found = difference(over(roads), over(roads), same_road=False)
    assert found.road == pytest.approx(T_5 * math.sqrt(2.0 * roads.var(ddof=1) / 6.0), rel=1e-4)
    assert difference(over(roads), over(roads), same_road=True).road == 0.0


def test_windows_that_one_rubber_lacks_are_left_out_of_both() -> None:
    whole = np.array([0.1, 0.5, 0.3])
    found = difference(over(whole), over(np.array([0.05, np.nan, 0.27])), same_road=True)
    assert found.value == pytest.approx(0.04)
    assert found.roads == 2


def totals(friction: float, roads: tuple[float, ...] = (), way: str = "direct", **more: float) -> pd.DataFrame:
    """Return a table of totals at two speeds, at the second without any friction."""
    row = {"velocity_mm_per_s": 100.0, "pressure_MPa": 0.3, "friction_total": friction, "friction_total_error": 0.01}
    row |= {"friction_numerical_error": 0.005, "friction_coupling_error": 0.0, "friction_road_error": np.nan}
    row |= {"way": way, "note": "", **more, **{f"friction_direct_{n}": one for n, one in enumerate(roads, 1)}}
    lacking = [name for name in row if name.startswith(("friction_total", "friction_numerical", "friction_direct"))]
    nothing = dict.fromkeys(lacking, np.nan)
    return pd.DataFrame([row, row | nothing | {"velocity_mm_per_s": 1000.0}])


def test_tables_say_who_grips_more() -> None:
    tables = {
        ("a", "street"): totals(0.5, (0.4, 0.6)),
        ("a", "track"): totals(0.3, (0.29, 0.31)),
        ("b", "street"): totals(0.39, (0.29, 0.49), friction_rubber_error=0.003),
        ("b", "track"): totals(0.3001, way="corrected", friction_rubber_error=0.003),
    }
    without = dict.fromkeys(tables, ("data of rubber a",)) | {("b", "street"): (), ("b", "track"): ()}
    table = ranking_table(tables, without)
    at = table[table["velocity_mm_per_s"] == 100.0].set_index(["compared", "on"])
    street, track = at.loc[("rubbers", "street")], at.loc[("rubbers", "track")]
    assert street["words"] == "a grips more than b on street at 100 mm/s and 0.3 MPa, by 0.1100 ± 0.0077"
    assert (street["verdict"], street["not_covered"], street["draws"]) == (FIRST, "data of rubber a", 2)
    assert track["verdict"] == EQUAL
    assert track["words"].startswith("a and b cannot be told apart on track at 100 mm/s and 0.3 MPa: they differ by 0.")
    # Two windows of each road say next to nothing about roads: t of one degree of freedom.
    assert at.loc[("roads", "a")]["verdict"] == EQUAL
    # One total in place of the other's windows: those of the other count alone.
    assert at.loc[("roads", "b")]["road_ci95"] == pytest.approx(12.706 * 0.1, rel=1e-3)
    last = table[table["velocity_mm_per_s"] == 1000.0]
    assert set(last["verdict"]) == {UNKNOWN}
    assert "a and b are not compared on street at 1000 mm/s and 0.3 MPa, since a total is missing" in set(last["words"])
    swapped = ranking_table({pair: tables[pair] for pair in sorted(tables, reverse=True)}, without)
    found = swapped[(swapped["compared"] == "rubbers") & (swapped["on"] == "street")].iloc[0]
    assert (found["verdict"], found["words"]) == (SECOND, street["words"])


def test_comparison_has_every_pair_with_its_interval() -> None:
    tables = {("a", "street"): totals(0.5, (0.4, 0.6)), ("b", "street"): totals(0.4, friction_rubber_error=0.012)}
    table = comparison_table(tables, dict.fromkeys(tables, ()))
    assert table["rubber"].tolist() == ["a", "a", "b", "b"]
    assert table["friction_total_ci95"].iloc[0] == pytest.approx(math.hypot(0.005, 12.706 * 0.1), rel=1e-3)
    assert table["friction_total_ci95"].iloc[2] == pytest.approx(0.013)
    assert table["draws"].tolist() == [2, 0, 0, 0]


def test_counts_of_verdicts_are_said() -> None:
    pair = {"compared": "rubbers", "on": "street", "first": "a", "second": "b"}
    roads = {"compared": "roads", "on": "a", "first": "street", "second": "track"}
    verdicts = [FIRST, SECOND, SECOND, EQUAL, UNKNOWN]
    rows = [*(pair | {"verdict": one} for one in verdicts), *(roads | {"verdict": one} for one in (FIRST, FIRST))]
    assert headlines([*rows, pair | {"on": "track", "verdict": EQUAL}]) == [
        "b grips more than a on street at 2 of 5 points, less at 1, neither for certain at 1, not known at 1",
        "a grips more on street than on track at 2 of 2 points",
        "a and b cannot be told apart on track at any of 1 points",
    ]


def test_table_of_other_scenes_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "friction_total.csv"
    write_table(totals(0.5).assign(collected="0123"), path)
    assert read_pair(path, "0123")["friction_total"].iloc[0] == 0.5
    with pytest.raises(BrokenResult, match=r"friction_total.csv is made of other scenes than this campaign's; delete"):
        read_pair(path, "123")


def test_each_road_has_its_column() -> None:
    axes = {"scale": [0], "velocity": [100.0, 1000.0], "pressure": [0.3], "aspect": [0.2]}
    roads = [
        xr.Dataset({"friction_coefficient": (tuple(axes), np.array([one, np.nan]).reshape(1, 2, 1, 1))}, coords=axes)
        for one in (0.4, 0.6)
    ]
    table = road_by_road(totals(0.5)[::-1], roads)
    np.testing.assert_array_equal(table["friction_direct_2"], [np.nan, 0.6])
