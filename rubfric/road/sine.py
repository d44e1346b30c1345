"""The road: rigid, frictionless sine scales s(x) = a sin(k x) (Zhou, Wang and Wei 2019, section 3.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rubfric import checks
from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.road.road import Waves


@dataclass(frozen=True)
class SineScale:
    """A road of one wave.

    Parameters
    ----------
    amplitude : float
        Peak-to-mean height a, mm; zero is a flat road.
    wavenumber : float
        Wavenumber k, 1/mm, positive.
    """

    amplitude: float
    wavenumber: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", checks.at_least("amplitude of the road", self.amplitude, 0.0, "mm"))
        checks.at_most("amplitude of the road", self.amplitude, checks.LARGEST, "mm")
        object.__setattr__(self, "wavenumber", checks.positive("wavenumber of the road", self.wavenumber, "1/mm"))

    @property
    def wavelength(self) -> float:
        """Lambda = 2 pi / k, mm."""
        return 2.0 * math.pi / self.wavenumber

    @property
    def period(self) -> float:
        """The wavelength, mm."""
        return self.wavelength

    @property
    def waves(self) -> Waves:
        """The one wave, of phase zero."""
        return Waves(np.array([self.amplitude]), np.array([self.wavenumber]), np.zeros(1))

    @property
    def steepest_slope(self) -> float:
        """A k, dimensionless."""
        return self.amplitude * self.wavenumber

    def height(self, position: ArrayLike) -> Real:
        """Return s(x), mm, at positions in mm of any shape."""
        return self.amplitude * np.sin(self.wavenumber * np.asarray(position, dtype=float))

    def slope(self, position: ArrayLike) -> Real:
        """Return s'(x), dimensionless, at positions in mm of any shape."""
        return self.steepest_slope * np.cos(self.wavenumber * np.asarray(position, dtype=float))

    def curvature(self, position: ArrayLike) -> Real:
        """Return s''(x), 1/mm, at positions in mm of any shape."""
        return -self.wavenumber * self.wavenumber * self.height(position)

    def excitation_frequency(self, velocity: float) -> float:
        """Return k v, rad/s: the frequency at which the road excites rubber that slides at ``velocity`` mm/s."""
        return self.wavenumber * velocity


def scales_from_config(name: str, entry: Any) -> tuple[SineScale, ...]:
    """Read one entry of ``roads``, a list of scales from coarse to fine; InvalidInput names what is wrong.

    Parameters
    ----------
    name : str
        Of the road.
    entry : object
        As read from YAML.
    """
    if not isinstance(entry, (list, tuple)) or not entry:
        raise InvalidInput(f"roads.{name} is {checks.shown(entry)}, but must be a list of at least one scale")
    scales = []
    for index, scale in enumerate(entry):
        at = f"roads.{name}[{index}]"
        checks.known_keys(at, scale, ("amplitude", "wavenumber"), ("amplitude", "wavenumber"))
        amplitude = checks.at_least(f"{at}.amplitude", scale["amplitude"], 0.0, "mm")
        wavenumber = checks.positive(f"{at}.wavenumber", scale["wavenumber"], "1/mm")
        scales.append(SineScale(amplitude, wavenumber))
    return tuple(scales)
