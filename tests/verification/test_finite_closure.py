"""Solved scenes of finite strain, all over the range of the paper: energies close, and the state is physical."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.finite.energy import branch_tensors
from rubfric.mechanics.finite.law import second_stress
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
Real = NDArray[np.float64]
# Scale, mm/s, MPa, height over width.
SCENES = [
    (1, 0.1, 5.0, 0.75),
    (1, 100.0, 0.5, 0.25),
    (1, 1e4, 5.0, 1.5),
    (2, 10.0, 0.1, 0.75),
    (3, 1000.0, 5.0, 0.75),
]
MORE = [
    (1, 0.1, 0.1, 0.75),
    (1, 1000.0, 2.0, 0.75),
    (2, 100.0, 5.0, 0.75),
    (2, 1e4, 0.5, 0.25),
    (3, 10.0, 0.5, 0.75),
    (4, 0.1, 0.1, 0.75),
    (4, 1e4, 0.1, 0.75),
]


PLANES = ["stress", "strain"]
THOROUGH = [pytest.param(case, marks=pytest.mark.thorough) for case in product(MORE, PLANES)]


@pytest.fixture(scope="module", params=[*product(SCENES, PLANES), *THOROUGH], ids=str)
def solution(request: pytest.FixtureRequest, paper_scene: SceneMaker) -> FiniteSolution:
    (scale, velocity, pressure, aspect), plane = request.param
    scene = paper_scene(velocity, pressure, scale, aspect=aspect, plane=plane, kinematics="finite")
    solved = solve(scene)
    assert isinstance(solved, FiniteSolution)
    return solved


@pytest.fixture
def forces(solution: FiniteSolution) -> Real:
    """Nodal forces that the stresses exert, over the largest of the contact: x and y, rows, columns."""
    largest = solution.contact.pressure.max() * solution.block.column_width
    return solution.finite.forces(solution.correction.state.stress[:4]) / largest


def test_energies_close(solution: FiniteSolution) -> None:
    assert evaluate(solution).closure <= 0.01


def test_branch_tensors_are_positive_definite(solution: FiniteSolution) -> None:
    for xx, yy, xy, zz in branch_tensors(solution.finite, solution.correction.state.deformation):
        least = 0.5 * (xx + yy) - np.hypot(0.5 * (xx - yy), xy)
        assert least.min() > 0.1  # 0.27 was the least
        assert zz.min() > 0.1


def test_nothing_is_turned_inside_out(solution: FiniteSolution) -> None:
    assert solution.correction.state.deformation.area.min() > 0.3  # 0.48 was the least
    assert np.diff(solution.surface_position).min() > 0.0


def test_road_neither_pulls_nor_pierces(solution: FiniteSolution) -> None:
    contact, road = solution.contact, solution.scene.road
    assert contact.pressure.min() >= 0.0
    assert contact.gap.min() >= 0.0
    assert not np.any(contact.pressure * contact.gap)
    # The gap is that of the nodes where they are, up to the rise of the whole block.
    height = solution.fields.displacement[1, 0] - road.height(solution.surface_position)
    risen = height - height[contact.touching].mean()
    np.testing.assert_allclose(risen, contact.gap, atol=1e-5 * road.amplitude)


def test_road_carries_the_load(solution: FiniteSolution) -> None:
    assert solution.contact.pressure.mean() == pytest.approx(solution.scene.pressure, rel=1e-12)


def test_inner_nodes_and_the_top_are_in_balance(solution: FiniteSolution, forces: Real) -> None:
    # Of the largest contact force: 2e-4 was the most, where one node carries most of the load.
    above = forces[:, 1:].copy()
    load = solution.finite.top_load(solution.scene.pressure)
    above[1, -1] += load / (solution.contact.pressure.max() * solution.block.column_width)
    above[0, -1, load > 0.0] = 0.0  # the top is driven
    np.testing.assert_allclose(above, 0.0, atol=5e-4)


def test_surface_nodes_carry_the_normal_force_of_the_road(solution: FiniteSolution, forces: Real) -> None:
    share = solution.contact.pressure / solution.contact.pressure.max()
    slope = solution.scene.road.slope(solution.surface_position)
    np.testing.assert_allclose(forces[1, 0], share, atol=5e-4)
    np.testing.assert_allclose(forces[0, 0], -share * slope, atol=5e-4)


def test_plane_stress_has_none_across(solution: FiniteSolution) -> None:
    state = solution.correction.state
    volumetric = np.broadcast_to(state.volumetric, state.deformation.volume.shape)
    second = np.abs(second_stress(state.deformation, state.driving, volumetric)).max(axis=(1, 2, 3))
    across = second[3] / second.max()
    assert across < 1e-4 if solution.scene.plane == "stress" else across > 0.3
