"""The rubber block: an x-periodic mesh of four-node cells and its operators, assembled by scikit-fem.

The mesh is uniform along x and graded in y, fine at the road (y = 0). Every column of cells is therefore
the same, and one column assembled on a strip one cell wide holds the whole block: node columns couple
to themselves and to the next on either side, so that in Fourier space along x harmonic n of a block of N
columns sees

    K(theta) = K_LL + K_RR + K_LR exp(i theta) + K_RL exp(-i theta),    theta = 2 pi n / N,

where L and R are the strip's left and right nodes. Mirror symmetry in x makes K(theta) real and symmetric
for the unknowns (i u_x, u_y), which is the basis used throughout.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.sparse import csr_matrix
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, MeshQuad
from skfem.helpers import ddot, div, sym_grad

Real = NDArray[np.float64]

FEWEST_ROWS = 8


@BilinearForm
def shear_form(u, v, w):
    """Twice the scalar product of strains: the operator of 2 G in plane stress."""
    return 2.0 * ddot(sym_grad(u), sym_grad(v))


@BilinearForm
def deviatoric_form(u, v, w):
    """Twice the scalar product of the deviators of plane strain: the operator of G."""
    return 2.0 * (ddot(sym_grad(u), sym_grad(v)) - div(u) * div(v) / 3.0)


@BilinearForm
def dilatation_form(u, v, w):
    """Product of the in-plane dilatations."""
    return div(u) * div(v)


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
        """x of the columns of nodes, mm, shape (columns,); the block repeats after ``width``."""
        return self.column_width * np.arange(self.columns)

    @property
    def harmonics(self) -> NDArray[np.int64]:
        """0 ... columns / 2, the harmonics that the mesh can carry."""
        return np.arange(self.columns // 2 + 1)

    def operators(self) -> tuple[RowOperator, RowOperator]:
        """Return the operators of shear and of dilatation, to be weighed by ``stiffness_moduli``."""
        heights = np.diff(self.row_positions) / self.column_width
        return _operators(tuple(heights), self.plane)

    def quadrature(self) -> Quadrature:
        """Return the quadrature of one column of cells."""
        heights = np.diff(self.row_positions) / self.column_width
        unit = _quadrature(tuple(heights))
        width = self.column_width
        return Quadrature(unit.shapes, unit.gradients / width, unit.weights * width**2)


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


def _strip(heights: tuple[float, ...], form_order: int = 3) -> tuple[MeshQuad, Basis]:
    """Return the strip one cell (of unit width) wide and the basis of its displacements."""
    mesh = MeshQuad.init_tensor(np.array([0.0, 1.0]), np.concatenate(([0.0], np.cumsum(heights))))
    return mesh, Basis(mesh, ElementVector(ElementQuad1()), intorder=form_order)


def _node_order(basis: Basis, rows: int) -> NDArray[np.int64]:
    """Return the strip's degrees of freedom as an array of shape (rows + 1, side, component)."""
    x, y = basis.mesh.p
    order = np.lexsort((x, y)).reshape(rows + 1, 2)
    return np.asarray(basis.nodal_dofs[:, order].transpose(1, 2, 0))


@lru_cache(maxsize=8)
def _operators(heights: tuple[float, ...], plane: str) -> tuple[RowOperator, RowOperator]:
    _, basis = _strip(heights)
    dofs = _node_order(basis, len(heights))
    if plane == "stress":
        shear, dilatation = shear_form.assemble(basis), dilatation_form.assemble(basis)
    else:
        shear, dilatation = deviatoric_form.assemble(basis), mean_dilatation(basis)
    return _harmonic(shear, dofs), _harmonic(dilatation, dofs)


def mean_dilatation(basis: Basis) -> csr_matrix:
    """Assemble the product of the cells' mean dilatations: exactly the form under one-point quadrature.

    On a rectangle the divergence of a bilinear displacement has its mean at the centre.
    """
    centre = (np.array([[0.5], [0.5]]), np.array([1.0]))
    return dilatation_form.assemble(Basis(basis.mesh, basis.elem, quadrature=centre))


def _harmonic(matrix: csr_matrix, dofs: NDArray[np.int64]) -> RowOperator:
    flat = dofs.ravel()
    # Axes of the strip's matrix: row, side, component of the test function, then of the displacement.
    strip = matrix.toarray()[np.ix_(flat, flat)].reshape(dofs.shape + dofs.shape)
    low = np.arange(dofs.shape[0])
    return RowOperator(_fourier(strip, low, low), _fourier(strip, low[:-1], low[1:]))


def _fourier(strip: Real, low: NDArray[np.int64], high: NDArray[np.int64]) -> Real:
    """Return the uniform, bending and sine parts of the blocks of row pairs, in the basis (i u_x, u_y)."""
    same = strip[low, 0, :, high, 0] + strip[low, 1, :, high, 1]
    forward, backward = strip[low, 0, :, high, 1], strip[low, 1, :, high, 0]
    # Rows of u_x are multiplied by i and its columns by -i, which turns i sin(theta) real;
    # by mirror symmetry only the mixed entries have a sine, and only the others the rest.
    straight, mixed = np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]])
    across = forward + backward
    return np.stack(((same + across) * straight, -across * straight, (forward - backward) * mixed))


@lru_cache(maxsize=8)
def _quadrature(heights: tuple[float, ...]) -> Quadrature:
    """Return the quadrature of the strip one cell of unit width wide, rows from the road upwards."""
    mesh, _ = _strip(heights)
    scalar = Basis(mesh, ElementQuad1(), intorder=3)
    middle = mesh.p[:, mesh.t].mean(axis=1, keepdims=True)
    cells = np.argsort(middle[1, 0])
    # Corner of each local node: 0 or 1 for left or right, plus 0 or 2 for low or high.
    corner = ((mesh.p[:, mesh.t] > middle) * np.array([1, 2])[:, None, None]).sum(axis=0)
    gradients = np.zeros((len(heights), scalar.dx.shape[1], 4, 2))
    shapes = np.zeros((len(heights), scalar.dx.shape[1], 4))
    for local in range(4):
        field = scalar.basis[local][0]
        value = np.broadcast_to(field.value, scalar.dx.shape)
        for row, cell in enumerate(cells):
            gradients[row, :, corner[local, cell]] = field.grad[:, cell].T
            shapes[row, :, corner[local, cell]] = value[cell]
    return Quadrature(shapes[0], gradients, scalar.dx[cells])
