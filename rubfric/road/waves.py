"""A road of many waves, s(x) = sum_j a_j sin(k_j x + phi_j): all scales of a road at once.

The block that slides over it is one period of the road wide: the shortest length that holds every wave a whole number
of times.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rubfric import checks
from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.road.road import Waves
from rubfric.rules import Items, Number, check_fields

# Most times that the finest wave may fit into the period: a mesh needs some 16 columns for each.
MOST_WAVES = 512
# Relative change of a wavenumber that is none: wavenumbers are given to twelve digits.
_SAME = 1e-9
# Nodes per finest wave at which the steepest slope is looked for.
_SAMPLES = 16


@dataclass(frozen=True)
class WaveRoad:
    """A road of many waves.

    Raises
    ------
    InvalidInput
        For waves without a period short enough, with the nearest wavenumbers that have one; for lists of different
        lengths; for any value outside its bounds.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.WaveRoad([0.01, 0.004], [10.0, 35.0], [0.0, 1.0])
    >>> print(f"the period of {road.period:.3f} mm holds the coarsest wave {road.period / road.wavelength:.0f} times")
    the period of 1.257 mm holds the coarsest wave 2 times
    """

    amplitudes: Annotated[tuple[float, ...], Items("a_j.", Number(unit="mm", low=0.0), distinct=False, ascending=False)]
    wavenumbers: Annotated[tuple[float, ...], Items("k_j.", Number(unit="1/mm"), distinct=False, ascending=False)]
    phases: Annotated[
        tuple[float, ...], Items("phi_j.", Number(unit="rad", low=-1e6, high=1e6), distinct=False, ascending=False)
    ]

    def __post_init__(self) -> None:
        check_fields(self, "road.")
        if not len(self.amplitudes) == len(self.wavenumbers) == len(self.phases):
            raise InvalidInput(
                f"road has {len(self.amplitudes)} amplitudes, {len(self.wavenumbers)} wavenumbers and "
                f"{len(self.phases)} phases, but must have one of each for every wave"
            )
        parts, change = common_parts(self.wavenumbers)
        if change > _SAME:
            raise InvalidInput(_no_period(self.wavenumbers, parts, change))

    def __repr__(self) -> str:
        finest = 2.0 * math.pi / max(self.wavenumbers)
        return (
            f"<WaveRoad: {len(self.wavenumbers)} waves of {self.wavelength:.4g} to {finest:.4g} mm, period "
            f"{self.period:.4g} mm>"
        )

    @classmethod
    def nearest(cls, amplitudes: Sequence[float], wavenumbers: Sequence[float], phases: Sequence[float]) -> WaveRoad:
        """Return the road of the nearest wavenumbers that have a common period.

        Parameters
        ----------
        amplitudes, wavenumbers, phases : sequence of float, shape (waves,)
            mm, 1/mm and rad.
        """
        return cls(tuple(amplitudes), nearest_multiples(wavenumbers, common_parts(wavenumbers)[0]), tuple(phases))

    @cached_property
    def fundamental(self) -> float:
        """Wavenumber of the period, 1/mm: the largest of which all others are multiples."""
        return min(self.wavenumbers) / common_parts(self.wavenumbers)[0]

    @property
    def period(self) -> float:
        """2 pi over ``fundamental``, mm."""
        return 2.0 * math.pi / self.fundamental

    @property
    def wavelength(self) -> float:
        """Of the coarsest wave, mm."""
        return 2.0 * math.pi / min(self.wavenumbers)

    @property
    def waves(self) -> Waves:
        """The waves as arrays, their wavenumbers multiples of ``fundamental`` to the last digit."""
        multiples = np.rint(np.array(self.wavenumbers) / self.fundamental)
        return Waves(np.array(self.amplitudes), multiples * self.fundamental, np.array(self.phases))

    @cached_property
    def steepest_slope(self) -> float:
        """Largest size of s'(x) at 16 points of the finest wave, dimensionless."""
        nodes = _SAMPLES * round(max(self.wavenumbers) / self.fundamental)
        return float(np.abs(self.slope(self.period / nodes * np.arange(nodes))).max())

    def height(self, position: ArrayLike) -> Real:
        """Return s(x), mm, at positions in mm of any shape."""
        return self._sum(position, 0)

    def slope(self, position: ArrayLike) -> Real:
        """Return s'(x), dimensionless, at positions in mm of any shape."""
        return self._sum(position, 1)

    def curvature(self, position: ArrayLike) -> Real:
        """Return s''(x), 1/mm, at positions in mm of any shape."""
        return self._sum(position, 2)

    def _sum(self, position: ArrayLike, order: int) -> Real:
        """Return a derivative of s: each adds a factor k_j and a quarter of a turn."""
        place = np.asarray(position, dtype=float)
        found = np.zeros_like(place)
        waves = self.waves
        for amplitude, wavenumber, phase in zip(waves.amplitudes, waves.wavenumbers, waves.phases, strict=True):
            found += amplitude * wavenumber**order * np.sin(wavenumber * place + (phase + 0.5 * math.pi * order))
        return found


def common_parts(wavenumbers: Sequence[float], most: int = MOST_WAVES) -> tuple[int, float]:
    """Return into how many parts the coarsest wavenumber is to be divided for all to be multiples of one.

    Parameters
    ----------
    wavenumbers : sequence of float, shape (waves,)
        1/mm.
    most : int
        How many times the finest wave may fit into the common period.

    Returns
    -------
    parts : int
        The fewest that leave no change; else, to a tenth, those that leave the smallest.
    change : float
        Largest relative change of any wavenumber to the nearest multiple.
    """
    ratios = np.array(wavenumbers) / min(wavenumbers)
    parts = np.arange(1, max(1, int(most / ratios.max())) + 1)
    multiples = parts[:, None] * ratios
    change = np.abs(np.rint(multiples) / multiples - 1.0).max(axis=1)
    first = int(np.argmax(change <= max(1.1 * float(change.min()), _SAME)))
    return int(parts[first]), float(change[first])


def nearest_multiples(wavenumbers: Sequence[float], parts: int) -> tuple[float, ...]:
    """Return the nearest multiples of a part of the coarsest wavenumber."""
    unit = min(wavenumbers) / parts
    return tuple(round(one / unit) * unit for one in wavenumbers)


def _no_period(wavenumbers: Sequence[float], parts: int, change: float) -> str:
    """Say that a road has no period short enough, and which wavenumbers near its own have one."""
    given, nearest = (
        ", ".join(checks.written(one) for one in some) for some in (wavenumbers, nearest_multiples(wavenumbers, parts))
    )
    return (
        f"wavenumbers of the road are {given} 1/mm, but must have a common period that holds the finest wave at most "
        f"{MOST_WAVES} times: the nearest that have one are {nearest} 1/mm, which changes none by more than "
        f"{100.0 * change:.2g} %"
    )
