"""The non-negative spectrum that fits moduli best at given shifts, and how its residuals change with the shifts.

With relative residuals of both moduli, M' and M'' of point i of isotherm k,

    r'_i = 1 - b_k (m_inf + sum_j m_j x² / (1 + x²)) / M'_i,    r''_i = 1 - b_k sum_j m_j x / (1 + x²) / M''_i,

x = w_i a_k tau_j, the moduli m >= 0 are a linear problem (Lawson and Hanson 1974). Shifts enter nonlinearly and few:
they are solved for with the moduli eliminated, by variable projection (Golub and Pereyra 1973; Kaufman 1975).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr
from scipy.optimize import nnls

from rubfric.arrays import Real
from rubfric.dma.measurements import Measurements

# Largest |ln a_T| while shifts are looked for.
_LARGEST = 200.0


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Moduli at given shifts.

    Attributes
    ----------
    moduli : ndarray, shape (1 + branches,)
        The static modulus, then those of the branches, MPa.
    residuals : ndarray, shape (2 points,)
        Relative residuals, (measured - fitted) / measured, of storage, then of loss moduli.
    by_time : ndarray, shape (2 points, branches)
        Derivatives of the residuals by ln tau of each branch at fixed moduli; their sum is that by the point's ln a.
    by_scale : ndarray, shape (2 points,)
        Derivative of the residuals of each point by its own ln b at fixed moduli.
    active : ndarray, shape (2 points, rank)
        Orthonormal basis of what the moduli above 0 span.
    """

    moduli: Real
    residuals: Real
    by_time: Real
    by_scale: Real
    active: Real

    def project(self, derivatives: Real) -> Real:
        """Return derivatives of the residuals with the moduli eliminated, shape (2 points, parameters).

        Parameters
        ----------
        derivatives : ndarray, shape (2 points, parameters)
            At fixed moduli.
        """
        return derivatives - self.active @ (self.active.T @ derivatives)


def kernel(reduced: Real, times: Real) -> tuple[Real, Real]:
    """Return the storage and loss modulus of each branch of unit modulus, shape (points, branches).

    Parameters
    ----------
    reduced : ndarray, shape (points,)
        Reduced angular frequencies w a_T, rad/s.
    times : ndarray, shape (branches,)
        Relaxation times, s.
    """
    x = np.multiply.outer(reduced, times)
    loss = 1.0 / (x + 1.0 / x)
    return x * loss, loss


def solve(data: Measurements, times: Real, shifts: Real, scales: Real, static: float | None = None) -> Spectrum:
    """Solve for the moduli at given shifts.

    Parameters
    ----------
    data : Measurements
    times : ndarray, shape (branches,)
        Relaxation times at the reference temperature, s.
    shifts, scales : ndarray, shape (isotherms,)
        ln a_T and ln b_T.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    storage, loss = kernel(data.frequency * np.exp(np.clip(shifts, -_LARGEST, _LARGEST)[data.isotherm]), times)
    factor = np.exp(scales[data.isotherm])
    over = np.concatenate((factor / data.storage, factor / data.loss))
    rest = np.concatenate((over[: len(factor)], np.zeros_like(factor)))
    branches = np.concatenate((storage, loss)) * over[:, None]
    target = np.ones_like(over)
    matrix = branches
    if static is None:
        matrix = np.column_stack((rest, branches))
    else:
        target = target - static * rest
    norm = np.linalg.norm(matrix, axis=0)
    norm[norm == 0.0] = 1.0
    # Without pivoting the triangle has the columns in their order, and the small problem the same solution.
    orthogonal, triangle = qr(matrix / norm, mode="economic", check_finite=False)
    found = nnls(triangle, orthogonal.T @ target, maxiter=30 * matrix.shape[1])[0] / norm
    moduli = found if static is None else np.concatenate(([static], found))
    positive = np.flatnonzero(found > 0.0)
    basis = qr(triangle[:, positive], mode="economic", check_finite=False)[0]
    # d/d ln x of x² / (1 + x²) is 2 l², and of l = x / (1 + x²) it is l (1 - 2 s), s being the former.
    slopes = np.concatenate((2.0 * loss**2, loss * (1.0 - 2.0 * storage))) * over[:, None]
    fitted = branches @ moduli[1:] + rest * moduli[0]
    return Spectrum(moduli, 1.0 - fitted, -slopes * moduli[1:], -fitted, orthogonal @ basis)


def grid(low: float, high: float, per_decade: float, margin: float) -> Real:
    """Return relaxation times, s, evenly spaced in their logarithm over a window of reduced frequencies.

    Parameters
    ----------
    low, high : float
        The window, rad/s.
    per_decade : float
        Branches a decade, at least.
    margin : float
        Decades by which the times reach beyond either end.
    """
    first, last = -np.log10(high) - margin, -np.log10(low) + margin
    count = 1 + max(int(np.ceil((last - first) * per_decade - 1e-9)), 1)
    return 10.0 ** np.linspace(first, last, count)
