"""Surfaces that yield to pressures linearly, and the pressures that hold some of their nodes at given heights.

Few nodes are a dense system. Many are solved by GMRES (Saad and Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856), which
applies C and an approximate inverse by Fourier transforms, at a cost of n log n. Its preconditioner is the saddle of
load, offset and the approximate inverse among the nodes (constraint preconditioner: Keller, Gould and Wathen 2000, SIAM
J. Matrix Anal. Appl. 21, 1300): corrections of the pressures carry no load, and a height that all nodes miss alike
needs none.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs

from rubfric.arrays import Complex, Real, Whole

# A dense system is faster where the cube of its nodes is below so many times the nodes of the surface.
_DENSE = 1.5e5
# Krylov vectors; what takes more is solved as a dense system of at most so many nodes, 300 MB.
_MOST_KRYLOV = 200
_MOST_NODES = 6000
# What GMRES may leave: over even pressures of the load, and over what those miss, of which that is round-off.
_TOLERANCE, _FLOOR = 1e-13, 1e-15
# Round-off of a dense system and of GMRES, over the largest pressure, and over the height of the road.
_ROUND_OFF, _ROUND_OFF_KRYLOV = 1e-11, 1e-10


class Unsolved(ArithmeticError):
    """A system that is not solved: a number that is in the way, and what it is."""


class Surface(Protocol):
    """A surface that yields to pressures linearly; both in the frame of the road."""

    def matrix(self, inside: Whole) -> Real:
        """Return C among the nodes ``inside``, shape (m, m), mm/MPa."""
        ...

    def deflection(self, pressure: Real) -> Real:
        """Return C p, shape (n,), mm, from pressures in MPa."""
        ...

    def pressing(self, deflection: Real) -> Real:
        """Return about the pressure that makes a deflection, shape (n,), MPa, from mm; the mean may be anything."""
        ...


class Convolution:
    """The surface of a block that is the same everywhere along the road.

    Parameters
    ----------
    compliance : ndarray of complex, shape (n // 2 + 1,)
        Spectrum of C, mm/MPa; the real part of its last entry counts where n is even.
    nodes : int
        n.
    """

    def __init__(self, compliance: Complex, nodes: int) -> None:
        self._compliance = compliance
        self._nodes = nodes
        self._kernel = np.fft.irfft(compliance, nodes)

    def matrix(self, inside: Whole) -> Real:
        """Return C among the nodes ``inside``."""
        return self._kernel[inside[:, None] - inside[None, :]]

    def deflection(self, pressure: Real) -> Real:
        """Return C p."""
        return np.fft.irfft(self._compliance * np.fft.rfft(pressure), self._nodes)

    def pressing(self, deflection: Real) -> Real:
        """Return the pressure that makes a deflection, but for the mean."""
        return np.fft.irfft(self._inverse * np.fft.rfft(deflection), self._nodes)

    @cached_property
    def _inverse(self) -> Complex:
        return inverse(self._compliance, self._nodes)


def inverse(compliance: Complex, nodes: int) -> Complex:
    """Return the spectrum of an inverse of C, MPa/mm; for the mean, that of the softest harmonic.

    Parameters
    ----------
    compliance : ndarray of complex, shape (n // 2 + 1,)
        Spectrum of C, mm/MPa; its entry 0 is not used. What is zero or not finite has the inverse zero.
    nodes : int
        n.
    """
    known = compliance.copy()
    known[0] = np.abs(known[1:]).max(initial=0.0)
    if nodes % 2 == 0:
        known[-1] = known[-1].real
    return np.divide(1.0, known, out=np.zeros_like(known), where=np.isfinite(known) & (known != 0.0))


class Equilibrium:
    """The pressures on some nodes, and the rigid offset, that hold these nodes at given heights under a load.

    Parameters
    ----------
    surface : Surface
        C.
    nodes : int
        n.
    inside : ndarray of int, shape (m,)
        The nodes that are held; pressures are zero elsewhere.

    Raises
    ------
    Unsolved
        Where the system is singular.
    """

    def __init__(self, surface: Surface, nodes: int, inside: Whole) -> None:
        self._surface, self._nodes, self._inside = surface, nodes, inside
        self._factors: tuple[Real, Whole, float] | None = None
        count = len(inside)
        even = self._among(surface.pressing, np.ones(count)) if count**3 >= _DENSE * nodes else np.zeros(count)
        total = float(even.sum())
        if total > 0.0:
            self._even = even / total
        else:
            self._factorise()

    @property
    def round_off(self) -> float:
        """What is round-off, over the largest pressure and the height of the road."""
        return _ROUND_OFF_KRYLOV if self._factors is None else _ROUND_OFF

    def solve(self, height: Real, load: float) -> tuple[Real, float]:
        """Return pressures p, shape (m,), and the offset d with C p + d = ``height``, sum(p) = ``load``.

        Parameters
        ----------
        height : ndarray, shape (m,)
            mm.
        load : float
            Sum of the pressures, MPa; n times the nominal pressure.

        Raises
        ------
        Unsolved
            Where the system is singular, or GMRES fails and there are too many nodes for a dense system.
        """
        if self._factors is None:
            found = self._krylov(height, load)
            if found is not None:
                return found
            self._factorise()
        return self._dense(height, load)

    def _factorise(self) -> None:
        count = len(self._inside)
        if count > _MOST_NODES:
            raise Unsolved(count, f"number of nodes in contact (where GMRES fails at most {_MOST_NODES})")
        # The load is an equation of the system: where all nodes touch, pressures alone would be unknown by a constant.
        system = np.zeros((count + 1, count + 1))
        system[:count, :count] = self._surface.matrix(self._inside)
        unit = float(np.abs(system.diagonal()).max())
        system[:count, count] = system[count, :count] = unit
        # Fortran reads the transpose.
        factors, pivots, info = dgetrf(system.T, overwrite_a=True)
        if info > 0:
            raise Unsolved(np.inf, "condition of the contact system")
        self._factors = factors, pivots, unit

    def _dense(self, height: Real, load: float) -> tuple[Real, float]:
        assert self._factors is not None
        factors, pivots, unit = self._factors
        held, _ = dgetrs(factors, pivots, np.append(height, unit * load), trans=1)
        return held[:-1], float(unit * held[-1])

    def _krylov(self, height: Real, load: float) -> tuple[Real, float] | None:
        """Return what GMRES finds, or None."""
        start = self._even * load
        missed = self._corrected(height - self._yielding(start))
        first = float(np.linalg.norm(missed))
        tolerance = max(_TOLERANCE * (float(np.linalg.norm(start)) or first), _FLOOR * first)
        most = min(_MOST_KRYLOV, len(height) - 1)  # pressures of sum zero have one dimension less
        change = gmres(self._preconditioned, missed, tolerance, most)
        if change is None:
            return None
        pressure = start + change
        return pressure, float(np.mean(height - self._yielding(pressure)))

    def _preconditioned(self, pressure: Real) -> Real:
        """Return what corrects the deflection; a load, which only round-off brings in, stays what it is."""
        return self._corrected(self._yielding(pressure)) + self._even * pressure.sum()

    def _yielding(self, pressure: Real) -> Real:
        return self._among(self._surface.deflection, pressure)

    def _corrected(self, missed: Real) -> Real:
        """Return about the pressures, of sum zero, that make up for heights that are missed, but for their mean."""
        pressure = self._among(self._surface.pressing, missed)
        return pressure - self._even * pressure.sum()

    def _among(self, applied: Callable[[Real], Real], values: Real) -> Real:
        everywhere = np.zeros(self._nodes)
        everywhere[self._inside] = values
        return applied(everywhere)[self._inside]


def gmres(applied: Callable[[Real], Real], right: Real, tolerance: float, most: int) -> Real | None:
    """Return x with A x = b but for a residual of norm ``tolerance``, or None where ``most`` vectors do not hold one.

    Parameters
    ----------
    applied : callable
        A x, shape (m,), of x.
    right : ndarray, shape (m,)
        b.
    tolerance : float
        Largest norm of the residual, in the unit of b.
    most : int
        Largest number of Krylov vectors.
    """
    left = float(np.linalg.norm(right))
    if left <= tolerance:
        return np.zeros_like(right)
    basis, triangle = np.empty((most + 1, len(right))), np.zeros((most, most))
    turns, sides = np.zeros((most, 2)), np.zeros(most + 1)
    basis[0], sides[0] = right / left, left
    for step in range(most):
        vector, column = applied(basis[step]), np.zeros(step + 2)
        for _ in range(2):  # twice is enough for vectors orthogonal to round-off
            part = basis[: step + 1] @ vector
            vector -= part @ basis[: step + 1]
            column[:-1] += part
        column[-1] = np.linalg.norm(vector)
        for row, (cosine, sine) in enumerate(turns[:step]):
            above, below = column[row : row + 2]
            column[row : row + 2] = cosine * above + sine * below, cosine * below - sine * above
        length = float(np.hypot(*column[-2:]))
        if not np.isfinite(length) or length == 0.0:
            return None
        turns[step] = column[-2:] / length
        triangle[: step + 1, step] = *column[:-2], length
        sides[step : step + 2] = turns[step] * (1.0, -1.0) * sides[step]
        if abs(sides[step + 1]) <= tolerance:
            kept = slice(0, step + 1)
            return np.linalg.solve(triangle[kept, kept], sides[kept]) @ basis[kept]
        basis[step + 1] = vector / column[-1]
    return None
