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
        slope = _slope(finite)
        weighed = slope.conj() * finite.weights
        volume = stiffness.points.volume.mean(axis=-1)[..., None]
        bulk = stiffness.curvature.mean(axis=-1)[..., None] + finite.bulk_kernel
        moduli = _moduli(finite, stiffness)
        pressed, swollen = volume, volume
        self._stiffening: Complex | float = 1.0
        if finite.unknowns == 5:
            # At constant volume every point finds its thickness alone; volume then follows from both.
            self._yield = 1.0 / moduli[4, 4]
            give, take = moduli[:4, 4] * self._yield, moduli[4, :4] * self._yield
            self._thickness, self._thickness_force = _caused(take, slope), _caused(give, weighed)
            self._swelling, self._volume_thickness = volume[4] * bulk * self._yield, volume[4] * self._yield
            self._stiffening = 1.0 + bulk * self._felt((volume[4] * self._volume_thickness)[None])[0]
            pressed, swollen = volume[:4] - give * volume[4], volume[:4] - take * volume[4]
            moduli = moduli[:4, :4] - give[:, None] * moduli[4, :4]
        # The volume ratio that displacements cause, and the forces of a volume ratio that they do not.
        self._dilatation = self._felt(_caused(swollen, slope)) / self._stiffening
        self._volume_force = _caused(pressed, weighed)
        if not finite.block.pointwise:
            self._volume_force = self._volume_force.sum(axis=1, keepdims=True)
        self._volume_force = self._volume_force * bulk
        cells = _cells(moduli, slope, weighed) + (self._dilatation * self._volume_force[:, None]).sum(axis=2)
        self._factors, self._pivots = self._factorise(cells, pressure)
        self._surface = np.stack([self._unit(component, transposed=True) for component in (0, 1)])
        self.compliance: Complex = np.stack([self._unit(component)[:, 0].T for component in (0, 1)], axis=1)
        self.compliance[..., -1] = self.compliance[..., -1].real
        if not finite.past.anchored:
            self.compliance[..., 0] = self._surface[:, 0] = 0.0

    def right_side(self, forces: Real, thickness_stress: Real, volume_excess: Real) -> RightSide:
        """Return the load of nodal forces, N per mm, of stresses C_zz S_zz, MPa, and of an excess of volume."""
        force = fft.rfft(forces, axis=-1)
        thickness = fft.rfft(thickness_stress, axis=-1)
        volume = fft.rfft(volume_excess, axis=-1)
        if len(thickness):
            volume = (volume + self._felt(self._volume_thickness * thickness)[0]) / self._stiffening
        pushed = (self._volume_force * volume).sum(axis=1)  # (level and component, row, harmonic)
        if len(thickness):
            pushed += (self._thickness_force * thickness[0]).sum(axis=1)
            thickness = self._yield * thickness - self._swelling * volume
        force[:, :-1] -= pushed[:2]
        force[:, 1:] -= pushed[2:]
        return RightSide(force, thickness, volume)

    def surface(self, right: RightSide) -> Real:
        """Return u_x and u_y at the surface, mm, shape (2, columns), without the means that are held."""
        force = np.where(self._held(), 0.0, right.force.transpose(2, 1, 0).reshape(self._harmonics, -1))
        spectrum = np.einsum("cnj,nj->cn", self._surface.reshape(2, self._harmonics, -1), force)
        answer: Real = fft.irfft(spectrum, self._finite.block.columns, axis=-1)
        return answer

    def solve(self, right: RightSide, contact: Real) -> Fields:
        """Return the fields under a load and nodal forces at the surface, N per mm, shape (2, columns)."""
        force = right.force.copy()
        force[:, 0] += fft.rfft(contact, axis=-1)
        ordered = np.where(self._held(), 0.0, force.transpose(2, 1, 0).reshape(self._harmonics, -1))
        spectrum = self._solve(ordered).transpose(2, 1, 0)
        if not self._finite.past.anchored:
            spectrum[0, :, 0] -= spectrum[0, 0, 0]
        corners = np.concatenate((spectrum[:, :-1], spectrum[:, 1:]))[:, None]
        dilatation = (self._dilatation * corners).sum(axis=0)
        volume, thickness = right.volume + dilatation, right.thickness
        if len(thickness):
            thickness = thickness - (self._thickness * corners).sum(axis=0) - self._swelling * dilatation
        columns = self._finite.block.columns
        return Fields(*(fft.irfft(field, columns, axis=-1) for field in (spectrum, thickness, volume)))

    def _felt(self, points: Complex) -> Complex:
        """Return what the volume of a cell feels of its points, which stand along the second axis."""
        return points if self._finite.block.pointwise else points.mean(axis=1, keepdims=True)

    def _solve(self, right: Complex, transposed: bool = False) -> Complex:
        """Solve for all harmonics, (n, unknowns of a harmonic) -> (n, rows + 1, 2)."""
        answer, info = lapack.zgbtrs(
            self._factors, _BAND, _BAND, right.reshape(-1), self._pivots, trans=1 if transposed else 0
        )
        assert info == 0
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


def _moduli(finite: FiniteBlock, stiffness: Stiffness) -> Complex:
    """Return the averaged moduli of all harmonics at constant volume, MPa, (m, m, points, rows, n)."""
    points = stiffness.points
    local, give, take = (part.mean(axis=-1) for part in (points.local, points.by_driving, points.inverse))
    past = np.einsum("ijpr,jkpr->ikpr", give, take)
    moduli: Complex = past[..., None] * -finite.shear_kernel
    moduli += local[..., None]
    return moduli


def _slope(finite: FiniteBlock) -> Complex:
    """Return d/dx and d/dy of harmonics, 1/mm, (2, 2, points, rows, n), from a lower and an upper row of nodes."""
    turn = np.exp(2j * np.pi / finite.block.columns * finite.block.harmonics)
    nodes = finite.quadrature.gradients.transpose(3, 2, 1, 0)[..., None]  # (derivative, node, point, row, 1)
    slope: Complex = nodes[:, 0::2] + nodes[:, 1::2] * turn
    return slope


def _caused(weight: Complex | Real, slope: Complex) -> Complex:
    """Return what u_x and u_y of the lower and the upper nodes cause through a weight on their gradients.

    The weight of the gradient's xx, xy, yx, yy comes first; what is beyond them does not count.
    Shape (4, points, rows, n), the upper nodes last.
    """
    parts = [
        weight[2 * component] * slope[0, level] + weight[2 * component + 1] * slope[1, level]
        for level in (0, 1)
        for component in (0, 1)
    ]
    return np.stack(parts)


def _cells(moduli: Complex, slope: Complex, weighed: Complex) -> Complex:
    """Return the stiffness of the cells, (4, 4, rows, n); nodes and components as in ``_caused``."""
    cells = np.empty((4, 4, *slope.shape[3:]), dtype=complex)
    for column in range(4):
        level, component = divmod(column, 2)
        stress = moduli[:, 2 * component] * slope[0, level]
        stress += moduli[:, 2 * component + 1] * slope[1, level]
        cells[:, column] = _caused(stress, weighed).sum(axis=1)
    return cells
