"""The surface of a block that is the same everywhere: pressures and deflections by two-dimensional Fourier transforms.

Fields are arrays of shape (ny, nx) on evenly spread nodes; their spectra have the shape (ny, nx // 2 + 1) of
``scipy.fft.rfft2``.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real

# What contact may miss: of balance over the pressures; of contact over the largest pressure and the height of the road.
TOLERANCE = 1e-8


class ArealSurface:
    """A surface that yields to pressures linearly, in the frame of the road.

    Parameters
    ----------
    compliance : ndarray of complex, shape (ny, nx // 2 + 1)
        Spectrum of C, mm/MPa, each of positive real part; its entry (0, 0) is not used.
    shape : tuple of int
        (ny, nx).
    """

    def __init__(self, compliance: Complex, shape: tuple[int, int]) -> None:
        self.shape = shape
        self.compliance = compliance.copy()
        self.compliance[0, 0] = 0.0
        # The mean may be anything: it gets the stiffness of the softest wave.
        known = self.compliance.copy()
        known[0, 0] = np.abs(known).max()
        self._stiffness = 1.0 / known

    @property
    def nodes(self) -> int:
        """Number of nodes."""
        return math.prod(self.shape)

    def deflection(self, pressure: Real) -> Real:
        """Return C p, mm, of mean zero, from pressures in MPa."""
        return self.filtered(self.compliance, pressure)

    def pressing(self, deflection: Real) -> Real:
        """Return the pressure that makes a deflection, MPa, from mm; the mean has the stiffness of the softest wave."""
        return self.filtered(self._stiffness, deflection)

    def filtered(self, spectrum: Complex | Real, field: Real) -> Real:
        """Return a field whose spectrum was multiplied by another.

        Parameters
        ----------
        spectrum : ndarray, shape (ny, nx // 2 + 1)
        field : ndarray, shape (ny, nx)
        """
        series = fft.rfft2(field)
        series *= spectrum
        return fft.irfft2(series, self.shape, overwrite_x=True)
