"""Cells of the averaged block in harmonic space, thickness and volume condensed: what ``Circulant`` is put together of.

A few rows at a time: the averaged moduli of all of them, for every harmonic, would take more memory than the factors.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rubfric.arrays import Complex, Real
from rubfric.mechanics.finite.block import FiniteBlock, Stiffness
from rubfric.mechanics.finite.law import Tangent
from rubfric.mechanics.finite.layers import Layer


class Condensed(NamedTuple):
    """Some rows of cells with thickness and volume condensed; rows are the last axis but one of every array.

    Compliances and what causes what, as in ``Circulant``; those of the thickness are empty in plane strain. The cells
    are of shape (4, 4, rows, n).
    """

    thickness_compliance: Complex
    thickness_of_displacement: Complex
    force_of_thickness: Complex
    volume_of_thickness: Complex
    thickness_of_volume: Complex
    volume_stiffness: Complex
    volume_of_displacement: Complex
    force_of_volume: Complex
    cells: Complex


def condensed(finite: FiniteBlock, stiffness: Stiffness, part: Layer) -> Condensed:
    """Condense thickness and volume in some rows of cells, as the equations of ``Circulant`` say.

    Parameters
    ----------
    finite : FiniteBlock
    stiffness : Stiffness
        The tangent to average along the road.
    part : Layer
        Rows of cells.
    """
    slope = _slope(finite, part)
    weighed = slope.conj() * finite.quadrature.weights.T[:, part.rows, None]
    points = stiffness.tangent(part.stored)
    volume = part.mean(points.volume)[..., None]
    bulk = part.mean(stiffness.curvature[..., part.stored, :])[..., None] + part.kernel(finite.bulk_kernel)
    moduli = _moduli(finite, points, part)
    stress_by_pressure, volume_by_gradient = volume, volume
    volume_stiffness: Complex = np.ones((1, *bulk.shape[1:2], 1), dtype=complex)  # s
    compliance = by_displacement = by_thickness = volume_of_thickness = thickness_of_volume = volume_stiffness[:0]
    if finite.unknowns == 5:
        compliance = 1.0 / moduli[4, 4]
        column, row = moduli[:4, 4] * compliance, moduli[4, :4] * compliance
        by_displacement, by_thickness = _caused(row, slope), _caused(column, weighed)
        volume_of_thickness = volume[4] * compliance
        thickness_of_volume = volume_of_thickness * bulk
        volume_stiffness = 1.0 + bulk * cell_mean(finite, (volume[4] * volume_of_thickness)[None])[0]
        stress_by_pressure = volume[:4] - column * volume[4]
        volume_by_gradient = volume[:4] - row * volume[4]
        moduli = moduli[:4, :4] - column[:, None] * moduli[4, :4]
    of_displacement = cell_mean(finite, _caused(volume_by_gradient, slope)) / volume_stiffness
    of_volume = _caused(stress_by_pressure, weighed)
    if not finite.block.pointwise:
        of_volume = of_volume.sum(axis=1, keepdims=True)
    of_volume = of_volume * bulk
    cells = _cells(moduli, slope, weighed)
    cells += (of_displacement * of_volume[:, None]).sum(axis=2)
    return Condensed(
        compliance,
        by_displacement,
        by_thickness,
        volume_of_thickness,
        thickness_of_volume,
        volume_stiffness,
        of_displacement,
        of_volume,
        cells,
    )


def cell_mean(finite: FiniteBlock, points: Complex) -> Complex:
    """Return <x>: the points along the second axis, or their mean where the volume is that of the cell.

    Parameters
    ----------
    finite : FiniteBlock
    points : ndarray of complex, shape (..., points, rows, n)
    """
    return points if finite.block.pointwise else points.mean(axis=1, keepdims=True)


def _moduli(finite: FiniteBlock, points: Tangent, part: Layer) -> Complex:
    """Return A_n = <local> - H_n <dS/dQ> <dCb^-1/d(unknowns)>, the averaged moduli at constant volume.

    Parameters
    ----------
    finite : FiniteBlock
    points : Tangent
        Of the part.
    part : Layer
        Rows of cells.

    Returns
    -------
    ndarray of complex, shape (m, m, points, rows, n)
        MPa.
    """
    local, by_driving, inverse = map(part.mean, (points.local, points.by_driving, points.inverse))
    relaxing = np.einsum("ijpr,jkpr->ikpr", by_driving, inverse)
    moduli: Complex = relaxing[..., None] * -part.kernel(finite.shear_kernel)
    moduli += local[..., None]
    return moduli


def _slope(finite: FiniteBlock, part: Layer) -> Complex:
    """Return d/dx and d/dy of harmonics, 1/mm, (2, 2, points, rows, n), from a lower and an upper row of nodes."""
    turn = part.kernel(finite.turn)
    nodes = finite.quadrature.gradients[part.rows].transpose(3, 2, 1, 0)[..., None]  # (derivative, node, point, row, 1)
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
