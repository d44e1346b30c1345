"""The compliance of a block to one wave of pressure: Fourier in the plane, finite elements over the depth.

Under a wave of wavevector k displacements are (i U along k, W down the depth z) times exp(i k . x), none across k. With
the shear modulus for a unit and kappa = K* / G*, the wave does the virtual work

    integral of 2 ((kU)(kU~) + W' W~' + (U' - kW)(U~' - kW~) / 2) - 2/3 tr tr~ + q tr~ + q~ (tr - q / kappa),

tr = kU + W', with U and W quadratic in each element and the pressure q linear, not continuous: a mixed form (Taylor and
Hood's with a pressure of each element's own) that neither locks nor loses digits where kappa is large. The top carries
uniform pressure and moves sideways as a whole, as that of the plane block. Elements are eliminated from the top down,
for all waves at once.
"""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Complex, Real
from rubfric.mechanics.block.line import line_products

# Unknowns of an element: U and W at its low end, then those that are eliminated: at its high end, in its middle, and q.
_LOW, _REST = slice(0, 2), slice(2, 8)


def depth_compliance(wavenumbers: Real, ratios: Complex, rows: Real) -> Complex:
    """Return surface displacement over pressure, times the shear modulus, mm.

    Parameters
    ----------
    wavenumbers : ndarray, shape (n,)
        |k|, 1/mm, positive.
    ratios : ndarray of complex, shape (n,)
        K* / G*.
    rows : ndarray, shape (m + 1,)
        Ends of the elements, mm, from the road (0) to the top.

    Returns
    -------
    ndarray of complex, shape (n,)
    """
    held: Complex = np.zeros(
        (len(wavenumbers), 2, 2), dtype=complex
    )  # stiffness of all above, at the low end of an element
    for element in range(len(rows) - 1, 0, -1):
        system = _element(wavenumbers, ratios, float(rows[element] - rows[element - 1]))
        system[:, 2:4, 2:4] += held
        if element == len(rows) - 1:  # U vanishes at the top
            system[:, 2, :], system[:, :, 2] = 0.0, 0.0
            system[:, 2, 2] = 1.0
        across = system[:, _REST, _LOW]
        held = system[:, _LOW, _LOW] - system[:, _LOW, _REST] @ np.linalg.solve(system[:, _REST, _REST], across)
    # No shear stress on the surface.
    stiffness: Complex = held[:, 1, 1] - held[:, 1, 0] * held[:, 0, 1] / held[:, 0, 0]
    return 1.0 / stiffness


def _element(wavenumbers: Real, ratios: Complex, height: float) -> Complex:
    """Return the matrix of an element for the unknowns U0 W0 U1 W1 U2 W2 q0 q1, shape (n, 8, 8)."""
    line = line_products()
    k = wavenumbers[:, None, None]
    mass, stiffness = height * line.mass, line.stiffness / height
    mixed = line.mixed + 0.0 * k
    found = np.zeros((len(wavenumbers), 8, 8), dtype=complex)
    u, w, q = slice(0, 6, 2), slice(1, 6, 2), slice(6, 8)
    third = 2.0 / 3.0
    found[:, u, u] = (2.0 - third) * k * k * mass + stiffness
    found[:, w, w] = (2.0 - third) * stiffness + k * k * mass
    found[:, u, w] = -third * k * mixed - k * mixed.swapaxes(1, 2)
    found[:, w, u] = found[:, u, w].swapaxes(1, 2)
    found[:, q, u] = k * height * line.value
    found[:, q, w] = line.slope
    found[:, u, q] = found[:, q, u].swapaxes(1, 2)
    found[:, w, q] = found[:, q, w].swapaxes(1, 2)
    found[:, q, q] = -height * line.linear / ratios[:, None, None]
    return found
