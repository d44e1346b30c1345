"""Frictionless unilateral contact of a sliding viscoelastic surface with a rigid road, in the plane, at n log n a step.

Find the pressure p and the rigid offset d such that

    gap = C p + d - s >= 0,    p >= 0,    p gap = 0,    mean(p) = nominal pressure.

The loss makes C non-symmetric, so that no energy is minimised; it is positive definite, and the problem has one
solution. Two methods take turns, from coarse nodes to fine:

1. Block pivots (Judice and Pires 1994, Computers and Operations Research 21, 587) whose systems are solved no further
   than each is worth, by GMRES with C^-1 among the nodes in contact for a preconditioner: in all some tens of
   transforms from a contact nearby. They cycle where rubber is many times softer along some waves than along others.
2. Douglas-Rachford splitting (Lions and Mercier 1979, SIAM J. Numer. Anal. 16, 964) of the problem into that without
   the bound on p, which a Fourier transform solves, and the bound: with any step lambda it converges for every C whose
   symmetric part is positive definite, if slowly,

       x = (1 + lambda C)^-1 (z + lambda (s - d)),  mean(x) = nominal;   r = max(2 x - z, 0);   z <- z + r - x.

   At the end z = p + lambda gap, which is also where it starts from.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Flags, Real
from rubfric.errors import NotConverged
from rubfric.mechanics.areal.surface import ArealSurface

# What may be left: of balance over the pressures; of contact over the largest pressure and the height of the road.
TOLERANCE = 1e-8
# What is left over the pressures where splitting has run as long as it may: friction has four digits then.
LOOSE = 1e-6
# Share of a residual that GMRES leaves in a pivoting step, and most vectors that it may hold.
_FORCING, _MOST_KRYLOV = 0.05, 24
# Pivoting steps in a row that need not bring the nodes that violate contact to a new low, and most steps.
_PATIENCE, _MOST_PIVOTS = 4, 60
# Splitting steps of the first turn, each turn having twice as many as the one before; turns.
_FIRST_TURN, _TURNS = 64, 10
# Lambda is doubled or halved where one of its two residuals is so many times the other.
_UNBALANCED = 4.0


@dataclass(frozen=True, eq=False)
class ArealContact:
    """A contact.

    Attributes
    ----------
    pressure : ndarray, shape (ny, nx)
        MPa, at the nodes; positive on the contact, zero elsewhere.
    gap : ndarray, shape (ny, nx)
        Height of the surface above the road, mm; zero on the contact.
    offset : float
        Rigid offset d, mm.
    pivots, splittings : int
        Steps of either method, on all meshes.
    """

    pressure: Real
    gap: Real
    offset: float
    pivots: int = 0
    splittings: int = 0

    @property
    def touching(self) -> Flags:
        """Nodes in contact, shape (ny, nx)."""
        return self.pressure > 0.0

    @property
    def fraction(self) -> float:
        """Share of the nodes in contact."""
        return float(self.touching.mean())

    def on(self, shape: tuple[int, int]) -> ArealContact:
        """Return it on other nodes, each with the values of the one at its place."""
        rows, columns = (np.arange(n) * len_ // n for n, len_ in zip(shape, self.pressure.shape, strict=True))
        place = np.ix_(rows, columns)
        pressure = self.pressure[place]
        pressure *= self.pressure.mean() / pressure.mean()
        return ArealContact(pressure, self.gap[place], self.offset, self.pivots, self.splittings)


def full_contact(surface: ArealSurface, profile: Real, nominal: float) -> ArealContact | None:
    """Return the contact that fills the whole road, or None where it would need to pull.

    Parameters
    ----------
    surface : ArealSurface
    profile : ndarray, shape (ny, nx)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    """
    pressure = surface.pressing(profile - profile.mean()) + nominal
    if pressure.min() <= 0.0:
        return None
    return ArealContact(pressure, np.zeros_like(profile), float(profile.mean()))


def solve_contact(
    surface: ArealSurface, profile: Real, nominal: float, near: ArealContact | None = None, label: str = "contact"
) -> ArealContact:
    """Solve the complementarity problem.

    Parameters
    ----------
    surface : ArealSurface
        C.
    profile : ndarray, shape (ny, nx)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    near : ArealContact, optional
        A contact nearby on the same nodes; without one, splitting begins.
    label : str
        Name that an error carries.

    Raises
    ------
    NotConverged
        Where neither method converges, with what splitting has left; at once where a number is not finite.
    """
    filled = full_contact(surface, profile, nominal)
    if filled is not None:
        return filled
    before = (near.pivots, near.splittings) if near else (0, 0)
    splitting = _Splitting(surface, profile, nominal, near)
    pivoting = _Pivoting(surface, profile, nominal, before[0])

    def found(pressure: Real) -> ArealContact:
        return _contact(surface, profile, nominal, pressure, (pivoting.steps, before[1] + splitting.steps))

    for turn in range(_TURNS):
        solved = (near is not None or turn > 0) and pivoting.run(splitting.pressure)
        if solved:
            return found(pivoting.pressure)
        if splitting.run(_FIRST_TURN * 2**turn):
            return found(splitting.pressure)
        if not np.isfinite(splitting.residual):
            break
    if splitting.residual <= LOOSE:
        return found(splitting.pressure)
    raise NotConverged(
        label,
        splitting.steps,
        splitting.residual,
        "distance from contact over the pressures",
        "the rubber is far softer along some waves than along others: raise the pressure, or lower numerics.nodes",
    )


def _contact(
    surface: ArealSurface, profile: Real, nominal: float, pressure: Real, steps: tuple[int, int]
) -> ArealContact:
    pressure = np.maximum(pressure, 0.0)
    pressure *= nominal / pressure.mean()
    touching = pressure > 0.0
    missed = profile - surface.deflection(pressure)
    offset = float(missed[touching].mean())
    return ArealContact(pressure, np.where(touching, 0.0, np.maximum(offset - missed, 0.0)), offset, *steps)


@dataclass
class _Pivoting:
    """Block pivots; ``run`` says whether the contact that it ends at is the solution."""

    surface: ArealSurface
    profile: Real
    nominal: float
    steps: int
    pressure: Real = field(init=False)

    def run(self, pressure: Real) -> bool:
        """Pivot from the nodes on which a pressure is positive.

        Parameters
        ----------
        pressure : ndarray, shape (ny, nx)
            MPa.
        """
        touching, best, patience = pressure > 0.0, self.surface.nodes + 1, _PATIENCE
        height = float(np.ptp(self.profile))
        for _ in range(_MOST_PIVOTS):
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
                return False
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

        inside = pressure[touching]
        inside += even * (self.nominal * self.surface.nodes - inside.sum())
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


class _Splitting:
    """Douglas-Rachford splitting; ``run`` says whether its pressure is the solution."""

    def __init__(self, surface: ArealSurface, profile: Real, nominal: float, near: ArealContact | None) -> None:
        self._surface, self._nominal = surface, nominal
        self._profile = fft.rfft2(profile)
        self.steps, self.residual = 0, np.inf
        if near is None:
            self.pressure, gap = np.full(surface.shape, nominal), np.maximum(-profile + profile.mean(), 0.0)
        else:
            self.pressure, gap = near.pressure, near.gap
        # The pressures and lambda times the gaps weigh alike.
        self._step = float(np.linalg.norm(self.pressure) / np.linalg.norm(gap)) if gap.any() else self._stiffest()
        self._state = self.pressure + self._step * gap

    def _stiffest(self) -> float:
        return float(1.0 / np.abs(self._surface.compliance[self._surface.compliance != 0.0]).min())

    def run(self, steps: int) -> bool:
        """Take so many steps, or fewer."""
        resolvent = self._resolvent()
        for _ in range(steps):
            series = fft.rfft2(self._state)
            series += self._step * self._profile
            series *= resolvent
            series[0, 0] = self._nominal * self._surface.nodes
            free = fft.irfft2(series, self._surface.shape, overwrite_x=True)
            bound = np.maximum(2.0 * free - self._state, 0.0)
            away = bound - free
            size, dual = float(np.linalg.norm(bound)), float(np.linalg.norm(self._state - free))
            change = float(np.linalg.norm(bound - self.pressure)) / (dual or 1.0)
            self._state += away
            self.pressure, self.steps = bound, self.steps + 1
            self.residual = max(float(np.linalg.norm(away)) / size, change * dual / size)
            if not self.residual > TOLERANCE:
                return bool(np.isfinite(self.residual))
            if self.steps & (self.steps - 1) == 0 and self.steps >= 8:
                primal = float(np.linalg.norm(away)) / size
                factor = 0.5 if primal > _UNBALANCED * change else 2.0 if change > _UNBALANCED * primal else 1.0
                if factor != 1.0:
                    self._state = bound + factor * (self._state - bound)
                    self._step *= factor
                    resolvent = self._resolvent()
        return False

    def _resolvent(self) -> Complex:
        return 1.0 / (1.0 + self._step * self._surface.compliance)
