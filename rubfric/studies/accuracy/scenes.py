"""Scenes on which accuracy is measured: a fixed set, and scenes drawn at random, inside the paper's grid and outside.

The fixed set takes each scale of the paper's road slow, near its peak and fast, lightly and heavily loaded, in both
planes, with flat and tall blocks among them. The drawn ones are spread evenly over the logarithms of their parameters;
outside the paper's grid, speeds, pressures, height-to-width ratios, slopes and wavelengths go ten to a hundred times
further, and half of the rubbers are random.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rubfric.config.campaign import Campaign
from rubfric.road.sine import SineScale
from rubfric.rubber.material import PLANES, Material
from rubfric.scene.scene import Scene

# Scale, speed in mm/s, pressure in MPa, height over width, plane.
_FIXED = (
    (1, 0.1, 0.1, 0.75, "stress"),
    (1, 10, 0.5, 0.25, "stress"),
    (1, 100, 0.5, 0.75, "stress"),
    (1, 100, 5, 0.75, "strain"),
    (1, 100, 5, 1.5, "stress"),
    (1, 1000, 0.2, 0.75, "strain"),
    (1, 10000, 1, 0.75, "stress"),
    (2, 0.1, 5, 0.75, "strain"),
    (2, 100, 1, 0.75, "stress"),
    (2, 500, 0.5, 0.75, "strain"),
    (2, 10000, 5, 0.75, "stress"),
    (3, 1, 0.5, 0.75, "stress"),
    (3, 10, 1, 0.75, "strain"),
    (3, 100, 5, 0.75, "stress"),
    (3, 10000, 2, 0.75, "strain"),
    (4, 0.1, 0.5, 0.75, "strain"),
    (4, 10, 5, 0.75, "stress"),
    (4, 100, 0.2, 0.75, "stress"),
    (4, 1000, 5, 0.75, "strain"),
    (4, 10000, 0.5, 0.75, "stress"),
)
# Ranges of the drawn scenes: speeds in mm/s, pressures in MPa, height over width; inside and outside.
_RANGES = {
    "inside": {"velocity": (0.1, 1e4), "pressure": (0.1, 5.0), "aspect": (0.25, 1.5)},
    "outside": {"velocity": (1e-3, 1e6), "pressure": (0.01, 10.0), "aspect": (0.1, 3.0)},
}
_SLOPES, _WAVELENGTHS, _BRANCHES = (0.03, 1.0), (2e-3, 5.0), 8
SETS = tuple(_RANGES)


def fixed_scenes(campaign: Campaign) -> dict[str, Scene]:
    """Return the fixed set, by name."""
    scenes = (
        campaign.scene(scale, velocity, pressure, aspect, plane, "auto")
        for scale, velocity, pressure, aspect, plane in _FIXED
    )
    return {scene.name: scene for scene in scenes}


def drawn_scenes(campaign: Campaign, count: int, seed: int) -> dict[str, Scene]:
    """Return drawn scenes by name, ``inside_0`` to ``outside_<count - 1>``: as many inside the grid as outside.

    A third of them ask for small strain, the others for ``auto``.

    Parameters
    ----------
    campaign : Campaign
        Its road and rubber.
    count : int
        Scenes inside the grid, and outside.
    seed : int
        Of the random numbers.
    """
    rng = np.random.default_rng(seed)
    return {f"{kind}_{number}": _drawn(campaign, rng, kind, number) for kind in SETS for number in range(count)}


def _drawn(campaign: Campaign, rng: np.random.Generator, kind: str, number: int) -> Scene:
    scale = int(rng.integers(len(campaign.road))) + 1
    velocity, pressure, aspect = (_between(rng, *limits) for limits in _RANGES[kind].values())
    plane = PLANES[int(rng.integers(len(PLANES)))]
    scene = campaign.scene(scale, velocity, pressure, aspect, plane, "small" if number % 3 == 2 else "auto")
    if kind == "inside":
        return scene
    wavenumber = 2.0 * math.pi / _between(rng, *_WAVELENGTHS)
    road = SineScale(_between(rng, *_SLOPES) / wavenumber, wavenumber)
    material = campaign.material if rng.random() < 0.5 else _rubber(rng)
    return replace(scene, scale=1, road=road, material=material)


def _rubber(rng: np.random.Generator) -> Material:
    """Return a random rubber with a few branches spread over ten decades."""
    branches = int(rng.integers(1, _BRANCHES + 1))
    fractions = rng.dirichlet(np.ones(branches)) * rng.uniform(0.3, 0.99)
    return Material(
        name="drawn",
        youngs_modulus=_between(rng, 1.0, 20.0),
        poissons_ratio=float(rng.choice([0.3, 0.45, 0.49, 0.499])),
        shear_fractions=tuple(fractions),
        relaxation_times=tuple(sorted((_between(rng, 1e-9, 10.0) for _ in range(branches)), reverse=True)),
        moduli="instantaneous",
        bulk="proportional" if rng.random() < 0.5 else "elastic",
        density=1e-9,
    )


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def batches(names: list[str], size: int) -> Iterator[list[str]]:
    """Yield names in groups.

    Parameters
    ----------
    names : list of str
    size : int
        Of a group; the last may be smaller.
    """
    for start in range(0, len(names), size):
        yield names[start : start + size]
