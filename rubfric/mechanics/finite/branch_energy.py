"""What the branches of finite viscoelasticity store and dissipate at a point: pure functions of arrays.

They follow from D_i = A_i - Cb^-1, by how much a branch is behind its equilibrium, so that branches that keep up lose
no digits. Source: Linder, Tkachuk and Miehe (2011, J. Mech. Phys. Solids 59, 2134).
"""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.finite.law import XX, XY, YY, ZZ


def excess(behind: Real, squared: Real, inverse: Real) -> Real:
    """Return A : Cb + A^-1 : Cb^-1 - 6, never negative: a branch dissipates G / (2 tau) times that.

    Computed as the trace of (D Cb) (D A^-1), which does not cancel.

    Parameters
    ----------
    behind, squared, inverse : ndarray, shape (4, ...)
        D, Cb and Cb^-1.
    """
    branch = inverse + behind
    determinant = branch[XX] * branch[YY] - branch[XY] * branch[XY]
    one = _product(behind, squared)
    other = _product(behind, (branch[YY], branch[XX], -branch[XY]))
    plane = one[0] * other[0] + one[1] * other[2] + one[2] * other[1] + one[3] * other[3]
    answer: Real = plane / determinant + behind[ZZ] * behind[ZZ] * squared[ZZ] / branch[ZZ]
    return answer


def elongation(behind: Real, squared: Real, inverse: Real) -> Real:
    """Return A : Cb - ln det A - 3, never negative: a branch stores G / 2 times that.

    Computed as tr M - ln det(1 + M) with M = D Cb, which loses few digits where D is small.

    Parameters
    ----------
    behind, squared, inverse : ndarray, shape (4, ...)
        D, Cb and Cb^-1.
    """
    xx, xy, yx, yy = _product(behind, squared)
    zz = behind[ZZ] * squared[ZZ]
    plane = xx + yy + xx * yy - xy * yx
    answer: Real = np.maximum(xx + yy + zz - np.log1p(plane + zz + plane * zz), 0.0)
    return answer


def trace(tensor: Real) -> Real:
    """Return the trace of a tensor, shape (4, ...)."""
    total: Real = tensor[XX] + tensor[YY] + tensor[ZZ]
    return total


def inverted(tensor: Real) -> Real:
    """Return the inverse of a symmetric tensor, shape (4, ...)."""
    determinant = tensor[XX] * tensor[YY] - tensor[XY] * tensor[XY]
    return np.stack((tensor[YY] / determinant, tensor[XX] / determinant, -tensor[XY] / determinant, 1.0 / tensor[ZZ]))


def _product(one: Real, other: Real | tuple[Real, ...]) -> tuple[Real, Real, Real, Real]:
    """Return the in-plane product of two symmetric tensors: its components xx, xy, yx, yy."""
    return (
        one[XX] * other[XX] + one[XY] * other[XY],
        one[XX] * other[XY] + one[XY] * other[YY],
        one[XY] * other[XX] + one[YY] * other[XY],
        one[XY] * other[XY] + one[YY] * other[YY],
    )
