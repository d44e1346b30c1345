"""Values in the middle of a window, with their confidence, from samples that may be correlated."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import t as student

from rubfric.arrays import Real

CONFIDENCE = 0.95
# A coefficient of a polynomial counts where it exceeds so many of its standard errors.
_CLEAR = 3.0


@dataclass(frozen=True)
class Centre:
    """A local polynomial's value and slopes in the middle of a window.

    Attributes
    ----------
    value, slope, curvature : float
        The polynomial and its first and second derivative there, in units of the samples and of s.
    value_error, slope_error, curvature_error : float
        Their standard errors.
    effective : float
        Number of independent samples that are worth as much.
    freedom : float
        Degrees of freedom of the standard errors.
    """

    value: float
    slope: float
    curvature: float
    value_error: float
    slope_error: float
    curvature_error: float
    effective: float
    freedom: float


def centre(time: Real, values: Real, order: int, most: int | None = None, longer: float = 1.0) -> Centre:
    """Fit a polynomial to samples by least squares and evaluate it in the middle of their times.

    The standard errors are those of as many independent samples as the residuals are worth. The order is raised while
    the next coefficient exceeds three times its standard error, so that no visible bend is taken for noise.

    Parameters
    ----------
    time, values : numpy.ndarray, shape (samples,)
        s, and any unit; times rise, at any distance.
    order, most : int
        Of the polynomial: to begin with, and at most (as at the beginning, by default).
    longer : float
        Samples that are worth one independent sample, at least: what is known of the noise from elsewhere.
    """
    found, best = _fit(time, values, order, longer), order
    for higher in range(order + 1, order + 1 if most is None else most + 1):
        other = _fit(time, values, higher, longer)
        if abs(other.last) > _CLEAR * other.last_error:
            found, best = other, higher
    if best == order:
        return found.centre
    # Samples that bend once may bend on, unseen: two orders more tell by how much that may shift the result.
    return _doubted(found.centre, _fit(time, values, best + 2, longer).centre)


def _doubted(found: Centre, other: Centre) -> Centre:
    """Return a result whose standard errors include its distance from another one."""
    names = ("value", "slope", "curvature")
    errors = {
        f"{name}_error": math.hypot(getattr(found, f"{name}_error"), getattr(found, name) - getattr(other, name))
        for name in names
    }
    return replace(found, **errors)


@dataclass(frozen=True)
class _Fit:
    centre: Centre
    last: float
    last_error: float


def _fit(time: Real, values: Real, order: int, longer: float) -> _Fit:
    """Return a polynomial in the middle of its samples, and its last coefficient with its standard error."""
    middle, half = 0.5 * (time[0] + time[-1]), 0.5 * (time[-1] - time[0])
    powers = np.vander((time - middle) / half, order + 1, increasing=True)
    orthogonal, triangle = np.linalg.qr(powers)
    reach = float(np.abs(values).max()) or 1.0  # squares of tiny readings must not underflow
    inverse = np.linalg.inv(triangle)
    found = inverse @ (orthogonal.T @ (values / reach))
    rest = values / reach - powers @ found
    effective = rest.size / max(correlation_length(rest), longer)
    freedom = max(effective - order - 1.0, 1.0)
    variance = float(rest @ rest) / freedom  # of the mean of as many samples as there are
    errors = np.sqrt(variance * np.sum(inverse**2, axis=1))
    # Of the polynomial in (t - middle) / half, the first three coefficients give value, slope and curvature.
    kept = min(order + 1, 3)
    scale = reach * np.array([1.0, 1.0 / half, 2.0 / half**2])[:kept]
    value, error = np.zeros(3), np.zeros(3)
    value[:kept], error[:kept] = found[:kept] * scale, errors[:kept] * scale
    names = ("value", "slope", "curvature")
    told = dict(zip(names, value.tolist(), strict=True))
    told |= {f"{name}_error": one for name, one in zip(names, error.tolist(), strict=True)}
    return _Fit(Centre(effective=effective, freedom=freedom, **told), float(found[-1]), float(errors[-1]))


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
    spectrum = np.fft.rfft(residuals / largest, 2 * count)
    covariance = np.fft.irfft(spectrum * spectrum.conj())[:count]
    pairs = covariance[: count // 2 * 2].reshape(-1, 2).sum(axis=1)
    ends = np.flatnonzero(pairs <= 0.0)
    positive = pairs[: ends[0]] if ends.size else pairs
    return max(2.0 * float(positive.sum()) / float(covariance[0]) - 1.0, 1.0)


def halfwidth(error: float, freedom: float) -> float:
    """Return the half-width of the 95 % confidence interval that goes with a standard error."""
    return error * float(student.ppf(0.5 + 0.5 * CONFIDENCE, freedom))
