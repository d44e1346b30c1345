"""The direction of one Newton step: the linearised contact problem with the full tangent, solved for its contact nodes.

Josephy (1979): the contact conditions stay inequalities where the balance of forces is linearised. For given contact
nodes GMRES solves the balance; nodes that pull leave the contact, nodes that pierce the road join it, and GMRES goes on
from what it had found, until no node does either. Without this, contact nodes that come and go from step to step
keep Newton's method from converging on roads of many waves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, Stiffness
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Linearised, Load, SlidingContact

MOST_KRYLOV = 60
# Sets of contact nodes that are tried, and how many of them in a row may violate no fewer conditions than the best.
_MOST_PASSES, _PATIENCE = 12, 4
# Violations below this share of the largest pressure, or of the road's height, are left to the next step.
_NEGLIGIBLE = 1e-9


@dataclass(frozen=True)
class Direction:
    """A Newton step, the contact nodes that it leads to, and what it took.

    Attributes
    ----------
    step : Fields
    touching : ndarray of bool, shape (columns,)
    krylov : int
        Applications of the tangent in all.
    most : int
        Of them, the most for one set of contact nodes.
    passes : int
        Sets of contact nodes tried.
    """

    step: Fields
    touching: Flags
    krylov: int
    most: int
    passes: int


def newton_direction(
    problem: SlidingContact,
    circulant: Circulant,
    stiffness: Stiffness,
    correction: Correction,
    load: Load,
    touching: Flags,
    forcing: float,
) -> Direction:
    """Solve the linearised contact problem.

    Parameters
    ----------
    problem : SlidingContact
    circulant : Circulant
        Of T.
    stiffness : Stiffness
        The full tangent.
    correction : Correction
        T at the fields about which is linearised.
    load : Load
    touching : ndarray of bool, shape (columns,)
        First guess of the contact nodes.
    forcing : float
        Share of the residual to which GMRES solves.

    Raises
    ------
    numpy.linalg.LinAlgError
        Where contact nodes leave the block loose.
    """
    vector: Real | None = None
    applied = most = passes = 0
    best, patience = len(touching) + 1, _PATIENCE
    while True:
        passes += 1
        linear = Linearised(problem, circulant, stiffness, correction, load, touching)
        vector, pressure, count = _balanced(problem, linear, vector, forcing)
        step = problem.unpack(vector)
        applied, most = applied + count, max(most, count)
        gap = linear.gap(step)
        pulls = touching & (pressure < -_NEGLIGIBLE * np.abs(pressure).max())
        pierces = ~touching & (gap < -_NEGLIGIBLE * problem.height)
        violated = pulls | pierces
        found = int(np.count_nonzero(violated))
        if found < best:
            best, patience = found, _PATIENCE
        else:
            patience -= 1
        if not (found and patience and passes < _MOST_PASSES):
            break
        touching = touching ^ violated
        if not touching.any():
            touching[int(np.argmin(gap))] = True
    return Direction(step, touching, applied, most, passes)


def _balanced(
    problem: SlidingContact, linear: Linearised, guess: Real | None, forcing: float
) -> tuple[Real, Real, int]:
    """Return the packed step at given contact nodes, the pressures, and how often the tangent was applied."""
    rest, held = linear.rest()
    right = problem.pack(rest)
    applied = 0

    def apply(packed: Real) -> Real:
        nonlocal applied
        applied += 1
        return problem.pack(linear.change(problem.unpack(packed))[0])

    operator = LinearOperator((right.size, right.size), matvec=apply, dtype=float)
    vector, _ = gmres(operator, right, x0=guess, rtol=forcing, restart=MOST_KRYLOV, maxiter=1)
    _, change = linear.change(problem.unpack(vector))
    return vector, held + change, applied + 1
