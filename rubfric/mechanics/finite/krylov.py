"""GMRES that can be asked on its way: what it solves is a Newton step, and contact nodes change while it does.

Saad and Schultz (1986). A vector that orthogonalisation leaves short is orthogonalised twice, which is enough for all
that a direction is asked for (Daniel et al. 1976, Mathematics of Computation 30, 772).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import DTypeLike

from rubfric.arrays import Real

# The operator: a vector to its image, and what else follows from the vector linearly.
Operator = Callable[[Real], tuple[Real, Real]]
# A vector of which less than this share is left is orthogonalised again.
_SHORT = 0.1


class Krylov:
    """The best step, in the space that the operator spans from its residual, so far.

    Parameters
    ----------
    operator : callable
        Takes a vector to its image, and to what else follows from it linearly, each an array.
    right : ndarray, shape (n,)
        The image sought.
    guess : ndarray, shape (n,), optional
        A vector to begin with.
    most : int
        Most vectors that the space may have.
    precision : dtype
        That of the basis; single takes half the memory and time where a residual of 1e-5 will do.

    Attributes
    ----------
    applied : int
        Applications of the operator.
    residual : float
        What the image misses, over the norm of ``right``.
    """

    def __init__(
        self, operator: Operator, right: Real, guess: Real | None, most: int, precision: DTypeLike = np.float64
    ) -> None:
        self._operator, self._guess = operator, guess
        self._norm = float(np.linalg.norm(right)) or 1.0
        self.applied, left = 0, right
        self._known: Real | float = 0.0
        if guess is not None:
            image, self._known = operator(guess.astype(precision, copy=False))
            self.applied, left = 1, right - image
        self._start = float(np.linalg.norm(left))
        self._basis = np.empty((most + 1, right.size), dtype=precision)
        self._basis[0] = left / (self._start or 1.0)
        self._beside: list[Real] = []
        self._hessenberg = np.zeros((most + 1, most))
        self._weights: Real = np.zeros(0)
        self.residual = self._start / self._norm

    @property
    def full(self) -> bool:
        """Whether the space cannot grow any more."""
        return len(self._beside) == self._hessenberg.shape[1] or self.residual == 0.0

    def grow(self) -> None:
        """Add one vector to the space."""
        count = len(self._beside)
        basis, column = self._basis[: count + 1], self._hessenberg[:, count]
        whole, beside = self._operator(basis[count])
        self.applied += 1
        self._beside.append(beside)
        image = whole.astype(basis.dtype, copy=False)
        size = float(np.linalg.norm(image))
        for _ in range(2):
            before = size
            shares = basis @ image
            image -= shares @ basis
            column[: count + 1] += shares
            size = float(np.linalg.norm(image))
            if size >= _SHORT * before:
                break
        column[count + 1] = size
        self._basis[count + 1] = image / (size or 1.0)
        system = self._hessenberg[: count + 2, : count + 1]
        wanted = np.zeros(count + 2)
        wanted[0] = self._start
        self._weights = np.linalg.lstsq(system, wanted, rcond=None)[0]
        self.residual = float(np.linalg.norm(wanted - system @ self._weights)) / self._norm

    def vector(self) -> Real:
        """Return the vector whose image comes nearest."""
        # The product in the precision of the basis: no copy of it.
        weights = self._weights.astype(self._basis.dtype)
        found: Real = (weights @ self._basis[: len(weights)]).astype(np.float64)
        return found if self._guess is None else self._guess + found

    def beside(self) -> Real:
        """Return what else follows from that vector."""
        found = self._known + sum(
            (weight * part for weight, part in zip(self._weights, self._beside, strict=True)), np.zeros(1)
        )
        return np.asarray(found)
