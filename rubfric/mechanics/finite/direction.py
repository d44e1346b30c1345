"""The direction of one Newton step: the linearised contact problem with the full tangent, solved for its contact nodes.

Josephy (1979): the contact conditions stay inequalities where the balance of forces is linearised. For given contact
nodes GMRES solves the balance; nodes that pull leave the contact, nodes that pierce the road join it, and GMRES goes on
from what it had found, until no node does either. Without this, contact nodes that come and go from step to step
keep Newton's method from converging on roads of many waves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, Stiffness
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact
from rubfric.mechanics.finite.krylov import Krylov, Operator
from rubfric.mechanics.finite.linearised import EVEN, Linearised, scaling
from rubfric.road.road import finest_waves

MOST_KRYLOV = 60
# Sets of contact nodes that are tried: more of them are worth less than a new linearisation.
_MOST_PASSES = 4
# Shares of the residual down to which single precision is enough, for vectors and, as long as moduli differ by no more
# than a factor, for the tangent: what differs by more would be lost in its digits.
_SINGLE, _MOST_CONTRAST = 1e-4, 1e4
# Applications of the tangent after which no other set is tried.
_MOST_APPLIED = 120
# The first few sets are told from each other after GMRES has solved to this share of the residual.
_LOOSE, _LOOSE_PASSES = 0.1, 3
# One violation in so many columns is left to the next step.
_COLUMNS_PER_FEW = 512
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
    plain : tuple of Fields and ndarray of bool, optional
        The step at the first guess of the contact nodes, and these, where the last ones still violate conditions.
    """

    step: Fields
    touching: Flags
    krylov: int
    most: int
    passes: int
    plain: tuple[Fields, Flags] | None = None


def newton_direction(
    problem: SlidingContact,
    circulant: Circulant,
    stiffness: Stiffness,
    correction: Correction,
    load: Load,
    touching: Flags,
    forcing: float,
    scaled: bool = True,
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
    scaled : bool
        Whether local stiffness scales the preconditioner, which pays where GMRES takes many iterations.

    Raises
    ------
    numpy.linalg.LinAlgError
        Where contact nodes leave the block loose.
    """
    vector: Real | None = None
    applied = most = passes = 0
    precision = np.float32 if forcing >= _SINGLE else np.float64
    scale = scaling(problem.finite, stiffness, finest_waves(load.road)) if scaled else EVEN
    few = len(touching) // _COLUMNS_PER_FEW
    finite = problem.finite
    if precision is np.float32 and finite.contrast <= _MOST_CONTRAST:
        finite, circulant, stiffness = finite.single(), circulant.single(), stiffness.single()
    while True:
        passes += 1
        linear = Linearised(problem, finite, circulant, stiffness, correction, load, touching, scale)
        rest, held = linear.rest()
        krylov = Krylov(_operator(problem, linear), problem.pack(rest), vector, MOST_KRYLOV, precision)
        for goal in (max(_LOOSE, forcing), forcing):
            while krylov.residual > goal and not krylov.full:
                krylov.grow()
            change, moved = krylov.beside()
            pressure, gap = held + change, correction.above + moved
            pulls = touching & (pressure < -_NEGLIGIBLE * np.abs(pressure).max())
            pierces = ~touching & (gap < -_NEGLIGIBLE * problem.height)
            violated = pulls | pierces
            found = int(np.count_nonzero(violated))
            if found > few and passes <= _LOOSE_PASSES:
                break
        vector = krylov.vector()
        applied, most = applied + krylov.applied, max(most, krylov.applied)
        if passes == 1:
            first = problem.unpack(vector), touching
        if not (found > few and passes < _MOST_PASSES and applied < _MOST_APPLIED):
            plain = first if found > few and passes > 1 else None
            return Direction(problem.unpack(vector), touching ^ violated, applied, most, passes, plain)
        touching = touching ^ violated
        if not touching.any():
            touching[int(np.argmin(gap))] = True


def _operator(problem: SlidingContact, linear: Linearised) -> Operator:
    """Return the derivative of u - T(u) on packed steps; beside it go the pressures and the way along the normals."""

    def apply(packed: Real) -> tuple[Real, Real]:
        step = problem.unpack(packed.astype(linear.precision, copy=False))
        change, pressure = linear.change(step)
        return problem.pack(change), np.stack((pressure, linear.along_normals(step)))

    return apply
