"""The rubber block: an x-periodic mesh of four-node cells and its operators, assembled by scikit-fem.

The mesh is uniform along x and graded in y, fine at the road (y = 0). Every column of cells is therefore
the same, and one column holds the whole block: node columns couple to themselves and to the next on either
side, so that in Fourier space along x harmonic n of a block of N columns sees

    K(theta) = K_LL + K_RR + K_LR exp(i theta) + K_RL exp(-i theta),    theta = 2 pi n / N,

where L and R are the left and right nodes of a column of cells. Mirror symmetry in x makes K(theta) real and
symmetric for the unknowns (i u_x, u_y), which is the basis used throughout.

All cells are rectangles, and the products of gradients of a cell of width 1 and height h are those of the unit
square times h (x with x), 1 (x with y) and 1 / h (y with y): scikit-fem assembles the unit square, once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from skfem import Basis, BilinearForm, ElementQuad1, MeshQuad
from skfem.helpers import grad

from rubfric.arrays import Real, Whole

FEWEST_ROWS = 8


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
class Quadrature:
    """Shape functions at the quadrature points of one column of cells.

    Nodes of a cell come in the order left low, right low, left high, right high.

    Attributes
    ----------
    shapes : ndarray, shape (points, 4)
        Values, dimensionless.
    gradients : ndarray, shape (rows, points, 4, 2)
        d/dx and d/dy, 1/mm.
    weights : ndarray, shape (rows, points)
        Area that each point stands for, mm².
    """

    shapes: Real
    gradients: Real
    weights: Real

    def strain_matrix(self) -> Real:
        """Return the matrix from a cell's eight displacements to its strains, 1/mm.

        Returns
        -------
        ndarray, shape (rows, points, 3, 8)
            Strains xx, yy, xy (tensor components); displacements node by node, x before y.
        """
        matrix = np.zeros((*self.weights.shape, 3, 4, 2))
        matrix[:, :, 0, :, 0] = self.gradients[..., 0]
        matrix[:, :, 1, :, 1] = self.gradients[..., 1]
        matrix[:, :, 2, :, 0] = 0.5 * self.gradients[..., 1]
        matrix[:, :, 2, :, 1] = 0.5 * self.gradients[..., 0]
        return matrix.reshape(*self.weights.shape, 3, 8)


@dataclass(frozen=True)
class Block:
    """A block one wavelength wide, meshed.

    Attributes
    ----------
    width, height : float
        lambda and H, mm.
    columns : int
        Cells along x.
    row_positions : ndarray, shape (rows + 1,)
        y of the rows of nodes, mm, from the road (0) to the top (H).
    plane : {"stress", "strain"}
        Decides how dilatation is integrated: pointwise in plane stress, by its mean over each cell in plane
        strain, where the pointwise form would lock as Poisson's ratio approaches 1/2.
    """

    width: float
    height: float
    columns: int
    row_positions: Real
    plane: str

    @classmethod
    def graded(
        cls, width: float, height: float, columns: int, plane: str, growth: float = 1.15, first_row: float = 1.0
    ) -> Block:
        """Mesh a block: rows grow upwards by about ``growth`` from ``first_row`` column widths at the road."""
        return cls(width, height, columns, graded_rows(height, first_row * width / columns, growth), plane)

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
        """X of the columns of nodes, mm, shape (columns,); the block repeats after ``width``."""
        return self.column_width * np.arange(self.columns)

    @property
    def harmonics(self) -> Whole:
        """0 ... columns / 2, the harmonics that the mesh can carry."""
        return np.arange(self.columns // 2 + 1)

    def operators(self) -> tuple[RowOperator, RowOperator]:
        """Return the operators of shear and of dilatation, to be weighed by the scene's moduli.

        Plane stress: 2 eps : eps and tr tr. Plane strain: 2 e : e (deviator) and the product of the cells'
        mean dilatations.
        """
        cells = _cell_products(np.diff(self.row_positions) / self.column_width)
        shear = 2.0 * _strain_product(cells.full)
        if self.plane == "stress":
            return _harmonic(shear), _harmonic(_dilatation_product(cells.full))
        deviator = shear - 2.0 / 3.0 * _dilatation_product(cells.full)
        return _harmonic(deviator), _harmonic(_dilatation_product(cells.mean))

    def quadrature(self) -> Quadrature:
        """Return the quadrature of one column of cells."""
        heights = np.diff(self.row_positions)
        shapes, unit, weights = _unit_quadrature()
        size = np.stack((np.full_like(heights, self.column_width), heights), axis=-1)
        gradients = unit / size[:, None, None, :]
        return Quadrature(shapes, gradients, np.outer(heights, weights) * self.column_width)


def graded_rows(height: float, first: float, growth: float) -> Real:
    """Return y of the rows of nodes, mm: heights grow by one ratio, as near to ``growth`` as fits.

    The first row is ``first`` high, or less in a block so flat that it would leave fewer than eight rows.
    """
    first = min(first, height / FEWEST_ROWS)
    span = height / first
    rows = max(FEWEST_ROWS, math.ceil(math.log1p(span * (growth - 1.0)) / math.log(growth)))
    if rows >= span:
        return np.linspace(0.0, height, rows + 1)

    def excess(logarithm: float) -> float:
        return math.expm1(rows * logarithm) / math.expm1(logarithm) - span

    ratio = math.exp(brentq(excess, 1e-12, math.log(growth) * 1.5 + 1e-9, xtol=1e-15))
    heights = ratio ** np.arange(rows)
    positions = np.concatenate(([0.0], np.cumsum(heights)))
    return positions * (height / positions[-1])


@dataclass(frozen=True)
class _CellProducts:
    """Integrals over the cells of one column of the products of gradients, by two quadratures.

    Attributes
    ----------
    full, mean : ndarray, shape (2, 2, rows, 4, 4)
        Integral of d_a N_i d_b N_j, dimensionless; under ``mean`` the product of the cell's mean gradients.
    """

    full: Real
    mean: Real


def _cell_products(heights: Real) -> _CellProducts:
    """Return the products for cells of width 1 and the given heights, shape (rows,)."""
    ones = np.ones_like(heights)
    scale = np.array(((heights, ones), (ones, 1.0 / heights)))[..., None, None]
    full, mean = _unit_products()
    return _CellProducts(scale * full[:, :, None], scale * mean[:, :, None])


def _strain_product(products: Real) -> Real:
    """Return eps(u) : eps(v), shape (rows, 4, 2, 4, 2): nodes and components of v, then of u."""
    cells = np.zeros((products.shape[2], 4, 2, 4, 2))
    for one, other in ((0, 1), (1, 0)):
        cells[:, :, one, :, one] = products[one, one] + 0.5 * products[other, other]
        cells[:, :, one, :, other] = 0.5 * products[other, one]
    return cells


def _dilatation_product(products: Real) -> Real:
    """Return tr(u) tr(v), shape (rows, 4, 2, 4, 2): nodes and components of v, then of u."""
    return np.ascontiguousarray(products.transpose(2, 3, 0, 4, 1))


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


def _unit_square() -> tuple[MeshQuad, Whole]:
    """Return the unit square as a mesh of one cell, and its nodes left low, right low, left high, right high."""
    mesh = MeshQuad.init_tensor(np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    return mesh, np.lexsort(mesh.p)


@lru_cache(maxsize=1)
def _unit_products() -> tuple[Real, Real]:
    """Return the products of gradients on the unit square, shape (2, 2, 4, 4): exact, and of their means."""
    mesh, order = _unit_square()
    exact = Basis(mesh, ElementQuad1(), intorder=2)
    # The mean gradient of a bilinear function on a rectangle is that at the centre. (An intorder of 1 is no
    # use here: scikit-fem rounds it up to four points.)
    centre = Basis(mesh, ElementQuad1(), quadrature=(np.array([[0.5], [0.5]]), np.array([1.0])))

    def product(basis: Basis, first: int, second: int) -> Real:
        form = BilinearForm(lambda u, v, w: grad(v)[first] * grad(u)[second])
        return np.asarray(form.assemble(basis).toarray())[np.ix_(order, order)]

    full, mean = (
        np.array([[product(basis, first, second) for second in (0, 1)] for first in (0, 1)])
        for basis in (exact, centre)
    )
    return full, mean


@lru_cache(maxsize=1)
def _unit_quadrature() -> tuple[Real, Real, Real]:
    """Return shapes (points, 4), gradients (points, 4, 2) and weights (points,) on the unit square."""
    mesh, order = _unit_square()
    basis = Basis(mesh, ElementQuad1(), intorder=3)
    local = [int(np.flatnonzero(basis.dofs.element_dofs[:, 0] == node)[0]) for node in order]
    fields = [basis.basis[index][0] for index in local]
    shapes = np.stack([np.broadcast_to(field.value, basis.dx.shape)[0] for field in fields], axis=1)
    gradients = np.stack([field.grad[:, 0].T for field in fields], axis=1)
    return shapes, gradients, np.asarray(basis.dx[0])
