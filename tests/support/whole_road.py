"""Scenes on the whole road of the paper, in small strain and plane strain unless told otherwise."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any

import numpy as np

from rubfric.config.campaign import load
from rubfric.road.waves import WaveRoad
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

CAMPAIGN = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
ROAD = CAMPAIGN.whole_road


def whole_scene(velocity: float, pressure: float, **changes: Any) -> Scene:
    """Return a scene on the paper's road, or on another; mm/s, MPa."""
    scene = CAMPAIGN.scene("all", velocity, pressure, plane="strain", kinematics="small")
    return dataclasses.replace(scene, **changes)


def pinned(columns: int, growth: float = 1.15) -> Numerics:
    """Return numerics that leave one mesh only, and every branch of the rubber."""
    return Numerics(
        accuracy=1e-6,
        contact_nodes=4,
        finite_contact_nodes=4,
        columns_min=columns,
        finite_columns_min=columns,
        columns_max=columns,
        row_growth=growth,
        refinements=0,
        folding=0.0,
    )


def shifted(road: WaveRoad, distance: float) -> WaveRoad:
    """Return s(x + distance); mm."""
    moved = zip(road.phases, road.wavenumbers, strict=True)
    return dataclasses.replace(road, phases=tuple(phase + number * distance for phase, number in moved))


def mirrored(road: WaveRoad) -> WaveRoad:
    """Return s(-x)."""
    return dataclasses.replace(road, phases=tuple(math.pi - phase for phase in road.phases))


def scaled(road: WaveRoad, lengths: float = 1.0, heights: float = 1.0) -> WaveRoad:
    """Return a road with all lengths, or all heights alone, so many times as large."""
    return dataclasses.replace(
        road,
        amplitudes=tuple(amplitude * lengths * heights for amplitude in road.amplitudes),
        wavenumbers=tuple(number / lengths for number in road.wavenumbers),
    )


def with_wave(road: WaveRoad, amplitude: float, wavenumber: float, phase: float = 0.0) -> WaveRoad:
    """Return a road with one wave more; mm, 1/mm, rad."""
    return WaveRoad((*road.amplitudes, amplitude), (*road.wavenumbers, wavenumber), (*road.phases, phase))


def random_phases(road: WaveRoad, rng: np.random.Generator) -> WaveRoad:
    """Return a road of the same waves with phases drawn evenly."""
    return dataclasses.replace(road, phases=tuple(rng.uniform(0.0, 2.0 * math.pi, len(road.phases))))
