"""How a block is pressed onto the road and slid: the steps of time of the procedure of Zhou, Wang and Wei (2019).

The load grows along a smooth curve, 3 s² - 2 s³, and is held; then so does the speed, and is kept. Infinitely slow
pressing and a start from steady sliding leave the first two phases out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric import checks
from rubfric.arrays import Real, Whole
from rubfric.config.choices import MOST_COLUMNS, MOST_STEPS, MOST_STEPS_PER_WAVELENGTH, STARTS
from rubfric.errors import InvalidInput
from rubfric.scene.scene import Scene

PHASES = ("press", "hold", "start", "slide")
# Loading time and hold by default, over the longest relaxation time of the rubber.
_LOADING, _HOLD = 3.0, 3.0


@dataclass(frozen=True)
class Procedure:
    """What is done to the block, and in how many steps.

    Parameters
    ----------
    start : {"pressed", "relaxed", "steady"}
        Press the block in time; or begin with the block pressed infinitely slowly; or with steady sliding.
    columns : int
        Columns of cells of the block, a multiple of 8.
    loading_time, hold_time : float, optional
        Of pressing, s; three times the longest relaxation time each by default.
    loading_steps, hold_steps : int
        Steps of the two.
    start_share : float
        Distance over which the speed rises, over a wavelength; not used in a start from steady sliding.
    steps_per_wavelength : int
        Steps in which the road goes past by a wavelength, at full speed.
    wavelengths : int
        Wavelengths to slide at most, at full speed.
    saturation : float
        Relative variation of friction, averaged over wavelengths, up to which it counts as saturated.
    until_saturated : bool
        Whether sliding ends there, or after all wavelengths.
    """

    start: str = "pressed"
    columns: int = 64
    loading_time: float | None = None
    hold_time: float | None = None
    loading_steps: int = 32
    hold_steps: int = 16
    start_share: float = 0.25
    steps_per_wavelength: int = 128
    wavelengths: int = 40
    saturation: float = 0.005
    until_saturated: bool = True

    def __post_init__(self) -> None:
        at = "procedure."
        checks.one_of(at + "start", self.start, STARTS)
        checks.multiple(at + "columns", self.columns, 8, MOST_COLUMNS)
        for name in ("loading_time", "hold_time"):
            if getattr(self, name) is not None:
                checks.positive(at + name, getattr(self, name), "s")
        for name, least in (("loading_steps", 1), ("hold_steps", 0)):
            checks.whole(at + name, getattr(self, name), least, MOST_STEPS)
        steps = checks.whole(at + "steps_per_wavelength", self.steps_per_wavelength, 4, MOST_STEPS_PER_WAVELENGTH)
        checks.whole(at + "wavelengths", self.wavelengths, 1, MOST_STEPS // steps)
        for name in ("start_share", "saturation"):
            checks.at_least(at + name, getattr(self, name), 0.0)

    def steps(self, scene: Scene) -> Steps:
        """Return the steps for a scene."""
        period = scene.road.wavelength / scene.velocity
        parts = []
        if self.start == "pressed":
            parts += self._pressing(scene, period)
        if self.start != "steady":
            parts += self._starting(scene, period)
        count = self.wavelengths * self.steps_per_wavelength
        length = period / self.steps_per_wavelength
        ahead = scene.velocity * length * np.arange(1.0, count + 1.0)
        begin = parts[-1].offset[-1] if parts else 0.0
        parts.append(_phase("slide", np.full(count, length), begin + ahead, np.full(count, scene.pressure)))
        joined = (np.concatenate([getattr(part, name) for part in parts]) for name in Steps.__annotations__)
        return Steps(*joined)

    def _pressing(self, scene: Scene, period: float) -> list[Steps]:
        longest = max(scene.material.relaxation_times, default=period)
        loading = _LOADING * longest if self.loading_time is None else self.loading_time
        hold = _HOLD * longest if self.hold_time is None else self.hold_time
        share = np.arange(1.0, self.loading_steps + 1.0) / self.loading_steps
        still = np.zeros_like(share)
        lengths = np.full(self.loading_steps, loading / self.loading_steps)
        parts = [_phase("press", lengths, still, scene.pressure * _smooth(share))]
        if self.hold_steps:
            lengths, still = np.full(self.hold_steps, hold / self.hold_steps), np.zeros(self.hold_steps)
            parts.append(_phase("hold", lengths, still, np.full(self.hold_steps, scene.pressure)))
        return parts

    def _starting(self, scene: Scene, period: float) -> list[Steps]:
        # At half the full speed on average, in steps as long as those at full speed.
        count = math.ceil(2.0 * self.start_share * self.steps_per_wavelength)
        share = np.arange(1.0, count + 1.0) / count
        length = period / self.steps_per_wavelength
        travelled = scene.velocity * length * count * share**3 * (1.0 - 0.5 * share)
        return [_phase("start", np.full(count, length), travelled, np.full(count, scene.pressure))] if count else []


@dataclass(frozen=True)
class Steps:
    """Steps of time, each array of shape (steps,).

    Attributes
    ----------
    phase : ndarray of int
        Index in ``PHASES``.
    duration : ndarray
        s.
    offset : ndarray
        How far the road has gone past at the end, mm.
    pressure : ndarray
        Nominal pressure at the end, MPa.
    """

    phase: Whole
    duration: Real
    offset: Real
    pressure: Real

    def __post_init__(self) -> None:
        if not (self.duration > 0.0).all():
            raise InvalidInput(f"shortest step is {self.duration.min():g} s, but must be longer than 0")


def _phase(name: str, duration: Real, offset: Real, pressure: Real) -> Steps:
    return Steps(np.full(len(duration), PHASES.index(name)), duration, offset, pressure)


def _smooth(share: Real) -> Real:
    return share * share * (3.0 - 2.0 * share)
