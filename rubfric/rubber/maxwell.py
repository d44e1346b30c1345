"""Maxwell branches over one step of time, exact where the strain varies as a parabola through three instants.

A branch of relaxation time tau carries w, with dw/dt = de/dt - w / tau. Over a step of length h in which e changes by
D, after a step of length r h in which it changed by P, the parabola through the three values has, with x = t / h,

    de/dx = D + q (2 x - 1),    q = (D - P / r) / (1 + r),

and w(x) = exp(-a x) w_0 + c(x) D + d(x) q with a = h / tau and

    c = (1 - exp(-a x)) / a,    d = 2 (x - c) / a - c.

A straight line instead (q = 0) puts the stress of a branch much faster than the step half a step behind: an error of
first order. It is used where nothing is known of the step before, or where that was so short that it may have been a
jump. In finite strain e is -Cb^-1 and w is A - Cb^-1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np

from rubfric.arrays import Complex, Real

Numbers = TypeVar("Numbers", Real, Complex)

# A step before that was shorter than this share of the step may have been a jump.
_SHORTEST = 0.1
# Below this a, differences of nearly equal numbers are taken from their series.
_SMALL = 1e-2
# Points of the quadrature that stands for exact integrals, and the power that gathers them at the begin of the step.
_POINTS, _POWER = 48, 6


@dataclass(frozen=True, eq=False)
class Relaxation:
    """Factors of a step.

    Attributes
    ----------
    duration : float
        Length of the step, s.
    times : ndarray, shape (branches,)
        Relaxation times, s.
    before : float
        Length of the step before, s; infinite where nothing is known of it.
    """

    duration: float
    times: Real
    before: float = np.inf

    @property
    def ratio(self) -> Real:
        """Length of the step over the relaxation times, a, shape (branches,)."""
        return self.duration / self.times

    @cached_property
    def decay(self) -> Real:
        """What is left of w at the end, exp(-a), shape (branches,)."""
        return np.exp(-self.ratio)

    @cached_property
    def share(self) -> Real:
        """What w at the end takes from the change D, shape (branches,)."""
        _, line, bow = self.at(1.0)
        return line + self._curved * bow

    @cached_property
    def lag(self) -> Real:
        """What w at the end gives back of the change before, P, shape (branches,)."""
        return self.at(1.0)[2] * self._curved * self.duration / self.before

    @property
    def follows(self) -> bool:
        """Whether the slope at the begin follows from the step before."""
        return _SHORTEST * self.duration <= self.before < np.inf

    @property
    def _curved(self) -> float:
        """1 / (1 + r), or 0 for a straight line."""
        return 1.0 / (1.0 + self.before / self.duration) if self.follows else 0.0

    def bow(self, change: Numbers, previous: Numbers) -> Numbers:
        """Return q from the changes D and P.

        Parameters
        ----------
        change : ndarray, shape (...)
            D.
        previous : ndarray, shape (...)
            P.
        """
        answer: Numbers = self._curved * (change - self.duration / self.before * previous)
        return answer

    def at(self, share: float) -> tuple[Real, Real, Real]:
        """Return exp(-a x), c and d at a share x of the step, each of shape (branches,)."""
        reach = self.ratio * share
        line = share * mean_decay(reach)
        return np.exp(-reach), line, 2.0 * share * share * _half(reach) - line

    @cached_property
    def gram(self) -> Real:
        """Means over the step of the products of exp(-a x), c and d, shape (branches, 3, 3)."""
        points, weights = np.polynomial.legendre.leggauss(_POINTS)
        roots = 0.5 * (points + 1.0)
        factors = np.array([self.at(float(x)) for x in roots**_POWER])  # (points, 3, branches)
        weights = 0.5 * weights * _POWER * roots ** (_POWER - 1)
        return np.einsum("x,xib,xjb->bij", weights, factors, factors)

    def mean_square(self, start: Numbers, change: Numbers, previous: Numbers) -> Real:
        """Return the mean over the step of |w|².

        Parameters
        ----------
        start : ndarray, shape (branches, ...)
            w_0, real or complex.
        change, previous : ndarray, shape (...)
            D and P.
        """
        bow = self.bow(change, previous)
        gram = self.gram.reshape(*self.gram.shape, *(1 for _ in change.shape))
        line = 2.0 * gram[:, 0, 1] * change.conj() + 2.0 * gram[:, 0, 2] * bow.conj()
        rest = gram[:, 1, 1] * _square(change) + gram[:, 2, 2] * _square(bow)
        rest = rest + 2.0 * gram[:, 1, 2] * (change * bow.conj()).real
        answer: Real = gram[:, 0, 0] * _square(start) + (start * line).real + rest
        return answer


def mean_decay(ratio: Real) -> Real:
    """Return (1 - exp(-a)) / a."""
    answer: Real = -np.expm1(-ratio) / ratio
    return answer


def _half(ratio: Real) -> Real:
    """Return (1 - (1 - exp(-a)) / a) / a, which is 1/2 for small a."""
    small = ratio < _SMALL
    safe = np.where(small, 1.0, ratio)
    series = np.polyval((-1 / 720, 1 / 120, -1 / 24, 1 / 6), ratio)
    return np.where(small, 0.5 - ratio * series, (1.0 - mean_decay(safe)) / safe)


def _square(values: Real | Complex) -> Real:
    answer: Real = values.real**2 + values.imag**2
    return answer
