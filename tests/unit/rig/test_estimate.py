"""Values in the middle of a window, and how sure they are: held to known noise and known polynomials."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binom, norm

from rubfric.rig.estimate import centre, correlation_length, halfwidth


def autoregression(rng: np.random.Generator, count: int, kept: float) -> np.ndarray:
    fresh = rng.standard_normal(count)
    fresh[1:] *= np.sqrt(1.0 - kept**2)
    return lfilter([1.0], [1.0, -kept], fresh)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_polynomial_is_evaluated_in_the_middle(order: int, rng: np.random.Generator) -> None:
    time = np.sort(rng.uniform(3.0, 5.0, 200))
    middle = 0.5 * (time[0] + time[-1])
    coefficients = [2.0, -3.0, 0.5, 0.25][: order + 1]
    values = sum(c * (time - middle) ** n for n, c in enumerate(coefficients))
    found = centre(time, np.asarray(values), order)
    expected = [2.0, -3.0, 1.0][: min(order, 2) + 1]
    assert [found.value, found.slope, found.curvature][: len(expected)] == pytest.approx(expected, rel=1e-9)
    assert max(found.value_error, found.slope_error) < 1e-9


@pytest.mark.parametrize("kept", [0.0, 0.5, 0.9])
def test_correlation_length_is_that_of_an_autoregression(kept: float, rng: np.random.Generator) -> None:
    lengths = [correlation_length(autoregression(rng, 5000, kept)) for _ in range(40)]
    # Where it errs it is long, which widens the intervals.
    assert 0.97 < np.mean(lengths) * (1.0 - kept) / (1.0 + kept) < 1.25
    assert min(lengths) >= 1.0


def test_constant_residuals_of_nothing_are_independent() -> None:
    assert correlation_length(np.zeros(10)) == 1.0


@pytest.mark.parametrize("kept", [0.0, 0.8])
@pytest.mark.parametrize("name", ["value", "slope"])
def test_intervals_hold_the_truth_as_often_as_they_say(name: str, kept: float, rng: np.random.Generator) -> None:
    """Neither too often nor too seldom: both bounds lie where a fair 95 % fails once in ten thousand."""
    runs = 500
    time = np.linspace(0.0, 1.0, 400)
    truth = {"value": 1.5, "slope": 1.0}[name]
    held = 0
    for _ in range(runs):
        found = centre(time, 1.0 + time + 0.1 * autoregression(rng, time.size, kept), 1)
        held += abs(getattr(found, name) - truth) <= halfwidth(getattr(found, f"{name}_error"), found.freedom)
    low, high = binom.ppf([5e-5, 1.0 - 5e-5], runs, 0.95)
    assert low <= held <= high


def test_correlated_samples_count_for_fewer(rng: np.random.Generator) -> None:
    time = np.linspace(0.0, 1.0, 2000)
    free, bound = (centre(time, autoregression(rng, 2000, kept), 0) for kept in (0.0, 0.9))
    assert bound.effective < 0.15 * free.effective
    assert bound.value_error > 2.5 * free.value_error


def test_a_visible_bend_raises_the_order_and_no_noise_does(rng: np.random.Generator) -> None:
    time = np.linspace(-1.0, 1.0, 1000)
    bent = time**2 + 0.05 * rng.standard_normal(1000)
    assert abs(centre(time, bent, 1).value) > 0.25
    assert abs(centre(time, bent, 1, 5).value) < 0.02
    straight = [centre(time, rng.standard_normal(1000), 1, 2) for _ in range(50)]
    plain = [one.value_error for one in straight]
    assert np.median(plain) == pytest.approx(1.0 / np.sqrt(1000.0), rel=0.15)


def test_known_correlation_is_not_forgotten(rng: np.random.Generator) -> None:
    time = np.linspace(0.0, 1.0, 500)
    found = centre(time, rng.standard_normal(500), 0, longer=5.0)
    assert found.effective <= 100.0


def test_halfwidth_tends_to_that_of_a_normal_distribution() -> None:
    assert halfwidth(1.0, 1e6) == pytest.approx(norm.ppf(0.975), rel=1e-5)
    assert halfwidth(1.0, 3.0) == pytest.approx(3.1824, rel=1e-4)
