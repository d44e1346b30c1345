"""All that is said of a measured road: heights, spectrum with its trusted band, octaves, depth, windows, and sines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rubfric.errors import InvalidInput
from rubfric.profile import window
from rubfric.profile.band import Band, Hurst, hurst, trusted
from rubfric.profile.cleaning import Cleaned
from rubfric.profile.depth import Depth, mean_profile_depth
from rubfric.profile.scales import Octave, octaves, sines
from rubfric.profile.spectrum import Spectrum, welch
from rubfric.profile.walls import STEEP, Walls, walls
from rubfric.road.profile import ProfileRoad
from rubfric.road.waves import MOST_WAVES, WaveRoad

# Length of a window, mm, unless another is given or the profile is too short.
WINDOW = 40.0
# Digits of a cutoff that is found out; and the part of an octave's ends that has to lie in the trusted band.
_DIGITS, _NEARLY = 2, 1.1
# Share of the mean square slope from which on walls are worth a word.
_MUCH_WALL = 0.2
# Part of the largest height within which heights are alike.
_ALIKE = 1e-9


@dataclass(frozen=True, eq=False)
class Analysis:
    """A measured road, analysed.

    Attributes
    ----------
    cleaned : Cleaned
    spectrum : Spectrum
        Mean over segments.
    band : Band
        In which it can be trusted.
    hurst : Hurst or None
        The power law in that band.
    depth : Depth
        Mean profile depth; without segments for a profile shorter than 100 mm.
    walls : Walls
        Places where heights jump.
    octaves : tuple of Octave
        Root mean square height and slope by band of wavelength.
    window, cutoff, blend : float
        Length of a window and shortest wavelength kept, mm, and the share of a window that is blended.
    windows : int
        How many there are side by side.
    sines : WaveRoad
        One sine for each of some bands, from a window to the cutoff.
    """

    cleaned: Cleaned
    spectrum: Spectrum
    band: Band
    hurst: Hurst | None
    depth: Depth
    walls: Walls
    octaves: tuple[Octave, ...]
    window: float
    cutoff: float
    blend: float
    windows: int
    sines: WaveRoad

    def road(self, number: int = 1, cutoff: float | None = None) -> ProfileRoad:
        """Return a window as a road to slide over.

        Parameters
        ----------
        number : int
            Which window, from 1.
        cutoff : float, optional
            Shortest wavelength kept, mm, instead of ``cutoff``.
        """
        return window.road(self.cleaned.profile, self.window, cutoff or self.cutoff, number, self.blend)

    def is_trusted(self, octave: Octave) -> bool:
        """Return whether an octave lies in the trusted band with both its ends, or nearly so."""
        shortest, longest = self.band.wavelengths
        half = math.sqrt(2.0) / _NEARLY
        return bool(octave.wavelength / half >= shortest and octave.wavelength * half <= longest)

    @property
    def slope(self) -> float:
        """Root mean square slope of all waves of the trusted band and longer ones, dimensionless."""
        return math.sqrt(self.spectrum.integral(0.0, self.band.high, 1))

    @property
    def moments(self) -> tuple[float, float, float]:
        """Root mean square of heights (mm), skewness and kurtosis (3 for a normal distribution)."""
        heights = self.cleaned.heights
        height = float(np.sqrt(np.mean(heights**2)))
        if height == 0.0:
            return 0.0, 0.0, 0.0
        return height, float(np.mean((heights / height) ** 3)), float(np.mean((heights / height) ** 4))

    def warnings(self) -> Iterator[str]:
        """Yield what is doubtful."""
        yield from self.cleaned.warnings
        shortest = self.band.wavelengths[0]
        if self.cutoff < shortest * (1.0 - 1e-9):
            yield (f"the cutoff, {self.cutoff:g} mm, is below the shortest wavelength to be trusted, {shortest:.3g} mm")
        if self.hurst is not None and not 0.0 < self.hurst.exponent < 1.0:
            yield (
                f"the spectrum goes with q^{-1.0 - 2.0 * self.hurst.exponent:.2g}, which no self-affine road has: "
                "q^-1 to q^-3"
            )
        if self.walls.share > _MUCH_WALL:
            found = self.walls
            yield (
                f"{found.count} places are steeper than {STEEP:g} from one height to the next, walls up to "
                f"{found.highest:.2g} mm high, and hold {found.share:.0%} of the mean square slope: gaps between "
                "stones, or errors of the instrument; the shortest waves are theirs, and in finite strain no solution "
                "may be found where rubber reaches them, which a longer cutoff makes less steep"
            )
        if self.windows < 2:
            yield "the profile holds one window: how friction scatters over the road cannot be told"
        if not len(self.depth.segments):
            yield "the profile is shorter than 100 mm: it has no mean profile depth by ISO 13473-1"
        elif np.isnan(self.depth.segments).any():
            lost = int(np.isnan(self.depth.segments).sum())
            yield f"{lost} segments of 100 mm have no mean segment depth: more than a tenth of them is bridged"


def analyse(
    cleaned: Cleaned,
    length: float | None = None,
    cutoff: float | None = None,
    scales: int = 4,
    blend: float = window.BLEND,
) -> Analysis:
    """Return what is to be said of a clean profile.

    Parameters
    ----------
    cleaned : Cleaned
    length : float, optional
        Of a window, mm; 40 mm by default, or the longest that fits.
    cutoff : float, optional
        Shortest wavelength kept, mm; by default the shortest that can be trusted, rounded up to two digits.
    scales : int
        Number of sines.
    blend : float
        Share of a window over which its ends are blended.

    Raises
    ------
    InvalidInput
        For heights that are all alike; for a window longer than the profile; for a cutoff below twice the spacing or
        not below the length of a window.
    """
    profile = cleaned.profile
    if np.ptp(profile.heights) <= _ALIKE * np.nanmax(np.abs(cleaned.measured.heights)):
        raise InvalidInput(f"{profile.source} is flat: all of its heights are alike but for tilt and form")
    spectrum = welch(profile)
    band = trusted(spectrum, profile.spacing)
    length = min(WINDOW, window.longest(profile, blend)) if length is None else length
    there = window.count(profile, length, blend)
    if cutoff is None:
        shortest = max(band.wavelengths[0], 1.02 * length / MOST_WAVES)
        unit = 10.0 ** (math.floor(math.log10(shortest)) + 1 - _DIGITS)
        cutoff = float(f"{unit * math.ceil(shortest / unit - 1e-9):.{_DIGITS}g}")
    _check_cutoff(cutoff, length, profile.spacing)
    return Analysis(
        cleaned,
        spectrum,
        band,
        hurst(spectrum, band),
        mean_profile_depth(profile.heights, profile.spacing, cleaned.bridged),
        walls(profile.heights, profile.spacing, cleaned.bridged),
        tuple(octaves(spectrum)),
        length,
        cutoff,
        blend,
        there,
        sines(spectrum, scales, length, cutoff),
    )


def _check_cutoff(cutoff: float, length: float, spacing: float) -> None:
    least = max(2.0 * spacing, length / MOST_WAVES)
    if cutoff < least * (1.0 - 1e-9):
        why = "twice the spacing of the heights" if least == 2.0 * spacing else f"a {MOST_WAVES}th of the window"
        raise InvalidInput(f"--cutoff is {cutoff:g} mm, but must be at least {least:.4g} mm, {why}")
    if cutoff > 0.5 * length:
        raise InvalidInput(f"--cutoff is {cutoff:g} mm, but must be at most half the window, {0.5 * length:g} mm")
