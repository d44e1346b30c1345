"""The road: rigid, frictionless sine scales s(x) = a sin(k x) (Zhou, Wang and Wei 2019, section 3.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rubfric.arrays import Real
from rubfric.road.road import Waves
from rubfric.rules import Number, check_fields


@dataclass(frozen=True)
class SineScale:
    """A road of one wave: meaning, unit and bounds of each field are written beside it.

    Raises
    ------
    InvalidInput
        For any value outside these bounds.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.SineScale(amplitude=0.015, wavenumber=35.0)
    >>> print(f"wavelength {road.wavelength:.3f} mm, slopes up to {road.steepest_slope:.3f}")
    wavelength 0.180 mm, slopes up to 0.525
    """

    amplitude: Annotated[float, Number("Peak-to-mean height a; zero is a flat road.", "mm", low=0.0)]
    wavenumber: Annotated[float, Number("Wavenumber k.", "1/mm")]

    def __post_init__(self) -> None:
        check_fields(self, "road.")

    def __repr__(self) -> str:
        return f"<SineScale: amplitude {self.amplitude:g} mm, wavelength {self.wavelength:.4g} mm>"

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
