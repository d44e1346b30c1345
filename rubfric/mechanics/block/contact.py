"""Frictionless unilateral contact of an elastic or viscoelastic surface with a rigid profile.

Find the pressure p and the rigid offset d of a periodic surface with compliance C such that

    gap = C p + d - s >= 0,    p >= 0,    p gap = 0,    mean(p) = nominal pressure.

In small strain C is circulant: a convolution along the surface, given by its spectrum. Sliding viscoelastic
surfaces have a C that is not symmetric, yet positive definite, so that the problem has one solution, which changes
continuously with load and profile. Block principal pivoting (Judice and Pires 1994, Computers and Operations Research
21, 587) finds it in a few steps from a contact nearby: that on a mesh of half as many nodes, or, where it cycles, that
with a profile nearby. Nothing is penalised.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rubfric.arrays import Complex, Flags, Real
from rubfric.errors import NotConverged
from rubfric.mechanics.block.surface import Convolution, Equilibrium, Surface, Unsolved

MOST_STEPS = 500
# Block pivots in a row that may fail to reduce the violations before single pivots take over.
_PATIENCE = 10
# Steps after which another way is faster. Where a profile turns into another: all steps, the least share of the way.
_STEPS_AT_ONCE, _MOST_STEPS_ALONG, _LEAST_SHARE = 30, 10_000, 1e-9
# Most nodes of the first mesh, from coarse to fine.
_COARSEST = 16


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
    start: Flags | None = None,
    label: str = "contact",
) -> Contact:
    """Solve the complementarity problem of a circulant C.

    From a first guess as ``pivot`` does. Without one, or where that is too far off, from coarse to fine: first the
    longest waves of the road on few nodes, then each mesh from the contact on the one before.

    Parameters
    ----------
    compliance : ndarray of complex, shape (n // 2 + 1,)
        Spectrum of C, mm/MPa; its entry 0 is not used.
    profile : ndarray, shape (n,)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    start : ndarray of bool, shape (n,), optional
        First guess, not empty; rather too large than too small.
    label : str
        Name that an error carries.

    Raises
    ------
    NotConverged
        As ``pivot`` does.
    """
    steps, sizes = 0, [len(profile)]
    if start is not None:
        most = min(_STEPS_AT_ONCE, MOST_STEPS)
        try:
            return pivot(Convolution(compliance, len(profile)), profile, nominal, start, label, most)
        except NotConverged as error:
            if not np.isfinite(error.residual):
                raise
            steps = error.step
    while sizes[-1] > _COARSEST:
        sizes.append((sizes[-1] + 1) // 2)
    series = np.fft.rfft(profile)
    near = Contact(np.full(sizes[-1], float(nominal)), np.zeros(sizes[-1]), 0.0, 0)
    for nodes in reversed(sizes):
        kept = nodes // 2 + 1
        road = profile if nodes == len(profile) else np.fft.irfft(series[:kept] * (nodes / len(profile)), nodes)
        near = follow(Convolution(compliance[:kept], nodes), road, nominal, _carried(near, nodes, nominal), label)
        steps += near.iterations
    return replace(near, iterations=steps)


def _carried(contact: Contact, nodes: int, nominal: float) -> Contact:
    """Return a contact on another number of nodes, each with the pressure or the gap of the one at its place."""
    place = np.arange(nodes) * len(contact.pressure) // nodes
    pressure = contact.pressure[place]
    return Contact(pressure * (nominal / pressure.mean()), contact.gap[place], contact.offset, 0)


def even_contact(touching: Flags, nominal: float) -> Contact:
    """Return the contact that bears a nominal pressure, MPa, alike on all nodes that touch, and leaves no gap.

    Parameters
    ----------
    touching : ndarray of bool, shape (n,)
        Not empty.
    nominal : float
    """
    return Contact(touching * (nominal / touching.mean()), np.zeros(len(touching)), 0.0, 0)


def follow(
    surface: Surface,
    profile: Real,
    nominal: float,
    near: Contact,
    label: str = "contact",
    most_steps: int = _MOST_STEPS_ALONG,
) -> Contact:
    """Solve the complementarity problem from any contact of the surface, with whatever profile.

    Pivots start from its nodes. Where they cycle, its profile, which follows from C p and the gap, turns into the given
    one in steps, so small that pivots find each contact from the one before.

    Parameters
    ----------
    surface : Surface
        C.
    profile : ndarray, shape (n,)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    near : Contact
        Pressure and gap at n nodes, one of them zero at each; of the same nominal pressure.
    label : str
        Name that an error carries.
    most_steps : int
        Pivoting steps of all attempts after which to give up.

    Raises
    ------
    NotConverged
        As ``pivot`` does, where the least step is too long or all steps are too many.
    """
    begin = surface.deflection(near.pressure) - near.gap
    touching, share, ahead, steps = near.touching, 0.0, 1.0, 0
    most = min(_STEPS_AT_ONCE, MOST_STEPS)
    while True:
        aim = min(share + ahead, 1.0)
        try:
            found = pivot(surface, (1.0 - aim) * begin + aim * profile, nominal, touching, label, most)
        except NotConverged as error:
            steps, ahead = steps + error.step, ahead / 4.0
            if not np.isfinite(error.residual) or ahead < _LEAST_SHARE or steps > most_steps:
                raise
            continue
        steps += found.iterations
        if aim == 1.0:
            return replace(found, iterations=steps)
        share, ahead, touching = aim, 2.0 * ahead, found.touching


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
        system is singular, its solution is not finite, or too many nodes touch for one that only a dense system solves.
    """
    nodes = len(profile)
    height_scale = float(np.ptp(profile)) or 1.0
    touching, best, patience = start.copy(), nodes + 1, _PATIENCE
    for step in range(1, most_steps + 1):
        inside = np.flatnonzero(touching)
        try:
            held, pressure = Equilibrium(surface, nodes, inside), np.zeros(nodes)
            pressure[inside], offset = held.solve(profile[inside], nominal * nodes)
        except Unsolved as error:
            raise NotConverged(label, step, *error.args) from error
        gap = surface.deflection(pressure) + offset - profile
        if not (np.isfinite(pressure).all() and np.isfinite(gap).all()):
            raise NotConverged(label, step, np.nan, "contact pressure or gap")
        gap[inside] = 0.0
        pulls = touching & (pressure < -held.round_off * np.abs(pressure).max())
        pierces = ~touching & (gap < -held.round_off * height_scale)
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
    raise NotConverged(
        label,
        most_steps,
        count,
        "number of surface nodes that violate contact",
        "another mesh may do: change numerics.columns_min or numerics.contact_nodes",
    )
