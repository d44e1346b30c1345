"""The difference of two frictions and its 95 % confidence interval; window by window where they share their windows.

Every part of an error is brought to a half-width at 95 %, and the parts are added in squares:

* numerics and coupling of each friction: their estimates, which cover the true error in 95 % of cases and more. One
  rule makes both meshes, so that errors of one sign cancel; adding squares then says too much rather than too little.
* the rubber's data: the 95 % band. Two rubbers were measured independently of one another. Under one rubber both
  frictions change together, by how much is not known: there the sum of the two bounds whatever they do.
* the road: of n roads with random phases, or windows, t_(n-1) s / sqrt(n) with Student's t. On one road two rubbers
  slide over the same windows, and s is the standard deviation of the n differences: what the windows have in common
  drops out. Two roads are independent, and Welch's degrees of freedom count.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import stdtrit

from rubfric.arrays import Real

# Of a two-sided interval of 95 %.
_QUANTILE = 0.975
PARTS = ("numerical", "coupling", "road", "rubber")


class Friction(NamedTuple):
    """The friction of one rubber on one road at one point, and what its error is made of.

    Attributes
    ----------
    value, numerical, coupling, rubber : float
        The coefficient, and the bounds on its absolute error; NaN where not known.
    roads : numpy.ndarray, shape (n,)
        Of every road with random phases, or window, of which ``value`` is the mean; NaN where it was refused, and of no
        length where there is one road, or another way to the total.
    """

    value: float
    numerical: float
    coupling: float
    rubber: float
    roads: Real

    @property
    def solved(self) -> Real:
        """Of the roads that were solved."""
        return self.roads[np.isfinite(self.roads)]


class Interval(NamedTuple):
    """A value with the half-width of its 95 % interval, the parts of that, and over how many roads or windows it is."""

    value: float
    half: float
    numerical: float
    coupling: float
    road: float
    rubber: float
    roads: int


def interval(one: Friction) -> Interval:
    """Return a friction with its 95 % interval; what is not known of the rubber's data is left out."""
    rubber = 0.0 if math.isnan(one.rubber) else one.rubber
    parts = (one.numerical, one.coupling, _independent([one.solved]), rubber)
    return _interval(one.value, parts, one.solved.size)


def difference(first: Friction, second: Friction, same_road: bool) -> Interval:
    """Return by how much the first friction exceeds the second.

    Parameters
    ----------
    first, second : Friction
        Of two rubbers on one road, or of one rubber on two roads.
    same_road : bool
        Which of the two.

    Returns
    -------
    Interval
        ``roads`` counts those that both have in common, or those of the road that has fewer. Over roads in common
        ``value`` is the mean of the differences, which is the difference of the means unless roads were refused.
    """
    value, roads = first.value - second.value, [first.solved, second.solved]
    data = [0.0 if math.isnan(one.rubber) else one.rubber for one in (first, second)]
    rubber = math.hypot(*data) if same_road else sum(data)
    if same_road and first.roads.size == second.roads.size:
        differences = first.roads - second.roads
        common = differences[np.isfinite(differences)]
        if common.size > 1:
            value, roads = float(common.mean()), [common]
    parts = (
        math.hypot(first.numerical, second.numerical),
        math.hypot(first.coupling, second.coupling),
        _independent(roads),
        rubber,
    )
    return _interval(value, parts, min(each.size for each in roads))


def _interval(value: float, parts: tuple[float, float, float, float], roads: int) -> Interval:
    numerical, coupling, road, rubber = parts
    return Interval(value, math.hypot(*parts), numerical, coupling, road, rubber, roads)


def _independent(samples: Sequence[Real]) -> float:
    """Return the half-width of the 95 % interval of a sum or difference of means; 0 without any scatter."""
    found = [(float(each.var(ddof=1)) / each.size, each.size - 1) for each in samples if each.size > 1]
    variance = sum(one for one, _ in found)
    if variance <= 0.0:
        return 0.0
    # Relative, so that no square underflows.
    freedom = 1.0 / sum((one / variance) ** 2 / degrees for one, degrees in found)
    return float(stdtrit(freedom, _QUANTILE)) * math.sqrt(variance)
