"""The difference of two frictions and its 95 % confidence interval; window by window where they share their windows.

Every part of an error is brought to a half-width at 95 %, and the parts are added in squares. Where they are of means
of few values, each with Student's t of its own, such an interval covers the difference in at least 95 % of cases
(Banerjee, Approximate confidence interval for linear functions of means of k populations, Sankhya 22, 357, 1960).

* numerics and coupling of each friction: their estimates, which cover the true error in 95 % of cases and more. One
  rule makes both meshes, so that errors of one sign cancel; adding squares then says too much rather than too little.
* the rubber's data: the 95 % band. Two rubbers were measured independently of one another. Under one rubber both
  frictions change together, by how much is not known: there the sum of the two bounds whatever they do.
* the road: of n roads with random phases, or windows, t_(n-1) s / sqrt(n). On one road two rubbers slide over the same
  windows, and s is the standard deviation of the n differences: what the windows have in common drops out. Two roads
  are independent of one another.
"""

from __future__ import annotations

import math
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
    parts = (one.numerical, one.coupling, _of_road(one.solved), rubber)
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
        math.hypot(*map(_of_road, roads)),
        rubber,
    )
    return _interval(value, parts, min(each.size for each in roads))


def _interval(value: float, parts: tuple[float, float, float, float], roads: int) -> Interval:
    numerical, coupling, road, rubber = parts
    return Interval(value, math.hypot(*parts), numerical, coupling, road, rubber, roads)


def _of_road(roads: Real) -> float:
    """Return the half-width of the 95 % interval of the mean over some roads; 0 for fewer than two."""
    if roads.size < 2:
        return 0.0
    return float(stdtrit(roads.size - 1, _QUANTILE)) * float(roads.std(ddof=1)) / math.sqrt(roads.size)
