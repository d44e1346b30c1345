"""What the rubber remembers at the end of a step of time: its tangent, and the block that is held by its top."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import PROPORTIONAL, RUBBER, coarse, flat, random_step, uniform

from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.memory import SteadyPast, StepPast
from rubfric.rubber.material import Material

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL], ids=["elastic bulk", "both"])


def stepping(plane: str, rubber: Material, rng: np.random.Generator | None = None) -> FiniteBlock:
    """Return a block in a step, which remembers a random past."""
    finite = coarse(plane, rubber)
    rest = finite.at_rest()
    shape = (4, finite.points, finite.block.rows, finite.block.columns)
    driving = np.zeros(shape) if rng is None else rng.uniform(-1.0, 1.0, shape)
    bulk = 7.0 if rubber is PROPORTIONAL else 0.0
    pressure = -7.0 * rest.volume if rubber is PROPORTIONAL else 0.0
    return finite.remembering(StepPast(3.0, bulk, driving, pressure, len(finite.block.harmonics)))


def test_another_past_leaves_the_block_alone() -> None:
    finite = coarse("strain")
    other = finite.remembering(StepPast(3.0, 0.0, np.zeros((4, 1, 1, 1)), 0.0, 9))
    assert isinstance(finite.past, SteadyPast)
    assert isinstance(other.past, StepPast)
    assert other.block is finite.block
    assert other.past.anchored
    assert not finite.past.anchored


@PLANES
@RUBBERS
def test_change_is_the_derivative_of_the_stresses(plane: str, rubber: Material, rng: np.random.Generator) -> None:
    finite = stepping(plane, rubber, rng)
    fields = flat(finite, 0.5).moved(random_step(finite, rng, 0.05))
    step = random_step(finite, rng)
    stiffness = finite.stiffness(fields, finite.stressed(fields))
    change, excess = finite.change(stiffness, step)
    size = 1e-6
    ahead, behind = (finite.stressed(fields.moved(step, sign * size)) for sign in (1.0, -1.0))
    scale = np.abs(change).max()
    np.testing.assert_allclose(change, (ahead.stress - behind.stress) / (2.0 * size), atol=1e-7 * scale)
    np.testing.assert_allclose(excess, (ahead.volume_excess - behind.volume_excess) / (2.0 * size), atol=1e-7)


@PLANES
@RUBBERS
def test_circulant_of_a_step_is_exact_in_a_uniform_block_and_holds_its_top(
    plane: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = stepping(plane, rubber)
    fields = uniform(finite, 0.9, 0.2, 1.05)
    stiffness = finite.stiffness(fields, finite.stressed(fields))
    step = random_step(finite, rng)
    step.displacement[0] += 0.01  # where the surface is counts
    step.displacement[0, -1] = 0.0
    change, excess = finite.change(stiffness, step)
    circulant = Circulant(finite, stiffness, 0.0)
    right = circulant.right_side(finite.forces(change[:4]), change[4:], excess)
    found = circulant.solve(right, np.zeros((2, finite.block.columns)))
    np.testing.assert_allclose(found.displacement, step.displacement, atol=1e-9 * np.abs(step.displacement).max())
    np.testing.assert_allclose(circulant.surface(right), step.displacement[:, 0], atol=1e-10)
