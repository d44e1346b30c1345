"""The contact of a finitely deformed block with the road, linearised: forces, gaps and one exact contact solve.

Let T map fields to those that the block-circulant stiffness and a complementarity solve along the deformed road
make of them: forces in balance, no node below the road, no tension. The fixed point of T solves the contact
problem, and T(u) - u measures by how far fields miss both balance and contact.

The contact is that of the deformed surface: a node is where it has moved to, X + u_x, and the frictionless
road pushes along its normal there. The pressure on the top is a dead load.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rubfric.arrays import Complex, Flags, Real, Whole
from rubfric.errors import NotConverged
from rubfric.mechanics.block.contact import Contact, even_contact, follow, pivot
from rubfric.mechanics.block.surface import inverse
from rubfric.mechanics.finite.block import Fields, FiniteBlock, Stressed
from rubfric.mechanics.finite.circulant import Circulant, RightSide
from rubfric.road.road import Road, finest_waves

# A change of volume counts for so much less than one of thickness: rubber yields to it so much less.
_VOLUME = 0.03
# On a flat road displacements count by this share of its period instead of the amplitude.
_FLAT = 1e-7
# A linearised contact that takes more pivots is that of fields too far off: rarely one has a solution.
_MOST_PIVOTS = 100
# Where they cycle, on a road of one wave: all pivots on the way from an even contact.
_MOST_PIVOTS_ALONG = 1000


@dataclass(frozen=True)
class Load:
    """What acts on a block that stays where it is: a share of a road that goes past, and a pressure on its top.

    Parameters
    ----------
    road : Road
    pressure : float
        Nominal pressure p, MPa.
    offset : float
        How far the road has gone past, mm.
    share : float
        Height of the road over that which it has, dimensionless.
    """

    road: Road
    pressure: float
    offset: float = 0.0
    share: float = 1.0

    def height(self, position: Real) -> Real:
        """Return the height of the road, mm, at positions of the block in mm."""
        return self.share * self.road.height(position + self.offset)

    def slope(self, position: Real) -> Real:
        """Return the slope of the road, dimensionless, at positions of the block in mm."""
        return self.share * self.road.slope(position + self.offset)

    def curvature(self, position: Real) -> Real:
        """Return the curvature of the road, 1/mm, at positions of the block in mm."""
        return self.share * self.road.curvature(position + self.offset)


def measures(road: Road) -> tuple[float, float]:
    """Return the displacement, mm, and the relative change of thickness that count as one on a road."""
    return max(math.hypot(*road.waves.amplitudes), _FLAT * road.period), max(road.steepest_slope, 2.0 * math.pi * _FLAT)


@dataclass(frozen=True)
class Correction:
    """What T makes of fields.

    Attributes
    ----------
    step : Fields
        T(u) - u.
    contact : Contact
        Contact pressure (vertical force per column width, MPa), and gap above the road where nodes are.
    position, slope : ndarray, shape (columns,)
        Where the surface nodes are, x in mm, and the road's slope there.
    state : Stressed
        The state of the points under the fields.
    right : RightSide
        What the block answers to beside the road.
    above, height : ndarray, shape (columns,)
        Height of the nodes above the road, mm, and that to which T's answer to ``right`` takes them, but for an offset.
    """

    step: Fields
    contact: Contact
    position: Real
    slope: Real
    state: Stressed
    right: RightSide
    above: Real
    height: Real

    @property
    def normal(self) -> Real:
        """Normal of the road where nodes are, of unit height, shape (2, columns)."""
        return np.stack((-self.slope, np.ones_like(self.slope)))


class SlopedSurface:
    """The surface of the block where the road pushes along its normals: compliance against vertical pressure."""

    def __init__(self, compliance: Complex, slope: Real, column_width: float) -> None:
        self._compliance = compliance * column_width
        self._kernel = np.fft.irfft(self._compliance, len(slope), axis=-1)
        self._normal = np.stack((-slope, np.ones_like(slope)))

    def matrix(self, inside: Whole) -> Real:
        """Return the compliance among the nodes ``inside``, mm/MPa."""
        lag = inside[:, None] - inside[None, :]
        (along, up), kernel = self._normal[:, inside], self._kernel
        by_height = along[:, None] * kernel[0, 1][lag]
        by_height += up[:, None] * kernel[1, 1][lag]
        by_height *= up
        matrix: Real = along[:, None] * kernel[0, 0][lag]
        matrix += up[:, None] * kernel[1, 0][lag]
        matrix *= along
        matrix += by_height
        return matrix

    def deflection(self, pressure: Real) -> Real:
        """Return how far the surface yields along the normals, mm."""
        force = np.fft.rfft(self._normal * pressure, axis=-1)
        moved = np.einsum("abn,bn->an", self._compliance, force)
        answer: Real = (self._normal * np.fft.irfft(moved, len(pressure), axis=-1)).sum(axis=0)
        return answer

    def pressing(self, deflection: Real) -> Real:
        """Return about the pressure that makes a deflection: as if the surface were as soft one way as the other."""
        steepness, inverted = self._inverse
        return np.fft.irfft(inverted * np.fft.rfft(deflection / steepness), len(deflection)) / steepness

    @cached_property
    def _inverse(self) -> tuple[Real, Complex]:
        """Length of the normals, and the spectrum of the inverse of the mean compliance, MPa/mm."""
        normal = self._normal
        mean = 0.5 * (self._compliance[0, 0] + self._compliance[1, 1])
        return np.hypot(*normal), inverse(mean, normal.shape[1])


class SlidingContact:
    """The contact problem of one block; what continuation varies is in the arguments.

    Parameters
    ----------
    finite : FiniteBlock
    scale : tuple of float
        Displacement, mm, and relative change of thickness that count as one in the measure of ``size``.
    label : str
        Name that errors carry.

    Attributes
    ----------
    height : float
        The displacement that counts as one, mm.
    """

    def __init__(self, finite: FiniteBlock, scale: tuple[float, float], label: str) -> None:
        self.finite = finite
        self.label = label
        self.height = scale[0]
        self._scale = (float(scale[0]), float(scale[1]), float(_VOLUME * scale[1]))
        rest = finite.at_rest()
        self._shapes = (rest.displacement.shape, rest.log_thickness.shape, rest.volume.shape)
        self._ends = np.cumsum([rest.displacement.size, rest.log_thickness.size])

    def correct(self, circulant: Circulant, fields: Fields, load: Load, touching: Flags) -> Correction:
        """Return T(u) - u and the contact that goes with it.

        Parameters
        ----------
        circulant : Circulant
            The averaged tangent.
        fields : Fields
        load : Load
        touching : ndarray of bool, shape (columns,)
            First guess of the contact nodes.

        Raises
        ------
        rubfric.mechanics.finite.law.Inverted
            Where the fields turn a point inside out.
        rubfric.errors.NotConverged
            Where the linearised contact has no solution.
        """
        finite = self.finite
        width = finite.block.column_width
        state = finite.stressed(fields)
        forces = finite.forces(state.stress[:4])
        forces[1, -1] += finite.top_load(load.pressure)
        right = circulant.right_side(-forces, -state.stress[4:], -state.volume_excess)
        free = circulant.surface(right)
        position = finite.block.column_positions + fields.displacement[0, 0]
        slope = load.slope(position)
        above = fields.displacement[1, 0] - load.height(position)
        height = above - slope * free[0] + free[1]
        surface = SlopedSurface(circulant.compliance, slope, width)
        try:
            contact = pivot(surface, -height, load.pressure, touching, self.label, _MOST_PIVOTS)
        except NotConverged as cycling:
            if not np.isfinite(cycling.residual) or finest_waves(load.road) > 1:
                raise
            near = even_contact(touching, load.pressure)
            contact = follow(surface, -height, load.pressure, near, self.label, _MOST_PIVOTS_ALONG)
        step = self.yielding(circulant, right, slope, contact.pressure, contact.offset)
        return Correction(step, contact, position, slope, state, right, above, height)

    def yielding(self, circulant: Circulant, right: RightSide, slope: Real, pressure: Real, offset: float) -> Fields:
        """Return what the averaged block does under a load, and under pressures of the road and a rigid offset.

        Parameters
        ----------
        circulant : Circulant
        right : RightSide
        slope, pressure : ndarray, shape (columns,)
            Of the road, dimensionless and MPa.
        offset : float
            mm.
        """
        normal = np.stack((-slope, np.ones_like(slope)))
        step = circulant.solve(right, normal * pressure * self.finite.block.column_width)
        step.displacement[1] += offset
        return step

    def size(self, step: Fields) -> float:
        """Return the root mean square of a step over its ``scale``."""
        packed = self.pack(step)
        return float(np.linalg.norm(packed) / np.sqrt(packed.size))

    def pack(self, step: Fields) -> Real:
        """Return a step as one dimensionless vector."""
        length, strain, volume = self._scale
        parts = (step.displacement / length, step.log_thickness / strain, step.volume / volume)
        return np.concatenate([part.ravel() for part in parts])

    def unpack(self, vector: Real) -> Fields:
        """Return the step that ``pack`` made a vector of."""
        parts = np.split(vector, self._ends)
        return Fields(
            *(scale * part.reshape(shape) for scale, part, shape in zip(self._scale, parts, self._shapes, strict=True))
        )
