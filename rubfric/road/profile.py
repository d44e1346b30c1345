"""A measured road: one period of a profile as its Fourier series, s(x) = sum_n a_n sin(2 pi n x / L + phi_n)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rubfric.arrays import Complex, Real
from rubfric.errors import InvalidInput
from rubfric.road.waves import MOST_WAVES, WaveRoad


@dataclass(frozen=True)
class ProfileRoad(WaveRoad):
    """A road whose waves are all harmonics of its period, up to the finest that is kept.

    It has the values of a ``WaveRoad``, as which it may be written and read; its sums take one product a wave and
    position instead of a sine.
    """

    @classmethod
    def of_heights(cls, heights: Real, period: float, cutoff: float) -> ProfileRoad:
        """Return the Fourier series of heights over one period.

        Parameters
        ----------
        heights : ndarray, shape (points,)
            At evenly spaced positions from 0, mm; their mean is left out.
        period : float
            L, mm.
        cutoff : float
            Shortest wavelength that is kept, mm.

        Raises
        ------
        InvalidInput
            For a cutoff below twice the spacing or above the period, and for more waves than a mesh resolves.
        """
        spacing = period / len(heights)
        # Rounding of the quotient must not lose the wave at the cutoff.
        count = math.floor(period / cutoff * (1.0 + 1e-9))
        if cutoff < 2.0 * spacing * (1.0 - 1e-9):
            raise InvalidInput(
                f"the cutoff is {cutoff:g} mm, but must be at least {2.0 * spacing:.4g} mm: twice the spacing is the "
                "shortest wavelength that heights hold"
            )
        if not 1 <= count <= MOST_WAVES:
            bound = f"at least {period / MOST_WAVES:.4g} mm: one mesh resolves {MOST_WAVES} waves at most"
            raise InvalidInput(
                f"the cutoff is {cutoff:g} mm, but with a period of {period:g} mm it must be "
                f"{bound if count else 'shorter than that'}"
            )
        series = np.fft.rfft(np.asarray(heights, dtype=float))[1 : count + 1] / len(heights)
        numbers = np.arange(1, count + 1)
        # At the Nyquist wavelength the two halves of the spectrum are one.
        amplitudes = np.where(2 * numbers == len(heights), 1.0, 2.0) * np.abs(series)
        phases = np.angle(series) + 0.5 * math.pi
        return cls(tuple(amplitudes), tuple(2.0 * math.pi / period * numbers), tuple(phases))

    @cached_property
    def fundamental(self) -> float:
        """Wavenumber of the period, 1/mm."""
        return min(self.wavenumbers)

    @cached_property
    def _series(self) -> Complex:
        """Amplitudes a_n exp(i (phi_n - pi / 2)) by harmonic from 0: s is the real part of their sum."""
        waves = self.waves
        series = np.zeros(round(waves.wavenumbers.max() / self.fundamental) + 1, dtype=complex)
        numbers = np.rint(waves.wavenumbers / self.fundamental).astype(int)
        np.add.at(series, numbers, waves.amplitudes * np.exp(1j * (waves.phases - 0.5 * math.pi)))
        return series

    def _sum(self, position: ArrayLike, order: int) -> Real:
        """Return a derivative of s, by Horner's rule in exp(2 pi i x / L)."""
        place = np.asarray(position, dtype=float)
        factors = (1j * self.fundamental * np.arange(len(self._series))) ** order * self._series
        turn = np.exp(1j * self.fundamental * place)
        found = np.zeros_like(turn)
        for factor in factors[::-1]:
            found *= turn
            found += factor
        return found.real
