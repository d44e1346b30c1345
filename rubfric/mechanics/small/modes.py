"""The block in small strain, condensed to its surface for any history: modes that do not couple.

For a harmonic along the road, shear and dilatation are two symmetric forms S and D of the rows of nodes, and one basis
makes both diagonal: V^T S V = 1, V^T D V = diag(mu). In plane strain a mode then is a scalar Maxwell element of modulus
G + mu K. In plane stress the strain across the thickness is an unknown of every mode, which may be minus the dilatation
of a displacement field, zeta. The stress there vanishes, and the energy

    G / 2 (q² + 2 mu zeta² - 2/3 mu (q + zeta)²) + K / 2 mu (q + zeta)²

becomes diagonal in x and y, q = x + 2 sqrt(mu) y, sqrt(mu) zeta = -sqrt(mu) x + y, of moduli

    (1 + 2 mu) G  and  (1 + 2 mu) (4/3 (1 - mu) G + (1 + 2 mu) K):

two scalar elements under one force, whatever the Prony series of G and K. All x of a harmonic follow one curve in
time, and make one element.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from rubfric.arrays import Complex, Real, Whole
from rubfric.mechanics.block.block import Block, RowOperator
from rubfric.rubber.material import Material

# Modes that add less than this share to the compliance of their harmonic are left out.
_NOTHING = 1e-14


@dataclass(frozen=True)
class Modes:
    """Scalar Maxwell elements, sorted by harmonic; harmonic 0 is the uniform compression of the block.

    Attributes
    ----------
    starts : ndarray of int, shape (harmonics,)
        The first mode of every harmonic, 0 to columns / 2.
    harmonic : ndarray of int, shape (modes,)
        n of every mode.
    reach : ndarray, shape (modes,)
        u_y at the surface over the mode's coordinate; for harmonic 0 the strain along the height.
    shear, bulk : ndarray, shape (modes,)
        Shares of G and K in the modulus of the mode.
    weight : ndarray, shape (modes,)
        Energy over half the modulus times the squared coordinate.
    """

    starts: Whole
    harmonic: Whole
    reach: Real
    shear: Real
    bulk: Real
    weight: Real

    def modulus(self, shear: float, bulk: float) -> Real:
        """Return the moduli of the modes, MPa, for moduli of the rubber in MPa."""
        return self.shear * shear + self.bulk * bulk

    def branch_moduli(self, material: Material) -> Real:
        """Return the moduli of the branches of all modes, MPa, shape (branches, modes)."""
        return np.outer(material.branch_shear_moduli, self.shear) + np.outer(material.branch_bulk_moduli, self.bulk)

    def surface(self, coordinates: Complex) -> Complex:
        """Return the spectrum of u_y at the surface, shape (harmonics,); its first entry is the strain."""
        return np.add.reduceat(self.reach * coordinates, self.starts)

    def forces(self, spectrum: Complex) -> Complex:
        """Return the forces on the modes, shape (modes,), from those of the harmonics."""
        return self.reach * spectrum[self.harmonic]


def surface_modes(block: Block) -> Modes:
    """Return the modes of a block."""
    angle = 2.0 * np.pi / block.columns * block.harmonics
    waves = np.stack((np.ones_like(angle), 2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)))
    shear, dilatation = block.operators()
    # Uniform compression of unit volume: in plane strain 2 e : e is 4/3, in plane stress 2 eps : eps is 2.
    unit = 3.0 / 4.0 if block.plane == "strain" else 1.0 / 2.0
    found = [_elements(np.array([unit]), np.array([np.sqrt(unit)]), block.plane)]
    for wave in waves.T[1:]:
        values, vectors = eigh(_dense(dilatation, wave), _dense(shear, wave))
        if not block.pointwise:  # one mean dilatation a row of cells: the other modes have none but round-off
            values[: -block.rows] = 0.0
        found.append(_elements(np.maximum(values, 0.0), vectors[1], block.plane))
    counts = np.array([len(elements[0]) for elements in found])
    harmonic = np.repeat(block.harmonics, counts)
    weight = np.where(harmonic == block.columns // 2, 1.0, 2.0) / block.columns
    weight[harmonic == 0] = block.width * block.height
    reach, parts, bulk = (np.concatenate(part) for part in zip(*found, strict=True))
    return Modes(np.concatenate(([0], np.cumsum(counts)[:-1])), harmonic, reach, parts, bulk, weight)


def _elements(values: Real, reach: Real, plane: str) -> tuple[Real, Real, Real]:
    """Return reach and the shares of G and K of the elements of one harmonic, from mu and reach of its modes."""
    if plane == "strain":
        reach, shear, bulk = reach, np.ones_like(values), values
    else:
        values = np.minimum(values, 1.0)
        swell = 1.0 + 2.0 * values
        together = np.sqrt(np.sum(reach * reach / swell, keepdims=True))
        reach = np.concatenate((together, 2.0 * np.sqrt(values) * reach))
        shear = np.concatenate(([1.0], 4.0 / 3.0 * (1.0 - values) * swell))
        bulk = np.concatenate(([0.0], swell * swell))
    part = reach * reach / (shear + bulk)
    kept = part > _NOTHING * part.sum()
    return reach[kept], shear[kept], bulk[kept]


def _dense(operator: RowOperator, wave: Real) -> Real:
    """Return a form for one harmonic, shape (2 rows + 1, 2 rows + 1): u_x is held at the top."""
    rows = operator.upward.shape[1]
    matrix = np.zeros((rows + 1, 2, rows + 1, 2))
    own, up = np.tensordot(wave, operator.diagonal, 1), np.tensordot(wave, operator.upward, 1)
    every = np.arange(rows + 1)
    matrix[every, :, every] = own
    matrix[every[:-1], :, every[1:]] = up
    matrix[every[1:], :, every[:-1]] = up.swapaxes(1, 2)
    free = np.delete(np.arange(2 * rows + 2), -2)
    answer: Real = matrix.reshape(2 * rows + 2, -1)[np.ix_(free, free)]
    return answer
