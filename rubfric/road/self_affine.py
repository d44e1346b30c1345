"""A self-affine areal road: random phases, and a power spectral density that falls as q^(-2 - 2 H).

From the period down to the roll-off wavelength the density is even, from there to the cut-off it falls, and beyond it
is none (Persson, Albohr, Tartaglino, Volokitin and Tosatti 2005, J. Phys.: Condens. Matter 17, R1). Amplitudes are
those of the density, so that the root mean square asked for is met exactly.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Annotated, Any

import numpy as np

from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealSpectrum
from rubfric.road.waves import MOST_WAVES
from rubfric.rules import Integer, Number, check_fields


@dataclass(frozen=True)
class SelfAffine:
    """A self-affine road: meaning, unit and bounds of each field are written beside it.

    The phase of a wave depends on the seed and its place in the plane alone: a road is the same on any nodes, and one
    with a shorter cut-off has the same coarse waves but for their common factor.

    Raises
    ------
    InvalidInput
        For any value outside its bounds, for wavelengths out of order, and unless one of ``rms_slope`` and
        ``rms_height`` is given.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.05, rms_slope=0.25, seed=2)
    >>> road.spectrum.periods
    (1.0, 1.0)
    """

    hurst: Annotated[float, Number("Hurst exponent H.", low=0.0, high=1.0)]
    period: Annotated[float, Number("Length after which the road repeats, along x and y.", "mm")]
    cut_off: Annotated[float, Number("Shortest wavelength.", "mm")]
    roll_off: Annotated[float | None, Number("Wavelength at which the density begins to fall.", "mm")] = None
    rms_slope: Annotated[float | None, Number("Root mean square of the gradient.")] = None
    rms_height: Annotated[float | None, Number("Root mean square of the heights.", "mm")] = None
    seed: Annotated[int, Integer("Of the phases.", 0, 2**32)] = 1

    def __post_init__(self) -> None:
        check_fields(self, "road.")
        if self.roll_off is None:
            object.__setattr__(self, "roll_off", self.period)
        if (self.rms_slope is None) == (self.rms_height is None):
            raise InvalidInput("road must have one of rms_slope and rms_height")
        assert self.roll_off is not None
        if self.roll_off > self.period:
            raise InvalidInput(
                f"road.roll_off is {self.roll_off:g} mm, but must be at most the period, {self.period:g} mm"
            )
        if self.cut_off > self.roll_off:
            raise InvalidInput(
                f"road.cut_off is {self.cut_off:g} mm, but must be at most the roll-off, {self.roll_off:g} mm"
            )
        if self.period > MOST_WAVES * self.cut_off * (1.0 + 1e-9):
            raise InvalidInput(
                f"road.cut_off is {self.cut_off:g} mm, but must be at least {self.period / MOST_WAVES:.4g} mm: a "
                f"surface resolves at most {MOST_WAVES} waves along the period"
            )

    def parameters(self) -> dict[str, Any]:
        """Return its fields, and its kind."""
        return {"kind": "self_affine", **asdict(self)}

    @cached_property
    def spectrum(self) -> ArealSpectrum:
        """The waves, from the middle of the plane outwards."""
        finest = self.period / self.cut_off * (1.0 + 1e-9)
        axis = np.arange(-math.floor(finest), math.floor(finest) + 1)
        m, n = (part.ravel() for part in np.meshgrid(axis, axis))
        half = (m > 0) | ((m == 0) & (n > 0))
        m, n = m[half], n[half]
        # Rings of squares: a shorter cut-off appends to them, and leaves the phases of coarse waves what they are.
        order = np.lexsort((m, n, np.maximum(m, np.abs(n))))
        m, n = m[order], n[order]
        # Raw bits of the generator are the same on every machine and in every version of NumPy.
        bits = np.random.PCG64(self.seed).random_raw(len(m)) >> np.uint64(11)
        phases = 2.0 * math.pi * 2.0**-53 * bits
        number = np.hypot(m, n)
        kept = number <= finest
        assert self.roll_off is not None
        fall = np.maximum(number[kept] * self.roll_off / self.period, 1.0) ** (-1.0 - self.hurst)
        shape = ArealSpectrum(
            (self.period, self.period), np.stack((m, n), axis=1)[kept], fall * np.exp(1j * phases[kept])
        )
        factor = self.rms_slope / shape.rms_slope if self.rms_slope else (self.rms_height or 0.0) / shape.rms_height
        return ArealSpectrum(shape.periods, shape.harmonics, factor * shape.amplitudes)
