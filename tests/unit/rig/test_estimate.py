"""Values in the middle of a window, and how sure they are: held to known noise and known polynomials."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binom, norm

from rubfric.rig.estimate import correlation_length, halfwidth, mean, noise_of, plain_mean, weights


def autoregression(rng: np.random.Generator, count: int, kept: float) -> np.ndarray:
    fresh = rng.standard_normal(count)
    fresh[1:] *= np.sqrt(1.0 - kept**2)
    return lfilter([1.0], [1.0, -kept], fresh)


def speed_up(time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return displacement, speed and acceleration that no polynomial of low order follows."""
    return time - 0.3 * np.exp(-2.0 * time), 1.0 + 0.6 * np.exp(-2.0 * time), -1.2 * np.exp(-2.0 * time)


def mean_of(function: np.ndarray, time: np.ndarray) -> float:
    """Return the mean under (1 - u²)² of a function on a fine grid."""
    weight = (1.0 - np.linspace(-1.0, 1.0, time.size) ** 2) ** 2
    return float(np.trapezoid(weight * function, time) / np.trapezoid(weight, time))


@pytest.mark.parametrize("uneven", [False, True])
def test_means_of_the_speed_and_acceleration_come_from_the_displacement(uneven: bool, rng: np.random.Generator) -> None:
    fine = np.linspace(3.0, 5.0, 100001)
    time = np.sort(rng.uniform(3.0, 5.0, 2000)) if uneven else fine[::50]
    time[[0, -1]] = fine[[0, -1]]
    over = weights(time)
    place, speed, _ = speed_up(time - 3.0)
    _, exact, bend = speed_up(fine - 3.0)
    assert over.mean @ speed == pytest.approx(mean_of(exact, fine), rel=1e-5)
    assert over.rate @ place == pytest.approx(mean_of(exact, fine), rel=1e-5)
    assert over.bend @ place == pytest.approx(mean_of(bend, fine), rel=2e-3)


def test_weights_are_exact_for_a_parabola_however_uneven_the_samples(rng: np.random.Generator) -> None:
    time = np.sort(rng.uniform(3.0, 5.0, 200))
    over, away = weights(time), time - 0.5 * (time[0] + time[-1])
    for weight, powers in ((over.mean, [1.0, 0.0]), (over.rate, [0.0, 1.0]), (over.bend, [0.0, 0.0, 2.0])):
        assert [weight @ away**power for power in range(len(powers))] == pytest.approx(powers, abs=1e-3)


@pytest.mark.parametrize("kept", [0.0, 0.5, 0.9])
def test_correlation_length_is_that_of_an_autoregression(kept: float, rng: np.random.Generator) -> None:
    lengths = [correlation_length(autoregression(rng, 5000, kept)) for _ in range(40)]
    # Where it errs it is long, which widens the intervals.
    assert 0.97 < np.mean(lengths) * (1.0 - kept) / (1.0 + kept) < 1.25
    assert min(lengths) >= 1.0


def test_constant_residuals_of_nothing_are_independent() -> None:
    assert correlation_length(np.zeros(10)) == 1.0


CURVES = {"straight": 0.0, "a bend too small to be seen": 0.03, "a bend": 1.0}


@pytest.mark.parametrize("kept", [0.0, 0.8])
@pytest.mark.parametrize("bend", CURVES)
def test_intervals_hold_the_truth_as_often_as_they_say(bend: str, kept: float, rng: np.random.Generator) -> None:
    """Neither too often nor too seldom: both bounds lie where a fair 95 % fails once in ten thousand."""
    runs = 500
    time = np.linspace(0.0, 1.0, 400)
    over = weights(time)
    truth = 1.0 + time + CURVES[bend] * (2.0 * time - 1.0) ** 2
    expected = {"mean": 1.5 + CURVES[bend] / 7.0, "rate": 1.0}
    held = dict.fromkeys(expected, 0)
    for _ in range(runs):
        values = truth + 0.1 * autoregression(rng, time.size, kept)
        noise = noise_of(time, values, 1)
        for name, value in expected.items():
            found = mean(values, getattr(over, name), noise)
            held[name] += abs(found.value - value) <= halfwidth(found.error, found.freedom)
    low, high = binom.ppf([5e-5, 1.0 - 5e-5], runs, 0.95)
    assert low <= min(held.values())
    assert max(held.values()) <= high


def test_correlated_samples_count_for_fewer(rng: np.random.Generator) -> None:
    time = np.linspace(0.0, 1.0, 2000)
    free, bound = (plain_mean(time, autoregression(rng, 2000, kept)) for kept in (0.0, 0.9))
    assert bound.effective < 0.15 * free.effective
    assert bound.error > 2.5 * free.error


def test_a_visible_bend_is_no_noise_and_noise_is_no_bend(rng: np.random.Generator) -> None:
    time = np.linspace(-1.0, 1.0, 1000)
    bent = time**2 + 0.05 * rng.standard_normal(1000)
    assert noise_of(time, bent, 1).effective > 500.0
    assert noise_of(time, bent, 1, 1).effective < 50.0
    plain = [noise_of(time, rng.standard_normal(1000), 1).variance for _ in range(50)]
    assert np.median(plain) == pytest.approx(1.0, rel=0.15)


@pytest.mark.parametrize("height", [0.0, 1e-160, 1e150])
def test_height_and_unit_of_the_samples_do_not_matter(height: float, rng: np.random.Generator) -> None:
    time = np.linspace(2.0, 4.0, 300)
    values = 1.0 - 0.2 * time + 0.1 * rng.standard_normal(300)
    one, other = noise_of(time, values, 0), noise_of(time, height * values, 0)
    assert one.slope == pytest.approx(-0.2, abs=3.0 * one.slope_error)
    assert other.slope == pytest.approx(height * one.slope)
    assert np.sqrt(other.variance) == pytest.approx(height * np.sqrt(one.variance), rel=1e-6)


def test_known_correlation_is_not_forgotten(rng: np.random.Generator) -> None:
    time = np.linspace(0.0, 1.0, 500)
    assert noise_of(time, rng.standard_normal(500), 0, longer=5.0).effective <= 100.0


def test_halfwidth_tends_to_that_of_a_normal_distribution() -> None:
    assert halfwidth(1.0, 1e6) == pytest.approx(norm.ppf(0.975), rel=1e-5)
    assert halfwidth(1.0, 3.0) == pytest.approx(3.1824, rel=1e-4)
