"""The nearest block that is the same everywhere along the road: a direct solver for it.

Averaged along the road, the tangent of a deformed block is block circulant: one banded system in y per harmonic,
with the complex moduli of its frequency. It is exact for a block pressed on a flat road, and close enough for
one on a rough road that a handful of Krylov iterations make up the difference.

Harmonics are those of the real Fourier transform, 0 to columns / 2. The mean u_y of the surface is held: what the block
rises by follows from the load. So is its mean u_x in steady sliding, where it does not matter where along the road
the block is; where that matters, its top is held.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import fft
from scipy.linalg import lapack

from rubfric.arrays import Complex, Flags, Real, Whole
from rubfric.mechanics.finite.block import Fields, FiniteBlock, Stiffness
from rubfric.mechanics.finite.condensation import Condensed, cell_mean, condensed

# Unknowns of a row couple with those of the rows beside it: diagonals on either side of the main one.
_BAND = 3


@dataclass(frozen=True)
class RightSide:
    """What the block answers to, in harmonic space, thickness and volume eliminated.

    Attributes
    ----------
    force : ndarray of complex, shape (2, rows + 1, n)
        N per mm of thickness.
    thickness : ndarray of complex, shape (1 or 0, points, rows, n)
        Logarithm of the thickness stretch that it causes in a block whose nodes are held.
    volume : ndarray of complex, shape (points or 1, rows, n)
        Volume ratio that it causes there.
    """

    force: Complex
    thickness: Complex
    volume: Complex


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
        parts = [condensed(finite, stiffness, rows) for rows in finite.row_slices()]
        whole = Condensed(*(np.concatenate(arrays, axis=-2) for arrays in zip(*parts, strict=True)))
        del parts
        self._thickness_compliance, self._volume_stiffness = whole.thickness_compliance, whole.volume_stiffness
        self._thickness_of_displacement = whole.thickness_of_displacement
        self._force_of_thickness, self._force_of_volume = whole.force_of_thickness, whole.force_of_volume
        self._volume_of_thickness, self._thickness_of_volume = whole.volume_of_thickness, whole.thickness_of_volume
        self._volume_of_displacement = whole.volume_of_displacement
        cells = whole.cells
        del whole
        self._factors, self._pivots = self._factorise(cells, pressure)
        self._surface_response = np.stack([self._unit(component, transposed=True) for component in (0, 1)])
        self.compliance: Complex = np.stack([self._unit(component)[:, 0].T for component in (0, 1)], axis=1)
        self.compliance[..., -1] = self.compliance[..., -1].real
        if not finite.history.anchored:
            self.compliance[..., 0] = self._surface_response[:, 0] = 0.0

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
        force = fft.rfft(forces, axis=-1)
        thickness = fft.rfft(thickness_stress, axis=-1)
        volume = fft.rfft(volume_excess, axis=-1)
        if len(thickness):
            volume = (
                volume + cell_mean(self._finite, self._volume_of_thickness * thickness)[0]
            ) / self._volume_stiffness
        pushed = (self._force_of_volume * volume).sum(axis=1)  # (level and component, row, harmonic)
        if len(thickness):
            pushed += (self._force_of_thickness * thickness[0]).sum(axis=1)
            thickness = self._thickness_compliance * thickness - self._thickness_of_volume * volume
        force[:, :-1] -= pushed[:2]
        force[:, 1:] -= pushed[2:]
        return RightSide(force, thickness, volume)

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
        corners = np.concatenate((spectrum[:, :-1], spectrum[:, 1:]))[:, None]
        dilatation = (self._volume_of_displacement * corners).sum(axis=0)
        volume, thickness = right.volume + dilatation, right.thickness
        if len(thickness):
            thickness = thickness - (self._thickness_of_displacement * corners).sum(axis=0)
            thickness -= self._thickness_of_volume * dilatation
        columns = self._finite.block.columns
        return Fields(*(fft.irfft(field, columns, axis=-1) for field in (spectrum, thickness, volume)))

    def _solve(self, right: Complex, transposed: bool = False) -> Complex:
        """Solve for all harmonics, (n, unknowns of a harmonic) -> (n, rows + 1, 2)."""
        answer, info = lapack.zgbtrs(
            self._factors, _BAND, _BAND, right.reshape(-1), self._pivots, trans=1 if transposed else 0
        )
        if info:
            raise ValueError(f"zgbtrs: argument {-info} has an illegal value")
        return np.asarray(answer).reshape(self._harmonics, -1, 2)

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

    def _factorise(self, cells: Complex, pressure: float) -> tuple[Complex, Whole]:
        """Assemble the cells, shape (4, 4, rows, n), to one banded matrix after another, and factorise them."""
        rows = cells.shape[2]
        size, middle = 2 * (rows + 1), 2 * _BAND
        band = np.zeros((3 * _BAND + 1, self._harmonics, size), dtype=complex)
        for a in range(4):
            for b in range(4):
                band[middle + a - b, :, b : b + 2 * rows : 2] += cells[a, b].T
        turning = 1j * pressure * np.sin(2.0 * np.pi / self._finite.block.columns * self._finite.block.harmonics)
        band[middle - 1, :, 1] += turning
        band[middle + 1, :, 0] -= turning
        for harmonics, held in ((slice(None), size - 2), (slice(0, 1), 1)):
            for other in range(max(0, held - _BAND), min(size, held + _BAND + 1)):
                band[middle + held - other, harmonics, other] = 0.0
                band[middle + other - held, harmonics, held] = 0.0
            band[middle, harmonics, held] = 1.0
        factors, pivots, info = lapack.zgbtrf(band.reshape(3 * _BAND + 1, -1), _BAND, _BAND)
        if info:
            raise np.linalg.LinAlgError("singular averaged stiffness")
        return factors, pivots
