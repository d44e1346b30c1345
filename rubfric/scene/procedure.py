"""How a block is pressed onto the road and slid: the steps of time of the procedure of Zhou, Wang and Wei (2019).

The load grows along a smooth curve, 3 s² - 2 s³, and is held; then so does the speed, and is kept. Infinitely slow
pressing and a start from steady sliding leave the first two phases out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from rubfric.arrays import Real, Whole
from rubfric.errors import InvalidInput
from rubfric.road.road import Road, finest_waves
from rubfric.rules import Choice, Integer, Number, check_fields
from rubfric.scene.numerics import MOST_COLUMNS
from rubfric.scene.scene import Scene

# What a march begins with: pressing in time, infinitely slow pressing, or steady sliding.
STARTS = ("pressed", "relaxed", "steady")
# Most steps of a march, whose records fill a gigabyte then.
MOST_STEPS = 10**7
PHASES = ("press", "hold", "start", "slide")
# Loading time and hold by default, over the longest relaxation time of the rubber.
_LOADING, _HOLD = 3.0, 3.0


@dataclass(frozen=True)
class Procedure:
    """What is done to the block, and in how many steps: meaning, bounds and default of each field are beside it.

    Raises
    ------
    InvalidInput
        For any value outside these bounds.

    Examples
    --------
    >>> import rubfric
    >>> rubfric.Procedure(start="relaxed", columns=128, wavelengths=10).steps_per_wavelength
    128
    """

    start: Annotated[
        str,
        Choice(
            "Begin by pressing the block in time (pressed), from the block pressed infinitely slowly (relaxed), or "
            "from steady sliding (steady).",
            STARTS,
        ),
    ] = "pressed"
    columns: Annotated[int, Integer("Columns of cells along one wavelength.", high=MOST_COLUMNS, step=8)] = 64
    loading_time: Annotated[
        float | None, Number("Time of loading; three times the longest relaxation time where it is left out.", "s")
    ] = None
    hold_time: Annotated[float | None, Number("Time for which the load is held then; the same.", "s")] = None
    loading_steps: Annotated[int, Integer("Steps of loading.", 1, MOST_STEPS)] = 32
    hold_steps: Annotated[int, Integer("Steps for which the load is held.", 0, MOST_STEPS)] = 16
    start_share: Annotated[
        float,
        Number(
            "Distance over which the speed rises, over a wavelength; not used in a start from steady sliding.", low=0.0
        ),
    ] = 0.25
    steps_per_wavelength: Annotated[
        int, Integer("Steps of time in which the road goes past by a wavelength, at full speed.", 4, 2**16)
    ] = 128
    wavelengths: Annotated[
        int,
        Integer(
            "Wavelengths to slide at most, in ten million steps at most; a march ends earlier where friction has "
            "saturated.",
            1,
            MOST_STEPS // 4,
        ),
    ] = 40
    saturation: Annotated[
        float,
        Number(
            "Relative variation of friction, averaged over wavelengths, up to which it counts as saturated.", low=0.0
        ),
    ] = 0.005
    until_saturated: bool = True

    def __post_init__(self) -> None:
        check_fields(self, "procedure.")
        check_wavelengths("procedure.wavelengths", self.wavelengths, self.steps_per_wavelength)

    def steps_per_period(self, road: Road) -> int:
        """Return the steps at full speed in a period of the road: as many to each wavelength of its finest wave."""
        return self.steps_per_wavelength * finest_waves(road)

    def steps(self, scene: Scene) -> Steps:
        """Return the steps for a scene."""
        period, steps = scene.road.period / scene.velocity, self.steps_per_period(scene.road)
        parts = []
        if self.start == "pressed":
            parts += self._pressing(scene, period)
        if self.start != "steady":
            parts += self._starting(scene, period)
        count, length = self.wavelengths * steps, period / steps
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
        steps = self.steps_per_period(scene.road)
        count = math.ceil(2.0 * self.start_share * steps)
        share = np.arange(1.0, count + 1.0) / count
        length = period / steps
        travelled = scene.velocity * length * count * share**3 * (1.0 - 0.5 * share)
        return [_phase("start", np.full(count, length), travelled, np.full(count, scene.pressure))] if count else []


def check_wavelengths(key: str, wavelengths: int, steps_per_wavelength: int) -> None:
    """Raise InvalidInput, naming ``key``, where a march of so many wavelengths has more than ``MOST_STEPS`` steps.

    Parameters
    ----------
    key : str
    wavelengths, steps_per_wavelength : int
    """
    Integer(high=MOST_STEPS // steps_per_wavelength).check(key, wavelengths)


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
