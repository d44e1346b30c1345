"""Sliding contact of a layer without finite elements: the closed-form compliance and the contact solver.

Its only error is that of the surface grid, and vanishes with it.
"""

from __future__ import annotations

import numpy as np

from rubfric.mechanics.block.contact import full_contact, solve_contact
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.scene.scene import Scene

COARSEST = 64


def friction_coefficient(scene: Scene, nodes: int = 2048) -> float:
    """Return mu, the mean of pressure x slope over the nominal pressure, on ``nodes`` = 64, 128, ... nodes."""
    road, count = scene.road, COARSEST
    start = np.ones(count, dtype=bool)
    while True:
        wavenumber = 2.0 * np.pi / road.period * np.arange(1, count // 2 + 1)
        compliance = layer_compliance(scene.material, wavenumber, scene.velocity, scene.height, scene.plane)
        spectrum, position = np.append(0.0, compliance), road.period / count * np.arange(count)
        solved = full_contact(spectrum, road.height(position), scene.pressure)
        if solved is None:
            solved = solve_contact(spectrum, road.height(position), scene.pressure, start, scene.name)
        if count >= nodes:
            return float(np.mean(solved.pressure * road.slope(position)) / scene.pressure)
        near = solved.touching | np.roll(solved.touching, 1) | np.roll(solved.touching, -1)
        start, count = np.repeat(near, 2), 2 * count
