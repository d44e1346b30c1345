"""The derivative of the sliding contact at given contact nodes: of fields and of the pressures of the road."""

from __future__ import annotations

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, Stiffness
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact, SlopedSurface


class Linearised:
    """The derivative of u - T(u) while given contact nodes stay on the road and no other node touches it.

    Parameters
    ----------
    problem : SlidingContact
    circulant : Circulant
        Of T.
    stiffness : Stiffness
        The full tangent.
    correction : Correction
        T at the fields about which it is linearised.
    load : Load
    touching : ndarray of bool, shape (columns,)
        The contact nodes.

    Raises
    ------
    numpy.linalg.LinAlgError
        Where the contact nodes leave the block loose.
    """

    def __init__(
        self,
        problem: SlidingContact,
        circulant: Circulant,
        stiffness: Stiffness,
        correction: Correction,
        load: Load,
        touching: Flags,
    ) -> None:
        self._problem, self._circulant, self._stiffness = problem, circulant, stiffness
        self._correction, self._load = correction, load
        self._normal = correction.normal
        self._width = width = problem.finite.block.column_width
        # The normal turns as nodes move along the road: a stiffness of the surface.
        self._turning = correction.contact.pressure * width * load.curvature(correction.position)
        self._touching = touching
        self._inside = np.flatnonzero(touching)
        count = len(self._inside)
        saddle = np.ones((count + 1, count + 1))
        surface = SlopedSurface(circulant.compliance, correction.slope, width)
        saddle[:count, :count] = surface.matrix(self._inside)
        saddle[count, count] = 0.0
        self._saddle = lu_factor(saddle, check_finite=False)

    def rest(self) -> tuple[Fields, Real]:
        """Return T(u) - u with these contact nodes, and the pressures of the road, MPa, that go with it."""
        known = self._correction
        if np.array_equal(known.contact.touching, self._touching):
            return known.step, known.contact.pressure
        total = self._load.pressure * len(self._touching)
        pressure, offset = self._held(-known.height[self._inside], total)
        return self._problem.yielding(self._circulant, known.right, known.slope, pressure, offset), pressure

    def change(self, step: Fields) -> tuple[Fields, Real]:
        """Return the change of u - T(u) under a change of u, and that of the pressures of the road, MPa."""
        finite, circulant = self._problem.finite, self._circulant
        change, excess = finite.change(self._stiffness, step)
        forces = finite.forces(change[:4])
        forces[0, 0] += self._turning * step.displacement[0, 0]
        right = circulant.right_side(forces, change[4:], excess)
        # Contact forces keep the contact nodes at their distance from the road, and carry no more than before.
        missed = (self._normal * (step.displacement[:, 0] - circulant.surface(right))).sum(axis=0)[self._inside]
        pressure, offset = self._held(missed, 0.0)
        answer = self._problem.yielding(circulant, right, self._correction.slope, pressure, offset)
        return answer, -pressure

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
