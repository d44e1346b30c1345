"""Maxwell branches over one step: against the differential equation, over all ratios of step to relaxation time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from rubfric.rubber.maxwell import Relaxation, mean_decay

RATIOS = pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.3, 2.0, 40.0])
CHANGE, PREVIOUS, START = 0.7, -0.2, 0.3


def step(ratio: float, before: float = 3.0) -> Relaxation:
    return Relaxation(2.0, np.array([2.0 / ratio]), before)


def slope(x: float, before: float) -> float:
    """Return de/dx of the parabola through the last three values, at a share x of the step."""
    r = before / 2.0
    bow = (CHANGE - PREVIOUS / r) / (1.0 + r) if math.isfinite(before) else 0.0
    return CHANGE + bow * (2.0 * x - 1.0)


@RATIOS
@pytest.mark.parametrize("before", [0.5, 3.0, math.inf])
def test_end_of_a_step_solves_the_equation(ratio: float, before: float) -> None:
    exact = solve_ivp(lambda x, w: slope(x, before) - ratio * w, (0, 1), [START], "Radau", rtol=1e-11, atol=1e-13)
    relaxation = step(ratio, before)
    found = relaxation.decay * START + relaxation.share * CHANGE - relaxation.lag * PREVIOUS
    assert found[0] == pytest.approx(exact.y[0, -1], abs=1e-10)


@RATIOS
@pytest.mark.parametrize("share", [0.2, 0.9])
def test_so_does_any_instant_of_it(ratio: float, share: float) -> None:
    exact = solve_ivp(lambda x, w: slope(x, 3.0) - ratio * w, (0, share), [START], "Radau", rtol=1e-11, atol=1e-13)
    relaxation = step(ratio)
    decay, line, bow = relaxation.at(share)
    found = decay * START + line * CHANGE + bow * relaxation.bow(np.array(CHANGE), np.array(PREVIOUS))
    assert found[0] == pytest.approx(exact.y[0, -1], abs=1e-10)


@RATIOS
@pytest.mark.parametrize("turn", [1.0, 1j])
def test_mean_square_is_that_of_the_curve(ratio: float, turn: complex) -> None:
    relaxation = step(ratio)
    bow = relaxation.bow(np.array(CHANGE), np.array(PREVIOUS))

    def square(x: float) -> float:
        decay, line, curve = relaxation.at(x)
        return abs(decay[0] * START * turn + line[0] * CHANGE + curve[0] * bow) ** 2

    expected = quad(square, 0.0, 1.0, limit=400, epsabs=1e-13)[0]
    values = (np.array([START * turn]), np.array(CHANGE + 0j), np.array(PREVIOUS + 0j))
    assert relaxation.mean_square(*values)[0] == pytest.approx(expected, rel=1e-10)


def test_mean_decay_and_its_series_meet() -> None:
    assert mean_decay(np.array([1e-12]))[0] == pytest.approx(1.0, rel=1e-11)
    below, above = step(0.0099999), step(0.0100001)
    np.testing.assert_allclose(below.share, above.share, rtol=1e-6)
    np.testing.assert_allclose(below.lag, above.lag, rtol=1e-4)


@pytest.mark.parametrize("time", [1e-6, 0.05, 1.0])
def test_order_is_two_also_for_branches_much_faster_than_the_step(time: float) -> None:
    """e = sin t: w is what a harmonic leaves after a long time."""
    errors = []
    for count in (40, 80, 160):
        length = 4.0 * np.pi / count
        relaxation = Relaxation(length, np.array([time]), length)
        instants = length * np.arange(count + 1)
        w = (1j * time / (1.0 + 1j * time)).imag  # at t = 0
        values = np.sin(np.append(-length, instants))
        for previous, change in zip(np.diff(values)[:-1], np.diff(values)[1:], strict=True):
            w = float((relaxation.decay * w + relaxation.share * change - relaxation.lag * previous)[0])
        exact = (np.exp(1j * instants[-1]) * 1j * time / (1.0 + 1j * time)).imag
        errors.append(abs(w - exact) / min(1.0, time))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(orders > 1.8)


def test_no_branches_are_no_work() -> None:
    relaxation = Relaxation(1.0, np.zeros(0), 1.0)
    assert relaxation.share.shape == relaxation.lag.shape == (0,)
    assert relaxation.mean_square(np.zeros((0, 3)), np.ones(3), np.ones(3)).shape == (0, 3)
