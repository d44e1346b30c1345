"""Four-node rectangular cells: products of gradients and quadrature, assembled by scikit-fem.

The products of gradients of a cell of width 1 and height h are those of the unit square times h (x with x), 1 (x
with y) and 1 / h (y with y): scikit-fem assembles the unit square, once, and every mesh follows from it.

Nodes of a cell come in the order left low, right low, left high, right high.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from skfem import Basis, BilinearForm, ElementLineP1, ElementQuad1, MeshLine, MeshQuad
from skfem.helpers import grad

from rubfric.arrays import Real, Whole


@dataclass(frozen=True)
class CellProducts:
    """Integrals over the cells of one column of the products of gradients, by two quadratures.

    Attributes
    ----------
    full, mean : ndarray, shape (2, 2, rows, 4, 4)
        Integral of d_a N_i d_b N_j, dimensionless; under ``mean`` the product of the cell's mean gradients.
    """

    full: Real
    mean: Real


def cell_products(heights: Real) -> CellProducts:
    """Return the products for cells of width 1 and the given heights, shape (rows,)."""
    ones = np.ones_like(heights)
    scale = np.array(((heights, ones), (ones, 1.0 / heights)))[..., None, None]
    full, mean = _unit_products()
    return CellProducts(scale * full[:, :, None], scale * mean[:, :, None])


def strain_product(products: Real) -> Real:
    """Return eps(u) : eps(v), shape (rows, 4, 2, 4, 2): nodes and components of v, then of u."""
    cells = np.zeros((products.shape[2], 4, 2, 4, 2))
    for one, other in ((0, 1), (1, 0)):
        cells[:, :, one, :, one] = products[one, one] + 0.5 * products[other, other]
        cells[:, :, one, :, other] = 0.5 * products[other, one]
    return cells


def dilatation_product(products: Real) -> Real:
    """Return tr(u) tr(v), shape (rows, 4, 2, 4, 2): nodes and components of v, then of u."""
    return np.ascontiguousarray(products.transpose(2, 3, 0, 4, 1))


@dataclass(frozen=True)
class Quadrature:
    """Shape functions at the quadrature points of one column of cells.

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


def cell_quadrature(width: float, heights: Real, centred: bool = False) -> Quadrature:
    """Return the quadrature of a column of cells.

    Parameters
    ----------
    width : float
        Width of the cells, mm.
    heights : ndarray, shape (rows,)
        Their heights, mm.
    centred : bool
        Two points on the vertical centre line of each cell instead of 2 x 2: half the work. They still see every
        deformation of the cell, and the error that they add falls with the square of the width.
    """
    shapes, unit, weights = _unit_quadrature(centred)
    size = np.stack((np.full_like(heights, width), heights), axis=-1)
    return Quadrature(shapes, unit / size[:, None, None, :], np.outer(heights, weights) * width)


def _unit_square() -> tuple[MeshQuad, Whole]:
    """Return the unit square as a mesh of one cell, and its nodes left low, right low, left high, right high."""
    # Counter-clockwise from the origin, so that the cell's own axes are x and y.
    corners = np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0]])
    mesh = MeshQuad(corners, np.arange(4)[:, None])
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


@lru_cache(maxsize=2)
def _unit_quadrature(centred: bool) -> tuple[Real, Real, Real]:
    """Return shapes (points, 4), gradients (points, 4, 2) and weights (points,) on the unit square."""
    mesh, order = _unit_square()
    if centred:
        across = MeshLine.init_tensor(np.array([0.0, 1.0]))
        heights, weights = Basis(across, ElementLineP1(), intorder=3).quadrature
        points = np.vstack((np.full(heights.size, 0.5), heights[0]))
        basis = Basis(mesh, ElementQuad1(), quadrature=(points, weights))
    else:
        basis = Basis(mesh, ElementQuad1(), intorder=3)
    local = [int(np.flatnonzero(basis.dofs.element_dofs[:, 0] == node)[0]) for node in order]
    fields = [basis.basis[index][0] for index in local]
    shapes = np.stack([np.broadcast_to(np.asarray(field), basis.dx.shape)[0] for field in fields], axis=1)
    gradients = np.stack([field.grad[:, 0].T for field in fields], axis=1)
    return shapes, gradients, np.asarray(basis.dx[0])
