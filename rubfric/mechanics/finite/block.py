"""The block in finite strain: forces and stiffness on the mesh, in steady sliding or at the end of a step of time.

In steady sliding every field is f(xi, Y) with xi = X + v t in the frame of the road, and material lines Y = const are
straight in the reference configuration. The history of a point is therefore the row of points upstream of it, and the
branch tensors of all branches together are one periodic convolution along the row: harmonic n sees the frequency
n k v. In a step of time they are a number times the state sought, and what is left of the state before.

The volume ratio is an unknown of its own, tied to the deformation by an equation of its own. Eliminated, it would
make the tangent as stiff as the bulk modulus along directions that turn with the deformation; kept, it leaves
Newton's method and Krylov iterations the same work for any Poisson's ratio up to 1/2.
"""

from __future__ import annotations

import copy
import dataclasses
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import DTypeLike

from rubfric.arrays import Complex, Real, single
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.law import (
    Deformation,
    Inverted,
    Tangent,
    deform,
    inverse_change,
    local_change,
    stress,
    tangent,
    volumetric_stress,
)
from rubfric.mechanics.finite.layers import Layer, restricted, spread, undivided
from rubfric.mechanics.finite.memory import BranchHistory, SteadyHistory, convolve, convolve_layers
from rubfric.mechanics.theory.compression import pressed
from rubfric.rubber.material import Material

# Points that are worked out at once: some hundred numbers each on the way, 50 MB. Fewer take more calls and more time.
_AT_ONCE = 65536
# Points up to which their tangents are held, which is faster to apply: 110 MB.
_HELD = 200_000


@dataclass(frozen=True)
class Fields:
    """What the solver looks for.

    Attributes
    ----------
    displacement : ndarray, shape (2, rows + 1, columns)
        u_x and u_y at the nodes, mm.
    log_thickness : ndarray, shape (1 or 0, points, rows, columns)
        Logarithm of the stretch across the thickness at the quadrature points; without entries in plane strain.
    volume : ndarray, shape (points, rows, columns) or (1, rows, columns)
        Volume ratio that the pressure follows from: at the points in plane stress, of the cells in plane strain.
    """

    displacement: Real
    log_thickness: Real
    volume: Real

    def moved(self, step: Fields, share: float = 1.0) -> Fields:
        """Return these fields plus a share of a step.

        Parameters
        ----------
        step : Fields
        share : float
        """
        return Fields(
            self.displacement + share * step.displacement,
            self.log_thickness + share * step.log_thickness,
            self.volume + share * step.volume,
        )

    def astype(self, precision: DTypeLike) -> Fields:
        """Return these fields in some precision."""
        return Fields(*(part.astype(precision, copy=False) for part in vars(self).values()))


@dataclass(frozen=True)
class Stressed:
    """The state of all quadrature points.

    Attributes
    ----------
    deformation : Deformation
        Shapes (..., points, rows, columns).
    driving : ndarray, shape (4, points, rows, columns)
        Q, MPa.
    volumetric : ndarray, shape of ``Fields.volume``
        U', MPa.
    stress : ndarray, shape (4 or 5, points, rows, columns)
        First Piola-Kirchhoff stress and, in plane stress, C_zz S_zz, MPa.
    volume_excess : ndarray, shape of ``Fields.volume``
        Volume ratio less that of the deformation; zero in a solution.
    """

    deformation: Deformation
    driving: Real
    volumetric: Real
    stress: Real
    volume_excess: Real


@dataclass(frozen=True)
class Stiffness:
    """The tangent at all quadrature points; on large meshes, where it would take the most memory, only its state.

    Attributes
    ----------
    state : Stressed
    curvature : ndarray, shape of ``Fields.volume``
        U'', MPa.
    held : Tangent, optional
        At all points.
    """

    state: Stressed
    curvature: Real
    held: Tangent | None = None

    def single(self) -> Stiffness:
        """Return it in single precision."""
        state = self.state
        deformation = Deformation(*map(single, vars(state.deformation).values()))
        others = (single(part) for name, part in vars(state).items() if name != "deformation")
        held = None if self.held is None else Tangent(*map(single, vars(self.held).values()))
        return Stiffness(Stressed(deformation, *others), single(self.curvature), held)

    def tangent(self, rows: slice) -> Tangent:
        """Return the tangent at the points of some rows of cells."""
        state = self.state
        if self.held is not None:
            return self.held.of_rows(rows)
        return tangent(state.deformation.of_rows(rows), state.driving[..., rows, :], state.volumetric[..., rows, :])


class FiniteBlock:
    """A meshed block of one rubber at one sliding speed; sliding steadily unless ``with_history`` says otherwise.

    Plane stress integrates dilatation pointwise; plane strain by its mean over each cell, where the pointwise form
    would lock.

    Parameters
    ----------
    block : Block
    material : Material
    velocity : float
        v, mm/s.
    layers : sequence of Layer, optional
        Rows that are worked out on fewer columns; none by default.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns of arrays of the points: those of the block, or fewer rows.
    weights : ndarray, shape (points, rows, 1) or (points, *shape)
        Area that points stand for, mm².
    """

    def __init__(
        self, block: Block, material: Material, velocity: float, layers: Sequence[Layer] | None = None
    ) -> None:
        self.block = block
        self.material = material
        self.velocity = velocity
        self.layers = undivided(block) if layers is None else tuple(layers)
        self.shape = self.layers[-1].stored.stop, block.columns
        self.quadrature = block.quadrature(centred=True)
        self.points = len(self.quadrature.shapes)
        self.weights = self.quadrature.weights.T[:, :, None]
        # From the four nodes of a cell to d/dx and d/dy at its points, and back with the weights.
        gradients = self.quadrature.gradients
        rows = block.rows
        self._to_points = np.ascontiguousarray(gradients.swapaxes(2, 3).reshape(rows, 2 * self.points, 4))
        weighed = gradients * self.quadrature.weights[:, :, None, None]
        self._to_nodes = np.ascontiguousarray(weighed.transpose(0, 2, 1, 3).reshape(rows, 4, 2 * self.points))
        if len(self.layers) > 1:
            own, self.weights = self.weights, np.empty((self.points, *self.shape))
            for layer in self.layers:
                layer.of(self.weights)[:] = layer.share * own[:, layer.rows]
                self._to_nodes[layer.rows] *= layer.share
        # One column along the road, for harmonics.
        self.turn = np.exp(2j * np.pi / block.columns * block.harmonics)
        self.frequencies = block.wavenumbers * velocity
        self.history: BranchHistory = SteadyHistory(material, self.frequencies, self.layers)

    def with_history(self, history: BranchHistory) -> FiniteBlock:
        """Return the same block with other branches' answers to a state."""
        other = copy.copy(self)
        other.history = history
        return other

    def single(self) -> FiniteBlock:
        """Return the same block, for ``change`` and ``forces`` in single precision."""
        other = self.with_history(self.history.single())
        other.turn = single(self.turn)
        other._to_points, other._to_nodes = single(self._to_points), single(self._to_nodes)
        return other

    @property
    def shear_kernel(self) -> Complex:
        """What the branches add to the long-term shear modulus of the harmonics, MPa, shape (n,)."""
        return self.history.shear_kernel

    @property
    def bulk_kernel(self) -> Complex:
        """What the branches add to the long-term bulk modulus of the harmonics, MPa, shape (n,)."""
        return self.history.bulk_kernel

    @property
    def contrast(self) -> float:
        """The largest modulus that a harmonic sees over the long-term shear modulus, dimensionless."""
        material = self.material
        bulk = material.long_term_bulk_modulus + np.abs(self.bulk_kernel).max()
        shear = material.long_term_shear_modulus + np.abs(self.shear_kernel).max()
        return float(max(bulk, shear) / material.long_term_shear_modulus)

    @property
    def unknowns(self) -> int:
        """Unknowns at a point: 5 in plane stress, 4 in plane strain."""
        return 5 if self.block.plane == "stress" else 4

    def at_rest(self) -> Fields:
        """Return the fields of the block as it was made."""
        block = self.block
        return Fields(
            np.zeros((2, self.shape[0] + 1, block.columns)),
            np.zeros((self.unknowns - 4, self.points, *self.shape)),
            np.ones((self.points if block.pointwise else 1, *self.shape)),
        )

    def pressed(self, pressure: float) -> Fields:
        """Return the fields of the relaxed block pressed on a flat road, by a nominal pressure in MPa."""
        stretch, thickness = pressed(self.material, pressure, self.block.plane)
        fields = self.at_rest()
        up = (stretch - 1.0) * self.block.row_positions[1:, None]
        for layer in self.layers:
            layer.nodes_of(fields.displacement[1])[:] = up[layer.rows]
        fields.log_thickness[:] = math.log(thickness)
        fields.volume[:] = stretch * thickness
        return fields

    def gradient(self, displacement: Real) -> Real:
        """Return the displacement gradient xx, xy, yx, yy at the points, shape (4, points, *shape)."""
        gradient = np.empty((4, self.points, *self.shape), dtype=displacement.dtype)
        top = displacement[:, :1]
        for layer in self.layers:
            nodes = displacement[:, : layer.stored.stop + 1]
            if layer.share > 1:
                nodes = np.concatenate((restricted(top, layer.columns), layer.nodes_of(displacement)), axis=1)
            rows, nodes = nodes.shape[1] - 1, nodes.swapaxes(0, 1)
            corners = np.empty((rows, 2, 2, 2, layer.columns), dtype=nodes.dtype)  # row, level, side, component
            corners[:, 0, 0], corners[:, 1, 0] = nodes[:-1], nodes[1:]
            if layer.share == 1:
                corners[:, :, 1, :, :-1], corners[:, :, 1, :, -1] = corners[:, :, 0, :, 1:], corners[:, :, 0, :, 0]
            else:
                right = convolve(layer.kernel(self.turn), nodes)
                corners[:, 0, 1], corners[:, 1, 1] = right[:-1], right[1:]
            slopes = self._to_points[layer.rows] @ corners.reshape(rows, 4, -1)
            # From (row, point, derivative, component, column).
            ordered = slopes.reshape(rows, self.points, 2, 2, layer.columns).transpose(3, 2, 1, 0, 4)
            layer.of(gradient).reshape(ordered.shape)[:] = ordered
            top = nodes[-1:].swapaxes(0, 1)
        return gradient

    def forces(self, stresses: Real) -> Real:
        """Return the nodal forces of first Piola-Kirchhoff stresses, N per mm of thickness, (2, rows + 1, columns)."""
        nodal = np.zeros((2, self.shape[0] + 1, self.block.columns), dtype=stresses.dtype)
        top = nodal[:, :1]
        for layer in self.layers:
            ordered = layer.of(stresses)
            rows = ordered.shape[-2]
            ordered = ordered.reshape(2, 2, self.points, rows, layer.columns).transpose(3, 2, 1, 0, 4)
            corners = self._to_nodes[layer.rows] @ ordered.reshape(rows, 2 * self.points, -1)
            corners = corners.reshape(rows, 4, 2, layer.columns).transpose(1, 2, 0, 3)
            nodes = nodal[:, : rows + 1] if layer.share == 1 else np.zeros((2, rows + 1, layer.columns), nodal.dtype)
            for level, part in ((0, nodes[:, :-1]), (2, nodes[:, 1:])):
                part += corners[level]
                if layer.share == 1:
                    part[..., 1:] += corners[level + 1][..., :-1]
                    part[..., 0] += corners[level + 1][..., -1]
                else:
                    part += convolve(layer.kernel(self.turn).conj(), corners[level + 1])
            if layer.share > 1:
                top += spread(nodes[:, :1], top.shape[-1])
                layer.nodes_of(nodal)[:] = nodes[:, 1:]
            top = layer.nodes_of(nodal)[:, -1:]
        return nodal

    def top_load(self, pressure: float) -> Real:
        """Return the forces of a nominal pressure in MPa on the uppermost stored row of nodes, shape (columns,)."""
        layer, forces = self.layers[-1], np.zeros(self.block.columns)
        forces[-layer.columns :] = layer.share * pressure * self.block.column_width
        return forces

    def stressed(self, fields: Fields) -> Stressed:
        """Return the state of the points under some fields.

        Raises
        ------
        Inverted
            Where a point is turned inside out, or its volume is not positive.
        """
        if not fields.volume.min() > 0.0:
            raise Inverted(f"smallest volume ratio is {fields.volume.min():.3g}")
        gradient = self.gradient(fields.displacement)
        gradient[0] += 1.0
        gradient[3] += 1.0
        state = deform(gradient, fields.log_thickness)
        driving = self.history.known_driving - self.history.shear(state.inverse)
        driving[[0, 1, 3]] += self.material.long_term_shear_modulus
        volumetric, _ = volumetric_stress(self.material.long_term_bulk_modulus, fields.volume)
        if self.history.bulk_relaxes:
            volumetric = volumetric + self.history.bulk(fields.volume) + self.history.known_pressure
        excess = fields.volume - self.dilatation(state.volume)
        return Stressed(state, driving, volumetric, stress(state, driving, volumetric), excess)

    def stiffness(self, fields: Fields, state: Stressed) -> Stiffness:
        """Return the tangent at the points of a state.

        Parameters
        ----------
        fields : Fields
        state : Stressed
            Of these fields.
        """
        _, curvature = volumetric_stress(self.material.long_term_bulk_modulus, fields.volume)
        stiffness = Stiffness(state, curvature)
        if state.deformation.area.size > _HELD:
            return stiffness
        held: dict[str, Real] = {}
        for rows in self.row_slices():
            for name, part in vars(stiffness.tangent(rows)).items():
                whole = part.shape[-2] == self.shape[0]
                held.setdefault(name, part if whole else np.empty((*part.shape[:-2], *self.shape)))
                if not whole:
                    held[name][..., rows, :] = part
        return dataclasses.replace(stiffness, held=Tangent(**held))

    def row_slices(self) -> Iterator[slice]:
        """Yield the rows of cells a few at a time, all at once on small meshes, so that work takes little memory."""
        for part in self.parts():
            yield part.stored

    def parts(self) -> Iterator[Layer]:
        """Yield the parts of layers that ``row_slices`` are the rows of."""
        few = max(1, _AT_ONCE // (self.points * self.block.columns))
        for layer in self.layers:
            for first in range(layer.stored.start, layer.stored.stop, few):
                yield layer.part(slice(first, min(first + few, layer.stored.stop)))

    def change(self, stiffness: Stiffness, step: Fields) -> tuple[Real, Real]:
        """Return the change of the stresses, MPa, and of the volume's excess under a small step.

        Parameters
        ----------
        stiffness : Stiffness
        step : Fields
        """
        state = stiffness.state
        change = np.concatenate((self.gradient(step.displacement), step.log_thickness))
        held = stiffness.held
        if held is not None:
            inverse = _apply(held.inverse, change)
        else:
            inverse = np.empty_like(state.driving)
            for rows in self.row_slices():
                inverse[:, :, rows] = inverse_change(state.deformation.of_rows(rows), change[:, :, rows])
        driving = -self.history.shear(inverse)
        volumetric = stiffness.curvature * step.volume
        if self.history.bulk_relaxes:
            volumetric = volumetric + self.history.bulk(step.volume)
        if held is not None:
            answer = _apply(held.local, change)
            answer += _apply(held.by_driving, driving)
            answer += held.volume * volumetric
            return answer, step.volume - self.dilatation((held.volume * change).sum(axis=0))
        answer, swelling = np.empty_like(change), np.empty_like(state.deformation.volume)
        for rows in self.row_slices():
            points, part = state.deformation.of_rows(rows), change[:, :, rows]
            answer[:, :, rows] = local_change(points, state.driving[:, :, rows], state.volumetric[:, rows], part)
            answer[:, :, rows] += stress(points, driving[:, :, rows], volumetric[:, rows])  # linear in Q and U'
            swelling[:, rows] = points.volume * (points.growth * part).sum(axis=0)
        return answer, step.volume - self.dilatation(swelling)

    def stress_power(self, fields: Fields, state: Stressed) -> Real:
        """Return S : dE/dt at the points, MPa/s, as P : dF/dt with the thickness's part; (points, rows, columns).

        Parameters
        ----------
        fields : Fields
        state : Stressed
            Of these fields.
        """
        unknowns = np.concatenate((state.deformation.gradient, fields.log_thickness))
        rate: Complex = 1j * self.frequencies.astype(complex)
        rate[-1] = 0.0  # the phase of the last harmonic is unknown
        power: Real = np.sum(state.stress * self.convolve(rate, unknowns), axis=0)
        return power

    def dilatation(self, volume: Real) -> Real:
        """Return a volume ratio at the points as the pressure sees it: there, or as its mean over each cell."""
        return volume if self.block.pointwise else volume.mean(axis=0, keepdims=True)

    def convolve(self, kernel: Complex, field: Real) -> Real:
        """Return the convolution along the road of a field with a kernel given by its harmonics.

        Parameters
        ----------
        kernel : ndarray of complex, shape (n,)
            For the harmonics 0 to columns / 2.
        field : ndarray, shape (..., columns)
        """
        return convolve_layers(self.layers, kernel, field)


def _apply(matrix: Real, vector: Real) -> Real:
    """Return the product at every point of (i, j, ...) and (j, ...)."""
    answer: Real = np.einsum("ij...,j...->i...", matrix, vector)
    return answer
