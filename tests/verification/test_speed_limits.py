"""Friction vanishes like v below the slowest relaxation and like 1 / v above the fastest: of random rubbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

# Speeds so far beyond the branches that the highest harmonics of the mesh are as well.
_BEYOND = 1e6
# One mesh for all speeds: what is compared shall not depend on how it is refined.
_PINNED = Numerics(contact_nodes=8, finite_contact_nodes=8, columns_min=96, finite_columns_min=96, columns_max=96)
_DRAWS = 4


@dataclass(frozen=True)
class Draw:
    """A rubber on a road: one of the scenes drawn."""

    scene: Scene

    @property
    def wavenumber(self) -> float:
        return self.scene.road.wavenumber

    def friction(self, velocity: float) -> float:
        """Return friction by dissipation: good to round-off, however small."""
        return evaluate(solve(replace(self.scene, velocity=velocity))).dissipation

    @property
    def slow(self) -> float:
        return 1.0 / (_BEYOND * self.wavenumber * max(self.scene.material.relaxation_times))

    @property
    def fast(self) -> float:
        return _BEYOND / (self.wavenumber * min(self.scene.material.relaxation_times))


def draw(rng: np.random.Generator, kinematics: str, plane: str) -> Draw:
    branches = int(rng.integers(1, 6))
    relaxed = float(10.0 ** rng.uniform(-2.0, -0.3))
    shares = rng.dirichlet(np.ones(branches)) * (1.0 - relaxed)
    times = 10.0 ** rng.uniform(-9.0, 1.0, branches)
    rubber = Material(
        "drawn",
        4.17,
        float(rng.uniform(0.2, 0.499)),
        tuple(shares.tolist()),
        tuple(times.tolist()),
        bulk="proportional",
    )
    wavenumber = float(10.0 ** rng.uniform(-1.0, 3.0))
    road = SineScale(float(rng.uniform(0.05, 0.4)) / wavenumber, wavenumber)
    pressure = float(10.0 ** rng.uniform(-1.0, 0.0))
    return Draw(Scene(1, road, 1.0, pressure, float(rng.uniform(0.3, 1.5)), rubber, plane, _PINNED, kinematics))


@pytest.fixture(params=["small", "finite"])
def kinematics(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(params=["stress", "strain"])
def plane(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_friction_follows_the_speed_below_the_slowest_relaxation(
    rng: np.random.Generator, kinematics: str, plane: str
) -> None:
    for _ in range(_DRAWS):
        drawn = draw(rng, kinematics, plane)
        slower, slow = drawn.friction(0.01 * drawn.slow), drawn.friction(drawn.slow)
        assert slower > 0.0
        assert slow / slower == pytest.approx(100.0, rel=1e-2), drawn


def test_friction_follows_one_over_the_speed_above_the_fastest_relaxation(
    rng: np.random.Generator, kinematics: str, plane: str
) -> None:
    for _ in range(_DRAWS):
        drawn = draw(rng, kinematics, plane)
        fast, faster = drawn.friction(drawn.fast), drawn.friction(100.0 * drawn.fast)
        assert faster > 0.0
        assert fast / faster == pytest.approx(100.0, rel=1e-2), drawn
