"""An areal road of a few waves, s(x, y) = sum_j a_j sin(k_j (x cos d_j + y sin d_j) + phi_j)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Annotated, Any

import numpy as np

from rubfric import checks
from rubfric.arrays import Real, Whole
from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealSpectrum, gathered, unit_vector
from rubfric.road.waves import common_parts, nearest_multiples
from rubfric.rules import Items, Number, check_fields

# Most times that a wave may fit into the period along an axis: nodes are needed along both.
MOST_WAVES = 128
# Change of a component, over the wavenumber, that is none; components smaller than this are zero.
_SAME = 1e-9


@dataclass(frozen=True)
class ArealWaves:
    """Waves with directions: meaning, unit and bounds of each field are written beside it.

    Raises
    ------
    InvalidInput
        For waves without common periods short enough, with the nearest that have them; for lists of different lengths;
        for any value outside its bounds.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.ArealWaves(amplitudes=[0.01, 0.01], wavenumbers=[10, 10], directions=[0, 90], phases=[0, 0])
    >>> print("periods {:.3f} and {:.3f} mm".format(*road.spectrum.periods))
    periods 0.628 and 0.628 mm
    """

    amplitudes: Annotated[
        tuple[float, ...], Items("Amplitudes a_j.", Number(unit="mm", low=0.0), distinct=False, ascending=False)
    ]
    wavenumbers: Annotated[
        tuple[float, ...], Items("Wavenumbers k_j.", Number(unit="1/mm"), distinct=False, ascending=False)
    ]
    directions: Annotated[
        tuple[float, ...],
        Items(
            "Directions d_j of the wavevectors, from x.",
            Number(unit="degrees", low=-360.0, high=360.0),
            1,
            False,
            False,
        ),
    ]
    phases: Annotated[
        tuple[float, ...],
        Items("Phases phi_j.", Number(unit="rad", low=-1e6, high=1e6), distinct=False, ascending=False),
    ]

    def __post_init__(self) -> None:
        check_fields(self, "road.")
        lengths = [len(one) for one in (self.amplitudes, self.wavenumbers, self.directions, self.phases)]
        if len(set(lengths)) > 1:
            raise InvalidInput(
                "road has {} amplitudes, {} wavenumbers, {} directions and {} phases, but must have one of each for "
                "every wave".format(*lengths)
            )
        components = _components(self.wavenumbers, self.directions)
        near = _nearest(components)
        if np.abs(near - components).max() > _SAME * max(self.wavenumbers):
            raise InvalidInput(_no_periods(self.wavenumbers, self.directions, near))

    def __repr__(self) -> str:
        lengths = [2.0 * math.pi / number for number in (min(self.wavenumbers), max(self.wavenumbers))]
        return f"<ArealWaves: {len(self.wavenumbers)} waves of {lengths[0]:.4g} to {lengths[1]:.4g} mm>"

    @classmethod
    def nearest(
        cls,
        amplitudes: Sequence[float],
        wavenumbers: Sequence[float],
        directions: Sequence[float],
        phases: Sequence[float],
    ) -> ArealWaves:
        """Return the road of the nearest waves that have common periods.

        Parameters
        ----------
        amplitudes, wavenumbers, directions, phases : sequence of float, shape (waves,)
            mm, 1/mm, degrees and rad.
        """
        lengths, angles = _polar(_nearest(_components(wavenumbers, directions)))
        return cls(tuple(amplitudes), tuple(lengths), tuple(angles), tuple(phases))

    def parameters(self) -> dict[str, Any]:
        """Return its fields, and its kind."""
        return {"kind": "waves", **asdict(self)}

    @cached_property
    def spectrum(self) -> ArealSpectrum:
        """The waves; along a direction in which nothing varies the road has the period of the other."""
        units, harmonics = zip(
            *(_harmonics(part) for part in _components(self.wavenumbers, self.directions).T), strict=True
        )
        known = [2.0 * math.pi / unit for unit in units if unit]
        periods = tuple(2.0 * math.pi / unit if unit else known[0] for unit in units)
        amplitudes = -1j * np.array(self.amplitudes) * np.exp(1j * np.array(self.phases))
        return gathered((periods[0], periods[1]), np.stack(harmonics, axis=1), amplitudes)


def _components(wavenumbers: Sequence[float], directions: Sequence[float]) -> Real:
    """Return the wavevectors, 1/mm, shape (waves, 2), zero where they all but are."""
    lengths = np.array(wavenumbers, dtype=float)
    found = lengths[:, None] * np.array([unit_vector(one) for one in directions])
    return np.where(np.abs(found) > _SAME * lengths[:, None], found, 0.0)


def _polar(components: Real) -> tuple[list[float], list[float]]:
    angles = np.degrees(np.arctan2(components[:, 1], components[:, 0]))
    return [float(one) for one in np.hypot(*components.T)], [float(one) for one in angles]


def _harmonics(part: Real) -> tuple[float, Whole]:
    """Return the wavenumber of the period along one axis, 0 where nothing varies, and what multiples the waves are."""
    moving = np.abs(part[part != 0.0])
    if not moving.size:
        return 0.0, np.zeros(len(part), dtype=int)
    unit = float(moving.min()) / common_parts(tuple(moving), MOST_WAVES)[0]
    return unit, np.rint(part / unit).astype(int)


def _nearest(components: Real) -> Real:
    """Return the nearest wavevectors that have a common period along each axis, shape (waves, 2)."""
    near = np.zeros_like(components)
    for axis, part in enumerate(components.T):
        moving = part != 0.0
        if moving.any():
            sizes = tuple(np.abs(part[moving]))
            near[moving, axis] = np.copysign(nearest_multiples(sizes, common_parts(sizes, MOST_WAVES)[0]), part[moving])
    return near


def _no_periods(wavenumbers: Sequence[float], directions: Sequence[float], near: Real) -> str:
    def listed(some: Sequence[float], others: Sequence[float]) -> str:
        pairs = zip(some, others, strict=True)
        return ", ".join(f"{checks.written(k)} 1/mm at {checks.written(d)} degrees" for k, d in pairs)

    return (
        f"waves of the road are {listed(wavenumbers, directions)}, but must have a common period along x and one along "
        f"y, each holding the finest wave at most {MOST_WAVES} times: the nearest that have them are "
        f"{listed(*_polar(near))}"
    )
