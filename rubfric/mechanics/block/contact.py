"""Frictionless unilateral contact of an elastic or viscoelastic surface with a rigid profile.

Find the pressure p and the rigid offset d of a periodic surface with compliance C such that

    gap = C p + d - s >= 0,    p >= 0,    p gap = 0,    mean(p) = nominal pressure.

In small strain C is circulant: a convolution along the surface, given by its spectrum. Sliding viscoelastic
surfaces have a C that is not symmetric, yet positive definite, so that the problem has one solution, and block
principal pivoting (Judice and Pires 1994, Computers and Operations Research 21, 587) with single pivots as its
fallback finds it after finitely many steps. Nothing is penalised.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from rubfric.arrays import Complex, Flags, Real, Whole
from rubfric.errors import NotConverged

MOST_STEPS = 500
# Block pivots in a row that may fail to reduce the violations before single pivots take over.
_PATIENCE = 10
# Ratio of one load to the one before where they fall step by step, and the one next to 1 at which to give up; pivoting
# steps at one of them, and in all.
_FIRST_FACTOR, _LAST_FACTOR = 0.7, 0.999999
_STEPS_ON_THE_WAY, _MOST_STEPS_ALONG = 60, 10_000
# Nodes in contact that one dense system may have: 300 MB.
_MOST_NODES = 6000
# Violations below this share of the height scale, or of the pressure scale, are round-off.
_ROUND_OFF = 1e-11


@dataclass(frozen=True)
class Contact:
    """A solved contact.

    Attributes
    ----------
    pressure : ndarray, shape (n,)
        Contact pressure at the surface nodes, MPa; positive on the contact, zero elsewhere.
    gap : ndarray, shape (n,)
        Height of the surface above the road, mm; zero on the contact.
    offset : float
        Rigid offset d, mm.
    iterations : int
        Pivoting steps; zero where full contact was recognised.
    """

    pressure: Real
    gap: Real
    offset: float
    iterations: int

    @property
    def touching(self) -> Flags:
        """Nodes in contact, shape (n,)."""
        return self.pressure > 0.0


class Surface(Protocol):
    """A surface that yields to pressures linearly; both in the frame of the road."""

    def matrix(self, inside: Whole) -> Real:
        """Return C among the nodes ``inside``, shape (m, m), mm/MPa."""
        ...

    def deflection(self, pressure: Real) -> Real:
        """Return C p, shape (n,), mm, from pressures in MPa."""
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
        self._kernel = np.fft.irfft(compliance, nodes)

    def matrix(self, inside: Whole) -> Real:
        """Return C among the nodes ``inside``."""
        return self._kernel[inside[:, None] - inside[None, :]]

    def deflection(self, pressure: Real) -> Real:
        """Return C p."""
        return np.fft.irfft(self._compliance * np.fft.rfft(pressure), len(self._kernel))


def full_contact(compliance: Complex, profile: Real, nominal: float) -> Contact | None:
    """Return the contact that fills the whole road, or None where it would need to pull.

    Parameters
    ----------
    compliance : ndarray of complex, shape (n // 2 + 1,)
        Spectrum of C, mm/MPa; its entry 0 is not used.
    profile : ndarray, shape (n,)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    """
    pressure = nominal + _filling(compliance, profile)
    if pressure.min() < 0.0:
        return None
    return Contact(pressure, np.zeros_like(profile), float(np.fft.rfft(profile)[0].real) / len(profile), 0)


def _filling(compliance: Complex, profile: Real) -> Real:
    """Return the pressure less its mean that holds the surface on the whole profile, shape (n,), MPa."""
    spectrum = np.fft.rfft(profile)
    held = np.zeros_like(spectrum)
    # Harmonics that the road lacks need no pressure; their round-off would be amplified.
    present = np.abs(spectrum) > 1e-13 * max(float(np.abs(spectrum).max()), 1e-300)
    present[0] = False
    held[present] = spectrum[present] / compliance[present]
    return np.fft.irfft(held, len(profile))


def solve_contact(
    compliance: Complex,
    profile: Real,
    nominal: float,
    start: Flags,
    label: str = "contact",
) -> Contact:
    """Solve the complementarity problem of a circulant C, as ``pivot`` does; along falling loads where that cycles.

    As the load falls from where it fills the road, the contact loses and gains few nodes at a time.

    Parameters
    ----------
    compliance : ndarray of complex, shape (n // 2 + 1,)
        Spectrum of C, mm/MPa; its entry 0 is not used.
    profile : ndarray, shape (n,)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    start : ndarray of bool, shape (n,)
        First guess, not empty; rather too large than too small.
    label : str
        Name that an error carries.

    Raises
    ------
    NotConverged
        As ``pivot`` does.
    """
    surface = Convolution(compliance, len(profile))
    try:
        return pivot(surface, profile, nominal, start, label, MOST_STEPS)
    except NotConverged as error:
        if error.step < MOST_STEPS:
            raise
    load = -float(_filling(compliance, profile).min())
    touching, factor, steps = np.ones_like(start), _FIRST_FACTOR, MOST_STEPS
    while True:
        ahead = max(nominal, load * factor)
        try:
            found = pivot(surface, profile, ahead, touching, label, min(_STEPS_ON_THE_WAY, MOST_STEPS))
        except NotConverged:
            if factor > _LAST_FACTOR or steps > _MOST_STEPS_ALONG:
                raise
            factor, steps = factor**0.5, steps + _STEPS_ON_THE_WAY
            continue
        load, touching, factor, steps = ahead, found.touching, factor**1.5, steps + found.iterations
        if load == nominal:
            return replace(found, iterations=steps)


def pivot(
    surface: Surface,
    profile: Real,
    nominal: float,
    start: Flags,
    label: str = "contact",
    most_steps: int = MOST_STEPS,
) -> Contact:
    """Solve the complementarity problem from a first guess of the contact.

    Parameters
    ----------
    surface : Surface
        C.
    profile : ndarray, shape (n,)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    start : ndarray of bool, shape (n,)
        First guess, not empty; rather too large than too small.
    label : str
        Name that an error carries.
    most_steps : int
        Pivoting steps after which to give up.

    Raises
    ------
    NotConverged
        After ``most_steps`` steps, with the number of nodes that still violate a condition; at once where the
        system is singular, its solution is not finite, or more nodes touch than can be solved at once.
    """
    nodes = len(profile)
    height_scale = float(np.ptp(profile)) or 1.0
    touching, best, patience = start.copy(), nodes + 1, _PATIENCE
    for step in range(1, most_steps + 1):
        inside = np.flatnonzero(touching)
        if len(inside) > _MOST_NODES:
            raise NotConverged(label, step, len(inside), f"number of nodes in contact (at most {_MOST_NODES})")
        try:
            pressure, offset = _equilibrium(surface, profile, nominal, inside)
        except np.linalg.LinAlgError as error:
            raise NotConverged(label, step, np.inf, "condition of the contact system") from error
        gap = surface.deflection(pressure) + offset - profile
        if not (np.isfinite(pressure).all() and np.isfinite(gap).all()):
            raise NotConverged(label, step, np.nan, "contact pressure or gap")
        gap[inside] = 0.0
        pulls = touching & (pressure < -_ROUND_OFF * np.abs(pressure).max())
        pierces = ~touching & (gap < -_ROUND_OFF * height_scale)
        violated = pulls | pierces
        count = int(np.count_nonzero(violated))
        if count == 0:
            return Contact(np.maximum(pressure, 0.0), np.maximum(gap, 0.0), offset, step)
        if count < best:
            best, patience = count, _PATIENCE
        elif patience:
            patience -= 1
        if patience:
            touching ^= violated
        else:
            touching[np.flatnonzero(violated)[-1]] ^= True
        if not touching.any():
            touching[int(np.argmin(gap))] = True
    raise NotConverged(label, most_steps, count, "number of surface nodes that violate contact")


def _equilibrium(surface: Surface, profile: Real, nominal: float, inside: Whole) -> tuple[Real, float]:
    """Return the pressure that holds the nodes ``inside`` on the road under the load, and the offset."""
    count = len(inside)
    # The load is an equation of the system: where all nodes touch, pressures alone would be unknown by a constant.
    system = np.zeros((count + 1, count + 1))
    system[:count, :count] = surface.matrix(inside)
    unit = float(np.abs(system.diagonal()).max())
    system[:count, count] = system[count, :count] = unit
    held = np.linalg.solve(system, np.append(profile[inside], unit * nominal * len(profile)))
    pressure = np.zeros_like(profile)
    pressure[inside] = held[:count]
    return pressure, float(unit * held[count])
