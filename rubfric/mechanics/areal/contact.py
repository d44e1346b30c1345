"""Frictionless unilateral contact of a sliding viscoelastic surface with a rigid road, in the plane, at n log n a step.

Find the pressure p and the rigid offset d such that

    gap = C p + d - s >= 0,    p >= 0,    p gap = 0,    mean(p) = nominal pressure.

The loss makes C non-symmetric, so that no energy is minimised; it is positive definite, and the problem has one
solution. Two methods take turns, from coarse nodes to fine:

1. Block pivots with inexact systems (``rubfric.mechanics.areal.pivoting``): in all some tens of transforms from a
   contact nearby. They cycle where rubber is many times softer along some waves than along others.
2. Douglas-Rachford splitting (``rubfric.mechanics.areal.splitting``) of the problem into that without the bound on p,
   which a Fourier transform solves, and the bound: it converges for every C, if slowly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.errors import NotConverged
from rubfric.mechanics.areal.pivoting import Pivoting
from rubfric.mechanics.areal.splitting import Splitting
from rubfric.mechanics.areal.surface import ArealSurface

# What is left over the pressures where splitting has run as long as it may: friction has four digits then.
LOOSE = 1e-6
# Splitting steps of the first turn, each turn having twice as many as the one before; turns; most steps times nodes,
# but for the first turns.
_FIRST_TURN, _TURNS, _MOST_WORK, _FIRST_TURNS = 64, 10, 2e9, 4


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
        rows, columns = (np.arange(to) * of // to for to, of in zip(shape, self.pressure.shape, strict=True))
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
    splitting = Splitting(surface, profile, nominal, (near.pressure, near.gap) if near else None)
    pivoting = Pivoting(surface, profile, nominal, before[0])

    def found(pressure: Real) -> ArealContact:
        return _contact(surface, profile, nominal, pressure, (pivoting.steps, before[1] + splitting.steps))

    for turn in range(_TURNS):
        solved = (near is not None or turn > 0) and pivoting.run(splitting.pressure)
        if solved:
            return found(pivoting.pressure)
        if splitting.run(_FIRST_TURN * 2**turn):
            return found(splitting.pressure)
        worked = splitting.steps * surface.nodes
        if not np.isfinite(splitting.residual) or (turn >= _FIRST_TURNS and worked > _MOST_WORK):
            break
    if splitting.residual <= LOOSE:
        return found(splitting.pressure)
    raise NotConverged(
        label,
        splitting.steps,
        splitting.residual,
        "distance from contact over the pressures",
        "at this speed the rubber is far stiffer than at rest, and nearly all loss: another speed, a higher pressure, "
        "or fewer nodes (numerics.nodes_max) may do",
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
