"""The rubber block: an x-periodic mesh of four-node cells and its operators.

The mesh is uniform along x and graded in y, fine at the road (y = 0). Every column of cells is therefore
the same, and one column holds the whole block: node columns couple to themselves and to the next on either
side, so that in Fourier space along x harmonic n of a block of N columns sees

    K(theta) = K_LL + K_RR + K_LR exp(i theta) + K_RL exp(-i theta),    theta = 2 pi n / N,

where L and R are the left and right nodes of a column of cells. Mirror symmetry in x makes K(theta) real and
symmetric for the unknowns (i u_x, u_y), which is the basis used throughout.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from rubfric.arrays import Real, Whole
from rubfric.mechanics.block.cell import Quadrature, cell_products, cell_quadrature, dilatation_product, strain_product

# Fewest rows of a block: so many over the growth of its rows less one, but within these bounds.
_ROWS_PER_GROWTH, _FEWEST_ROWS = 1.2, (4, 64)
# Rows whose heights would grow by less than this in all are even: no ratio can be found to more digits.
_EVEN = 1e-9


@dataclass(frozen=True)
class RowOperator:
    """One form of the block in harmonic space, row by row, for the unknowns (i u_x, u_y).

    Every 2 x 2 block is ``uniform + bend (1 - cos(theta)) + sine sin(theta)``, the three along the first axis.

    Attributes
    ----------
    diagonal : ndarray, shape (3, rows + 1, 2, 2)
        Coupling of a row of nodes with itself.
    upward : ndarray, shape (3, rows, 2, 2)
        Coupling of a row of nodes (first index) with the one above it (second index).
    """

    diagonal: Real
    upward: Real


@dataclass(frozen=True)
class Block:
    """A block one period of the road wide, meshed.

    Attributes
    ----------
    width, height : float
        Period of the road and H, mm.
    columns : int
        Cells along x.
    row_positions : ndarray, shape (rows + 1,)
        y of the rows of nodes, mm, from the road (0) to the top (H).
    plane : {"stress", "strain"}
        Plane stress or plane strain.
    dilatation : {"auto", "pointwise", "mean"}
        How dilatation is integrated: point by point, by its mean over each cell, or (``auto``) pointwise in plane
        stress and by its mean in plane strain, where the pointwise form would lock as Poisson's ratio approaches 1/2.
    """

    width: float
    height: float
    columns: int
    row_positions: Real
    plane: str
    dilatation: str = "auto"

    @classmethod
    def graded(
        cls,
        width: float,
        height: float,
        columns: int,
        plane: str,
        growth: float = 1.15,
        first_row: float = 1.0,
        dilatation: str = "auto",
    ) -> Block:
        """Mesh a block: rows grow upwards by about ``growth`` from ``first_row`` column widths at the road."""
        rows = graded_rows(height, first_row * width / columns, growth)
        return cls(width, height, columns, rows, plane, dilatation)

    @property
    def pointwise(self) -> bool:
        """Whether dilatation counts point by point, rather than by its mean over each cell."""
        return self.plane == "stress" if self.dilatation == "auto" else self.dilatation == "pointwise"

    @property
    def rows(self) -> int:
        """Cells along y."""
        return len(self.row_positions) - 1

    @property
    def column_width(self) -> float:
        """Width of a column of cells, mm."""
        return self.width / self.columns

    @property
    def column_positions(self) -> Real:
        """Positions x of the columns of nodes, mm, shape (columns,); the block repeats after ``width``."""
        return self.column_width * np.arange(self.columns)

    @property
    def harmonics(self) -> Whole:
        """0 ... columns / 2, the harmonics that the mesh can carry."""
        return np.arange(self.columns // 2 + 1)

    @property
    def wavenumbers(self) -> Real:
        """Wavenumbers n 2 pi / width of the harmonics, 1/mm, shape (columns // 2 + 1,)."""
        return 2.0 * np.pi / self.width * self.harmonics

    def operators(self) -> tuple[RowOperator, RowOperator]:
        """Return the operators of shear and of dilatation, to be weighed by the scene's moduli.

        Plane stress: 2 eps : eps and tr tr. Plane strain: 2 e : e (deviator) and tr tr. The dilatation tr is that
        at the points, or its mean over each cell.
        """
        cells = cell_products(np.diff(self.row_positions) / self.column_width)
        shear = 2.0 * strain_product(cells.full)
        dilatation = dilatation_product(cells.full if self.pointwise else cells.mean)
        if self.plane == "strain":
            shear -= 2.0 / 3.0 * dilatation_product(cells.full)
        return _harmonic(shear), _harmonic(dilatation)

    def quadrature(self, centred: bool = False) -> Quadrature:
        """Return the quadrature of one column of cells, of 2 x 2 points or of two on the centre line."""
        return cell_quadrature(self.column_width, np.diff(self.row_positions), centred)


def graded_rows(height: float, first: float, growth: float) -> Real:
    """Return y of the rows of nodes, mm: heights grow by one ratio, as near to ``growth`` as fits.

    The first row is ``first`` high, or less in a block so flat that it would leave fewer rows than ``fewest_rows``.
    """
    fewest = fewest_rows(growth)
    first = min(first, height / fewest)
    span = height / first
    rows = max(fewest, math.ceil(math.log1p(span * (growth - 1.0)) / math.log(growth)))
    if rows >= span * (1.0 - _EVEN):
        return np.linspace(0.0, height, rows + 1)

    def excess(logarithm: float) -> float:
        return math.expm1(rows * logarithm) / math.expm1(logarithm) - span

    ratio = math.exp(brentq(excess, 1e-12, math.log(growth) * 1.5 + 1e-9, xtol=1e-15))
    heights = ratio ** np.arange(rows)
    positions = np.concatenate(([0.0], np.cumsum(heights)))
    return positions * (height / positions[-1])


def fewest_rows(growth: float) -> int:
    """Return the fewest rows of a block: 12 at a growth of 1.1, and more the slower they grow, 4 to 64."""
    low, high = _FEWEST_ROWS
    return int(min(max(math.ceil(_ROWS_PER_GROWTH / (growth - 1.0) - 1e-9), low), high))


def _harmonic(cells: Real) -> RowOperator:
    """Return a form of one column of cells, shape (rows, 4, 2, 4, 2), in harmonic space."""
    corners = cells.reshape(-1, 2, 2, 2, 2, 2, 2)  # cell, then level, side, component of v and of u
    rows = len(corners)
    own = np.zeros((rows + 1, 2, 2, 2, 2))  # side and component of v, then of u
    own[:-1] += corners[:, 0, :, :, 0]
    own[1:] += corners[:, 1, :, :, 1]
    return RowOperator(_fourier(own), _fourier(corners[:, 0, :, :, 1]))


def _fourier(blocks: Real) -> Real:
    """Return the uniform, bending and sine parts of blocks of shape (rows, side, 2, side, 2)."""
    same = blocks[:, 0, :, 0] + blocks[:, 1, :, 1]
    forward, backward = blocks[:, 0, :, 1], blocks[:, 1, :, 0]
    # Rows of u_x are multiplied by i and its columns by -i, which turns i sin(theta) real;
    # by mirror symmetry only the mixed entries have a sine, and only the others the rest.
    straight, mixed = np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]])
    across = forward + backward
    return np.stack(((same + across) * straight, -across * straight, (forward - backward) * mixed))
