"""Friction depends on a k, k v tau, p / E, nu, g and the aspect only, and reverses with the direction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.contact import solve_contact
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.steady.energies import Energies
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
LOADS = pytest.mark.parametrize(("velocity", "pressure"), [(10.0, 5.0), (1000.0, 5.0), (1000.0, 0.1)])


def assert_same_friction(one: Energies, two: Energies) -> None:
    assert one.stress_power > 1e-3
    for route in ("stress_power", "dissipation", "contact"):
        assert getattr(two, route) == pytest.approx(getattr(one, route), rel=1e-10)


@PLANES
@LOADS
@pytest.mark.parametrize("factor", [8.0, 1e-3])
def test_scaling_lengths_and_speed_together_changes_nothing(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float, factor: float
) -> None:
    larger = SineScale(0.015 * factor, 35.0 / factor)
    one = evaluate(solve(paper_scene(velocity, pressure, plane=plane)))
    two = evaluate(solve(paper_scene(velocity * factor, pressure, plane=plane, road=larger)))
    assert_same_friction(one, two)
    largest = one.density.max()
    np.testing.assert_allclose(two.density, one.density, atol=1e-9 * largest)
    np.testing.assert_allclose(two.displacement, factor * one.displacement, atol=1e-9 * 0.015 * factor)


@PLANES
@LOADS
def test_scaling_moduli_and_pressure_together_changes_nothing(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, velocity: float, pressure: float
) -> None:
    stiffer = replace(paper_rubber, youngs_modulus=1e3 * 4.17)
    one = evaluate(solve(paper_scene(velocity, pressure, plane=plane)))
    two = evaluate(solve(paper_scene(velocity, 1e3 * pressure, plane=plane, material=stiffer)))
    assert_same_friction(one, two)
    np.testing.assert_allclose(two.density, 1e3 * one.density, atol=1e-6 * one.density.max())


@PLANES
@LOADS
def test_scaling_speed_against_relaxation_times_changes_nothing(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, velocity: float, pressure: float
) -> None:
    slower = replace(paper_rubber, relaxation_times=tuple(50.0 * time for time in paper_rubber.relaxation_times))
    one = evaluate(solve(paper_scene(velocity, pressure, plane=plane)))
    two = evaluate(solve(paper_scene(velocity / 50.0, pressure, plane=plane, material=slower)))
    assert_same_friction(one, two)


@PLANES
def test_a_branch_cut_in_two_is_the_same_rubber(paper_scene: SceneMaker, paper_rubber: Material, plane: str) -> None:
    first, *others = paper_rubber.shear_fractions
    cut = replace(
        paper_rubber,
        shear_fractions=(0.25 * first, 0.75 * first, *others),
        relaxation_times=(paper_rubber.relaxation_times[0], *paper_rubber.relaxation_times),
    )
    assert_same_friction(
        evaluate(solve(paper_scene(10.0, 1.0, plane=plane))),
        evaluate(solve(paper_scene(10.0, 1.0, plane=plane, material=cut))),
    )


def mirrored(values: Real) -> Real:
    """Return f(-x) on evenly spread columns."""
    return np.roll(values[::-1], 1)


def slide(block: Block, rubber: Material, velocity: float, profile: Real) -> Real:
    response = respond(block, rubber, velocity, block.harmonics[1:])
    everywhere = np.ones(block.columns, dtype=bool)
    return solve_contact(np.append(0.0, response.compliance), profile, 2.0, everywhere).pressure


@PLANES
def test_sliding_the_other_way_mirrors_the_pressure_and_reverses_friction(paper_rubber: Material, plane: str) -> None:
    road = SineScale(0.015, 35.0)
    block = Block.graded(road.wavelength, 0.75 * road.wavelength, 256, plane)
    position = block.column_positions
    # A second harmonic makes the profile unlike its mirror image.
    profile = road.height(position) + 0.3 * road.height(2.0 * position + 0.02)
    slope = road.slope(position) + 0.6 * road.slope(2.0 * position + 0.02)
    forth, back = slide(block, paper_rubber, 300.0, profile), slide(block, paper_rubber, -300.0, mirrored(profile))
    np.testing.assert_allclose(back, mirrored(forth), atol=1e-9 * forth.max())
    friction = np.mean(forth * slope) / 2.0
    assert friction > 0.05
    assert np.mean(back * -mirrored(slope)) / 2.0 == pytest.approx(-friction, rel=1e-9)
    assert np.abs(slide(block, paper_rubber, -300.0, profile) - forth).max() > 0.1 * forth.max()


@PLANES
@LOADS
def test_sine_slid_the_other_way_has_the_opposite_friction(
    paper_rubber: Material, plane: str, velocity: float, pressure: float
) -> None:
    road = SineScale(0.015, 35.0)
    block = Block.graded(road.wavelength, 0.75 * road.wavelength, 256, plane)
    profile, slope = road.height(block.column_positions), road.slope(block.column_positions)
    friction = [np.mean(slide(block, paper_rubber, sign * velocity, profile) * slope) / 2.0 for sign in (1.0, -1.0)]
    assert friction[0] > 1e-3
    assert friction[1] == pytest.approx(-friction[0], rel=1e-9)


@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_tall_blocks_are_half_spaces_in_full_and_in_partial_contact(paper_scene: SceneMaker, plane: str) -> None:
    for velocity in (1.0, 1000.0):
        tall, taller = (
            evaluate(solve(paper_scene(velocity, 5.0, plane=plane, aspect=aspect))).stress_power
            for aspect in (3.0, 20.0)
        )
        assert taller == pytest.approx(tall, rel=1e-3)
