"""The whole periodic block, assembled on a plain mesh: what the program never builds, for comparison."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, MeshQuad
from skfem.helpers import ddot, div, sym_grad

Real = NDArray[np.float64]


@BilinearForm
def strain_product(u, v, w):
    return ddot(sym_grad(u), sym_grad(v))


@BilinearForm
def dilatation_product(u, v, w):
    return div(u) * div(v)


class PeriodicBlock:
    """Displacements are ordered by row of nodes, then component, then column; the sides are tied.

    Parameters
    ----------
    columns : ndarray
        x of the columns of nodes, mm, without the right side.
    width : float
        mm.
    rows : ndarray
        y of the rows of nodes, mm.
    """

    def __init__(self, columns: Real, width: float, rows: Real) -> None:
        self.mesh = MeshQuad.init_tensor(np.append(columns, width), rows)
        self.element = ElementVector(ElementQuad1())
        self.tie = self._tie(columns, width, rows)

    def _tie(self, columns: Real, width: float, rows: Real) -> csr_matrix:
        """Return the matrix from the displacements of the block to those of the mesh."""
        positions = self.mesh.p
        column = np.argmin(np.abs(np.append(columns, width)[:, None] - positions[0]), axis=0) % len(columns)
        row = np.argmin(np.abs(rows[:, None] - positions[1]), axis=0)
        dofs = Basis(self.mesh, self.element).nodal_dofs  # component, node
        block = (2 * row + np.arange(2)[:, None]) * len(columns) + column
        shape = (dofs.size, 2 * len(rows) * len(columns))
        return csr_matrix((np.ones(dofs.size), (dofs.ravel(), block.ravel())), shape=shape)

    def _assemble(self, form: BilinearForm, basis: Basis) -> csr_matrix:
        return self.tie.T @ form.assemble(basis) @ self.tie

    def forms(self, plane: str, pointwise: bool) -> tuple[csr_matrix, csr_matrix]:
        """Return the forms that the shear modulus and the modulus of dilatation weigh.

        Dilatation counts point by point, or by its mean over each cell, which is that at its centre.
        """
        exact = Basis(self.mesh, self.element, intorder=4)
        strain, dilatation = (self._assemble(form, exact) for form in (strain_product, dilatation_product))
        shear = 2.0 * strain if plane == "stress" else 2.0 * strain - 2.0 / 3.0 * dilatation
        if pointwise:
            return shear, dilatation
        centre = Basis(self.mesh, self.element, quadrature=(np.array([[0.5], [0.5]]), np.array([1.0])))
        return shear, self._assemble(dilatation_product, centre)
