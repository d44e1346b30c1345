"""Block pivots on a surface (Judice and Pires 1994, Computers and Operations Research 21, 587), with inexact systems.

Each step holds the nodes in contact on the road no better than it is worth, by GMRES with C^-1 among the nodes for a
preconditioner; then nodes that pull leave the contact, and those that pierce the road join it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.mechanics.areal.surface import TOLERANCE, ArealSurface

# Share of a residual that GMRES leaves in a pivoting step, and most vectors that it may hold.
_FORCING, _MOST_KRYLOV = 0.05, 24
# Pivoting steps in a row that need not bring the nodes that violate contact to a new low, and most steps.
_PATIENCE, MOST_PIVOTS = 4, 60


@dataclass
class Pivoting:
    """Block pivots; ``run`` says whether the contact that it ends at is the solution."""

    surface: ArealSurface
    profile: Real
    nominal: float
    steps: int
    pressure: Real = field(init=False)

    def run(self, pressure: Real) -> bool:
        """Pivot from the nodes on which a pressure is positive, or from the highest.

        Parameters
        ----------
        pressure : ndarray, shape (ny, nx)
            MPa.
        """
        touching, best, patience = pressure > 0.0, self.surface.nodes + 1, _PATIENCE
        height = float(np.ptp(self.profile))
        if not touching.any():
            touching.flat[int(np.argmax(self.profile))] = True
        for _ in range(MOST_PIVOTS):
            self.steps += 1
            pressure, left = self._held(pressure, touching)
            missed = self.profile - self.surface.deflection(pressure)
            gap = missed[touching].mean() - missed
            pulls = touching & (pressure < -TOLERANCE * pressure.max())
            pierces = ~touching & (gap < -TOLERANCE * height)
            violated = pulls | pierces
            count = int(np.count_nonzero(violated))
            if not np.isfinite(left) or not np.isfinite(gap).all():
                return False
            if count == 0 and left <= TOLERANCE:
                self.pressure = pressure
                return True
            if count < best:
                best, patience = count, _PATIENCE
            elif count and patience == 0:
                return False
            patience -= 1
            touching = touching ^ violated
            if not touching.any():
                touching.flat[int(np.argmin(gap))] = True
        return False

    def _held(self, pressure: Real, touching: Flags) -> tuple[Real, float]:
        """Return pressures on the nodes in contact that hold them on the road better, and the residual left.

        The preconditioner is the saddle of load, offset and C^-1 among the nodes (Keller, Gould and Wathen 2000, SIAM
        J. Matrix Anal. Appl. 21, 1300): corrections carry no load, and a height that all nodes miss alike needs none.
        """
        even = self.surface.pressing(touching.astype(float))[touching]
        even /= even.sum()

        def spread(values: Real) -> Real:
            everywhere = np.zeros(self.surface.shape)
            everywhere[touching] = values
            return everywhere

        def corrected(missed: Real) -> Real:
            found = self.surface.pressing(missed)[touching]
            return found - even * found.sum()

        def applied(values: Real) -> Real:
            return corrected(self.surface.deflection(spread(values)) * touching)

        inside, load = pressure[touching], self.nominal * self.surface.nodes
        missing = load - float(inside.sum())
        # Pressures far beyond a light load would leave none of its digits.
        inside = inside + even * missing if abs(missing) < load else even * load
        missed = (self.profile - self.surface.deflection(spread(inside))) * touching
        right = corrected(missed)
        size = float(np.linalg.norm(inside))
        change, left = _reduced(applied, right, max(_FORCING * float(np.linalg.norm(right)), 0.5 * TOLERANCE * size))
        return spread(inside + change), left / size


def _reduced(applied: Callable[[Real], Real], right: Real, target: float) -> tuple[Real, float]:
    """Return x that GMRES finds with few vectors, and the norm of A x - b that is left.

    Parameters
    ----------
    applied : callable
        A x, shape (m,), of x.
    right : ndarray, shape (m,)
        b.
    target : float
        Norm that is small enough.
    """
    left = size = float(np.linalg.norm(right))
    most = min(_MOST_KRYLOV, len(right) - 1)
    if not target < left < np.inf or most < 1:
        return np.zeros_like(right), left
    basis, projected = [right / size], np.zeros((most + 1, most))
    weights = np.zeros(0)
    for step in range(most):
        vector = applied(basis[step])
        for known, part in enumerate(basis):
            projected[known, step] = part @ vector
            vector -= projected[known, step] * part
        length = float(np.linalg.norm(vector))
        projected[step + 1, step] = length
        system, goal = projected[: step + 2, : step + 1], np.eye(step + 2)[0] * size
        weights = np.linalg.lstsq(system, goal, rcond=None)[0]
        left = float(np.linalg.norm(system @ weights - goal))
        if left <= target or not length > 0.0:
            break
        basis.append(vector / length)
    change = np.zeros_like(right)
    for weight, part in zip(weights, basis, strict=False):
        change += weight * part
    return change, left
