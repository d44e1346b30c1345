"""The band of wavelengths in which a spectrum can be trusted, and the Hurst exponent in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.profile.spectrum import Spectrum

# Heights to the shortest wavelength that is trusted, and segments' shares of the longest.
_SHORTEST, _LONGEST = 4.0, 2.0
# By how much the slope of the spectrum, in log over log, changes where noise or a roll-off begins; the range, in
# logarithms of q, over which each part of it lasts at least; and the part of the residual's sum of squares that a
# corner has to remove.
_CORNER, _LASTS, _REMOVES = 0.5, math.log(3.0), 0.4
# Where noise begins, it is as strong as the road: what is trusted keeps away from that by this factor.
_ABOVE_NOISE = 2.0
# Bins that a fit of a line needs.
_FEWEST = 5


@dataclass(frozen=True)
class Band:
    """Where a spectrum can be trusted.

    Attributes
    ----------
    low, high : float
        Wavenumbers, 1/mm.
    why_low, why_high : str
        What bounds it.
    roll_off : float
        Wavenumber below which the spectrum flattens, 1/mm; NaN where it does not.
    """

    low: float
    high: float
    why_low: str
    why_high: str
    roll_off: float

    @property
    def wavelengths(self) -> tuple[float, float]:
        """Shortest and longest, mm."""
        return 2.0 * math.pi / self.high, 2.0 * math.pi / self.low


@dataclass(frozen=True)
class Hurst:
    """C(q) = level (q / reference)^-(1 + 2 H), fitted.

    Attributes
    ----------
    exponent, error : float
        H, and the half-width of its 95 % confidence interval.
    reference, level : float
        1/mm, and mm³ there.
    level_error : float
        Half-width of the 95 % confidence interval of the level's natural logarithm.
    low, high : float
        Wavenumbers between which it was fitted, 1/mm.
    """

    exponent: float
    error: float
    reference: float
    level: float
    level_error: float
    low: float
    high: float


def trusted(spectrum: Spectrum, spacing: float) -> Band:
    """Return the band in which a spectrum can be trusted.

    It ends at two wavelengths a segment and at four heights a wavelength, or at twice the wavelength below which
    the spectrum becomes shallower, as noise makes it: a road's does not.

    Parameters
    ----------
    spectrum : Spectrum
        Of segments, as ``welch`` makes it.
    spacing : float
        Of the heights, mm.
    """
    step = float(spectrum.wavenumbers[0])
    low, high = _LONGEST * step, 2.0 * math.pi / (_SHORTEST * spacing)
    why_low = "two wavelengths in a segment of the spectrum"
    why_high = "four heights in a wavelength"
    bins = spectrum.binned()
    inside = (bins.wavenumbers >= low) & (bins.wavenumbers <= 0.5 * high * _SHORTEST)
    x, y, weight = _logarithms(bins, inside)
    corners = _corners(x, y, weight)
    roll_off = math.nan
    if corners is not None:
        places, slopes = corners
        for place, before, after in zip(places, slopes[:-1], slopes[1:], strict=True):
            if after - before > _CORNER and math.exp(place) < high:
                high = math.exp(place) / _ABOVE_NOISE
                why_high = (
                    f"twice the wavelength below which the spectrum goes with q^{after:.1f} instead of q^{before:.1f}, "
                    "as noise makes it"
                )
            elif before - after > _CORNER:
                roll_off = math.exp(place)
    return Band(low, max(high, 2.0 * low), why_low, why_high, roll_off)


def hurst(spectrum: Spectrum, band: Band) -> Hurst | None:
    """Return the Hurst exponent over the trusted band, above the roll-off; None where that is less than 5 bins.

    Parameters
    ----------
    spectrum : Spectrum
    band : Band
    """
    bins = spectrum.binned()
    low = band.low if math.isnan(band.roll_off) else max(band.low, band.roll_off)
    inside = (bins.wavenumbers >= low) & (bins.wavenumbers <= band.high)
    if inside.sum() < _FEWEST:
        return None
    from scipy.stats import t

    x, y, weight = _logarithms(bins, inside)
    centre = float(np.average(x, weights=weight))
    design = np.stack([np.ones_like(x), x - centre], axis=1)
    covariance = np.linalg.inv(design.T @ (weight[:, None] * design))
    found = covariance @ (design.T @ (weight * y))
    # Scatter beyond that of chi² is the road's own.
    scatter = max(float(np.sum(weight * (y - design @ found) ** 2)) / (len(x) - 2), 1.0)
    width = float(t.ppf(0.975, len(x) - 2)) * np.sqrt(scatter * np.diag(covariance))
    return Hurst(
        exponent=float(-0.5 * (found[1] + 1.0)),
        error=float(0.5 * width[1]),
        reference=math.exp(centre),
        level=math.exp(float(found[0])),
        level_error=float(width[0]),
        low=low,
        high=band.high,
    )


def _logarithms(bins: Spectrum, inside: np.ndarray) -> tuple[Real, Real, Real]:
    """Return ln q, ln C without the bias of the logarithm of chi², and the inverse of its variance."""
    from scipy.special import digamma, polygamma

    inside = inside & (bins.density > 0.0)
    half = 0.5 * bins.freedom[inside]
    y = np.log(bins.density[inside]) - (digamma(half) - np.log(half))
    return np.log(bins.wavenumbers[inside]), y, 1.0 / polygamma(1, half)


def _corners(x: Real, y: Real, weight: Real) -> tuple[list[float], list[float]] | None:
    """Return where a line with up to two corners through the logarithms turns, and its slopes; None for none.

    A corner more has to remove a good part of the residual.
    """
    if len(x) < 2 * _FEWEST:
        return None
    best: tuple[float, list[float], list[float]] = (_residual(x, y, weight, [])[0], [], [])
    lone = [at for at in x if at - x[0] >= _LASTS and x[-1] - at >= _LASTS]
    singles = [[at] for at in lone]
    pairs = [[one, other] for one in lone for other in lone if other - one >= _LASTS]
    for choices in (singles, pairs):
        fits = [(*_residual(x, y, weight, at), at) for at in choices]
        if not fits:
            break
        residual, slopes, places = min(fits, key=lambda fit: fit[0])
        if residual < (1.0 - _REMOVES) * best[0]:
            best = (residual, places, slopes)
    return (best[1], best[2]) if best[1] else None


def _residual(x: Real, y: Real, weight: Real, places: list[float]) -> tuple[float, list[float]]:
    """Return the weighted sum of squares about a line with corners, and the slopes of its parts."""
    design = np.stack([np.ones_like(x), x, *(np.maximum(x - at, 0.0) for at in places)], axis=1)
    root = np.sqrt(weight)
    found = np.linalg.lstsq(root[:, None] * design, root * y, rcond=None)[0]
    return float(np.sum(weight * (y - design @ found) ** 2)), np.cumsum(found[1:]).tolist()
