"""The nearest block that is the same everywhere along the road: a direct solver for it.

Averaged along the road, the tangent of a deformed block is block circulant: one banded system in y per harmonic,
with the complex moduli of its frequency. It is exact for a block pressed on a flat road, and close enough for
one on a rough road that a handful of Krylov iterations make up the difference.

Harmonics are those of the real Fourier transform, 0 to columns / 2. The mean u_y of the surface is held: what the block
rises by follows from the load. So is its mean u_x in steady sliding, where it does not matter where along the road
the block is; where that matters, its top is held.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import fft
from scipy.linalg import lapack

from rubfric.arrays import Complex, Flags, Real, Whole, single
from rubfric.mechanics.finite.block import Fields, FiniteBlock, Stiffness
from rubfric.mechanics.finite.condensation import Condensed, cell_mean, condensed
from rubfric.mechanics.finite.layers import gathered, node_fields, node_harmonics

# Unknowns of a row couple with those of the rows beside it: diagonals on either side of the main one.
_BAND = 3


@dataclass(frozen=True)
class RightSide:
    """What the block answers to, in harmonic space, thickness and volume eliminated.

    Attributes
    ----------
    force : ndarray of complex, shape (2, rows + 1, n)
        N per mm of thickness.
    thickness : list of ndarray of complex, shape (1 or 0, points, rows, n)
        Of each layer: logarithm of the thickness stretch that it causes in a block whose nodes are held.
    volume : list of ndarray of complex, shape (points or 1, rows, n)
        Of each layer: volume ratio that it causes there.
    """

    force: Complex
    thickness: list[Complex]
    volume: list[Complex]


class _Factors(NamedTuple):
    """A factorised band of the harmonics that go up to the same row of nodes."""

    harmonics: slice
    rows: int
    factors: Complex
    pivots: Whole


class Circulant:
    """A factorised block-circulant stiffness.

    For every harmonic the change of the displacement gradient h, of the logarithm of the thickness t (plane stress
    only) and of the volume ratio J at the points obeys, with averaged moduli A, v = dJ / d(h, t) and B = U'' + B_n,

        P = A_hh h + A_ht t + v_h B J,    T = A_th h + A_tt t + v_t B J,    e = J - <v_h h + v_t t>,

    where <> is the mean over a cell where the volume ratio is that of the cell. T and e are loads; P is in balance with
    the forces at the nodes. Thickness, and then volume, are condensed:

        t = (T - A_th h - v_t B J) / A_tt,
        J = (e + <v_t T / A_tt> + <(v_h - v_t A_th / A_tt) h>) / s,    s = 1 + B <v_t^2 / A_tt>,
        P = (A_hh - A_ht A_th / A_tt) h + A_ht T / A_tt + (v_h - A_ht v_t / A_tt) B J.

    What remains is one banded system in the nodes of a column for each harmonic.

    Parameters
    ----------
    finite : FiniteBlock
    stiffness : Stiffness
        The tangent to average along the road.
    pressure : float
        Nominal pressure, MPa. Where the surface turns, the pressure of the road turns with it.

    Attributes
    ----------
    compliance : ndarray of complex, shape (2, 2, n)
        u_x and u_y of the surface over nodal forces there, mm² / N.

    Raises
    ------
    numpy.linalg.LinAlgError
        Where the averaged stiffness is singular.
    """

    def __init__(self, finite: FiniteBlock, stiffness: Stiffness, pressure: float) -> None:
        self._finite = finite
        self._harmonics = len(finite.block.harmonics)
        layers: list[list[Condensed]] = [[] for _ in finite.layers]
        for part in finite.parts():
            number = sum(layer.stored.stop <= part.stored.start for layer in finite.layers)
            layers[number].append(condensed(finite, stiffness, part))
        self._layers = [
            Condensed(*(np.concatenate(arrays, axis=-2) for arrays in zip(*parts, strict=True))) for parts in layers
        ]
        del layers
        for layer in self._layers[1:]:  # which see no last harmonic of the nodes below them
            layer.cells[:2, :, 0, -1] = layer.cells[:, :2, 0, -1] = 0.0
            for name in (
                "thickness_of_displacement",
                "force_of_thickness",
                "volume_of_displacement",
                "force_of_volume",
            ):
                getattr(layer, name)[:2, ..., 0, -1] = 0.0
        self._factors = self._factorise([layer.cells for layer in self._layers], pressure)
        self._layers = [layer._replace(cells=layer.cells[..., :0]) for layer in self._layers]  # no longer needed
        self._surface_response = np.stack([self._unit(component, transposed=True) for component in (0, 1)])
        self.compliance: Complex = np.stack([self._unit(component)[:, 0].T for component in (0, 1)], axis=1)
        self.compliance[..., -1] = self.compliance[..., -1].real
        if not finite.history.anchored:
            self.compliance[..., 0] = self._surface_response[:, 0] = 0.0

    def single(self) -> Circulant:
        """Return it for loads in single precision; its compliance stays as it is."""
        other = copy.copy(self)
        other._layers = [Condensed(*map(single, layer)) for layer in self._layers]
        other._factors = [part._replace(factors=single(part.factors)) for part in self._factors]
        other._surface_response = single(self._surface_response)
        return other

    def right_side(self, forces: Real, thickness_stress: Real, volume_excess: Real) -> RightSide:
        """Return the right-hand side for loads on nodes and points, thickness and volume condensed.

        Parameters
        ----------
        forces : ndarray, shape (2, rows + 1, columns)
            N per mm of thickness.
        thickness_stress : ndarray, shape (1 or 0, points, rows, columns)
            T, change of C_zz S_zz, MPa.
        volume_excess : ndarray, shape (points or 1, rows, columns)
            e, dimensionless.
        """
        right = RightSide(node_harmonics(self._finite.layers, forces), [], [])
        for layer, known in zip(self._finite.layers, self._layers, strict=True):
            thickness = fft.rfft(layer.of(thickness_stress), axis=-1)
            volume = fft.rfft(layer.of(volume_excess), axis=-1)
            if len(thickness):
                volume = (
                    volume + cell_mean(self._finite, known.volume_of_thickness * thickness)[0]
                ) / known.volume_stiffness
            pushed = (known.force_of_volume * volume).sum(axis=1)  # (level and component, row, harmonic)
            if len(thickness):
                pushed += (known.force_of_thickness * thickness[0]).sum(axis=1)
                thickness = known.thickness_compliance * thickness - known.thickness_of_volume * volume
            below, above = slice(layer.rows.start, layer.rows.stop), slice(layer.rows.start + 1, layer.rows.stop + 1)
            if layer.share > 1:
                pushed *= layer.share  # sums over fewer points
            right.force[:, below, : layer.harmonics] -= pushed[:2]
            right.force[:, above, : layer.harmonics] -= pushed[2:]
            right.thickness.append(thickness)
            right.volume.append(volume)
        return right

    def surface(self, right: RightSide) -> Real:
        """Return u_x and u_y at the surface under a load, without the means that are held.

        By reciprocity: the surface rows of the inverse are the answers of the transposed system to unit forces there.

        Returns
        -------
        ndarray, shape (2, columns)
            mm.
        """
        force = np.where(self._held(), 0.0, right.force.transpose(2, 1, 0).reshape(self._harmonics, -1))
        spectrum = np.einsum("cnj,nj->cn", self._surface_response.reshape(2, self._harmonics, -1), force)
        answer: Real = fft.irfft(spectrum, self._finite.block.columns, axis=-1)
        return answer

    def solve(self, right: RightSide, contact: Real) -> Fields:
        """Return the fields under a load and contact forces.

        Parameters
        ----------
        right : RightSide
        contact : ndarray, shape (2, columns)
            Forces on the surface nodes, N per mm of thickness.
        """
        force = right.force.copy()
        force[:, 0] += fft.rfft(contact, axis=-1)
        ordered = np.where(self._held(), 0.0, force.transpose(2, 1, 0).reshape(self._harmonics, -1))
        spectrum = self._solve(ordered).transpose(2, 1, 0)
        if not self._finite.history.anchored:
            spectrum[0, :, 0] -= spectrum[0, 0, 0]
        layers, thickness, volume = self._finite.layers, [], []
        for number, (layer, known) in enumerate(zip(layers, self._layers, strict=True)):
            nodes = spectrum[:, layer.rows.start : layer.rows.stop + 1, : layer.harmonics]
            corners = np.concatenate((nodes[:, :-1], nodes[:, 1:]))[:, None]
            if layer.share > 1:
                corners /= layer.share
            dilatation = (known.volume_of_displacement * corners).sum(axis=0)
            volume.append(fft.irfft(right.volume[number] + dilatation, layer.columns, axis=-1))
            caused = right.thickness[number]
            if len(caused):
                caused = caused - (known.thickness_of_displacement * corners).sum(axis=0)
                caused -= known.thickness_of_volume * dilatation
            thickness.append(fft.irfft(caused, layer.columns, axis=-1))
        return Fields(node_fields(layers, spectrum), gathered(thickness), gathered(volume))

    def _solve(self, right: Complex, transposed: bool = False) -> Complex:
        """Solve for all harmonics, (n, unknowns of a harmonic) -> (n, rows + 1, 2)."""
        answer = np.zeros((self._harmonics, self._finite.block.rows + 1, 2), dtype=right.dtype)
        solver = lapack.cgbtrs if right.dtype == np.complex64 else lapack.zgbtrs
        for part in self._factors:
            size = 2 * (part.rows + 1)
            sought = right[part.harmonics, :size].reshape(-1)
            found, info = solver(part.factors, _BAND, _BAND, sought, part.pivots, trans=1 if transposed else 0)
            if info:
                raise ValueError(f"gbtrs: argument {-info} has an illegal value")
            if len(self._factors) == 1:
                return np.asarray(found).reshape(answer.shape)
            answer[part.harmonics, : part.rows + 1] = np.asarray(found).reshape(-1, part.rows + 1, 2)
        return answer

    def _unit(self, component: int, transposed: bool = False) -> Complex:
        """Return the response to a unit force at the surface, for all harmonics, (n, rows + 1, 2)."""
        right = np.zeros((self._harmonics, 2 * (self._finite.block.rows + 1)), dtype=complex)
        right[:, component] = 1.0
        right[self._held()] = 0.0
        return self._solve(right, transposed)

    def _held(self) -> Flags:
        """Flag the unknowns that are held: harmonics of u_x at the top, and the mean of u_y at the surface."""
        held = np.zeros((self._harmonics, 2 * (self._finite.block.rows + 1)), dtype=bool)
        held[:, -2] = True
        held[0, 1] = True
        return held

    def _factorise(self, cells: list[Complex], pressure: float) -> list[_Factors]:
        """Assemble the cells of the layers, (4, 4, rows, n), to one banded matrix after another, and factorise them.

        Harmonics that the layer above does not resolve end, free, with the last row of nodes of their own.
        """
        layers, found, first = self._finite.layers, [], 0
        for last in reversed(range(len(layers))):
            harmonics, rows = slice(first, layers[last].harmonics), layers[last].rows.stop
            first = harmonics.stop
            size, middle = 2 * (rows + 1), 2 * _BAND
            band = np.zeros((3 * _BAND + 1, harmonics.stop - harmonics.start, size), dtype=complex)
            for layer, parts in zip(layers[: last + 1], cells, strict=False):
                low, high = 2 * layer.rows.start, 2 * layer.rows.stop
                for a in range(4):
                    for b in range(4):
                        band[middle + a - b, :, low + b : high + b : 2] += parts[a, b, :, harmonics].T
            turning = 1j * pressure * self._finite.turn[harmonics].imag
            band[middle - 1, :, 1] += turning
            band[middle + 1, :, 0] -= turning
            top, mean = (slice(None), size - 2), (slice(0, 1), 1)
            for which, held in (top, mean) if last == len(layers) - 1 else ():
                for other in range(max(0, held - _BAND), min(size, held + _BAND + 1)):
                    band[middle + held - other, which, other] = 0.0
                    band[middle + other - held, which, held] = 0.0
                band[middle, which, held] = 1.0
            factors, pivots, info = lapack.zgbtrf(band.reshape(3 * _BAND + 1, -1), _BAND, _BAND)
            if info:
                raise np.linalg.LinAlgError("singular averaged stiffness")
            found.append(_Factors(harmonics, rows, factors, pivots))
        return found
