"""Friction on a measured road as a table: means over windows, and which waves carry friction."""

from __future__ import annotations

import math

import pandas as pd
import pytest

from rubfric.figures.road_friction import over_cutoff
from rubfric.results.carriers import carried, carriers
from rubfric.results.road_friction import means


def test_refused_windows_are_left_out_of_means_and_counted() -> None:
    row = means([(0.2, 0.01, 0.3), "no balance", (0.4, 0.03, 0.5)])
    assert (row["windows"], row["refused"], row["note"]) == (2, 1, "window 2: no balance")
    found = [row[name] for name in ("friction_coefficient", "friction_numerical_error", "contact_fraction")]
    assert found == pytest.approx([0.3, 0.02, 0.4])
    # The standard deviation of two values is their difference over the root of 2, that of their mean half of it.
    assert (row["friction_road_error"], row["contact_road_error"]) == pytest.approx((0.1, 0.1))
    assert row["friction_scatter"] == pytest.approx(0.2 / math.sqrt(2.0))
    assert math.isnan(means([(0.2, 0.01, 0.3)])["friction_road_error"])
    assert math.isnan(means(["no balance"])["friction_coefficient"])


def rows(velocity: float, *points: tuple[float, str, float, int]) -> list[dict[str, object]]:
    place = {"pressure_MPa": 0.3, "velocity_mm_per_s": velocity, "friction_road_error": 0.01}
    names = ("cutoff_mm", "way", "friction_coefficient", "refused")
    return [place | {"friction_numerical_error": 0.0} | dict(zip(names, point, strict=True)) for point in points]


TABLE = pd.DataFrame(
    [
        *rows(10.0, (4.0, "direct", 0.1, 0), (2.0, "direct", 0.3, 0), (1.0, "direct", 0.4, 0)),
        *rows(10.0, (0.5, "persson", 0.5, 0), (0.25, "persson", 0.6, 0), (1.0, "sum", 0.9, 0)),
        *rows(100.0, (4.0, "direct", 0.2, 0), (2.0, "direct", 0.25, 0)),
        # Means over different windows say nothing of the waves between them.
        *rows(1000.0, (4.0, "direct", 0.2, 0), (2.0, "direct", 0.9, 1)),
        *rows(1.0, (2.0, "direct", 0.5, 0)),
    ]
)


def test_shares_of_bands_of_wavelength_add_up_to_the_friction_of_the_shortest_cutoff() -> None:
    found = {velocity: (bands, finer) for _, velocity, bands, finer in carried(TABLE)}
    assert list(found) == [10.0, 100.0]
    bands, finer = found[10.0]
    assert [name for name, _ in bands] == ["4 mm and longer", "2 to 4 mm", "1 to 2 mm"]
    assert [share for _, share in bands] == pytest.approx([0.25, 0.5, 0.25])
    assert finer == "+50% down to 0.25 mm"
    assert found[100.0][1] == ""
    assert carriers(TABLE) == (
        "at 10 mm/s and 0.3 MPa waves of 4 mm and longer carry 25% of friction, those of 2 to 4 mm 50% and those of "
        "1 to 2 mm 25%; by Persson's theory, a model, finer ones would change it by +50% down to 0.25 mm"
    )
    assert carriers(TABLE[TABLE["cutoff_mm"] == 2.0]) == ""


def test_what_a_model_adds_is_dashed_and_has_no_band() -> None:
    figure = over_cutoff(TABLE[TABLE["velocity_mm_per_s"] == 10.0])
    (panel,) = figure.axes
    solid, dashed = panel.get_lines()[:2]
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    # The model begins where the direct part ends.
    assert dashed.get_xydata()[0].tolist() == solid.get_xydata()[-1].tolist()
    (band,) = panel.collections
    assert band.get_paths()[0].vertices[:, 0].max() == solid.get_xdata()[-1]
