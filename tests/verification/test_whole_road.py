"""Friction on the whole road at once, in small strain, against boundary elements written apart from this code.

Their values for the paper's road in plane strain, 0.75 of the coarsest wavelength high, were printed to three or four
digits; ``boundary_element`` is another such code, here.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from boundary_element import friction_coefficient
from whole_road import CAMPAIGN, ROAD, pinned, random_phases, shifted, whole_scene

from rubfric.mechanics.steady.error import friction_error
from rubfric.simulation import evaluate, simulate, solve
from rubfric.studies.accuracy.calibration import COVERAGE
from rubfric.studies.accuracy.converged import converge

VELOCITIES = (0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 1e4)  # mm/s
FRICTION_AT_5_MPA = (0.0290, 0.0938, 0.3390, 0.6543, 0.6437, 0.5510, 0.2751)
CONTACT_AT_5_MPA = (0.987, 0.947, 0.716, 0.269, 0.125, 0.097, 0.060)
# Over the sum of the scales, at 0.5 MPa.
RATIOS = {0.1: 0.58, 10.0: 0.73, 100.0: 0.89, 1e4: 1.26}
HALF_A_DIGIT = 5e-5
# Mean over draws of the phases and their scatter, as printed: speed, pressure.
DRAWS = {(100.0, 5.0): (0.656, 0.009), (10.0, 0.5): (0.467, 0.012), (1000.0, 0.5): (0.241, 0.024)}


@pytest.mark.parametrize(
    ("velocity", "friction", "contact"), list(zip(VELOCITIES, FRICTION_AT_5_MPA, CONTACT_AT_5_MPA, strict=True))
)
def test_friction_and_contact_at_5_mpa_are_those_printed(velocity: float, friction: float, contact: float) -> None:
    result = simulate(whole_scene(velocity, 5.0))
    assert abs(float(result["friction_coefficient"]) - friction) <= 0.01 * friction + HALF_A_DIGIT
    assert float(result["contact_fraction"]) == pytest.approx(contact, abs=0.015)
    assert float(result["energy_closure"]) <= 0.01
    assert float(result["friction_coefficient_error"]) <= 0.01 * friction


@pytest.mark.parametrize("velocity", RATIOS)
def test_ratio_to_the_sum_of_the_scales_at_half_a_mpa_is_that_printed(velocity: float) -> None:
    scenes = (CAMPAIGN.scene(scale, velocity, 0.5, plane="strain", kinematics="small") for scale in CAMPAIGN.scales)
    total = sum(evaluate(solve(scene)).stress_power for scene in scenes)
    ratio = evaluate(solve(whole_scene(velocity, 0.5))).stress_power / total
    assert abs(ratio - RATIOS[velocity]) <= 0.01 * ratio + 0.005


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("pressure", [0.2, 0.5, 5.0])
@pytest.mark.parametrize("velocity", [1.0, 100.0, pytest.param(1e4, marks=pytest.mark.thorough)])
def test_boundary_elements_agree_within_the_stated_error(velocity: float, pressure: float, plane: str) -> None:
    solution = solve(whole_scene(velocity, pressure, plane=plane))
    nodes = 1024 if solution.contact_fraction > 0.5 else 8192
    expected = friction_coefficient(solution.scene, nodes)
    assert abs(solution.friction.stress_power - expected) <= friction_error(solution) + 1e-3 * expected


@pytest.mark.parametrize(("velocity", "pressure"), DRAWS)
def test_random_phases_scatter_as_printed(velocity: float, pressure: float) -> None:
    rng = np.random.default_rng(13)
    roads = [random_phases(ROAD, rng) for _ in range(3)]
    friction = [solve(whole_scene(velocity, pressure, road=road)).friction.stress_power for road in roads]
    mean, scatter = DRAWS[velocity, pressure]
    assert np.mean(friction) == pytest.approx(mean, abs=2.0 * scatter / np.sqrt(3.0) + 0.01 * mean)
    assert np.abs(np.array(friction) - mean).max() <= 3.0 * scatter
    assert np.ptp(friction) > 1e-3


@pytest.mark.parametrize(
    ("velocity", "pressure", "coarsest"), [(1000.0, 5.0, 480), (500.0, 2.0, 480), (1000.0, 0.5, 960)]
)
def test_friction_converges_between_orders_one_and_two(velocity: float, pressure: float, coarsest: int) -> None:
    expected = friction_coefficient(whole_scene(velocity, pressure), 16384)
    columns, errors = coarsest * np.array([1, 2, 4, 8]), []
    for count in columns:
        # Rows grow the slower the narrower the columns; three places of the nodes on the road average their luck.
        numerics = pinned(int(count), 1.0 + 144.0 / count)
        roads = [shifted(ROAD, place * ROAD.period / count / 3.0) for place in range(3)]
        found = [solve(whole_scene(velocity, pressure, numerics=numerics, road=road)).friction for road in roads]
        errors.append(abs(np.mean([one.stress_power for one in found]) / expected - 1.0))
    order = -np.polyfit(np.log(columns), np.log(errors), 1)[0]
    assert 1.3 < order < 2.1
    assert errors[-1] < 0.01


@pytest.mark.parametrize(("velocity", "pressure"), [(0.1, 0.5), (10.0, 0.5), (1000.0, 5.0), (1e4, 5.0)])
def test_stated_error_covers_the_difference_to_a_mesh_twice_as_fine(velocity: float, pressure: float) -> None:
    solution = solve(whole_scene(velocity, pressure))
    last = solution.meshes[-1]
    numerics = pinned(2 * last.columns, 1.0 + (last.growth - 1.0) / 2.0)
    finer = solve(whole_scene(velocity, pressure, numerics=numerics))
    difference = abs(solution.friction.stress_power - finer.friction.stress_power)
    assert 0.0 < difference <= friction_error(solution) <= 0.01 * solution.friction.stress_power


@pytest.mark.thorough
def test_stated_error_covers_the_difference_to_the_limit_of_three_meshes() -> None:
    covered = []
    for velocity, pressure, plane in product((0.1, 100.0, 1e4), (0.2, 1.0, 3.0), ("strain", "stress")):
        solution = solve(whole_scene(velocity, pressure, plane=plane))
        reference, stated = converge(solution.scene), friction_error(solution)
        error = abs(solution.friction.stress_power - reference.friction)
        assert error <= min(2.0 * stated, 0.01 * reference.friction)
        assert reference.error <= stated
        covered.append(error <= stated)
    assert np.mean(covered) >= COVERAGE


@pytest.mark.thorough
@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_three_routes_agree_over_the_grid(plane: str) -> None:
    for velocity in VELOCITIES:
        for pressure in (0.1, 0.5, 2.0):
            assert evaluate(solve(whole_scene(velocity, pressure, plane=plane))).closure <= 0.01
