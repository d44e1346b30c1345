"""Friction over speed at one pressure: interpolated, with the error of that, and the speeds that would lower it.

Friction is a spline through its points, log over log: a sum of relaxations, each of which rises in proportion to speed
and falls again. Half of it is wider than a decade, so that no curve has anything narrower than one relaxation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from rubfric.arrays import Flags, Real

# One relaxation is missed by 2.2 % at most where points are half a decade apart, and by the fourth power of their
# distance elsewhere: in an interval, that is its width squared times that of its wider neighbour squared. This much is
# allowed for; and no slope of log over log is beyond one.
_MISSED, _APART, _POWER = 0.03, 0.5, 2
# A point that is left out is missed by the spline through the others; an interval beside it has a share of that, by its
# part of theirs to this power. The first and the last interval are known from one side only.
_SHARE, _ONE_SIDED = 1.5, 2.0
# Errors are shares of friction, or of this much of the highest where friction is lower.
_LOW = 0.1
# Friction below this share of the highest counts as that: logs need it positive.
_LEAST = 1e-4
# No interval is divided that is narrower, decades; there is a kink.
_NARROWEST = 0.04
# Places between two points at which a curve is looked at.
_PLACES = 65


@dataclass(frozen=True)
class Curve:
    """Friction over speed.

    Attributes
    ----------
    speeds : numpy.ndarray, shape (points,)
        mm/s, ascending.
    friction, error : numpy.ndarray, shape (points,)
        Friction coefficients, one above zero at least, and their absolute errors, dimensionless.
    """

    speeds: Real
    friction: Real
    error: Real

    @classmethod
    def known(cls, speeds: Real, friction: Real, error: Real) -> Curve | None:
        """Return the curve through those points that are known, sorted; None for fewer than two, or without friction.

        Parameters
        ----------
        speeds, friction, error : array_like, shape (points,)
            As for the attributes; NaN for friction that is not known, or errors.
        """
        order = np.argsort(speeds)
        order = order[np.isfinite(np.asarray(friction)[order])]
        if order.size < 2 or np.max(np.asarray(friction)[order]) <= 0.0:
            return None
        return cls(
            *(np.asarray(values, dtype=np.float64)[order] for values in (speeds, friction, np.nan_to_num(error)))
        )

    @cached_property
    def decades(self) -> Real:
        """Logarithms of the speeds, shape (points,)."""
        return np.log10(self.speeds)

    @cached_property
    def _logs(self) -> Real:
        return np.log(np.maximum(self.friction, _LEAST * self.friction.max()))

    def _against(self, friction: Real) -> Real:
        """Return what errors are shares of."""
        return np.maximum(friction, _LOW * self.friction.max())

    @cached_property
    def missed(self) -> Real:
        """Estimated largest error of log friction in each interval between points, shape (points - 1,)."""
        at, logs, widths = self.decades, self._logs, np.diff(self.decades)
        around = np.concatenate([widths[:1], widths, widths[-1:]])
        wider = np.maximum(np.maximum(around[:-2], around[2:]), widths)
        found = np.minimum(_MISSED * (widths * wider / _APART**2) ** _POWER, 0.5 * math.log(10.0) * widths)
        for place in range(1, at.size - 1):
            others = np.arange(at.size) != place
            off = abs(float(CubicSpline(at[others], logs[others])(at[place])) - logs[place])
            for interval in (place - 1, place):
                share = float(widths[interval] / (at[place + 1] - at[place - 1])) ** _SHARE
                sided = _ONE_SIDED if interval in (0, widths.size - 1) else 1.0
                found[interval] = max(found[interval], sided * share * off)
        return found

    @cached_property
    def gaps(self) -> Real:
        """Estimated largest error of interpolation in each interval, as a share of friction there."""
        top = np.maximum(self.friction[1:], self.friction[:-1])
        return np.expm1(self.missed) * np.maximum(top, 0.0) / self._against(top)

    @property
    def worst(self) -> float:
        """The largest of ``gaps``."""
        return float(self.gaps.max())

    @cached_property
    def _numerical(self) -> Real:
        """The larger of the errors of both ends of each interval, as a share of friction there."""
        shares = self.error / self._against(self.friction)
        return np.maximum(shares[1:], shares[:-1])

    def open(self, accuracy: float, refused: Real | None = None) -> Flags:
        """Return which intervals are not known to an accuracy, though their ends are better known than they are.

        Parameters
        ----------
        accuracy : float
            Relative.
        refused : numpy.ndarray, optional
            Speeds (mm/s) that have no friction; the intervals they are in stay as they are.
        """
        wide = np.diff(self.decades) > _NARROWEST
        for speed in [] if refused is None else refused:
            wide[np.clip(np.searchsorted(self.speeds, speed) - 1, 0, wide.size - 1)] = False
        return wide & (self.gaps > np.maximum(accuracy, self._numerical))

    def next_speed(self, accuracy: float, refused: Real | None = None) -> float | None:
        """Return the speed (mm/s) at which the least known interval is best divided; None where all are known.

        It is near the middle of the interval, and on a lattice of decades, halves, quarters and so on, so that curves
        through other points ask for the same speeds.

        Parameters
        ----------
        accuracy, refused
            As for ``open``.
        """
        waiting = self.open(accuracy, refused)
        if not waiting.any():
            return None
        worst = int(np.argmax(np.where(waiting, self.gaps, -1.0)))
        low, high = self.decades[worst], self.decades[worst + 1]
        middle, halves = 0.5 * (low + high), 1.0
        while abs(round(middle * halves) / halves - middle) > 0.25 * (high - low):
            halves *= 2.0
        return float(f"{10.0 ** (round(middle * halves) / halves):.4g}")

    @cached_property
    def places(self) -> Real:
        """Logarithms of the speeds at which the curve is drawn and searched, shape (places,)."""
        between = [np.linspace(*ends, _PLACES)[:-1] for ends in zip(self.decades[:-1], self.decades[1:], strict=True)]
        return np.concatenate([*between, self.decades[-1:]])

    def at(self, decades: Real) -> tuple[Real, Real]:
        """Return friction and its absolute error, of the points and of interpolation, at logarithms of speeds.

        Parameters
        ----------
        decades : numpy.ndarray, shape (places,)
            Within the points.
        """
        friction = np.exp(CubicSpline(self.decades, self._logs)(decades))
        left = np.clip(np.searchsorted(self.decades, decades, side="right") - 1, 0, self.speeds.size - 2)
        share = (decades - self.decades[left]) / np.diff(self.decades)[left]
        between = np.expm1(self.missed[left] * np.sqrt(4.0 * share * (1.0 - share))) * friction
        shares = np.interp(decades, self.decades, self.error / self._against(self.friction))
        return friction, between + shares * self._against(friction)
