"""Maxwell branches over one step of time, exact where the strain varies linearly in it.

A branch of relaxation time tau carries w, with dw/dt = de/dt - w / tau. Over a step of length h in which e changes
linearly by de, with a = h / tau,

    w(s) = exp(-s / tau) (w_0 + r) - r,    r = -de / a,    w(h) = exp(-a) w_0 + c de,    c = (1 - exp(-a)) / a.

In finite strain e is -Cb^-1 and w is A - Cb^-1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real

# Below this a, differences of nearly equal numbers are taken from their series.
_SMALL = 2e-2


@dataclass(frozen=True)
class Relaxation:
    """Factors of a step for each branch, all dimensionless and of shape (branches,).

    Attributes
    ----------
    ratio : ndarray
        a, the length of the step over the relaxation time.
    decay : ndarray
        exp(-a), what is left of the state before.
    share : ndarray
        c, what is left of a change during the step.
    middle : ndarray
        Decay at the instant at which it is halfway between 1 and exp(-a).
    instant : ndarray
        That instant, as a share of the step.
    weights : ndarray, shape (3, branches)
        Of the begin, that instant and the end in the mean over the step of a quadratic function of exp(-s / tau).
    """

    ratio: Real
    decay: Real
    share: Real
    middle: Real
    instant: Real
    weights: Real

    @classmethod
    def over(cls, step: float, times: Real) -> Relaxation:
        """Return the factors of a step of a length in s, for relaxation times in s."""
        ratio = step / np.asarray(times, dtype=float)
        decay, share = np.exp(-ratio), mean_decay(ratio)
        middle = 0.5 * (1.0 + decay)
        instant = -np.log1p(0.5 * np.expm1(-ratio)) / ratio
        return cls(ratio, decay, share, middle, instant, _weights(ratio, decay))


def mean_decay(ratio: Real) -> Real:
    """Return (1 - exp(-a)) / a."""
    share: Real = -np.expm1(-ratio) / ratio
    return share


def mean_square(relaxation: Relaxation, before: Real, change: Real) -> Real:
    """Return the mean over a step of |w|², exactly.

    Parameters
    ----------
    before : ndarray, shape (branches, ...)
        w at the begin, real or complex.
    change : ndarray, shape (...)
        Change of e.
    """
    a = relaxation.ratio
    one, two = mean_decay(a), mean_decay(2.0 * a)
    # 1 - 2 c(a) + c(2a) and c(a) - c(2a), over a² and a: they vanish so for small a.
    small = a < _SMALL
    safe = np.where(small, 1.0, a)
    square = np.where(small, np.polyval((31 / 2520, -1 / 24, 7 / 60, -1 / 4, 1 / 3), a), (1.0 - 2.0 * one + two) / (safe * safe))
    mixed = np.where(small, np.polyval((31 / 720, -1 / 8, 7 / 24, -1 / 2, 1 / 2), a), (one - two) / safe)
    shape = (-1,) + (1,) * change.ndim
    one, two, square, mixed = (factor.reshape(shape) for factor in (one, two, square, mixed))
    cross = (before * np.conj(change)).real
    answer: Real = two * np.abs(before) ** 2 + 2.0 * mixed * cross + square * np.abs(change) ** 2
    return answer


def _weights(ratio: Real, decay: Real) -> Real:
    """Integrate the quadratic through three equally spread values of E = exp(-s / tau), over s."""
    half = -0.5 * np.expm1(-ratio)  # half the range of E
    # Mean over the step of t and t², t = (E - middle) / half going from 1 to -1.
    small = ratio < 0.1
    safe, wide = np.where(small, 1.0, ratio), np.where(small, 1.0, half)
    middle = 0.5 * (1.0 + decay)
    first = mean_decay(safe) - middle
    second = mean_decay(2.0 * safe) - 2.0 * middle * mean_decay(safe) + middle * middle
    # dE = -E ds: the mean of t^n is that of t^n / (1 + d t) over dE, with d = half / middle.
    d = half / middle
    series_first = -d / 3 - d**3 / 5 - d**5 / 7
    series_norm = 1 + d * d / 3 + d**4 / 5 + d**6 / 7
    series_second = 1 / 3 + d * d / 5 + d**4 / 7 + d**6 / 9
    first = np.where(small, series_first / series_norm, first / wide)
    second = np.where(small, series_second / series_norm, second / (wide * wide))
    return np.stack((0.5 * (second + first), 1.0 - second, 0.5 * (second - first)))
