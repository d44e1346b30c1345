"""Virtual roads: self-affine profiles of known spectrum, and what a profilometer makes of them."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Flags, Real


def self_affine(
    rng: np.random.Generator,
    points: int,
    spacing: float,
    hurst: float,
    level: float,
    longest: float = np.inf,
    shortest: float = 0.0,
) -> Real:
    """Return Gaussian heights with C(q) = level q^-(1 + 2 H), as ``rubfric.profile.spectrum`` defines C.

    Parameters
    ----------
    rng : numpy.random.Generator
    points : int
        The profile repeats after that many.
    spacing : float
        mm.
    hurst : float
        H; the fractal dimension of the profile is 2 - H.
    level : float
        C at 1/mm, mm³.
    longest : float
        Wavelength beyond which C is constant, mm.
    shortest : float
        Wavelength below which C is zero, mm.

    Returns
    -------
    ndarray, shape (points,)
        mm.
    """
    step = 2.0 * np.pi / (points * spacing)
    q = step * np.arange(1, points // 2 + 1)
    density = level * np.maximum(q, 2.0 * np.pi / longest) ** -(1.0 + 2.0 * hurst) * (q * shortest <= 2.0 * np.pi)
    waves = np.zeros(points // 2 + 1, dtype=complex)
    waves[1:] = np.sqrt(0.25 * density * step) * (rng.standard_normal(len(q)) + 1j * rng.standard_normal(len(q)))
    return np.fft.irfft(waves * points, points)


def as_measured(
    rng: np.random.Generator, heights: Real, dropouts: int = 0, longest: int = 10, spikes: int = 0, spike: float = 1.0
) -> tuple[Real, Flags]:
    """Return heights with dropouts (NaN) and spikes of one point, and where the spikes are.

    Parameters
    ----------
    rng : numpy.random.Generator
    heights : ndarray, shape (points,)
        mm.
    dropouts, longest : int
        How many, some of which may overlap, and most points of one.
    spikes : int
        How many, none of them in a dropout.
    spike : float
        Height of a spike, up or down, mm.
    """
    out = heights.copy()
    for begin in rng.integers(0, len(out) - longest, dropouts):
        out[begin : begin + rng.integers(1, longest + 1)] = np.nan
    there = np.zeros(len(out), dtype=bool)
    there[rng.choice(np.flatnonzero(np.isfinite(out)), spikes, replace=False)] = True
    out[there] += rng.choice([-spike, spike], spikes)
    return out, there
