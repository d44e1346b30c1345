"""An areal road from measured heights: what is missing filled and counted, form removed, periodic by blending."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rubfric.arrays import Flags, Real
from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealSpectrum, gathered

# Fewest heights along each side, and largest share of them that may be missing.
_FEWEST, _MOST_MISSING = 8, 0.5
# Share of a window over which its ends are blended, unless another is given.
BLEND = 0.1


@dataclass(frozen=True, eq=False)
class ScannedRoad:
    """A measured surface as a road.

    Missing heights are filled linearly between their neighbours, beyond the outermost by the nearest. The window is as
    long as the scan without what is blended: the first heights go over into those that follow on the window, by
    w = sin²(pi x / 2 b) over the length b, in both directions. Heights that repeat with the window's periods stay what
    they are.

    Parameters
    ----------
    heights : ndarray, shape (lines, points)
        mm, a row for each y; NaN where nothing was measured.
    spacing : tuple of float, shape (2,)
        Along x and along y, mm.
    degree : {0, 1, 2}
        Of the form that is removed: mean, plane, or paraboloid.
    blend : float
        Share of a window over which its ends are blended, 0 to 0.5.
    cut_off : float, optional
        Shortest wavelength that is kept, mm.

    Raises
    ------
    InvalidInput
        For a scan with too few heights, or of which half is missing; for other values that cannot be.

    Examples
    --------
    >>> import numpy as np
    >>> import rubfric
    >>> heights = np.random.default_rng(1).normal(scale=0.01, size=(48, 64))
    >>> heights[10, 20] = np.nan  # not measured
    >>> road = rubfric.ScannedRoad(heights, spacing=(0.02, 0.02), cut_off=0.2)
    >>> road.missing, len(road.spectrum.periods)
    (1, 2)
    """

    heights: Real
    spacing: tuple[float, float]
    degree: int = 1
    blend: float = BLEND
    cut_off: float | None = None

    def __post_init__(self) -> None:
        shape = self.heights.shape
        if len(shape) != 2 or min(shape) < _FEWEST:
            raise InvalidInput(f"the scan has the shape {shape}, but must have {_FEWEST} x {_FEWEST} heights or more")
        if not (min(self.spacing) > 0.0 and np.isfinite(self.spacing).all()):
            raise InvalidInput(f"the spacing of the scan is {self.spacing} mm, but must be positive along x and y")
        if self.degree not in (0, 1, 2):
            raise InvalidInput(
                f"the degree of the form is {self.degree}, but must be 0 (mean), 1 (plane) or 2 (paraboloid)"
            )
        if not 0.0 <= self.blend <= 0.5:
            raise InvalidInput(f"the blend is {self.blend:g}, but must be between 0 and 0.5 of the window")
        if self.missing > _MOST_MISSING * self.heights.size:
            raise InvalidInput(
                f"the scan lacks {self.missing} of {self.heights.size} heights, but at most half of them may be "
                "missing: measure again, or cut out a part that was measured"
            )
        if self.cut_off is not None and not 0.0 < self.cut_off <= 0.5 * min(self.periods):
            raise InvalidInput(
                f"cut_off is {self.cut_off:g} mm, but must be above 0 and at most half of the window, "
                f"{0.5 * min(self.periods):.4g} mm"
            )

    def __repr__(self) -> str:
        (rows, columns), (dx, dy) = self.heights.shape, self.spacing
        cut = "" if self.cut_off is None else f", waves of {self.cut_off:g} mm and longer"
        return f"<ScannedRoad: {columns} x {rows} heights, every {dx:g} x {dy:g} mm{cut}>"

    @classmethod
    def of_heights(
        cls,
        heights: ArrayLike,
        spacing: tuple[float, float],
        *,
        degree: int = 1,
        blend: float = BLEND,
        cut_off: float | None = None,
    ) -> ScannedRoad:
        """Return the road that a scan shows; for the parameters see the class."""
        return cls(np.array(heights, dtype=float), spacing, degree, blend, cut_off)

    @cached_property
    def missing(self) -> int:
        """Heights that were not measured, and filled."""
        return int(self.heights.size - np.count_nonzero(np.isfinite(self.heights)))

    @property
    def periods(self) -> tuple[float, float]:
        """L_x and L_y of the window, mm."""
        lines, points = self.heights.shape
        return _window(points, self.blend) * self.spacing[0], _window(lines, self.blend) * self.spacing[1]

    @property
    def shortest(self) -> float:
        """Wavelength of the shortest waves along x and y that heights so far apart can hold, mm."""
        return max(period / ((count - 1) // 2) for period, count in self._sides)

    @property
    def _sides(self) -> Iterator[tuple[float, int]]:
        return ((period, round(period / each)) for period, each in zip(self.periods, self.spacing, strict=True))

    @property
    def form(self) -> Real:
        """Coefficients of what was removed, mm, over 1, x, y, or 1, x, y, x², x y, y²; x and y go from -1 to 1."""
        return self._removed[0]

    @cached_property
    def _removed(self) -> tuple[Real, Real]:
        return _form(self.heights, np.isfinite(self.heights), self.degree)

    @cached_property
    def spectrum(self) -> ArealSpectrum:
        """Its waves."""
        filled = _filled(self.heights - self._removed[1], np.isfinite(self.heights))
        for axis in (0, 1):
            filled = _blended(filled, axis, self.blend)
        spectrum = _series(filled, self.periods)
        return spectrum.without(self.cut_off) if self.cut_off else spectrum

    @cached_property
    def _digest(self) -> str:
        """SHA-256 of the heights: of what was measured, and not of what is computed from it, whose last digits vary."""
        known = np.where(np.isfinite(self.heights), self.heights, np.nan)
        return hashlib.sha256(np.ascontiguousarray(known, dtype="<f8").tobytes()).hexdigest()

    def parameters(self) -> dict[str, Any]:
        """Return a digest of its heights, and what is made of them."""
        lines, points = self.heights.shape
        made = {"degree": self.degree, "blend": self.blend, "cut_off": self.cut_off, "missing": self.missing}
        size = {"lines": lines, "points": points, "spacing": list(self.spacing)}
        return {"kind": "scan", "heights_sha256": self._digest} | size | made


def _form(surface: Real, known: Flags, degree: int) -> tuple[Real, Real]:
    """Return the coefficients of the form, and the form at all places, shape (lines, points)."""
    y, x = np.meshgrid(*(np.linspace(-1.0, 1.0, count) for count in surface.shape), indexing="ij")
    terms = [x**i * y**j for total in range(degree + 1) for i, j in ((total - j, j) for j in range(total + 1))]
    basis = np.stack(terms, axis=-1)
    form = np.linalg.lstsq(basis[known], surface[known], rcond=None)[0]
    return form, basis @ form


def _filled(surface: Real, known: Flags) -> Real:
    if known.all():
        return surface
    from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator  # heavy: only where heights are missing
    from scipy.ndimage import binary_dilation

    # Triangles over what is missing have their corners beside it, whatever is known elsewhere.
    beside = known & binary_dilation(~known, np.ones((3, 3)))
    there, lacking = np.argwhere(beside), np.argwhere(~known)
    values = surface[beside]
    found = LinearNDInterpolator(there, values)(lacking)
    outside = np.isnan(found)
    if outside.any():
        found[outside] = NearestNDInterpolator(there, values)(lacking[outside])
    filled = surface.copy()
    filled[~known] = found
    return filled


def _window(count: int, blend: float) -> int:
    """Return how many of some heights in a row are left of them when their ends are blended."""
    return int(count / (1.0 + blend))


def _blended(surface: Real, axis: int, blend: float) -> Real:
    """Return a window of a surface that repeats along an axis."""
    lines = np.moveaxis(surface, axis, 0)
    points = _window(len(lines), blend)
    over = len(lines) - points
    if not blend or not over:
        return surface
    weight = np.sin(0.5 * np.pi * np.arange(over) / over)[:, None] ** 2
    window = lines[:points].copy()
    window[:over] = weight * window[:over] + (1.0 - weight) * lines[points:]
    return np.moveaxis(window, 0, axis)


def _series(surface: Real, periods: tuple[float, float]) -> ArealSpectrum:
    """Return the waves of a periodic surface, but for those of its Nyquist wavelengths and its mean."""
    ny, nx = surface.shape
    series = 2.0 * np.fft.rfft2(surface) / surface.size
    m, n = np.meshgrid(np.arange(nx // 2 + 1), np.fft.fftfreq(ny, 1.0 / ny).round().astype(int))
    kept = (2 * m < nx) & (2 * np.abs(n) < ny) & ((m > 0) | (n > 0))
    return gathered(periods, np.stack((m[kept], n[kept]), axis=1), series[kept])
