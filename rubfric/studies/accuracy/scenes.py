"""Scenes on which accuracy is measured: a fixed set, and scenes drawn at random, inside the paper's grid and outside.

The fixed set takes each scale of the paper's road slow, near its peak and fast, lightly and heavily loaded, in both
planes, with flat and tall blocks among them. The drawn ones are spread evenly over the logarithms of their parameters;
outside the paper's grid, speeds, pressures, height-to-width ratios, slopes and wavelengths go ten to a hundred times
further, and half of the rubbers are random. Whole roads are drawn too: the paper's with random phases, and others of
up to 64 waves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rubfric.config.campaign import Campaign
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import PLANES, Material
from rubfric.scene.scene import ALL, Scene

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
# On the whole road: speed in mm/s, pressure in MPa, plane, kinematics. In finite strain the light and fast ones, whose
# references are affordable.
_TOTALS = (
    (0.1, 0.1, "strain", "small"),
    (10, 0.5, "stress", "small"),
    (100, 5, "strain", "small"),
    (1000, 0.5, "strain", "small"),
    (1000, 5, "stress", "small"),
    (10000, 0.5, "stress", "small"),
    (100, 0.1, "stress", "finite"),
    (1000, 0.2, "strain", "finite"),
    (10000, 0.5, "stress", "finite"),
)
# Ranges of the drawn scenes: speeds in mm/s, pressures in MPa, height over width; inside and outside.
_RANGES = {
    "inside": {"velocity": (0.1, 1e4), "pressure": (0.1, 5.0), "aspect": (0.25, 1.5)},
    "outside": {"velocity": (1e-3, 1e6), "pressure": (0.01, 10.0), "aspect": (0.1, 3.0)},
}
_SLOPES, _WAVELENGTHS, _BRANCHES = (0.03, 1.0), (2e-3, 5.0), 8
SETS = tuple(_RANGES)
# Whole roads other than the paper's: waves, the most often that the finest of them fits into the period, and the
# steepest slope.
WHOLE, FINITE = "whole", "finite"
_WAVES, _FINEST, _STEEPEST = (2.0, 64.0), 128, (0.1, 3.0)
# Ranges on the paper's whole road in finite strain.
_LIGHT = {"velocity": (50.0, 1e4), "pressure": (0.1, 0.6), "aspect": (0.5, 1.0)}


def fixed_scenes(campaign: Campaign) -> dict[str, Scene]:
    """Return the fixed set, by name."""
    scenes = (
        campaign.scene(scale, velocity, pressure, aspect, plane, "auto")
        for scale, velocity, pressure, aspect, plane in _FIXED
    )
    return {scene.name: scene for scene in scenes}


def total_scenes(campaign: Campaign) -> dict[str, Scene]:
    """Return the scenes on which the ways to the total are compared, by their kinematics and name."""
    scenes = (
        campaign.scene(ALL, velocity, pressure, plane=plane, kinematics=kinematics)
        for velocity, pressure, plane, kinematics in _TOTALS
    )
    return {f"{scene.kinematics}_{scene.name}": scene for scene in scenes}


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


def whole_scenes(campaign: Campaign, count: int, seed: int) -> dict[str, Scene]:
    """Return drawn scenes on whole roads by name, ``whole_0`` to ``whole_<count - 1>``.

    Every other one is on the paper's road, inside its grid, with random phases; the others are outside, on roads of
    two to 64 random waves. All are in small strain; ``finite_scenes`` are in finite strain.

    Parameters
    ----------
    campaign : Campaign
        Its road and rubber.
    count : int
    seed : int
        Of the random numbers.
    """
    rng = np.random.default_rng(seed)
    return {f"{WHOLE}_{number}": _whole(campaign, rng, number) for number in range(count)}


def finite_scenes(campaign: Campaign, count: int, seed: int) -> dict[str, Scene]:
    """Return drawn scenes on the paper's whole road in finite strain by name, ``finite_0`` to ``finite_<count - 1>``.

    Phases are random. All are light and fast: others need most of the cells that a mesh may have in finite strain, and
    a reference has to be finer.

    Parameters
    ----------
    campaign : Campaign
        Its road and rubber.
    count : int
    seed : int
        Of the random numbers.
    """
    rng = np.random.default_rng(seed)
    found = {}
    for number in range(count):
        velocity, pressure, aspect = (_between(rng, *limits) for limits in _LIGHT.values())
        road = replace(campaign.whole_road, phases=_phases(rng, len(campaign.road)))
        scene = campaign.scene(ALL, velocity, pressure, aspect, PLANES[number % len(PLANES)], FINITE)
        found[f"{FINITE}_{number}"] = replace(scene, road=road)
    return found


def _whole(campaign: Campaign, rng: np.random.Generator, number: int) -> Scene:
    kind = SETS[number % len(SETS)]
    velocity, pressure, aspect = (_between(rng, *limits) for limits in _RANGES[kind].values())
    plane = PLANES[int(rng.integers(len(PLANES)))]
    scene = campaign.scene(ALL, velocity, pressure, aspect, plane, "small")
    if kind == "inside":
        road = campaign.whole_road
        return replace(scene, road=replace(road, phases=_phases(rng, len(road.amplitudes))))
    return replace(scene, road=_waves(rng))


def _waves(rng: np.random.Generator) -> WaveRoad:
    """Return a random road, whose heights fall with the wavenumber about as those of rough surfaces do."""
    count = round(_between(rng, *_WAVES))
    numbers = np.sort(rng.choice(np.arange(1, _FINEST + 1), count, replace=False))
    wavenumbers = numbers / numbers[0] * (2.0 * math.pi / _between(rng, *_WAVELENGTHS))
    amplitudes = wavenumbers ** -rng.uniform(0.5, 1.5) * np.exp(rng.uniform(-1.0, 1.0, count))
    road = WaveRoad(tuple(amplitudes), tuple(wavenumbers), _phases(rng, count))
    factor = _between(rng, *_STEEPEST) / road.steepest_slope
    return replace(road, amplitudes=tuple(factor * amplitudes))


def _phases(rng: np.random.Generator, count: int) -> tuple[float, ...]:
    return tuple(rng.uniform(0.0, 2.0 * math.pi, count))


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
