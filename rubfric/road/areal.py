"""What the mechanics know of an areal road: a rigid, frictionless surface s(x, y) that repeats in both directions.

It is a finite sum of waves,

    s(x, y) = sum_j Re A_j exp(i q_j . (x, y)),    q_j = 2 pi (m_j / L_x, n_j / L_y),

with m_j > 0, or m_j = 0 and n_j > 0: heights and slopes at nodes follow by Fourier transforms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from rubfric.arrays import Complex, Flags, Real, Whole


@dataclass(frozen=True, eq=False)
class ArealSpectrum:
    """The waves of an areal road.

    Attributes
    ----------
    periods : tuple of float, shape (2,)
        L_x and L_y, mm.
    harmonics : ndarray of int, shape (waves, 2)
        m_j and n_j, each pair once, of the half of the plane that the module describes.
    amplitudes : ndarray of complex, shape (waves,)
        A_j, mm.
    """

    periods: tuple[float, float]
    harmonics: Whole
    amplitudes: Complex

    @cached_property
    def wavevectors(self) -> Real:
        """q_j, 1/mm, shape (waves, 2)."""
        return 2.0 * math.pi * self.harmonics / np.array(self.periods)

    @cached_property
    def wavenumbers(self) -> Real:
        """|q_j|, 1/mm, shape (waves,)."""
        return np.hypot(*self.wavevectors.T)

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights, mm."""
        return math.sqrt(0.5 * float(np.sum(np.abs(self.amplitudes) ** 2)))

    @property
    def rms_slope(self) -> float:
        """Root mean square of the length of the gradient, dimensionless."""
        return math.sqrt(0.5 * float(np.sum((np.abs(self.amplitudes) * self.wavenumbers) ** 2)))

    def shape(self, columns: int) -> tuple[int, int]:
        """Return (ny, nx) of nodes that are ``columns`` along the longer period and as far apart along the other.

        Both are even; the distances differ where the ratio of the periods asks for it.
        """
        longest = max(self.periods)
        nx, ny = (2 * max(2, round(0.5 * columns * period / longest)) for period in self.periods)
        return ny, nx

    def heights(self, shape: tuple[int, int]) -> Real:
        """Return s at nodes (i L_x / nx, j L_y / ny), mm, without the waves that they do not resolve.

        Parameters
        ----------
        shape : tuple of int
            (ny, nx).

        Returns
        -------
        ndarray, shape (ny, nx)
        """
        return self._field(shape, self.amplitudes)

    def slopes(self, shape: tuple[int, int], direction: float) -> Real:
        """Return the derivative of s along a direction at the nodes of ``heights``, dimensionless.

        Parameters
        ----------
        shape : tuple of int
            (ny, nx).
        direction : float
            Degrees from x towards y.

        Returns
        -------
        ndarray, shape (ny, nx)
        """
        return self._field(shape, 1j * (self.wavevectors @ unit_vector(direction)) * self.amplitudes)

    def without(self, shortest: float) -> ArealSpectrum:
        """Return the surface without waves shorter than a wavelength, mm; it may have none left."""
        kept = self.wavenumbers * shortest <= 2.0 * math.pi * (1.0 + 1e-9)
        return ArealSpectrum(self.periods, self.harmonics[kept], self.amplitudes[kept])

    def _resolved(self, shape: tuple[int, int]) -> Flags:
        ny, nx = shape
        return (2 * self.harmonics[:, 0] < nx) & (2 * np.abs(self.harmonics[:, 1]) < ny)

    def _field(self, shape: tuple[int, int], amplitudes: Complex) -> Real:
        ny, nx = shape
        kept = self._resolved(shape)
        (m, n), half = self.harmonics[kept].T, 0.5 * ny * nx * amplitudes[kept]
        series = np.zeros((ny, nx // 2 + 1), dtype=complex)
        series[n % ny, m] = half
        ridges = m == 0  # waves along y are their own column, of which the transform wants both halves
        series[-n[ridges] % ny, 0] = half[ridges].conj()
        return np.fft.irfft2(series, shape, axes=(0, 1))


class ArealRoad(Protocol):
    """A surface that repeats in both directions."""

    @property
    def spectrum(self) -> ArealSpectrum:
        """Its waves."""

    def parameters(self) -> dict[str, Any]:
        """Return plain values that describe it, its kind among them."""


def unit_vector(direction: float) -> Real:
    """Return (cos, sin) of a direction in degrees, exact at multiples of 90."""
    turns, rest = divmod(direction, 90.0)
    cosine, sine = math.cos(math.radians(rest)), math.sin(math.radians(rest))
    return np.array(((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))[int(turns) % 4])


def gathered(periods: tuple[float, float], harmonics: Whole, amplitudes: Complex) -> ArealSpectrum:
    """Return the spectrum of waves of any wavevectors: those of the other half of the plane turned, equal ones added.

    Parameters
    ----------
    periods : tuple of float, shape (2,)
        mm.
    harmonics : ndarray of int, shape (waves, 2)
    amplitudes : ndarray of complex, shape (waves,)
        mm.
    """
    turned = (harmonics[:, 0] < 0) | ((harmonics[:, 0] == 0) & (harmonics[:, 1] < 0))
    each, place = np.unique(np.where(turned[:, None], -harmonics, harmonics), axis=0, return_inverse=True)
    total = np.zeros(len(each), dtype=complex)
    np.add.at(total, place.ravel(), np.where(turned, amplitudes.conj(), amplitudes))
    kept = (np.abs(total) > 0.0) & each.any(axis=1)
    return ArealSpectrum(periods, each[kept], total[kept])
