"""Self-affine profiles of known spectrum, and what a laser profilometer makes of them."""

from __future__ import annotations

import numpy as np


def self_affine(
    rng: np.random.Generator,
    points: int,
    spacing: float,
    hurst: float,
    level: float,
    longest: float = np.inf,
    shortest: float = 0.0,
) -> np.ndarray:
    """Return heights with C(q) = level q^-(1 + 2 hurst), constant beyond the longest wavelength, 0 below the shortest.

    They are Gaussian and repeat after ``points * spacing``.
    """
    step = 2.0 * np.pi / (points * spacing)
    q = step * np.arange(1, points // 2 + 1)
    density = level * np.maximum(q, 2.0 * np.pi / longest) ** -(1.0 + 2.0 * hurst) * (q * shortest <= 2.0 * np.pi)
    waves = np.zeros(points // 2 + 1, dtype=complex)
    waves[1:] = np.sqrt(0.25 * density * step) * (rng.standard_normal(len(q)) + 1j * rng.standard_normal(len(q)))
    return np.fft.irfft(waves * points, points)


def dropouts(rng: np.random.Generator, heights: np.ndarray, count: int, longest: int) -> np.ndarray:
    """Return heights with gaps of up to so many points."""
    out = heights.copy()
    for begin in rng.integers(0, len(out) - longest, count):
        out[begin : begin + rng.integers(1, longest + 1)] = np.nan
    return out
