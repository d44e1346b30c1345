"""Laws of shifting as the fit sees them: ln a_T of every isotherm from a few parameters, with derivatives and bounds.

The WLF equation is fitted as ln a = -ln(10) s D / (1 + u D), D = T - T_ref, with C1 = s / u and C2 = 1 / u: slope and
curvature are far less correlated than C1 and C2, and u near 0 is a straight line instead of two infinities. Free
shifts are steps from isotherm to isotherm, none of them negative: rubber relaxes faster when it is warmer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.measurements import Measurements
from rubfric.rubber.shift import GAS, KELVIN

LN10 = math.log(10.0)
# Widest gap of reduced frequency between neighbours, decades.
WIDEST_GAP = 1.0
# Largest share of the way to the pole of the WLF equation, and the largest C2, K.
_POLE, _LARGEST_C2 = 0.98, 1e4
# Decades between the coldest and the warmest isotherm that are tried, and shares of the way to the pole.
_DECADES, _SHARES = (1.0, 2.0, 4.0, 7.0, 11.0, 16.0, 23.0, 32.0), (0.02, 0.3, 0.6, 0.9)


class Law(Protocol):
    """What the fit asks of a law."""

    @property
    def name(self) -> str:
        """Its name, one of those of ``rubfric.rubber.shift`` or ``free``."""

    @property
    def bounds(self) -> tuple[Real, Real]:
        """Least and largest parameters, each of shape (parameters,)."""

    @property
    def starts(self) -> Real:
        """Parameters to begin with, shape (starts, parameters)."""

    def shifts(self, parameters: Real) -> Real:
        """Return ln a_T, shape (isotherms,)."""

    def derivative(self, parameters: Real) -> Real:
        """Return the derivative of ``shifts``, shape (isotherms, parameters)."""


@dataclass(frozen=True, eq=False)
class Wlf:
    """Parameters s (1/K) and u (1/K).

    Attributes
    ----------
    change : ndarray, shape (isotherms,)
        T - T_ref, K.
    """

    change: Real
    name = "wlf"

    @property
    def bounds(self) -> tuple[Real, Real]:
        """Least and largest s and u."""
        coldest = max(-float(self.change.min()), 10.0)
        return np.array([1e-6, 1.0 / _LARGEST_C2]), np.array([100.0, _POLE / coldest])

    @property
    def starts(self) -> Real:
        """A grid of decades between coldest and warmest, and curvatures."""
        low, high = self.bounds[0][1], self.bounds[1][1]
        curvatures = [low + share * (high - low) for share in _SHARES]
        unit = [np.ptp(self.shifts(np.array([1.0, each]))) / LN10 for each in curvatures]
        return np.array([(n / one, each) for n in _DECADES for one, each in zip(unit, curvatures, strict=True)])

    def shifts(self, parameters: Real) -> Real:
        """Return ln a_T, shape (isotherms,)."""
        return -LN10 * parameters[0] * self.change / (1.0 + parameters[1] * self.change)

    def derivative(self, parameters: Real) -> Real:
        """Return the derivatives by s and u, shape (isotherms, 2)."""
        whole = 1.0 + parameters[1] * self.change
        return LN10 * np.stack([-self.change / whole, parameters[0] * self.change**2 / whole**2], axis=1)


@dataclass(frozen=True, eq=False)
class Arrhenius:
    """One parameter, the activation energy, kJ/mol.

    Attributes
    ----------
    inverse : ndarray, shape (isotherms,)
        (1 / T - 1 / T_ref) / R, mol/kJ.
    """

    inverse: Real
    name = "arrhenius"

    @property
    def bounds(self) -> tuple[Real, Real]:
        """Least and largest activation energy."""
        return np.array([0.1]), np.array([1e4])

    @property
    def starts(self) -> Real:
        """A row of decades between coldest and warmest."""
        return np.array(_DECADES)[:, None] * LN10 / np.ptp(self.inverse)

    def shifts(self, parameters: Real) -> Real:
        """Return ln a_T, shape (isotherms,)."""
        return parameters[0] * self.inverse

    def derivative(self, parameters: Real) -> Real:
        """Return the derivative, shape (isotherms, 1)."""
        return self.inverse[:, None]


@dataclass(frozen=True, eq=False)
class Free:
    """Steps d_k >= 0 of -ln a_T between neighbouring isotherms.

    Attributes
    ----------
    first : ndarray, shape (starts, isotherms)
        Shifts ln a_T to begin with.
    widest : ndarray, shape (isotherms - 1,)
        Largest steps, those that leave a gap of a decade between the reduced frequencies of neighbours.
    """

    first: Real
    widest: Real
    name = "free"

    @property
    def bounds(self) -> tuple[Real, Real]:
        """No step is negative, or too wide."""
        return np.zeros_like(self.widest), self.widest

    @property
    def starts(self) -> Real:
        """Steps of the shifts to begin with, shape (starts, isotherms - 1)."""
        return np.clip(-np.diff(self.first, axis=1), 1e-3, self.widest)

    def shifts(self, parameters: Real) -> Real:
        """Return ln a_T, shape (isotherms,); 0 at the coldest."""
        return -np.concatenate(([0.0], np.cumsum(parameters)))

    def derivative(self, parameters: Real) -> Real:
        """Return the derivative, shape (isotherms, isotherms - 1)."""
        return -np.tri(len(parameters) + 1, len(parameters), -1)


def free_law(data: Measurements, *first: Real) -> Free:
    """Return free shifts of data.

    Parameters
    ----------
    data : Measurements
    *first : ndarray, each of shape (isotherms,)
        Shifts ln a_T to begin with.
    """
    count = len(data.temperatures)
    ends = [np.log(data.frequency[data.isotherm == one]) for one in range(count)]
    widest = [ends[one + 1].max() - ends[one].min() for one in range(count - 1)]
    return Free(np.array(first), np.maximum(np.array(widest) + WIDEST_GAP * LN10, 0.1))


def law_of(name: str, temperatures: Real, reference: float) -> Law:
    """Return the law ``wlf`` or ``arrhenius``.

    Parameters
    ----------
    name : {"wlf", "arrhenius"}
    temperatures : ndarray, shape (isotherms,)
        degC.
    reference : float
        Reference temperature, degC.
    """
    if name == "wlf":
        return Wlf(temperatures - reference)
    return Arrhenius((1.0 / (temperatures + KELVIN) - 1.0 / (reference + KELVIN)) / GAS)
