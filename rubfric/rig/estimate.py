"""Means over a window, with their confidence, from samples that may be correlated and whose speed may change.

The speed changes slowly within a window, in an unknown way, and friction follows it. A polynomial fitted to each
quantity would have to be of the right order: a curvature too small to be seen shifts a value in the middle by up to
several of its standard errors. Means need no order. All quantities are averaged with the same weight,
w = (1 - u²)² over the window (u from -1 to 1), and belong together whatever the speed does: it is the weak form of the
equation of motion with the test function w. As w and its slope vanish at both ends, partial integration gives the mean
speed and the mean acceleration from the displacement itself: int w v dt = -int w' x dt, int w a dt = int w'' x dt.
(For evenly spaced times the latter is the parabola fitted by least squares.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.stats import t as student

from rubfric.arrays import Real

CONFIDENCE = 0.95
# A coefficient of a polynomial is significant above this multiple of its standard error; highest order.
_CLEAR, _HIGHEST = 3.0, 7


@dataclass(frozen=True)
class Mean:
    """A weighted sum of samples.

    Attributes
    ----------
    value, error : float
        Its value and its standard error, in units of the samples times those of the weights.
    effective : float
        Number of independent samples in the window that are worth as much.
    freedom : float
        Degrees of freedom of the standard error.
    """

    value: float
    error: float
    effective: float
    freedom: float


@dataclass(frozen=True)
class Noise:
    """What is left of the samples of a window when a polynomial of visible order is taken out.

    Attributes
    ----------
    variance : float
        Of the samples, times how many correlated ones are worth one independent one; their unit squared.
    effective, freedom : float
        As in ``Mean``.
    slope, slope_error : float
        Of a straight line through the samples, per s, and its standard error.
    """

    variance: float
    effective: float
    freedom: float
    slope: float
    slope_error: float


@dataclass(frozen=True)
class Weights:
    """What samples of a window are multiplied by, and summed, for means of the same weight.

    Attributes
    ----------
    mean : numpy.ndarray, shape (samples,)
        For the mean of what is sampled.
    rate, bend : numpy.ndarray, shape (samples,)
        For the mean of its first and of its second derivative, 1/s and 1/s².
    """

    mean: Real
    rate: Real
    bend: Real


def weights(time: Real) -> Weights:
    """Return the weights (1 - u²)² of a window; its samples may lie at any distance.

    Each quantity is linear between two samples. So the mean rate of what is sampled is exact for a straight line,
    and the mean of a force belongs to it however uneven the samples are.

    Parameters
    ----------
    time : numpy.ndarray, shape (samples,)
        s, rising; three samples at least.
    """
    steps = np.diff(time)
    half = 0.5 * (time[-1] - time[0])
    along = (time - 0.5 * (time[0] + time[-1])) / half
    weight = (1.0 - along**2) ** 2 * (15.0 / 16.0) / half
    inside = np.diff(along - 2.0 / 3.0 * along**3 + along**5 / 5.0) * (15.0 / 16.0)  # of each step, 1 in all
    mean = 0.5 * (np.append(inside, 0.0) + np.append(0.0, inside))
    rate = -np.diff(inside / steps, prepend=0.0, append=0.0)
    bend = np.diff(np.diff(weight) / steps, prepend=0.0, append=0.0)
    # Exact for a parabola, too.
    bend /= 0.5 * float(bend @ (time - time.mean()) ** 2)
    return Weights(mean, rate, bend)


def mean(values: Real, weight: Real, noise: Noise) -> Mean:
    """Return the weighted sum of samples with its standard error.

    Parameters
    ----------
    values, weight : numpy.ndarray, shape (samples,)
    noise : Noise
        Of the samples.
    """
    error = math.sqrt(noise.variance) * float(np.linalg.norm(weight))
    return Mean(float(weight @ values), error, noise.effective, noise.freedom)


def plain_mean(time: Real, values: Real) -> Mean:
    """Return the mean of samples of a constant, all with the same weight.

    Parameters
    ----------
    time, values : numpy.ndarray, shape (samples,)
        s, and any unit.
    """
    return mean(values, np.full(values.size, 1.0 / values.size), noise_of(time, values, 0, 0))


def noise_of(time: Real, values: Real, order: int, most: int = _HIGHEST, longer: float = 1.0) -> Noise:
    """Return the noise of samples about a polynomial.

    Its order is raised while the next coefficient exceeds three times its standard error. Curvature
    too small to be seen counts as noise; it widens intervals a little, and shifts nothing.

    Parameters
    ----------
    time, values : numpy.ndarray, shape (samples,)
        s, and any unit; times rise, at any distance.
    order, most : int
        Of the polynomial: to begin with, and at most.
    longer : float
        Samples that are worth one independent sample, at least: what is known of the noise from elsewhere.
    """
    middle, half = 0.5 * (time[0] + time[-1]), 0.5 * (time[-1] - time[0])
    reach = float(np.abs(values).max()) or 1.0  # squares of tiny readings must not underflow
    # Legendre's polynomials are almost orthogonal on the samples already, so that the columns keep their digits.
    columns, triangle = np.linalg.qr(np.polynomial.legendre.legvander((time - middle) / half, max(order, most, 1)))
    found = columns.T @ (values / reach)
    values = values / reach
    rest = _about(values - columns[:, : order + 1] @ found[: order + 1], order, longer)
    for higher in range(order + 1, most + 1):
        left = values - columns[:, : higher + 1] @ found[: higher + 1]
        freedom = max(left.size / longer - higher - 1.0, 1.0)
        if abs(found[higher]) <= _CLEAR * math.sqrt(float(left @ left) / freedom):
            continue  # not clear even if no sample were more correlated than is known
        other = _about(left, higher, longer)
        if abs(found[higher]) > _CLEAR * math.sqrt(other.variance):
            rest = other
    return Noise(
        variance=reach**2 * rest.variance,
        effective=rest.effective,
        freedom=rest.freedom,
        slope=reach * float(found[1] / triangle[1, 1]) / half,
        slope_error=reach * math.sqrt(rest.variance) / abs(float(triangle[1, 1])) / half,
    )


def _about(rest: Real, order: int, longer: float) -> Noise:
    """Return the noise of the residuals of a polynomial; without slopes."""
    effective = rest.size / max(correlation_length(rest), longer)
    freedom = max(effective - order - 1.0, 1.0)
    return Noise(float(rest @ rest) / freedom, effective, freedom, 0.0, 0.0)


def correlation_length(residuals: Real) -> float:
    """Return how many correlated samples are worth one independent one, for their mean; 1 at least.

    1 plus twice the sum of the autocorrelations, which is cut where the sum of two neighbouring ones is no longer
    positive (Geyer 1992, Practical Markov chain Monte Carlo, Statistical Science 7(4), initial positive sequence).

    Parameters
    ----------
    residuals : numpy.ndarray, shape (samples,)
        Of mean zero.
    """
    count = residuals.size
    largest = float(np.abs(residuals).max())
    if largest == 0.0:
        return 1.0
    padded = next_fast_len(2 * count, real=True)
    spectrum = rfft(residuals / largest, padded)
    covariance = irfft(spectrum * spectrum.conj(), padded)[:count]
    pairs = covariance[: count // 2 * 2].reshape(-1, 2).sum(axis=1)
    ends = np.flatnonzero(pairs <= 0.0)
    positive = pairs[: ends[0]] if ends.size else pairs
    return max(2.0 * float(positive.sum()) / float(covariance[0]) - 1.0, 1.0)


def halfwidth(error: float, freedom: float) -> float:
    """Return the half-width of the 95 % confidence interval, by Student's t distribution.

    Parameters
    ----------
    error : float
        Standard error, in any unit.
    freedom : float
        Its degrees of freedom.
    """
    return error * float(student.ppf(0.5 + 0.5 * CONFIDENCE, freedom))
