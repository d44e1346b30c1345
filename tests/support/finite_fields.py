"""Coarse blocks in finite strain and fields on them, for the tests of everything that works on such fields."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.contact import Load, SlidingContact
from rubfric.mechanics.theory.compression import pressed
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

Real = NDArray[np.float64]

AMPLITUDE, WAVENUMBER = 0.015, 35.0
WIDTH = 2.0 * np.pi / WAVENUMBER  # mm
RUBBER = Material("soft", 4.17, 0.45, (0.3, 0.4), (1e-3, 1e-5))
PROPORTIONAL = Material("soft", 4.17, 0.45, (0.3, 0.4), (1e-3, 1e-5), bulk="proportional")
ELASTIC = Material("elastic", 4.17, 0.45, (), ())


def coarse(
    plane: str, material: Material = RUBBER, columns: int = 16, velocity: float = 100.0, dilatation: str = "auto"
) -> FiniteBlock:
    """Return a block of a few rows, 0.75 times as high as wide."""
    block = Block.graded(WIDTH, 0.75 * WIDTH, columns, plane, growth=1.6, dilatation=dilatation)
    return FiniteBlock(block, material, velocity)


def uniform(finite: FiniteBlock, stretch: float, shear: float, thickness: float) -> Fields:
    """Return a block stretched along its height and sheared, the same everywhere; the top stays in its place."""
    fields, heights = finite.at_rest(), finite.block.row_positions
    fields.displacement[0] = shear * (heights - heights[-1])[:, None]
    fields.displacement[1] = (stretch - 1.0) * heights[:, None]
    fields.log_thickness[:] = np.log(thickness)
    fields.volume[:] = stretch * thickness if finite.block.plane == "stress" else stretch
    return fields


def flat(finite: FiniteBlock, pressure: float) -> Fields:
    """Return the block pressed on a flat road."""
    stretch, thickness = pressed(finite.material, pressure, finite.block.plane)
    return uniform(finite, stretch, 0.0, thickness)


def random_step(finite: FiniteBlock, rng: np.random.Generator, size: float = 1.0) -> Fields:
    """Return a random step: strains of about ``size``, top moved as a whole, mean surface where it was."""
    rest, block = finite.at_rest(), finite.block
    length = size * min(block.column_width, float(np.diff(block.row_positions).min()))
    step = Fields(
        length * rng.uniform(-1.0, 1.0, rest.displacement.shape),
        size * rng.uniform(-1.0, 1.0, rest.log_thickness.shape),
        size * rng.uniform(-1.0, 1.0, rest.volume.shape),
    )
    step.displacement[0, -1] = step.displacement[0, -1, 0]
    step.displacement[:, 0] -= step.displacement[:, 0].mean(axis=-1, keepdims=True)
    return step


def sliding(finite: FiniteBlock) -> SlidingContact:
    return SlidingContact(finite, (AMPLITUDE, AMPLITUDE * WAVENUMBER), "some scene")


def load(pressure: float, amplitude: float = AMPLITUDE) -> Load:
    return Load(SineScale(amplitude, WAVENUMBER), pressure)


def everywhere(finite: FiniteBlock) -> NDArray[np.bool_]:
    return np.ones(finite.block.columns, dtype=bool)
