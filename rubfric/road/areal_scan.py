"""An areal road from measured heights: what is missing filled and counted, form removed, periodic by blending."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator

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

    Attributes
    ----------
    spectrum : ArealSpectrum
        Its waves.
    missing : int
        Heights that were not measured, and filled.
    form : ndarray, shape (terms,)
        Coefficients of what was removed, mm, over 1, x, y, or 1, x, y, x², x y, y², with x and y from -1 to 1.
    """

    spectrum: ArealSpectrum
    missing: int
    form: Real

    def parameters(self) -> dict[str, Any]:
        """Return a digest of its waves, and what was missing."""
        return {"kind": "scan", "waves_sha256": _digest(self.spectrum), "missing": self.missing}

    @classmethod
    def of_heights(
        cls,
        heights: Real,
        spacing: tuple[float, float],
        *,
        degree: int = 1,
        blend: float = BLEND,
        cut_off: float | None = None,
    ) -> ScannedRoad:
        """Return the road that a scan shows.

        Missing heights are filled linearly between their neighbours, beyond the outermost by the nearest. The window
        is as long as the scan without what is blended: the first heights go over into those that follow on the window,
        by w = sin²(pi x / 2 b) over the length b, in both directions. Heights that repeat with the window's periods
        stay what they are.

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
        """
        surface = np.array(heights, dtype=float)
        if surface.ndim != 2 or min(surface.shape) < _FEWEST:
            raise InvalidInput(
                f"the scan has the shape {surface.shape}, but must have {_FEWEST} x {_FEWEST} heights or more"
            )
        if not (min(spacing) > 0.0 and np.isfinite(spacing).all()):
            raise InvalidInput(f"the spacing of the scan is {spacing} mm, but must be positive along x and y")
        if degree not in (0, 1, 2):
            raise InvalidInput(f"the degree of the form is {degree}, but must be 0 (mean), 1 (plane) or 2 (paraboloid)")
        if not 0.0 <= blend <= 0.5:
            raise InvalidInput(f"the blend is {blend:g}, but must be between 0 and 0.5 of the window")
        known = np.isfinite(surface)
        missing = int(surface.size - np.count_nonzero(known))
        if missing > _MOST_MISSING * surface.size:
            raise InvalidInput(
                f"the scan lacks {missing} of {surface.size} heights, but at most half of them may be missing: measure "
                "again, or cut out a part that was measured"
            )
        form, removed = _form(surface, known, degree)
        filled = _filled(surface - removed, known)
        for axis in (0, 1):
            filled = _blended(filled, axis, blend)
        spectrum = _series(filled, spacing)
        return cls(spectrum.without(cut_off) if cut_off else spectrum, missing, form)


def _digest(spectrum: ArealSpectrum) -> str:
    found = hashlib.sha256(repr(spectrum.periods).encode())
    found.update(np.ascontiguousarray(spectrum.harmonics, dtype="<i8").tobytes())
    found.update(np.ascontiguousarray(spectrum.amplitudes, dtype="<c16").tobytes())
    return found.hexdigest()


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
    there, lacking = np.argwhere(known), np.argwhere(~known)
    values = surface[known]
    found = LinearNDInterpolator(there, values)(lacking)
    outside = np.isnan(found)
    if outside.any():
        found[outside] = NearestNDInterpolator(there, values)(lacking[outside])
    filled = surface.copy()
    filled[~known] = found
    return filled


def _blended(surface: Real, axis: int, blend: float) -> Real:
    """Return a window of a surface that repeats along an axis."""
    lines = np.moveaxis(surface, axis, 0)
    points = int(len(lines) / (1.0 + blend))
    over = len(lines) - points
    if not blend or not over:
        return surface
    weight = np.sin(0.5 * np.pi * np.arange(over) / over)[:, None] ** 2
    window = lines[:points].copy()
    window[:over] = weight * window[:over] + (1.0 - weight) * lines[points:]
    return np.moveaxis(window, 0, axis)


def _series(surface: Real, spacing: tuple[float, float]) -> ArealSpectrum:
    """Return the waves of a periodic surface, but for those of its Nyquist wavelengths and its mean."""
    ny, nx = surface.shape
    series = 2.0 * np.fft.rfft2(surface) / surface.size
    m, n = np.meshgrid(np.arange(nx // 2 + 1), np.fft.fftfreq(ny, 1.0 / ny).round().astype(int))
    kept = (2 * m < nx) & (2 * np.abs(n) < ny) & ((m > 0) | (n > 0))
    periods = (nx * spacing[0], ny * spacing[1])
    return gathered(periods, np.stack((m[kept], n[kept]), axis=1), series[kept])
