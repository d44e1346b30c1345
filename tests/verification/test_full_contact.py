"""Full contact: friction and pressure of the finite-element block against the closed form of the layer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory import layer as reference
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
ASPECTS = pytest.mark.parametrize("aspect", [0.25, 0.5, 0.75, 1.0, 2.0])
VELOCITIES = (1e-3, 1.0, 10.0, 100.0, 1e3, 1e4)  # mm/s
FINE = Numerics(**fineness(1.0), refinements=0)
FINER = replace(FINE, row_growth=1.05)


def filled(
    paper_scene: SceneMaker, plane: str, aspect: float, velocity: float, numerics: Numerics
) -> tuple[Scene, SteadySolution, Energies]:
    """Solve a scene just above the pressure that fills the road."""
    scene = paper_scene(velocity, 1.0, plane=plane, aspect=aspect, numerics=numerics)
    fills = reference.full_contact_pressure(scene.material, scene.road, velocity, scene.height, plane)
    scene = paper_scene(velocity, 1.05 * fills, plane=plane, aspect=aspect, numerics=numerics)
    solution = solve(scene)
    assert solution.contact_fraction == 1.0
    return scene, solution, evaluate(solution)


def expected_friction(scene: Scene) -> float:
    return reference.full_contact_friction(
        scene.material, scene.road, scene.velocity, scene.pressure, scene.height, scene.plane
    )


@PLANES
@ASPECTS
def test_friction_to_a_thousandth_with_graded_rows_of_five_percent(
    paper_scene: SceneMaker, plane: str, aspect: float
) -> None:
    for velocity in VELOCITIES:
        scene, _, result = filled(paper_scene, plane, aspect, velocity, FINER)
        for route in (result.stress_power, result.dissipation, result.contact):
            assert route == pytest.approx(expected_friction(scene), rel=1e-3)


@PLANES
@ASPECTS
def test_rows_of_ten_percent_err_by_a_thousandth_and_by_two_in_flat_blocks(
    paper_scene: SceneMaker, plane: str, aspect: float
) -> None:
    limit = 2e-3 if aspect == 0.25 else 1e-3
    for velocity in VELOCITIES:
        scene, _, result = filled(paper_scene, plane, aspect, velocity, FINE)
        assert result.stress_power == pytest.approx(expected_friction(scene), rel=limit)


@PLANES
@ASPECTS
def test_default_mesh_errs_by_three_thousandths_and_less_than_its_estimate(
    paper_scene: SceneMaker, plane: str, aspect: float
) -> None:
    for velocity in VELOCITIES:
        scene, solution, result = filled(paper_scene, plane, aspect, velocity, Numerics())
        error = abs(result.stress_power - expected_friction(scene))
        assert error <= 3e-3 * expected_friction(scene)
        assert error <= friction_error(solution)


@PLANES
def test_pressure_follows_the_closed_form_and_vanishes_at_one_place_when_the_road_just_fills(
    paper_scene: SceneMaker, plane: str
) -> None:
    scene, solution, _ = filled(paper_scene, plane, 0.75, 100.0, FINER)
    compliance = reference.layer_compliance(scene.material, scene.road.wavenumber, 100.0, scene.height, plane)
    phase = 35.0 * solution.block.column_positions
    expected = scene.pressure + np.imag(scene.road.amplitude / compliance * np.exp(1j * phase))
    np.testing.assert_allclose(solution.contact.pressure, expected, atol=1e-3 * scene.pressure)
    assert solution.contact.pressure.min() == pytest.approx(0.05 / 1.05 * scene.pressure, abs=1e-3 * scene.pressure)


@PLANES
def test_friction_of_a_filled_road_falls_as_one_over_pressure(paper_scene: SceneMaker, plane: str) -> None:
    one, two = (evaluate(solve(paper_scene(10.0, pressure, plane=plane))).stress_power for pressure in (10.0, 20.0))
    assert one / two == pytest.approx(2.0, rel=1e-12)


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("aspect", [0.001, 0.01, 0.1])
def test_flat_blocks_do_not_lock(paper_scene: SceneMaker, plane: str, aspect: float) -> None:
    scene = paper_scene(100.0, 20.0, plane=plane, aspect=aspect)
    assert evaluate(solve(scene)).stress_power == pytest.approx(expected_friction(scene), rel=5e-3)
