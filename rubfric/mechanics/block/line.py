"""Quadratic line elements over the depth of a block: integrals of shape functions, assembled by scikit-fem.

Nodes of an element come in the order low, high, middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from skfem import Basis, BilinearForm, ElementLineP1, ElementLineP2, MeshLine
from skfem.helpers import grad

from rubfric.arrays import Real


@dataclass(frozen=True)
class LineProducts:
    """Integrals over an element of length 1, dimensionless.

    Attributes
    ----------
    mass, mixed, stiffness : ndarray, shape (3, 3)
        Of N_i N_j, N_i N_j' and N_i' N_j', N quadratic.
    value, slope : ndarray, shape (2, 3)
        Of psi_a N_j and psi_a N_j', psi linear.
    linear : ndarray, shape (2, 2)
        Of psi_a psi_b.
    """

    mass: Real
    mixed: Real
    stiffness: Real
    value: Real
    slope: Real
    linear: Real


@lru_cache(maxsize=1)
def line_products() -> LineProducts:
    """Return the integrals over an element from 0 to 1."""
    mesh = MeshLine(np.array([[0.0, 1.0]]))
    quadratic = Basis(mesh, ElementLineP2(), intorder=4)
    linear = quadratic.with_element(ElementLineP1())

    def assembled(form: BilinearForm, columns: Basis, rows: Basis) -> Real:
        orders = (rows.element_dofs[:, 0], columns.element_dofs[:, 0])
        return np.asarray(form.assemble(columns, rows).toarray())[np.ix_(*orders)]

    values = BilinearForm(lambda u, v, w: v * u)
    slopes = BilinearForm(lambda u, v, w: v * grad(u)[0])
    bend = BilinearForm(lambda u, v, w: grad(v)[0] * grad(u)[0])
    return LineProducts(
        mass=assembled(values, quadratic, quadratic),
        mixed=assembled(slopes, quadratic, quadratic),
        stiffness=assembled(bend, quadratic, quadratic),
        value=assembled(values, quadratic, linear),
        slope=assembled(slopes, quadratic, linear),
        linear=assembled(values, linear, linear),
    )
