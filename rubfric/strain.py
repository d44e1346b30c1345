"""Strains of a small-strain field in harmonic space: their squares over the cells, their values at the nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rubfric.block import Block, Quadrature
from rubfric.material import Material

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


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
    nodal : ndarray of complex, shape (rows + 1, 5, n)
        Strains xx, yy, xy and zz and the dilatation at the nodes, averaged from the quadrature points by area.
    """

    harmonics: NDArray[np.int64]
    shear_square: Real
    volume_square: Real
    nodal: Complex


def harmonic_strain(
    block: Block,
    material: Material,
    harmonics: NDArray[np.int64],
    frequencies: Real,
    displacement: list[Complex],
) -> StrainHarmonics:
    """Return the strains of the displacement amplitudes, by quadrature over one column of cells.

    Parameters
    ----------
    harmonics : ndarray of int, shape (n,)
        Harmonics that the displacement has.
    frequencies : ndarray, shape (n,)
        Their frequencies, rad/s.
    displacement : list of ndarray of complex, each of shape (2, m)
        (u_x, u_y) of the rows of nodes from the road upwards, mm, for the first m harmonics.
    """
    quadrature = block.quadrature()
    strains, recovery, area = _recovery(quadrature, block.plane)
    points = quadrature.weights.shape[1]
    matrix = np.concatenate((strains, recovery), axis=1).astype(complex)
    turn = np.exp(2j * np.pi / block.columns * harmonics)
    thickness = material.thickness_ratio(frequencies, block.plane)
    shear, volume = (np.zeros((block.rows, len(harmonics))) for _ in range(2))
    nodal = np.zeros((block.rows + 1, 5, len(harmonics)), dtype=complex)
    for row in range(block.rows):
        low, high = displacement[row], displacement[row + 1]
        count, above = low.shape[1], high.shape[1]
        nodes = np.zeros((4, 2, count), dtype=complex)
        nodes[0], nodes[1] = low, low * turn[:count]
        nodes[2, :, :above], nodes[3, :, :above] = high, high * turn[:above]
        product = matrix[row] @ nodes.reshape(8, count)
        strain = product[: 3 * points].reshape(points, 3, count)
        shear[row, :count], volume[row, :count] = _squares(
            strain, quadrature.weights[row], thickness[:count], block.plane
        )
        # A node is the left corner of the cell to its right, and the right corner of the one to its left.
        corners = product[3 * points :].reshape(2, 2, 4, count)
        nodal[row : row + 2, [0, 1, 2, 4], :count] += corners[:, 0] + corners[:, 1] / turn[:count]
    nodal /= area[:, None, None]
    nodal[:, 3] = thickness * nodal[:, 4]
    nodal[:, 4] += nodal[:, 3]
    return StrainHarmonics(harmonics, shear, volume, nodal)


def _recovery(quadrature: Quadrature, plane: str) -> tuple[Real, Real, Real]:
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
    if plane == "strain":  # dilatation acts through its mean over the cell
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


def _squares(strain: Complex, weights: Real, thickness: Complex, plane: str) -> tuple[Real, Real]:
    """Return the integrals of |e|² and |tr|² over a cell from strains of shape (points, 3, n)."""
    flat = strain[:, 0] + strain[:, 1]
    across = thickness * flat
    dilatation = flat + across
    total = _square(strain[:, 0]) + _square(strain[:, 1]) + 2.0 * _square(strain[:, 2]) + _square(across)
    shear = weights @ (total - _square(dilatation) / 3.0)
    if plane == "strain":
        return shear, weights.sum() * _square(weights @ dilatation / weights.sum())
    return shear, weights @ _square(dilatation)


def _square(amplitude: Complex) -> Real:
    return amplitude.real**2 + amplitude.imag**2


def synthesise(amplitude: Complex, harmonics: NDArray[np.int64], columns: int) -> Real:
    """Return the real field f(x) = Re sum_n pairs_n f_n exp(i n k x) at evenly spread columns.

    Harmonics that the columns cannot tell apart are folded together, so the values are exact there.
    All harmonics count twice, for themselves and their conjugates.

    Parameters
    ----------
    amplitude : ndarray of complex, shape (..., n)
    harmonics : ndarray of int, shape (n,)
        Ascending, without gaps.
    columns : int

    Returns
    -------
    ndarray, shape (..., columns)
    """
    first, turns = int(harmonics[0]), int(harmonics[-1]) // columns + 1
    folded = np.zeros((*amplitude.shape[:-1], turns * columns), dtype=complex)
    folded[..., first : first + len(harmonics)] = amplitude
    if turns > 1:
        folded = folded.reshape(*amplitude.shape[:-1], turns, columns).sum(axis=-2)
    return 2.0 * columns * np.fft.ifft(folded).real
