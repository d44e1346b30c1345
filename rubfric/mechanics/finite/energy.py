"""Friction from energy in finite strain: three routes to one number, and the strain energy stored in the block.

1. Stress power (Zhou, Wang and Wei 2019, eq. 4): F v = mean over a cycle of the integral of S : dE/dt.
2. Viscous dissipation of the branches, never negative:
   D = sum_i G_i / (2 tau_i) (A_i : Cb + A_i^-1 : Cb^-1 - 6) (Linder, Tkachuk and Miehe 2011).
3. Contact: F = sum over the surface nodes of vertical force x slope of the road where they are.

The friction coefficient is F / (p lambda). The three share no more than the deformation: the second knows no stress,
and the third no interior.
"""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.branch_energy import elongation, excess, trace
from rubfric.mechanics.finite.law import Deformation, volumetric_energy
from rubfric.mechanics.finite.layers import even_cells, even_nodes
from rubfric.mechanics.finite.memory import branch_transfers
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.mechanics.steady.energies import Energies, output_stride, rows_to_nodes


def evaluate_finite(solution: FiniteSolution) -> Energies:
    """Return the friction coefficient by three routes and the stored strain energy of a solved scene."""
    scene, block, finite = solution.scene, solution.block, solution.finite
    lost, stored = dissipated_and_stored(finite, solution.correction.state.deformation)
    force = scene.pressure * block.width
    stride = output_stride(scene, block.columns, block.rows + 1)
    weights = finite.quadrature.weights.T
    means = np.concatenate([layer.of(stored).mean(axis=-1) for layer in finite.layers], axis=-1)
    cells = (means * weights).sum(axis=0) / weights.sum(axis=0)
    displacement = even_nodes(finite.layers, solution.fields.displacement)
    return Energies(
        stress_power=solution.friction.stress_power,
        dissipation=float((lost * finite.weights).sum() / (scene.velocity * force)),
        contact=solution.friction.contact,
        depth_profile=rows_to_nodes(np.diff(block.row_positions), cells),
        # Harmonics, of which layers are made even, pass below zero where there is next to nothing.
        density=np.maximum(nodal_density(finite, stored)[:, ::stride], 0.0),
        displacement=np.ascontiguousarray(displacement.swapaxes(0, 1)[..., ::stride]),
        resolution=solution.friction.resolution,
    )


def dissipated_and_stored(finite: FiniteBlock, state: Deformation) -> tuple[Real, Real]:
    """Return the dissipation D, MPa/s, and the stored energy W, MPa, at the points, each (points, rows, columns).

    Parameters
    ----------
    finite : FiniteBlock
    state : Deformation
        Of its points.
    """
    material = finite.material
    squared, inverse = state.isochoric_squared, state.inverse
    volume = np.broadcast_to(finite.dilatation(state.volume), state.volume.shape)
    stored = volumetric_energy(material.long_term_bulk_modulus, volume)
    stored = stored + 0.5 * material.long_term_shear_modulus * (trace(squared) - 3.0)
    stored = np.maximum(stored, 0.0)  # round-off, where the rubber is hardly strained
    lost = np.zeros_like(stored)
    branches = zip(
        material.branch_shear_moduli,
        material.branch_bulk_moduli,
        branch_transfers(finite.material, finite.frequencies),
        material.relaxation_times,
        strict=True,
    )
    for shear, bulk, transfer, time in branches:
        behind = -finite.convolve(transfer, inverse)  # A_i - Cb^-1, without cancellation
        lost += shear / (2.0 * time) * excess(behind, squared, inverse)
        stored += 0.5 * shear * elongation(behind, squared, inverse)
        if bulk:
            stretched = finite.convolve(transfer, volume)
            lost += bulk / time * stretched * stretched
            stored += 0.5 * bulk * stretched * stretched
    return lost, stored


def branch_tensors(finite: FiniteBlock, state: Deformation) -> Real:
    """Return A_i, shape (branches, 4, points, rows, columns).

    Parameters
    ----------
    finite : FiniteBlock
    state : Deformation
        Of its points.
    """
    return np.stack(
        [
            state.inverse - finite.convolve(transfer, state.inverse)
            for transfer in branch_transfers(finite.material, finite.frequencies)
        ]
    )


def nodal_density(finite: FiniteBlock, density: Real) -> Real:
    """Average a density from the quadrature points to the nodes by area, shape (rows + 1, columns).

    Parameters
    ----------
    finite : FiniteBlock
    density : ndarray, shape (points, rows, columns)
        MPa, rows and columns those of ``FiniteBlock.shape``.
    """
    shapes, weights = finite.quadrature.shapes, finite.quadrature.weights.T[:, :, None]
    density = even_cells(finite.layers, density)
    total = np.zeros((finite.block.rows + 1, finite.block.columns))
    area = np.zeros((finite.block.rows + 1, 1))
    for corner in range(4):
        rows = slice(None, -1) if corner < 2 else slice(1, None)
        share = shapes[:, corner, None, None] * weights
        part = (share * density).sum(axis=0)
        total[rows] += np.roll(part, 1, axis=1) if corner % 2 else part
        area[rows] += share.sum(axis=0)
    return total / area
