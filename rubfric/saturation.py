"""Whether the friction of a march has settled: what the last wavelengths still changed, and what memory may still do.

Means over a wavelength that hardly differ do not prove saturation where the slowest branch remembers hundreds of
wavelengths: it goes on by the same small change for as long. What is still to come is judged by the last change times
the wavelengths that the slowest branch remembers, at least one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.scene import Scene


@dataclass(frozen=True)
class Saturation:
    """How far friction has settled.

    Attributes
    ----------
    friction : float
        Mean over the last wavelength, or NaN where none is whole.
    wavelengths : int
        Wavelengths slid at full speed.
    change : float
        Relative change of the mean from the last wavelength but one, NaN where there is none.
    to_come : float
        Estimate of the relative change still to come.
    memory : float
        Wavelengths that the slowest branch remembers, tau v / lambda.
    reached : bool
        Whether what is still to come is within the tolerance.
    """

    friction: float
    wavelengths: int
    change: float
    to_come: float
    memory: float
    reached: bool

    def __str__(self) -> str:
        found = f"friction {self.friction:.5g} after {self.wavelengths} wavelengths"
        last = f"the last changed it by {self.change:.2%}, and the slowest branch remembers {self.memory:.3g}"
        return f"{found}: {'saturated' if self.reached else 'NOT saturated'} ({last})"


def judge(scene: Scene, means: Real, tolerance: float) -> Saturation:
    """Judge the means of friction over the wavelengths of a march, shape (wavelengths,)."""
    memory = max(scene.material.relaxation_times, default=0.0) * scene.velocity / scene.road.wavelength
    friction = float(means[-1]) if len(means) else np.nan
    change = np.nan
    if len(means) > 1:
        scale = max(abs(friction), np.finfo(float).tiny)
        change = abs(friction - float(means[-2])) / scale
    to_come = change * max(1.0, memory)
    return Saturation(friction, len(means), change, to_come, memory, bool(to_come <= tolerance))
