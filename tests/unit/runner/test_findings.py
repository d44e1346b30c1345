"""What the tables say at a glance."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from synthetic_campaign import make_campaign, make_totals

from rubfric.runner.findings import findings, highest, told_apart, verdicts


@pytest.fixture
def tables(tmp_path: Path) -> list[Path]:
    """Return two tables of two scenes each."""
    rows = {
        "velocity_mm_per_s": [1.0, 100.0],
        "pressure_MPa": [0.5, 5.0],
        "aspect": [0.75, 0.75],
        "friction_coefficient": [0.1, 0.2],
    }
    paths = [tmp_path / f"friction_scale_{scale}.csv" for scale in (1, 12)]
    for path, errors, warnings in zip(paths, ([1e-3, 1e-4], [2e-4, 3e-3]), ([0, 0], [2, 0]), strict=True):
        pd.DataFrame(rows | {"friction_coefficient_error": errors, "warnings": warnings}).to_csv(path, index=False)
    return paths


def test_largest_error_is_relative_and_has_its_place(tables: list[Path]) -> None:
    lines = findings(tables)
    assert lines == [
        "largest estimated error of friction 1.5 %, on scale 12 at 100.0 mm/s, 5.0 MPa, height/width 0.75",
        "1 of 4 scenes carry a warning: scale 12 at 1 mm/s, 0.5 MPa; the words are in the scenes' logs",
    ]


def test_scenes_with_a_warning_are_named_by_scale_speed_and_pressure(tables: list[Path], tmp_path: Path) -> None:
    one = pd.read_csv(tables[1])
    many = pd.concat([one.assign(pressure_MPa=load, aspect=1.5) for load in (0.2, 1.0, 0.2)])
    many.to_csv(tables[1], index=False)
    assert "scale 12 at 1 mm/s, 0.2 and 1 MPa; the words" in findings(tables)[1]
    fast = [many.assign(velocity_mm_per_s=speed, pressure_MPa=load) for speed in range(1, 8) for load in (0.5, 1, 5)]
    pd.concat(fast).assign(warnings=1).to_csv(tables[1], index=False)
    line = findings(tables)[1]
    assert "scale 12 at 5 mm/s, 3 pressures from 0.5 to 5 MPa; and at 2 more speeds; the words" in line
    total = tmp_path / "friction_total.csv"
    make_totals(make_campaign()).to_csv(total, index=False)
    assert findings([total])[-1] == (
        "friction of the whole road at 10000 mm/s, 3 pressures from 0.5 to 5 MPa rests on scenes that carry a warning"
    )


def test_no_warning_is_said_too(tables: list[Path]) -> None:
    assert findings(tables[:1])[1] == "none of 2 scenes carries a warning"


def test_missing_tables_count_for_nothing(tables: list[Path], tmp_path: Path) -> None:
    nowhere = tmp_path / "friction_scale_3.csv"
    assert findings([nowhere, *tables]) == findings(tables)
    assert findings([nowhere]) == []


def test_tables_of_another_version_count_for_nothing(tables: list[Path]) -> None:
    old = pd.read_csv(tables[0]).drop(columns="warnings")
    old.to_csv(tables[0], index=False)
    assert findings(tables[:1]) == []


def test_road_without_friction_has_no_largest_error(tables: list[Path]) -> None:
    flat = pd.read_csv(tables[0]).assign(friction_coefficient=0.0)
    flat.to_csv(tables[0], index=False)
    assert findings(tables[:1]) == ["none of 2 scenes carries a warning"]


def test_first_comparisons_of_a_ranking_are_said(tmp_path: Path) -> None:
    path = tmp_path / "ranking.csv"
    pairs = [("rubbers", "street", "a", f"b{number}") for number in range(7)]
    columns = ["compared", "on", "first", "second"]
    pd.DataFrame(pairs, columns=columns).assign(verdict="first grips more").to_csv(path, index=False)
    lines = findings([path])
    assert (len(lines), lines[0]) == (6, "a grips more than b0 on street at 1 of 1 points")
    assert lines[-1] == f"and 2 more comparisons in {path}"
    assert told_apart(path) == "a grips more than b0 on street at 1 of 1 points; 6 more"
    assert told_apart(tmp_path / "nowhere.csv") == ""


HEAD = "velocity_mm_per_s,pressure_MPa,friction_total,friction_total_error,refused,way\n"


def test_highest_friction_has_its_error_place_and_way(tmp_path: Path) -> None:
    table = tmp_path / "friction_total.csv"
    table.write_text(
        f"{HEAD}1,0.5,0.31,0.002,0,direct\n10000,5,1.0411,0.00754,0,sum\n100,5,,,0,direct\n10,5,0.2,,0,direct\n"
    )
    assert highest(table) == "at most 1.04 ± 0.008, at 10000 mm/s and 5 MPa (sum over the scales)"
    table.write_text(f"temperature_degC,{HEAD}-5,1,0.5,0.31,0.002,0,direct\n")
    assert highest(table) == "at most 0.31 ± 0.002, at 1 mm/s and 0.5 MPa, -5 degC (all scales at once)"
    table.write_text(HEAD)
    assert highest(table) == ""
    table.unlink()
    assert highest(table) == ""


def test_largest_error_of_the_whole_road_and_its_refusals_are_told(tmp_path: Path) -> None:
    table = tmp_path / "friction_total.csv"
    table.write_text(f"{HEAD}1,0.5,0.3,0.003,0,direct\n1,5,0.4,0.1,1,sum\n100,0.5,0.0,0.0,0,direct\n")
    worst, refused = findings([table])
    assert worst == "largest error of the whole road's friction 25 %, sum over the scales, at 1 mm/s, 5 MPa"
    told = "scenes of the whole road were refused at 1 of 3 points: 1 mm/s, 5 MPa; why is in "
    assert refused == f"{told}{table}, column note"
    table.write_text(HEAD + "".join(f"{v},5,0.4,0.1,2,sum\n" for v in range(1, 10)))
    assert "refused at 9 of 9 points: 1 mm/s, 5 MPa; " in findings([table])[1]
    assert "; 5 mm/s, 5 MPa; and 4 more; why" in findings([table])[1]


def test_verdicts_are_counted_over_all_pressures_of_the_campaign(tmp_path: Path) -> None:
    path = tmp_path / "claims.csv"
    assert verdicts(path) == ""
    path.write_text(
        "claim,reading,pressure_MPa,verdict\nC1,campaign,all,holds\nC1,campaign,5,does not hold\n"
        "C2,campaign,all,holds in part\nC3,campaign,all,holds\nC1,other,all,does not hold\n"
    )
    assert verdicts(path) == "holds: 2 of 3; holds in part: 1 of 3"


def test_largest_friction_between_speeds_is_said_where_some_were_added(tmp_path: Path) -> None:
    row = {"curve": "whole road", "pressure_MPa": 0.1, "peak_friction": 0.3612, "peak_friction_error": 0.0179} | {
        f"peak_speed_{name}mm_per_s": speed for name, speed in (("", 23.29), ("low_", 10.55), ("high_", 39.0))
    }
    lower = row | {"peak_friction": 0.3, "pressure_MPa": 0.2}
    scale = row | {"curve": "scale 1", "peak_friction": 0.9}
    peaks = tmp_path / "peaks.csv"
    pd.DataFrame([lower, row, scale]).assign(added=11).to_csv(peaks, index=False)
    assert findings([peaks]) == [
        "largest friction of the whole road over all speeds 0.361 ± 0.02, at 23.3 mm/s (between 10.6 and 39) and "
        "0.1 MPa"
    ]
    pd.DataFrame([lower, row, scale]).assign(added=0).to_csv(peaks, index=False)
    assert findings([peaks]) == []
