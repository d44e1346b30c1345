"""The matrix of numerical stability: scenes and marches at extreme inputs, as plain data.

Every case differs from one base scene, near the paper's, in a few parameters. Planes of two parameters show where the
limits are; roads of one to 64 waves go to slopes of three; seeded corners combine extremes of all parameters.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from itertools import product
from typing import Any

import numpy as np

from rubfric import checks
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import ALL, Scene

_CORNERS, _MARCHED_CORNERS, _SEED = 40, 12, 20190923
# Speeds of the panel ``limits``, mm/s: two far slower than its branch relaxes, one near that, two far faster.
LIMIT_SPEEDS = (1e-9, 1e-6, 1.0, 1e6, 1e9)
# Roads of many waves: the most often that the finest fits into the coarsest, and how the amplitudes fall with the
# wavenumber, as those of a self-affine profile of Hurst exponent 0.8.
_FINEST, _FALL = 64, -1.3
# Decades over which the branches of the rubber are spread, in the corners and in the panel of branches.
_MOST_DECADES = 20.0

PANELS = {
    "speed_pressure": "speed and pressure",
    "aspect_slope": "aspect and slope",
    "wavelength_speed": "wavelength and speed",
    "poisson_pressure": "Poisson's ratio and pressure",
    "branches_share": "branches and relaxed share",
    "limits": "one branch, from far slower to far faster than it relaxes",
    "waves": "roads of many waves: slow and fast, light and heavy",
    "march_speed_pressure": "marches over speed and pressure",
    "march_branches_share": "marches over branches and relaxed share",
    "corners": "corners of everything",
}


@dataclass(frozen=True)
class Case:
    """One case of the matrix: the base scene unless something else is given.

    Parameters
    ----------
    panel : str
        What it belongs to, a key of ``PANELS``.
    motion : {"steady", "march"}
        Steady sliding, or press and slide in time from an infinitely slow load.
    velocity, pressure, aspect : float
        mm/s, MPa, and height over width.
    waves : int
        Of the road, with random phases; 0 for a single scale.
    slope : float
        Amplitude times wavenumber of the road; where it has waves, the root mean square of its slopes.
    wavelength : float
        mm; of the coarsest wave.
    poissons_ratio : float
    branches : int
        Prony branches of equal shares.
    long_term_fraction : float
        Relaxed share g_inf of the shear modulus; 1 without branches.
    slowest, decades : float
        Longest relaxation time, s, and over how many decades below it the branches are spread evenly.
    moduli, plane, kinematics : str
        As of ``Material`` and ``Scene``.
    """

    panel: str
    motion: str = "steady"
    velocity: float = 100.0
    pressure: float = 0.5
    aspect: float = 0.75
    waves: int = 0
    slope: float = 0.5
    wavelength: float = 0.18
    poissons_ratio: float = 0.49
    branches: int = 6
    long_term_fraction: float = 1e-3
    slowest: float = 1e-2
    decades: float = 8.0
    moduli: str = "long_term"
    plane: str = "stress"
    kinematics: str = "finite"

    @property
    def name(self) -> str:
        """Every parameter in one word, in the order of the table: unique in the matrix."""
        values = (checks.written(value) if isinstance(value, float) else str(value) for value in asdict(self).values())
        return "-".join(values)

    def parameters(self) -> dict[str, Any]:
        """Return the parameters by name."""
        return asdict(self)

    def material(self) -> Material:
        """Return the rubber; E is 4.17 MPa."""
        spread = self.decades * np.arange(self.branches) / max(1, self.branches - 1)
        return Material(
            name="extreme",
            youngs_modulus=4.17,
            poissons_ratio=self.poissons_ratio,
            shear_fractions=((1.0 - self.long_term_fraction) / max(1, self.branches),) * self.branches,
            relaxation_times=tuple((self.slowest * 10.0**-spread).tolist()),
            moduli=self.moduli,
        )

    def scene(self) -> Scene:
        """Return the scene.

        Raises
        ------
        rubfric.errors.InvalidInput
            For what no scene may be.
        """
        return Scene(
            scale=ALL if self.waves else 1,
            road=self._road(),
            velocity=self.velocity,
            pressure=self.pressure,
            aspect=self.aspect,
            material=self.material(),
            plane=self.plane,
            kinematics=self.kinematics,
        )

    def _road(self) -> SineScale | WaveRoad:
        wavenumber = 2.0 * math.pi / self.wavelength
        if not self.waves:
            return SineScale(self.slope / wavenumber, wavenumber)
        generator = np.random.default_rng(_SEED + self.waves)
        finer = generator.choice(np.arange(2, _FINEST + 1), self.waves - 1, replace=False)
        numbers = np.append(1, np.sort(finer)).astype(float)
        slopes = numbers ** (1.0 + _FALL)
        slopes *= self.slope * math.sqrt(2.0) / np.linalg.norm(slopes)
        phases = generator.uniform(0.0, 2.0 * math.pi, self.waves)
        wavenumbers = numbers * wavenumber
        return WaveRoad(tuple(slopes / wavenumbers), tuple(wavenumbers), tuple(phases))

    def procedure(self) -> Procedure:
        """Return how a march goes: over two wavelengths, in few steps, from an infinitely slow load."""
        return Procedure(start="relaxed", columns=64, steps_per_wavelength=32, wavelengths=2, until_saturated=False)


def cases() -> tuple[Case, ...]:
    """Return the whole matrix, panel by panel."""
    both = [
        {"plane": plane, "kinematics": kinematics}
        for plane in ("stress", "strain")
        for kinematics in ("small", "finite")
    ]
    share = {"decades": _MOST_DECADES, "slowest": 1e4}
    speeds, pressures = (1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9), (1e-6, 1e-4, 1e-2, 1.0, 30.0, 1e3)
    shares = (1e-9, 1e-6, 1e-3, 0.5)
    found = [
        *_plane("speed_pressure", both, velocity=speeds, pressure=pressures),
        *_plane("aspect_slope", both, aspect=(0.02, 0.1, 0.5, 2.0, 20.0), slope=(0.0, 1e-3, 0.5, 1.0, 2.0)),
        *_plane("wavelength_speed", both, wavelength=(1e-6, 1e-3, 1.0, 1e3), velocity=(1e-9, 1e-3, 1e3, 1e9)),
        *_plane(
            "poisson_pressure", both, poissons_ratio=(-0.9, -0.5, 0.0, 0.3, 0.49, 0.4999), pressure=(0.01, 1.0, 1e2)
        ),
        *_plane("branches_share", [way | share for way in both], branches=(1, 6, 40), long_term_fraction=shares),
        *_plane("branches_share", [way | share for way in both], branches=(0,), long_term_fraction=(1.0,)),
        *_plane("limits", both, branches=(1,), velocity=LIMIT_SPEEDS, pressure=(0.05, 5.0)),
        *_plane(
            "waves", both, waves=(1, 2, 4, 16, 64), slope=(0.3, 1.0, 3.0), velocity=(0.01, 1e3), pressure=(0.2, 5.0)
        ),
        *_plane("march_speed_pressure", both, "march", velocity=(1e-9, 1e-3, 1e3, 1e9), pressure=(1e-6, 1.0, 1e3)),
        *_plane(
            "march_branches_share",
            [way | share for way in both],
            "march",
            branches=(1, 40),
            long_term_fraction=(1e-9, 1e-3),
        ),
        *_plane(
            "march_branches_share", [way | share for way in both], "march", branches=(0,), long_term_fraction=(1.0,)
        ),
        *_corners(),
    ]
    return tuple(dict.fromkeys(found))


def _plane(panel: str, ways: list[dict[str, Any]], motion: str = "steady", **axes: tuple[float, ...]) -> list[Case]:
    """Return the cases of a panel: every combination of the values of its axes, in every way."""
    combined: list[dict[str, Any]] = [dict(zip(axes, values, strict=True)) for values in product(*axes.values())]
    return [Case(panel, motion, **way, **values) for way in ways for values in combined]


def _corners() -> list[Case]:
    """Return seeded combinations of all parameters, near the ends of their ranges rather than between them."""
    generator = np.random.default_rng(_SEED)
    found = []
    for number in range(_CORNERS + _MARCHED_CORNERS):
        branches = int(generator.choice((0, 1, 40)))

        def between(low: float, high: float) -> float:
            """Return a number near one of the ends, evenly in its logarithm."""
            place = generator.beta(0.3, 0.3)
            return float(f"{low ** (1.0 - place) * high**place:.3g}")

        found.append(
            Case(
                panel="corners",
                motion="march" if number >= _CORNERS else "steady",
                velocity=between(1e-9, 1e9),
                pressure=between(1e-6, 1e3),
                aspect=between(0.02, 20.0),
                slope=between(1e-3, 2.0),
                wavelength=between(1e-6, 1e3),
                poissons_ratio=float(generator.choice((-0.9, -0.3, 0.0, 0.3, 0.49, 0.4999))),
                branches=branches,
                long_term_fraction=between(1e-9, 0.5) if branches else 1.0,
                slowest=between(1e-4, 1e4),
                decades=_MOST_DECADES,
                moduli=str(generator.choice(("long_term", "instantaneous"))),
                plane=str(generator.choice(("stress", "strain"))),
                kinematics=str(generator.choice(("small", "finite", "auto"))),
            )
        )
    return found
