"""Strains of a small-strain field in harmonic space: their squares over the cells, their values at the nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Complex, Real, Whole
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.cell import Quadrature
from rubfric.mechanics.small.response import HarmonicResponse


@dataclass(frozen=True)
class StrainHarmonics:
    """Strain amplitudes of the harmonics.

    Attributes
    ----------
    harmonics : ndarray of int, shape (n,)
        Which harmonics.
    shear_square : ndarray, shape (rows, n)
        Integral of |e|² (deviator) over one cell of every row, mm².
    volume_square : ndarray, shape (rows, n)
        Integral of |tr|² (dilatation) over one cell of every row, mm².
    nodal : ndarray of complex, shape (rows + 1, 4, n)
        Strains xx, yy, xy and in-plane dilatation at the nodes, averaged from the quadrature points by area.
    """

    harmonics: Whole
    shear_square: Real
    volume_square: Real
    nodal: Complex


def harmonic_strain(
    block: Block, response: HarmonicResponse, thickness: Complex, displacement: Complex
) -> StrainHarmonics:
    """Return the strains of the displacement amplitudes, by quadrature over one column of cells.

    Parameters
    ----------
    block : Block
    response : HarmonicResponse
    thickness : ndarray of complex, shape (n,)
        Strain across the thickness over in-plane dilatation, for each harmonic.
    displacement : ndarray of complex, shape (rows + 1, 2, n)
        (u_x, u_y) of the rows of nodes from the road upwards, mm.
    """
    harmonics = response.harmonics
    quadrature = block.quadrature()
    strains, recovery, area = _recovery(quadrature, block.pointwise)
    matrix = np.concatenate((strains, recovery), axis=1)
    turn = np.exp(2j * np.pi / block.columns * harmonics)
    shear, volume = (np.zeros((block.rows, len(harmonics))) for _ in range(2))
    nodal = np.zeros((block.rows + 1, 4, len(harmonics)), dtype=complex)
    for rows, count in response.bands():
        above = slice(rows.start + 1, rows.stop + 1)
        low, high = displacement[rows, :, :count], displacement[above, :, :count]
        nodes = np.stack((low, low * turn[:count], high, high * turn[:count]), axis=1)
        product = _apply(matrix[rows], nodes.reshape(-1, 8, count))
        strain, corners = np.split(product, [strains.shape[1]], axis=1)
        shear[rows, :count], volume[rows, :count] = _squares(
            strain.reshape(len(strain), -1, 3, count), quadrature.weights[rows], thickness[:count], block
        )
        # A node is the left corner of the cell to its right, and the right corner of the one to its left.
        corners = corners.reshape(-1, 2, 2, 4, count)
        levels = corners[:, :, 0] + corners[:, :, 1] / turn[:count]
        nodal[rows, :, :count] += levels[:, 0]
        nodal[above, :, :count] += levels[:, 1]
    nodal /= area[:, None, None]
    return StrainHarmonics(harmonics, shear, volume, nodal)


def _apply(matrix: Real, nodes: Complex) -> Complex:
    """Return matrix @ nodes for a real matrix, without making it complex."""
    return (matrix @ nodes.view(float)).view(complex)


def _recovery(quadrature: Quadrature, pointwise: bool) -> tuple[Real, Real, Real]:
    """Return the matrices from a cell's displacements to its strains, and to their shares at its corners.

    Returns
    -------
    strains : ndarray, shape (rows, 3 points, 8)
        xx, yy and xy at the quadrature points.
    recovery : ndarray, shape (rows, 16, 8)
        xx, yy, xy and dilatation, times area, for the corners left low, right low, left high, right high.
    area : ndarray, shape (rows + 1,)
        Area of the cells' shares around a node, mm².
    """
    strain = quadrature.strain_matrix()
    rows, points = quadrature.weights.shape
    dilatation = strain[:, :, 0] + strain[:, :, 1]
    if not pointwise:  # dilatation acts through its mean over the cell
        part = quadrature.weights / quadrature.weights.sum(axis=1, keepdims=True)
        dilatation = np.broadcast_to(np.einsum("rp,rpj->rj", part, dilatation)[:, None], dilatation.shape)
    four = np.concatenate((strain, dilatation[:, :, None]), axis=2)
    share = np.einsum("pc,rp->rcp", quadrature.shapes, quadrature.weights)
    recovery = np.einsum("rcp,rpsj->rcsj", share, four).reshape(rows, 16, 8)
    area = np.zeros(rows + 1)
    corner = share.sum(axis=2)
    area[:-1] += corner[:, 0] + corner[:, 1]
    area[1:] += corner[:, 2] + corner[:, 3]
    return strain.reshape(rows, 3 * points, 8), recovery, area


def _squares(strain: Complex, weights: Real, thickness: Complex, block: Block) -> tuple[Real, Real]:
    """Return the integrals of |e|² and |tr|² over cells, (rows, n), from strains (rows, points, 3, n)."""
    xx, yy, xy = strain[:, :, 0], strain[:, :, 1], strain[:, :, 2]
    flat = np.einsum("rp,rpn->rn", weights, _square(xx + yy))
    effective = flat
    if not block.pointwise:
        area = weights.sum(axis=1)[:, None]
        effective = _square(np.einsum("rp,rpn->rn", weights, xx + yy)) / area
    volume = _square(1.0 + thickness) * effective
    straight = np.einsum("rp,rpn->rn", weights, _square(xx) + _square(yy) + 2.0 * _square(xy))
    if block.plane == "strain":
        return straight - flat / 3.0, volume
    return straight + _square(thickness) * effective - volume / 3.0, volume


def _square(amplitude: Complex) -> Real:
    return amplitude.real**2 + amplitude.imag**2


def synthesise(amplitude: Complex, harmonics: Whole, columns: int) -> Real:
    """Return the real field f(x) = 2 Re sum_n f_n exp(i n k x) at evenly spread columns.

    Harmonics that the columns cannot tell apart are folded together, so the values are exact there.

    Parameters
    ----------
    amplitude : ndarray of complex, shape (..., m)
    harmonics : ndarray of int, shape (n,)
        Without gaps; the amplitudes are those of the first m.
    columns : int

    Returns
    -------
    ndarray, shape (..., columns)
    """
    first = int(harmonics[0])
    turns = (first + amplitude.shape[-1] - 1) // columns + 1
    folded = np.zeros((*amplitude.shape[:-1], turns * columns), dtype=complex)
    folded[..., first : first + amplitude.shape[-1]] = amplitude
    if turns > 1:
        folded = folded.reshape(*amplitude.shape[:-1], turns, columns).sum(axis=-2)
    field: Real = np.fft.ifft(folded, norm="forward").real
    return 2.0 * field
