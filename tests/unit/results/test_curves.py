"""The tables of curves and of their peaks: which points are on a curve, and what is said of its peak."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from rubfric.results.curves import ADDED, GRID, curve_table, scale_name
from rubfric.results.limits import MOST, WHOLE
from rubfric.results.peaks import peak_table

SPEEDS = np.array([0.1, 1.0, 10.0, 100.0, 1000.0])


def relaxation(speeds: np.ndarray, at: float = 30.0) -> np.ndarray:
    """Return a friction that is 0.5 at its peak."""
    return speeds / at / (1.0 + (speeds / at) ** 2)


def scale(speeds: np.ndarray, friction: np.ndarray, error: float = 0.0, pressure: float = 1.0) -> pd.DataFrame:
    """Return a table of one scale."""
    return pd.DataFrame(
        {"velocity_mm_per_s": speeds, "pressure_MPa": pressure, "aspect": 0.75, "friction_coefficient": friction}
    ).assign(friction_coefficient_error=error * friction)


def total(speeds: np.ndarray, friction: np.ndarray, error: float = 0.0) -> pd.DataFrame:
    """Return a table of totals."""
    return pd.DataFrame({"velocity_mm_per_s": speeds, "pressure_MPa": 1.0, "friction_total": friction}).assign(
        friction_total_error=error * friction, way="direct"
    )


def test_points_are_those_of_the_grid_and_the_added_ones_of_one_aspect() -> None:
    table = pd.concat([scale(SPEEDS, relaxation(SPEEDS)), scale(SPEEDS, relaxation(SPEEDS)).assign(aspect=0.5)])
    between = np.array([31.6, 3.16])
    points = curve_table(
        {scale_name(1): table, WHOLE: total(SPEEDS, relaxation(SPEEDS))},
        {scale_name(1): [scale(between, relaxation(between), 0.1), scale(between[:0], between[:0])]},
        0.75,
    )
    first = points[points["curve"] == "scale 1"]
    assert first["velocity_mm_per_s"].tolist() == [0.1, 1.0, 3.16, 10.0, 31.6, 100.0, 1000.0]
    assert first["point"].tolist() == [GRID, GRID, ADDED, GRID, ADDED, GRID, GRID]
    assert first["friction_coefficient_error"].tolist()[2] == pytest.approx(0.1 * relaxation(between)[1])
    whole = points[points["curve"] == WHOLE]
    assert whole["way"].tolist() == ["direct"] * 5
    assert whole["friction_coefficient"].tolist() == relaxation(SPEEDS).tolist()


def test_the_error_of_a_measured_rubber_counts() -> None:
    table = scale(SPEEDS, relaxation(SPEEDS), 0.01).assign(friction_coefficient_rubber_error=0.02)
    points = curve_table({scale_name(1): table}, {}, 0.75)
    assert points["friction_coefficient_error"].tolist() == pytest.approx(0.01 * relaxation(SPEEDS) + 0.02)


def test_peaks_are_stated_curve_by_curve_with_their_errors() -> None:
    dense = np.geomspace(0.3, 300.0, 13)
    tables = {
        scale_name(1): pd.concat([scale(SPEEDS, relaxation(SPEEDS), pressure=p) for p in (1.0, 2.0)]),
        WHOLE: total(SPEEDS, relaxation(SPEEDS)),
    }
    peaks = peak_table(curve_table(tables, {WHOLE: [total(dense, relaxation(dense))]}, 0.75), "r", "x", 0.01)
    assert peaks[["rubber", "road", "curve", "pressure_MPa"]].values.tolist() == [
        ["r", "x", "scale 1", 1.0],
        ["r", "x", "scale 1", 2.0],
        ["r", "x", WHOLE, 1.0],
    ]
    assert peaks["added"].tolist() == [0, 0, 13]
    assert peaks["points"].tolist() == [5, 5, 18]
    assert (peaks["peak_speed_low_mm_per_s"] < 30.0).all()
    assert (peaks["peak_speed_high_mm_per_s"] > 30.0).all()
    coarse, fine = peaks["peak_friction_error"].to_numpy()[[0, 2]]
    assert coarse > 0.05 > 0.01 > fine
    assert (np.abs(peaks["peak_friction"] - 0.5) < peaks["peak_friction_error"]).all()
    assert (peaks["half_faster_speed_high_mm_per_s"] > 30.0 * (2.0 + 3.0**0.5)).all()


@pytest.mark.parametrize(
    ("friction", "error", "accuracy", "says"),
    [
        (SPEEDS**0.3, 0.0, None, "highest at the fastest speed: the peak is there or beyond, add faster speeds"),
        (SPEEDS**-0.3, 0.0, None, "highest at the slowest speed: the peak is there or beyond, add slower speeds"),
        (0.5 + 0.001 * relaxation(SPEEDS), 0.1, None, "by its error the highest friction may be at the slowest or"),
        (0.6 + relaxation(SPEEDS), 0.0, None, "does not fall to half on the slower and the faster side"),
        (relaxation(SPEEDS), 0.9, 0.01, "points are known no better themselves: a finer preset"),
        (relaxation(SPEEDS), 0.0, 0.01, "since scenes in between have no solution"),
    ],
)
def test_what_must_be_known_of_a_peak_is_said(
    friction: np.ndarray, error: float, accuracy: float | None, says: str
) -> None:
    peaks = peak_table(curve_table({scale_name(1): scale(SPEEDS, friction, error)}, {}, 0.75), "r", "x", accuracy)
    assert says in peaks["note"][0]


def test_a_curve_that_took_all_speeds_says_so() -> None:
    many = np.geomspace(0.11, 0.9, MOST)
    added = {scale_name(1): [scale(many, relaxation(many))]}
    peaks = peak_table(curve_table({scale_name(1): scale(SPEEDS, relaxation(SPEEDS))}, added, 0.75), "r", "x", 0.01)
    assert f"{MOST} speeds were added, the most of a curve" in peaks["note"][0]


def test_a_peak_found_to_the_accuracy_needs_no_note() -> None:
    dense = np.geomspace(0.15, 900.0, 30)
    added = {scale_name(1): [scale(dense, relaxation(dense))]}
    peaks = peak_table(curve_table({scale_name(1): scale(SPEEDS, relaxation(SPEEDS))}, added, 0.75), "r", "x", 0.01)
    assert peaks["note"].tolist() == [""]


def test_one_speed_makes_no_curve() -> None:
    peaks = peak_table(curve_table({scale_name(1): scale(SPEEDS[:1], SPEEDS[:1])}, {}, 0.75), "r", "x", None)
    assert len(peaks) == 0
    assert {"curve", "kind"} <= set(peaks)
