"""Power spectral density of a profile along its line, one-sided over the wavenumber: its integral is the variance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.profile.measured import Profile

# Segments that are averaged, if they hold so many heights; and bins of wavenumber in an octave.
_SEGMENTS, _FEWEST, _PER_OCTAVE = 4, 256, 4
# Equivalent noise bandwidth of Hann's window, in bins: so many neighbours are one estimate.
_BANDWIDTH = 1.5


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A power spectral density.

    Attributes
    ----------
    wavenumbers : ndarray, shape (waves,)
        q, 1/mm, ascending, without zero.
    density : ndarray, shape (waves,)
        C(q), mm³: the variance of heights, mm², is the integral of C over q from 0.
    freedom : ndarray, shape (waves,)
        Degrees of freedom of each estimate, which is distributed as chi².
    """

    wavenumbers: Real
    density: Real
    freedom: Real

    def integral(self, low: float, high: float, order: int = 0) -> float:
        """Return the integral of q^(2 order) C over a band: the variance of heights, mm², or of slopes.

        Parameters
        ----------
        low, high : float
            Of the band, 1/mm. Each estimate is that of a bin as wide as the step from one to the next.
        order : int
            0 for heights, 1 for slopes.
        """
        step = np.diff(self.wavenumbers).min() if len(self.wavenumbers) > 1 else self.wavenumbers[0]
        left, right = self.wavenumbers - 0.5 * step, self.wavenumbers + 0.5 * step
        share = np.clip(np.minimum(right, high) - np.maximum(left, low), 0.0, None)
        return float(np.sum(share * self.density * self.wavenumbers ** (2 * order)))

    def interval(self) -> tuple[Real, Real]:
        """Return the 95 % confidence interval of the density."""
        from scipy.stats import chi2

        scale = self.freedom * self.density
        return scale / chi2.ppf(0.975, self.freedom), scale / chi2.ppf(0.025, self.freedom)

    def binned(self, per_octave: int = _PER_OCTAVE) -> Spectrum:
        """Return means over bins of wavenumber that are equal parts of an octave, where there are estimates.

        Parameters
        ----------
        per_octave : int
        """
        place = np.floor(per_octave * np.log2(self.wavenumbers / self.wavenumbers[0]) + 1e-9).astype(int)
        _, place = np.unique(place, return_inverse=True)
        count = np.bincount(place)
        many = np.bincount(place, self.freedom) / np.where(count > 1, _BANDWIDTH, 1.0)
        centre = np.exp(np.bincount(place, np.log(self.wavenumbers)) / count)
        return Spectrum(centre, np.bincount(place, self.density) / count, np.maximum(many, 1.0))


def periodogram(heights: Real, period: float) -> Spectrum:
    """Return the spectrum of heights that repeat: the sum of C over its waves, times their step, is the variance.

    Parameters
    ----------
    heights : ndarray, shape (points,)
        Over one period, mm.
    period : float
        mm.
    """
    count = len(heights)
    waves = np.arange(1, count // 2 + 1)
    power = np.abs(np.fft.rfft(heights)[1:]) ** 2 / count**2
    power *= np.where(2 * waves == count, 1.0, 2.0)
    step = 2.0 * math.pi / period
    return Spectrum(step * waves, power / step, np.where(2 * waves == count, 1.0, 2.0))


def welch(profile: Profile, segments: int = _SEGMENTS) -> Spectrum:
    """Return the mean spectrum of segments that overlap by half, each without its trend and under Hann's window.

    Parameters
    ----------
    profile : Profile
        Without gaps.
    segments : int
        Lengths of a segment in the profile; fewer where segments would have less than 256 heights.
    """
    from scipy.signal import welch as averaged

    count = len(profile.heights)
    size = min(count, max(count // segments, _FEWEST))
    frequency, density = averaged(
        profile.heights, 1.0 / profile.spacing, "hann", size, size // 2, detrend="linear", scaling="density"
    )
    many = max(1 + (count - size) // (size - size // 2), 1)
    # Overlapping by half, neighbouring segments under Hann's window share 1/6 of their amplitude.
    averages = many / (1.0 + 2.0 / 36.0 * (many - 1) / many)
    freedom = np.full(len(frequency) - 1, 2.0 * averages)
    if size % 2 == 0:
        freedom[-1] = averages
    return Spectrum(2.0 * math.pi * frequency[1:], density[1:] / (2.0 * math.pi), freedom)
