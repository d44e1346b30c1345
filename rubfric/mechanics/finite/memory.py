"""The branches as the solver of one deformed state sees them: linear in that state, plus what is known.

They add -H[Cb^-1] + M to the driving tensor Q and B[J] + N to the volumetric stress U'. In steady sliding the history
is the row of points upstream: H and B are periodic convolutions along the road, and nothing is known. In a step of
time they are numbers, and M and N what is left of the state before.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real, single
from rubfric.mechanics.finite.layers import Layer
from rubfric.rubber.material import Material


class BranchHistory(Protocol):
    """How the branches answer to a state.

    Attributes
    ----------
    shear_kernel, bulk_kernel : ndarray of complex, shape (n,)
        H and B for the harmonics of the road, MPa.
    bulk_relaxes : bool
        Whether B and N differ from zero.
    anchored : bool
        Whether it matters where along the road the block is.
    """

    shear_kernel: Complex
    bulk_kernel: Complex
    bulk_relaxes: bool
    anchored: bool

    @property
    def known_driving(self) -> Real | float:
        """M, MPa, shape (4, points, rows, columns) or a number."""
        ...

    @property
    def known_pressure(self) -> Real | float:
        """N, MPa, in the shape of ``Fields.volume`` or a number."""
        ...

    def shear(self, field: Real) -> Real:
        """Return H of a field of points, MPa."""
        ...

    def bulk(self, field: Real) -> Real:
        """Return B of a field of points, MPa."""
        ...

    def single(self) -> BranchHistory:
        """Return H and B for fields in single precision."""
        ...


class SteadyHistory:
    """The history of a block that slides steadily: H and B are convolutions, M and N vanish.

    Harmonic n sees H_n = G*(n k v) - G_inf and B_n = K*(n k v) - K_inf.

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        n k v, rad/s, of the harmonics 0 to columns / 2.
    layers : sequence of Layer
        Of the block; none where all rows have all columns.
    """

    known_driving: Real | float = 0.0
    known_pressure: Real | float = 0.0
    anchored = False

    def __init__(self, material: Material, frequencies: Real, layers: Sequence[Layer] = ()) -> None:
        self._layers = layers
        self.shear_kernel = _kernel(material.complex_shear_modulus(frequencies))
        self.bulk_kernel = _kernel(material.complex_bulk_modulus(frequencies))
        self.bulk_relaxes = bool(material.branch_bulk_moduli.any())

    def shear(self, field: Real) -> Real:
        """Return the convolution of a field with the shear kernel, MPa."""
        return convolve_layers(self._layers, self.shear_kernel, field)

    def bulk(self, field: Real) -> Real:
        """Return the convolution of a field with the bulk kernel, MPa."""
        return convolve_layers(self._layers, self.bulk_kernel, field)

    def single(self) -> SteadyHistory:
        """Return H and B for fields in single precision."""
        other = copy.copy(self)
        other.shear_kernel, other.bulk_kernel = single(self.shear_kernel), single(self.bulk_kernel)
        return other


class StepHistory:
    """The history of a block at the end of a step of time: H and B are numbers.

    Parameters
    ----------
    shear, bulk : float
        H and B, MPa.
    known_driving : ndarray, shape (4, points, rows, columns)
        M, MPa.
    known_pressure : ndarray, shape of ``Fields.volume``, or float
        N, MPa; a float where the bulk does not relax.
    harmonics : int
        n.
    """

    anchored = True

    def __init__(
        self, shear: float, bulk: float, known_driving: Real, known_pressure: Real | float, harmonics: int
    ) -> None:
        self._shear, self._bulk = float(shear), float(bulk)
        self.known_driving: Real | float = known_driving
        self.known_pressure: Real | float = known_pressure
        self.bulk_relaxes = isinstance(known_pressure, np.ndarray)
        self.shear_kernel = np.full(harmonics, shear, dtype=complex)
        self.bulk_kernel = np.full(harmonics, bulk, dtype=complex)

    def shear(self, field: Real) -> Real:
        """Return H times a field, MPa."""
        return self._shear * field

    def bulk(self, field: Real) -> Real:
        """Return B times a field, MPa."""
        return self._bulk * field

    def single(self) -> StepHistory:
        """Return H and B for fields in single precision: themselves."""
        return self


def convolve(kernel: Complex, field: Real) -> Real:
    """Return the periodic convolution along the road of a field with a kernel given by its harmonics.

    g_n = k_n f_n for the harmonics n = 0 ... columns / 2 of f and g.

    Parameters
    ----------
    kernel : ndarray of complex, shape (n,)
        k_n, of any unit; its first and last entries real.
    field : ndarray, shape (..., columns)
        f.

    Returns
    -------
    ndarray, shape (..., columns)
        g.
    """
    spectrum = fft.rfft(field, axis=-1)
    spectrum *= kernel
    answer: Real = fft.irfft(spectrum, field.shape[-1], axis=-1, overwrite_x=True)
    return answer


def convolve_layers(layers: Sequence[Layer], kernel: Complex, field: Real) -> Real:
    """Return ``convolve`` of a field of points, each layer of rows with its own harmonics.

    Parameters
    ----------
    layers : sequence of Layer
        None where all rows have all columns.
    kernel : ndarray of complex, shape (n,)
        As for ``convolve``.
    field : ndarray, shape (..., stored rows, columns)
    """
    if len(layers) <= 1:
        return convolve(kernel, field)
    answer = np.empty_like(field)
    for layer in layers:
        layer.of(answer)[:] = convolve(layer.kernel(kernel), layer.of(field))
    return answer


def branch_transfers(material: Material, frequencies: Real) -> Complex:
    """Return i w tau / (1 + i w tau) for ``convolve``; the last harmonic is its own conjugate.

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        w of the harmonics 0 to columns / 2, rad/s.

    Returns
    -------
    ndarray of complex, shape (branches, n)
    """
    transfers = material.branch_transfer(frequencies)
    transfers[:, -1] = transfers[:, -1].real
    return transfers


def _kernel(modulus: Complex) -> Complex:
    """Return what a modulus adds to its long-term value; the last harmonic is its own conjugate."""
    kernel = modulus - modulus[0].real
    kernel[-1] = kernel[-1].real
    return kernel
