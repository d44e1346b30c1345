"""Whether the friction of a march has settled: by what it did over as long as the slowest branch remembers.

Means over a wavelength that hardly differ do not prove saturation where the slowest branch remembers many wavelengths:
friction may turn, or go on by the same small change for as long. It counts as saturated when its means have stayed
within the tolerance over the whole of that memory, tau v / lambda wavelengths, and at least over two wavelengths.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.scene.scene import Scene


@dataclass(frozen=True)
class Saturation:
    """How far friction has settled.

    Attributes
    ----------
    friction : float
        Mean over the last wavelength, or NaN where none is whole.
    wavelengths : int
        Wavelengths slid at full speed.
    needed : int
        Wavelengths over which friction has to stay the same.
    variation : float
        Largest difference between means over so many wavelengths, or all there are, over the last of them.
    reached : bool
        Whether there are as many, and they differ by no more than the tolerance.
    """

    friction: float
    wavelengths: int
    needed: int
    variation: float
    reached: bool

    def __str__(self) -> str:
        found = f"friction {self.friction:.5g} after {self.wavelengths} wavelengths"
        seen = f"it varied by {self.variation:.2%} over the last {min(self.wavelengths, self.needed)}"
        if self.reached:
            return f"{found}: saturated ({seen})"
        return f"{found}: NOT saturated ({seen}; the slowest branch remembers {self.needed - 1})"


def judge(scene: Scene, means: Real, tolerance: float) -> Saturation:
    """Judge the means of friction over the wavelengths of a march, shape (wavelengths,)."""
    memory = max(scene.material.relaxation_times, default=0.0) * scene.velocity / scene.road.period
    needed = max(1, math.ceil(memory)) + 1
    if not len(means):
        return Saturation(math.nan, 0, needed, math.nan, False)
    friction = float(means[-1])
    variation = float(np.ptp(means[-needed:])) / max(abs(friction), float(np.finfo(float).tiny))
    return Saturation(friction, len(means), needed, variation, len(means) >= needed and variation <= tolerance)


def wavelength_means(values: Real, steps: int) -> Real:
    """Return the means over whole wavelengths of so many steps, shape (wavelengths,)."""
    whole = len(values) // steps
    means: Real = values[: whole * steps].reshape(whole, steps).mean(axis=1)
    return means
