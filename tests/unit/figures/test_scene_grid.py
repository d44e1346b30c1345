from __future__ import annotations

from collections.abc import Callable

import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.scenes import by_pressure_and_speed

Maker = Callable[..., xr.Dataset]


def test_results_are_sorted_by_pressure_and_speed(make_result: Maker) -> None:
    results = [make_result(pressure, speed) for pressure in (5.0, 1.0) for speed in (100.0, 1.0, 10.0)]
    grid = by_pressure_and_speed(results, ["depth"])
    assert grid.pressures == (1.0, 5.0)
    assert grid.speeds == (1.0, 10.0, 100.0)
    assert grid.results[5.0, 10.0] is results[2]


def test_no_results_are_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^there are no results to draw, but at least one is needed$"):
        by_pressure_and_speed([], [])


def test_gap_is_refused(make_result: Maker) -> None:
    results = [make_result(1.0, 1.0), make_result(1.0, 10.0), make_result(5.0, 1.0)]
    with pytest.raises(InvalidInput, match=r"^there is no result at pressure 5 MPa, speed 10 mm/s, so its panel"):
        by_pressure_and_speed(results, [])


def test_second_result_of_a_panel_is_refused(make_result: Maker) -> None:
    with pytest.raises(InvalidInput, match=r"^there are two results at pressure 1 MPa, speed 10 mm/s, but"):
        by_pressure_and_speed([make_result(), make_result()], [])


def test_two_blocks_are_refused(make_result: Maker) -> None:
    results = [make_result(1.0), make_result(5.0, scale=2)]
    complaint = (
        r"^the results are of scale 1, height-to-width ratio 0\.75 and of scale 2, height-to-width ratio 0\.75, "
        r"but one figure shows one block$"
    )
    with pytest.raises(InvalidInput, match=complaint):
        by_pressure_and_speed(results, [])


def test_what_is_lacking_is_named(make_result: Maker) -> None:
    result = make_result().drop_vars("contact_fraction")
    del result.attrs["aspect"]
    with pytest.raises(InvalidInput, match=r"^the result made up lacks aspect, contact_fraction$"):
        by_pressure_and_speed([result], ["depth", "contact_fraction"])
