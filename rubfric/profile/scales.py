"""From a spectrum to a few sines, the paper's own route, and what of it is in which octave."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rubfric.errors import InvalidInput
from rubfric.profile.spectrum import Spectrum
from rubfric.road.waves import MOST_WAVES, WaveRoad

# Largest relative change of a wavenumber by which a common period is made.
_MOVED = 0.05


@dataclass(frozen=True)
class Octave:
    """What an octave of wavelength holds.

    Attributes
    ----------
    wavelength : float
        Its centre, a power of two, mm; it reaches from that over the square root of 2 to that times it.
    height, slope : float
        Root mean square, mm and dimensionless.
    """

    wavelength: float
    height: float
    slope: float


def octaves(spectrum: Spectrum) -> list[Octave]:
    """Return the octaves that a spectrum has whole, from long to short wavelengths.

    Parameters
    ----------
    spectrum : Spectrum
    """
    longest, shortest = (2.0 * math.pi / spectrum.wavenumbers[at] for at in (0, -1))
    powers = range(math.floor(math.log2(longest) - 0.5), math.ceil(math.log2(shortest) + 0.5) - 1, -1)
    found = []
    for power in powers:
        low, high = (2.0 * math.pi / 2.0 ** (power + side) for side in (0.5, -0.5))
        parts = [math.sqrt(spectrum.integral(low, high, order)) for order in (0, 1)]
        found.append(Octave(2.0**power, *parts))
    return found


def sines(spectrum: Spectrum, count: int, longest: float, shortest: float) -> WaveRoad:
    """Return a road of sines, one for each of some bands of equal ratio, with a common period.

    Each sine has the variance of heights and of slopes of its band: a = sqrt(2 V), k² = integral of q² C over
    that of C. Wavenumbers are then moved by up to 5 % to have a short common period, a k kept. What is lost: all but
    one wave of a band, so the height distribution, the phases, and the largest slopes.

    Parameters
    ----------
    spectrum : Spectrum
    count : int
        Number of sines.
    longest, shortest : float
        Wavelengths between which the bands lie, mm.

    Raises
    ------
    InvalidInput
        For bands without heights, or too far apart for a common period.
    """
    edges = 2.0 * math.pi / np.geomspace(longest, shortest, count + 1)
    amplitudes, wavenumbers = [], []
    for low, high in pairwise(edges.tolist()):
        heights, slopes = (spectrum.integral(low, high, order) for order in (0, 1))
        if not heights > 0.0:
            raise InvalidInput(
                f"the band from {2.0 * math.pi / low:.4g} to {2.0 * math.pi / high:.4g} mm of wavelength holds no "
                "heights: ask for fewer sines with --scales"
            )
        amplitudes.append(math.sqrt(2.0 * heights))
        wavenumbers.append(math.sqrt(slopes / heights))
    unit, numbers = _common(wavenumbers, longest, shortest)
    placed = tuple(float(f"{number * unit:.12g}") for number in numbers)
    kept = (float(f"{a * k / new:.4g}") for a, k, new in zip(amplitudes, wavenumbers, placed, strict=True))
    return WaveRoad(tuple(kept), placed, (0.0,) * count)


def _common(wavenumbers: list[float], longest: float, shortest: float) -> tuple[float, list[int]]:
    """Return the largest unit, of four digits, of which all wavenumbers are multiples but for some per cent."""
    for parts in range(1, MOST_WAVES + 1):
        unit = float(f"{wavenumbers[0] / parts:.4g}")
        numbers = [round(k / unit) for k in wavenumbers]
        if numbers[-1] > MOST_WAVES:
            break
        if all(abs(number * unit / k - 1.0) <= _MOVED for number, k in zip(numbers, wavenumbers, strict=True)):
            return unit, numbers
    raise InvalidInput(
        f"sines from {longest:.4g} to {shortest:.4g} mm of wavelength have no common period that holds the finest at "
        f"most {MOST_WAVES} times: choose a longer --cutoff or a shorter --window"
    )
