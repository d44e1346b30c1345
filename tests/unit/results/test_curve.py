"""Friction over speed between its points: that the stated errors cover the true ones, on curves in closed form."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.special import erf

from rubfric.arrays import Real
from rubfric.mechanics.theory.layer import full_contact_friction, layer_compliance
from rubfric.mechanics.theory.persson import persson_friction
from rubfric.results.curve import Curve
from rubfric.results.peaks import CurvePeak, find_curve_peak
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

GRID = np.array([0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 10000.0])
FINE = np.geomspace(0.1, 1e4, 1001)
COUNT = 60
Known = Callable[[Any], Real]


def rubber(draw: np.random.Generator) -> Material:
    """Return a rubber of up to eight Maxwell elements, some of them of nearly all of the relaxation."""
    count = int(draw.integers(1, 9))
    shares = 0.999 * draw.dirichlet(np.full(count, draw.choice([0.3, 1.0, 3.0])))
    times = tuple(10.0 ** draw.uniform(-9.0, 0.0, count))
    return Material("random", 4.17, 0.49, tuple(shares), times)


def full_contact(draw: np.random.Generator) -> Known:
    """Return friction over speed of a random rubber on a random sine, in full contact."""
    material, k = rubber(draw), 10.0 ** draw.uniform(0.5, 3.0)

    def known(speeds: Any) -> Real:
        stiffness = 1.0 / layer_compliance(material, k, np.asarray(speeds), 0.5, "stress")
        return 0.5 * 0.01**2 * k * stiffness.imag

    assert known(3.0) == pytest.approx(full_contact_friction(material, SineScale(0.01, k), 3.0, 1.0, 0.5, "stress"))
    return known


def partial_contact(draw: np.random.Generator) -> Known:
    """Return friction over speed of a random rubber on the paper's road by Persson's theory, at a random load."""
    material, pressure = rubber(draw), 10.0 ** draw.uniform(-1.0, 0.7)
    a, k = np.array([[0.015, 0.006, 0.003, 0.002], [35.0, 80.0, 200.0, 300.0]])[:, :, None]

    def known(speeds: Any) -> Real:
        stiffness = 1.0 / layer_compliance(material, k, np.asarray(speeds), 0.15, "stress")
        touching = erf(pressure / np.sqrt(np.cumsum(np.abs(a * stiffness) ** 2, axis=0)))
        return np.sum(0.5 * a**2 * k * stiffness.imag / pressure * touching, axis=0)

    road = WaveRoad(tuple(a[:, 0]), tuple(k[:, 0]), (0.0,) * 4)
    shares = persson_friction(material, road, 3.0, pressure, 0.15, "stress")
    assert float(known(3.0)[0]) == pytest.approx(float(np.sum(shares)))
    return known


def refined(known: Known, accuracy: float, error: float = 0.0) -> Curve:
    """Return the curve of a function, with speeds added until it says that it is known, from the paper's seven."""
    speeds = GRID
    while True:
        friction = known(speeds)
        curve = Curve(speeds, friction, error * friction)
        speed = curve.next_speed(accuracy)
        if speed is None:
            return curve
        assert speed not in speeds
        assert speeds.size < 40
        speeds = np.sort(np.append(speeds, speed))


@cache
def tried(kind: Callable[[np.random.Generator], Known], accuracy: float) -> list[tuple[Curve, Real]]:
    """Return curves to an accuracy, and their true friction at all places."""
    draw = np.random.default_rng(2019)
    found = []
    for _ in range(COUNT):
        known = kind(draw)
        curve = refined(known, accuracy)
        found.append((curve, known(FINE)))
    return found


def covers(peak: CurvePeak, truth: Real) -> tuple[bool, bool]:
    """Return whether the true height and its speed lie within those stated of a peak."""
    top = int(np.argmax(truth))
    height = abs(peak.friction - truth[top]) <= peak.error + 1e-4 * truth[top]
    return bool(height), bool(0.99 * peak.speed.low <= FINE[top] <= 1.01 * peak.speed.high)


@pytest.mark.parametrize(
    "accuracy",
    [pytest.param(10.0, id="seven speeds"), pytest.param(0.01, id="to 1 %", marks=pytest.mark.thorough)],
)
@pytest.mark.parametrize("kind", [full_contact, partial_contact])
def test_stated_errors_cover_the_true_ones(kind: Callable[[np.random.Generator], Known], accuracy: float) -> None:
    within, peaks, halves = [], [], []
    for curve, truth in tried(kind, accuracy):
        friction, error = curve.at(np.log10(FINE))
        within.append(np.mean(np.abs(friction - truth) <= error + 1e-4 * truth.max()))
        peak = find_curve_peak(curve)
        peaks.append(covers(peak, truth))
        for side, of in ((slice(None, int(np.argmax(truth)) + 1), peak.slower), (slice(None), peak.faster)):
            below = np.flatnonzero(truth[side] < 0.5 * truth.max())
            beyond = below[-1:] if of is peak.slower else below[below > int(np.argmax(truth))][:1]
            if beyond.size and np.isfinite([of.low, of.high]).all():
                halves.append(0.98 * of.low <= FINE[beyond[0]] <= 1.02 * of.high)
    assert np.mean(within) >= 0.95
    assert (np.mean(peaks, axis=0) >= 0.95).all()
    assert np.mean(halves) >= 0.95
    assert len(halves) > COUNT // 2


@pytest.mark.thorough
@pytest.mark.parametrize("kind", [full_contact, partial_contact])
def test_added_speeds_make_curves_as_accurate_as_asked(
    kind: Callable[[np.random.Generator], Known],
) -> None:
    off, added = [], []
    for curve, truth in tried(kind, 0.01):
        friction, _ = curve.at(np.log10(FINE))
        off.append(np.max(np.abs(friction - truth) / np.maximum(truth, 0.1 * truth.max())))
        added.append(curve.speeds.size - GRID.size)
    assert np.quantile(off, 0.95) <= 0.01
    assert np.mean(added) < 14.0  # half of the points that an even spacing to the same accuracy takes, a quarter decade


def test_one_relaxation_is_found_to_its_peak_and_half_width() -> None:
    # omega tau / (1 + omega² tau²): highest at 1, half of it at 2 - sqrt(3) and 2 + sqrt(3).
    curve = refined(lambda speed: 0.03 * speed / (30.0**2 + speed**2) * 30.0, 0.01)
    peak = find_curve_peak(curve)
    assert peak.kind == "peak"
    assert peak.friction == pytest.approx(0.015, rel=0.01)
    assert peak.error < 0.01 * peak.friction
    for found, true in ((peak.speed, 30.0), (peak.slower, 30.0 * (2 - 3**0.5)), (peak.faster, 30.0 * (2 + 3**0.5))):
        assert found.low < true < found.high
        assert found.high / found.low < 1.5
    # Of the seven speeds, none of which is near it, it is known as well as it can be.
    coarse = find_curve_peak(Curve(GRID, np.array([0.9 * s / (900.0 + s**2) for s in GRID]), np.zeros(7)))
    assert coarse.error > 0.1 * coarse.friction
    assert coarse.speed.low < 30.0 < coarse.speed.high


@pytest.mark.parametrize(("slope", "kind"), [(0.3, "rising"), (-0.3, "falling")])
def test_the_highest_friction_at_an_end_is_no_peak(slope: float, kind: str) -> None:
    friction = GRID**slope
    peak = find_curve_peak(Curve(GRID, friction, 0.01 * friction))
    assert peak.kind == kind
    assert peak.speed.speed == GRID[-1 if kind == "rising" else 0]
    assert np.isnan((peak.slower if kind == "falling" else peak.faster).speed)


def test_a_peak_that_may_be_at_an_end_is_open() -> None:
    friction = np.array([0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.301])[::-1]
    assert find_curve_peak(Curve(GRID, np.sort(friction)[[0, 1, 6, 2, 3, 4, 5]], 0.1 * friction)).kind == "open"


def test_nothing_is_added_where_points_are_no_better_known() -> None:
    known = full_contact(np.random.default_rng(3))
    exact = refined(known, 0.01)
    rough = refined(known, 0.01, error=0.1)
    assert GRID.size < rough.speeds.size < exact.speeds.size
    wide = rough.gaps > 0.1
    assert not (wide & rough.open(0.01)).any()


def test_other_speeds_of_the_grid_ask_for_the_same_speeds() -> None:
    known = full_contact(np.random.default_rng(4))
    first = set(refined(known, 0.01).speeds.tolist())
    speeds = np.array(sorted({*GRID.tolist(), 50.0}))
    curve = Curve(speeds, known(speeds), np.zeros(speeds.size))
    asked = set()
    while (speed := curve.next_speed(0.01)) is not None:
        asked.add(speed)
        curve = Curve.known(
            np.append(curve.speeds, speed), np.append(curve.friction, known(speed)), np.append(curve.error, 0.0)
        ) or pytest.fail("no curve")
    assert len(asked - first) <= 2
    assert len(asked & first) >= 6


def test_an_interval_with_a_speed_without_friction_is_left() -> None:
    curve = Curve(GRID[1:4], np.array([0.1, 0.5, 0.1]), np.zeros(3))
    first = curve.next_speed(0.01)
    assert first is not None
    other = curve.next_speed(0.01, np.array([first]))
    assert other is not None
    assert (first < 10.0) != (other < 10.0)
    assert curve.next_speed(0.01, np.array([first, other])) is None


def test_unknown_points_are_left_out_and_none_may_be_left() -> None:
    curve = Curve.known([10.0, 1.0, 100.0], [0.2, 0.1, np.nan], [0.01, np.nan, 0.01])
    assert curve is not None
    assert curve.speeds.tolist() == [1.0, 10.0]
    assert curve.error.tolist() == [0.0, 0.01]
    assert Curve.known([1.0, 10.0], [0.0, 0.0], [0.0, 0.0]) is None
    assert Curve.known([1.0, 10.0], [0.1, np.nan], [0.0, 0.0]) is None
