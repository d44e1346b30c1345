"""What a sliding block yields to each wave of pressure on an areal road.

In the frame of the road a wave of wavevector k is felt at the frequency w = v . k, so that its compliance depends on
|k| and on w only. It is that of the homogeneous layer, 2 / (|k| E*(w) f(|k| H)) (``rubfric.mechanics.theory.layer``),
times what finite elements over the depth make of it: a factor near 1, smooth in the logarithms of |k| and w, which is
worked out at some hundred places and interpolated by cubic splines.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from scipy.interpolate import RectBivariateSpline

from rubfric.arrays import Complex, Real
from rubfric.mechanics.areal.depth import depth_compliance
from rubfric.mechanics.areal.surface import ArealSurface
from rubfric.mechanics.block.block import graded_rows
from rubfric.mechanics.theory.layer import layer_factor
from rubfric.road.areal import unit_vector
from rubfric.rubber.material import Material

# Height of the first element over the distance of nodes, and growth of the elements: 1e-5 of the compliance of all but
# waves of a few nodes, and less than 1 % of that of the shortest.
_FIRST, _GROWTH = 0.25, 1.25
# Places along the logarithms of |k| and of w, and how far below the slowest wave w begins.
_WAVES, _FREQUENCIES, _SLOWEST = 24, 12, 1e-2


class ArealCompliance:
    """A block that slides steadily over an areal road.

    Parameters
    ----------
    material : Material
    velocity : float
        v, mm/s.
    direction : float
        Of sliding, degrees from x towards y.
    height : float
        H, mm.
    periods : tuple of float, shape (2,)
        L_x and L_y, mm.
    shape : tuple of int
        (ny, nx) of the finest nodes.
    """

    def __init__(
        self,
        material: Material,
        velocity: float,
        direction: float,
        height: float,
        periods: tuple[float, float],
        shape: tuple[int, int],
    ) -> None:
        self.material, self.velocity, self.direction = material, velocity, direction
        self.height, self.periods, self.shape = height, periods, shape

    @cached_property
    def rows(self) -> Real:
        """Ends of the elements over the depth, mm, from the road to the top."""
        spacing = min(period / nodes for period, nodes in zip(self.periods, reversed(self.shape), strict=True))
        return graded_rows(self.height, _FIRST * spacing, _GROWTH)

    def rates(self, shape: tuple[int, int]) -> Real:
        """Return k along the direction of sliding, 1/mm, of all waves on nodes of a shape.

        The shortest wave along an axis moves neither way at the nodes: along it k counts as zero.

        Returns
        -------
        ndarray, shape (ny, nx // 2 + 1)
        """
        ky, kx = self._axes(shape)
        kx[-1] = ky[len(ky) // 2] = 0.0
        cosine, sine = unit_vector(self.direction)
        return cosine * kx + sine * ky[:, None]

    def surface(self, shape: tuple[int, int]) -> ArealSurface:
        """Return the surface on nodes of a shape, none finer than ``shape``."""
        ky, kx = self._axes(shape)
        frequencies = self.velocity * self.rates(shape)
        found = np.empty(frequencies.shape, dtype=complex)
        for row, (across, frequency) in enumerate(zip(ky, frequencies, strict=True)):
            wavenumbers = np.hypot(kx, across)
            if row == 0:
                wavenumbers[0] = 1.0  # the mean, which is not used
            found[row] = self.compliance(wavenumbers, frequency)
        return ArealSurface(found, shape)

    def compliance(self, wavenumbers: Real, frequencies: Real) -> Complex:
        """Return surface displacement over pressure, mm/MPa.

        Parameters
        ----------
        wavenumbers : ndarray, shape (n,)
            |k|, 1/mm.
        frequencies : ndarray, shape (n,)
            w, rad/s, of either sign.

        Returns
        -------
        ndarray of complex, shape (n,)
        """
        modulus = self.material.plane_modulus(frequencies, "strain")
        layer = 2.0 / (wavenumbers * modulus * layer_factor(wavenumbers * self.height))
        return layer * self._factor(wavenumbers, frequencies)

    def _axes(self, shape: tuple[int, int]) -> tuple[Real, Real]:
        (ny, nx), (across_x, across_y) = shape, self.periods
        ky = 2.0 * math.pi / across_y * np.fft.fftfreq(ny, 1.0 / ny)
        return ky, 2.0 * math.pi / across_x * np.arange(nx // 2 + 1)

    def _factor(self, wavenumbers: Real, frequencies: Real) -> Complex:
        """Return the compliance over that of the homogeneous layer."""
        waves, slow, fast, (real, imaginary) = self._splines
        place = np.clip(np.log(wavenumbers), waves[0], waves[-1])
        turn = np.log(np.clip(np.abs(frequencies), slow, fast))
        return real.ev(place, turn) + 1j * np.sign(frequencies) * imaginary.ev(place, turn)

    @cached_property
    def _splines(self) -> tuple[Real, float, float, tuple[RectBivariateSpline, RectBivariateSpline]]:
        ky, kx = self._axes(self.shape)
        longest, shortest = min(kx[1], abs(ky[1])), math.hypot(kx[-1], np.abs(ky).max())
        waves = np.linspace(math.log(longest), math.log(shortest), _WAVES)
        slow, fast = _SLOWEST * self.velocity * longest, self.velocity * shortest
        turns = np.linspace(math.log(slow), math.log(fast), _FREQUENCIES)
        k, w = (part.ravel() for part in np.meshgrid(np.exp(waves), np.exp(turns), indexing="ij"))
        shear, bulk = self.material.complex_shear_modulus(w), self.material.complex_bulk_modulus(w)
        modulus = self.material.plane_modulus(w, "strain")
        layer = 2.0 * shear / (k * modulus * layer_factor(k * self.height))
        factor = (depth_compliance(k, bulk / shear, self.rows) / layer).reshape(_WAVES, _FREQUENCIES)
        real, imaginary = (RectBivariateSpline(waves, turns, part) for part in (factor.real, factor.imag))
        return waves, slow, fast, (real, imaginary)
