"""The linearised balance of forces at given contact nodes: of fields and of the pressures of the road.

The averaged block preconditions it, T at these contact nodes. Under contacts rubber is several times as stiff as its
average along the road, so that forces and fields are scaled by s**-1/2 before and after, s being local stiffness over
its average: D (D K D)~^-1 D in place of K~^-1, ~ for the average. GMRES then takes a third fewer iterations.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, FiniteBlock, Stiffness
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact, SlopedSurface

# The local stiffness counts as no less than this share of its average.
_SOFTEST = 0.05
# The scale that leaves the preconditioner to T, for directions that are easily found.
EVEN = Fields(np.ones((1, 1)), np.ones((1, 1)), np.ones((1, 1)))


def scaling(finite: FiniteBlock, stiffness: Stiffness, harmonic: int) -> Fields:
    """Return s**-1/2 of the displacement, the thickness and the volume ratio; that of the latter is inverted.

    Local stiffness is the trace of dP/dF, with the branches as a harmonic of the road sees them. A volume ratio is a
    pressure over the bulk modulus, and pressures are forces.

    Parameters
    ----------
    finite : FiniteBlock
    stiffness : Stiffness
        The full tangent.
    harmonic : int
        The finest wave of the road.

    Returns
    -------
    Fields
        Dimensionless; the displacement's has the shape (rows + 1, columns), the thickness's that of one field.
    """
    kernel = finite.shear_kernel
    branches = np.abs(kernel[min(harmonic, len(kernel) - 1)])
    stiff = np.empty_like(stiffness.state.deformation.area)
    for rows in finite.row_slices():
        points = stiffness.tangent(rows)
        relaxing = np.einsum("ij...,ji...->...", points.by_driving[:4], points.inverse[:, :4])
        stiff[:, rows] = np.einsum("ii...->...", points.local[:4, :4]) - branches * relaxing
    cells, nodes = np.empty((1, *finite.shape)), np.ones((finite.shape[0] + 1, finite.block.columns))
    for layer in finite.layers:
        local = layer.of(stiff)
        local[:] = np.maximum(local / local.mean(axis=-1, keepdims=True), _SOFTEST)
        layer.of(cells)[:] = local.mean(axis=0)
        columns = layer.of(cells)[0]
        columns = 0.5 * (columns + np.roll(columns, 1, axis=1))
        layer.nodes_of(nodes)[:-1] = 0.5 * (columns[1:] + columns[:-1])
        if layer.rows.start == 0:
            nodes[0] = columns[0]
        if layer.rows.stop < finite.block.rows:  # the top moves as a whole
            layer.nodes_of(nodes)[-1] = columns[-1]
    volume = stiff if finite.block.pointwise else cells
    return Fields(nodes**-0.5, stiff**-0.5, volume**0.5)


class Linearised:
    """The linearised balance, preconditioned, while given contact nodes stay on the road and no other node touches it.

    Parameters
    ----------
    problem : SlidingContact
    finite : FiniteBlock
        The block of the problem, which with the next two may be in single precision.
    circulant : Circulant
        Of T.
    stiffness : Stiffness
        The full tangent.
    correction : Correction
        T at the fields about which it is linearised.
    load : Load
    touching : ndarray of bool, shape (columns,)
        The contact nodes.
    scale : Fields
        From ``scaling``, or ``EVEN``.

    Attributes
    ----------
    precision : dtype
        Of the steps that ``change`` takes.

    Raises
    ------
    numpy.linalg.LinAlgError
        Where the contact nodes leave the block loose.
    """

    def __init__(
        self,
        problem: SlidingContact,
        finite: FiniteBlock,
        circulant: Circulant,
        stiffness: Stiffness,
        correction: Correction,
        load: Load,
        touching: Flags,
        scale: Fields,
    ) -> None:
        self._problem, self._finite, self._circulant, self._stiffness = problem, finite, circulant, stiffness
        self._correction, self._load, self._even = correction, load, scale is EVEN
        self.precision = stiffness.curvature.dtype
        self._scale = scale.astype(self.precision)
        self._normal = correction.normal
        self._width = width = problem.finite.block.column_width
        # The normal turns as nodes move along the road: a stiffness of the surface.
        self._turning = correction.contact.pressure * width * load.curvature(correction.position)
        self._touching = touching
        self._inside = np.flatnonzero(touching)
        count = len(self._inside)
        saddle = np.ones((count + 1, count + 1))
        surface = SlopedSurface(circulant.compliance, correction.slope, width)
        softness = np.broadcast_to(scale.displacement[0], len(touching))[self._inside]
        saddle[:count, :count] = surface.matrix(self._inside)
        saddle[:count, :count] *= softness[:, None] * softness
        saddle[count, count] = 0.0
        self._saddle = lu_factor(saddle, check_finite=False, overwrite_a=True)

    def rest(self) -> tuple[Fields, Real]:
        """Return what the preconditioner makes of unbalanced forces, and the pressures of the road, MPa, with it."""
        known, load = self._correction, self._load
        if self._even and np.array_equal(known.contact.touching, self._touching):
            return known.step, known.contact.pressure
        # Only what the pressures of T leave unbalanced, which is small, goes into single precision.
        balancing = np.where(self._touching, known.contact.pressure, 0.0)
        forces = -self._problem.finite.forces(known.state.stress[:4])
        forces[1, -1] -= self._problem.finite.top_load(load.pressure)
        forces[:, 0] += self._normal * balancing * self._width
        loads = Fields(forces, -known.state.stress[4:], -known.state.volume_excess).astype(self.precision)
        unbalanced = loads.displacement, loads.log_thickness, loads.volume
        total = load.pressure * len(self._touching) - float(balancing.sum())
        step, change = self._preconditioned(*unbalanced, -known.above, total)
        return step, balancing + change

    def change(self, step: Fields) -> tuple[Fields, Real]:
        """Return what the preconditioner makes of the change under a step, and minus the pressures with it."""
        change, excess = self._finite.change(self._stiffness, step)
        forces = self._finite.forces(change[:4])
        forces[0, 0] += self._turning * step.displacement[0, 0]
        # Contact forces keep the contact nodes at their distance from the road, and carry no more than before.
        answer, pressure = self._preconditioned(forces, change[4:], excess, self.along_normals(step), 0.0)
        return answer, -pressure

    def _preconditioned(
        self, forces: Real, thickness_stress: Real, volume_excess: Real, distance: Real, total: float
    ) -> tuple[Fields, Real]:
        """Return fields that answer to loads, and pressures, MPa, of some sum that move the contact nodes as asked.

        Parameters
        ----------
        forces, thickness_stress, volume_excess : ndarray
            As for ``Circulant.right_side``.
        distance : ndarray, shape (columns,)
            Way of the contact nodes along the normals, mm.
        total : float
            MPa.
        """
        scale, circulant = self._scale, self._circulant
        at_road = scale.displacement[0]
        right = circulant.right_side(
            forces * scale.displacement, thickness_stress * scale.log_thickness, volume_excess * scale.volume
        )
        free = at_road * (self._normal * circulant.surface(right)).sum(axis=0)
        pressure, offset = self._held((distance - free)[self._inside], total)
        slope = self._correction.slope
        found = self._problem.yielding(circulant, right, slope, pressure * at_road, 0.0)
        displacement = found.displacement * scale.displacement
        displacement[1] += offset
        if not self._problem.finite.history.anchored:
            displacement[0] -= displacement[0, 0].mean()
        return Fields(displacement, found.log_thickness * scale.log_thickness, found.volume * scale.volume), pressure

    def along_normals(self, step: Fields) -> Real:
        """Return how far a step takes the nodes from a road that is straight under them, mm, shape (columns,)."""
        moved: Real = (self._normal * step.displacement[:, 0]).sum(axis=0)
        return moved

    def _held(self, moved: Real, total: float) -> tuple[Real, float]:
        """Return pressures, MPa, of a given sum that move the contact nodes along the normals, and the offset, mm."""
        held = lu_solve(self._saddle, np.append(moved, total), check_finite=False)
        pressure = np.zeros(len(self._touching))
        pressure[self._inside] = held[:-1]
        return pressure, float(held[-1])
