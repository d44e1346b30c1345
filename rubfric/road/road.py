"""What the mechanics know of a road: a rigid, frictionless profile s(x) that repeats after a period."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from rubfric.arrays import Complex, Real, Whole


@dataclass(frozen=True, eq=False)
class Waves:
    """A profile as a sum of sines, s(x) = sum_j a_j sin(k_j x + phi_j).

    Attributes
    ----------
    amplitudes : ndarray, shape (waves,)
        a_j, mm.
    wavenumbers : ndarray, shape (waves,)
        k_j, 1/mm: whole multiples of 2 pi over the period of the road.
    phases : ndarray, shape (waves,)
        phi_j, rad.
    """

    amplitudes: Real
    wavenumbers: Real
    phases: Real


class Road(Protocol):
    """A periodic road. Positions are in mm, of any shape, and results have that shape."""

    @property
    def period(self) -> float:
        """Length after which the road repeats, mm: the width of a block."""

    @property
    def wavelength(self) -> float:
        """Of the coarsest wave, mm."""

    @property
    def waves(self) -> Waves:
        """The sines that the road is a sum of."""

    @property
    def steepest_slope(self) -> float:
        """Largest |s'(x)|, or a bound on it, dimensionless."""

    def height(self, position: ArrayLike) -> Real:
        """Return s(x), mm."""

    def slope(self, position: ArrayLike) -> Real:
        """Return s'(x), dimensionless."""

    def curvature(self, position: ArrayLike) -> Real:
        """Return s''(x), 1/mm."""


def finest_waves(road: Road) -> int:
    """Return how many times the finest wave of a road fits into its period."""
    return round(float(road.waves.wavenumbers.max()) * road.period / (2.0 * math.pi))


def fourier_series(road: Road) -> tuple[Whole, Complex]:
    """Return the harmonics of a road that differ from zero: s(x) = 2 Re sum_n s_n exp(2 pi i n x / period).

    Returns
    -------
    harmonics : ndarray of int, shape (n,)
        n, ascending, each once.
    amplitudes : ndarray of complex, shape (n,)
        s_n = sum of -i a_j exp(i phi_j) / 2 over the waves of that harmonic, mm.
    """
    waves = road.waves
    numbers = np.rint(waves.wavenumbers * road.period / (2.0 * np.pi)).astype(int)
    harmonics, place = np.unique(numbers, return_inverse=True)
    amplitudes = np.zeros(len(harmonics), dtype=complex)
    np.add.at(amplitudes, place, -0.5j * waves.amplitudes * np.exp(1j * waves.phases))
    return harmonics, amplitudes
