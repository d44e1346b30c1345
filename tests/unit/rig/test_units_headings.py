"""Units and headings as loggers write them."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.columns.textfile import TextTable
from rubfric.columns.units import check_factor, factor, split_heading
from rubfric.errors import InvalidInput
from rubfric.rig.headings import recognise


@pytest.mark.parametrize(
    ("kind", "unit", "expected"),
    [
        ("time", "ms", 1e-3),
        ("time", "S", 1.0),
        ("time", "µs", 1e-6),
        ("time", "μs", 1e-6),
        ("force", "kN", 1e3),
        ("force", "KN", 1e3),
        ("force", "mN", 1e-3),
        ("force", "MN", None),
        ("force", "kg", 9.80665),
        ("force", "g", 9.80665e-3),
        ("force", "lbf", 4.4482216152605),
        ("force", "Kilonewtons", 1e3),
        ("time", "msec.", 1e-3),
        ("length", "millimetres", 1.0),
        ("length", "㎜", 1.0),
        ("force", "m", None),
        ("length", "m", 1e3),
        ("length", " mm ", 1.0),
        ("length", "um", 1e-3),
        ("length", "s", None),
    ],
)
def test_factor_is_that_of_the_unit(kind: str, unit: str, expected: float | None) -> None:
    assert factor(kind, unit) == expected


@pytest.mark.parametrize(
    ("heading", "expected"),
    [
        ("Normal force [kN]", ("Normal force", "kN")),
        ("Normal force (N)", ("Normal force", "N")),
        ("Force / N", ("Force", "N")),
        ("Time, s", ("Time", "s")),
        ("Weg in mm", ("Weg", "mm")),
        ("x_mm", ("x", "mm")),
        ("F_N", ("F_N", "")),
        ("'Time'", ("Time", "")),
        ("Normal force", ("Normal force", "")),
        ("Position <µm>", ("Position", "µm")),
        ("Fn [N] (filtered)", ("Fn (filtered)", "N")),
        ("時間（s）", ("時間", "s")),
    ],
)
def test_heading_is_split_into_name_and_unit(heading: str, expected: tuple[str, str]) -> None:
    assert split_heading(heading) == expected


def test_unknown_unit_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InvalidInput, match=r"^units.time is 'fortnight', but must be one of s, ms, "):
        check_factor("units.time", "time", "fortnight")


def table(*headings: str) -> TextTable:
    values = np.arange(4.0 * len(headings)).reshape(4, -1)
    return TextTable((), headings, ("",) * len(headings), values, np.zeros(values.shape, dtype=bool), [], ())


def columns(*headings: str, **named: str | int) -> dict[str, int]:
    return {name: column.place for name, column in recognise("run.csv", table(*headings), named, {}).items()}


def test_named_columns_come_first() -> None:
    found = columns("t [s]", "K1 [N]", "K2 [N]", "Weg [mm]", "normal [N]", normal="K1", traction="K2 [N]")
    assert found == {"time": 0, "normal": 1, "traction": 2, "displacement": 3}


def test_given_units_come_first() -> None:
    given = {"time": "ms", "normal": "kN", "traction": "N", "displacement": "m"}
    found = recognise("run.csv", table("t", "Fn", "Ft", "x (mm)"), {}, given)
    assert [column.factor for column in found.values()] == [1e-3, 1e3, 1.0, 1e3]


def test_one_column_for_two_quantities_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"has one column, 'A \(N\)', for normal and another quantity"):
        columns("t (s)", "A (N)", "x (mm)", "z (mm)", normal="A", traction="A", displacement="x")


def test_name_that_no_column_has_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"has no column named 'Fz' for normal; its columns are 't \(s\)', "):
        columns("t (s)", "Fn (N)", "Ft (N)", "x (mm)", normal="Fz")
