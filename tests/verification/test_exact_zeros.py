"""Where friction must vanish: without branches, on a flat road, infinitely slow, infinitely fast."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
# Contacts of one size are solved on one mesh: no error asks for a finer one.
SAME_MESH = Numerics(refinements=0)
BULK = pytest.mark.parametrize("bulk", ["elastic", "proportional"])


@PLANES
@pytest.mark.parametrize("pressure", [0.002, 0.05, 0.5, 5.0])
def test_rubber_without_branches_has_no_friction(
    paper_scene: SceneMaker, elastic_rubber: Material, plane: str, pressure: float
) -> None:
    result = evaluate(solve(paper_scene(100.0, pressure, plane=plane, material=elastic_rubber)))
    assert result.stress_power == 0.0
    assert result.dissipation == 0.0
    assert abs(result.contact) < 1e-12


@PLANES
@pytest.mark.parametrize("velocity", [0.1, 1e4])
def test_flat_road_has_no_friction(paper_scene: SceneMaker, plane: str, velocity: float) -> None:
    result = evaluate(solve(paper_scene(velocity, 5.0, plane=plane, road=SineScale(0.0, 35.0))))
    assert (result.stress_power, result.dissipation, result.contact) == (0.0, 0.0, 0.0)
    assert result.closure == 0.0


@PLANES
@pytest.mark.parametrize("velocity", [1.0, 1000.0])
def test_friction_vanishes_with_the_amplitude(paper_scene: SceneMaker, plane: str, velocity: float) -> None:
    # A filled road: quadratic in the amplitude.
    coarse, fine = (
        evaluate(solve(paper_scene(velocity, 5.0, plane=plane, road=SineScale(amplitude, 35.0)))).stress_power
        for amplitude in (1e-4, 1e-7)
    )
    assert fine == pytest.approx(1e-6 * coarse, rel=1e-9)
    assert coarse > 0.0


@PLANES
@BULK
@pytest.mark.parametrize("pressure", [0.1, 5.0])
def test_friction_vanishes_as_fast_as_the_speed(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str, pressure: float
) -> None:
    # Partial and full contact: the loss modulus is linear in frequency far below the slowest branch.
    rubber = replace(paper_rubber, bulk=bulk)
    speeds = np.array([1e-4, 1e-6, 1e-8])  # mm/s; the slowest branch turns at 2.5 mm/s
    results = [
        evaluate(solve(paper_scene(v, pressure, plane=plane, material=rubber, numerics=SAME_MESH))) for v in speeds
    ]
    per_speed = np.array([result.stress_power for result in results]) / speeds
    assert per_speed[-1] > 0.0
    np.testing.assert_allclose(per_speed, per_speed[-1], rtol=1e-3)
    assert abs(results[-1].contact) < 1e-9


@PLANES
@BULK
def test_friction_vanishes_as_fast_as_the_speed_grows(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    speeds = np.array([1e11, 1e13, 1e15])  # mm/s; the fastest branch turns at 7e7 mm/s
    results = [evaluate(solve(paper_scene(v, 5.0, plane=plane, material=rubber))) for v in speeds]
    times_speed = np.array([result.stress_power for result in results]) * speeds
    assert times_speed[-1] > 0.0
    np.testing.assert_allclose(times_speed, times_speed[-1], rtol=1e-3)
    assert abs(results[-1].contact) < 1e-8


@PLANES
def test_slowest_and_fastest_contacts_are_those_of_the_elastic_limits(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str
) -> None:
    relaxed = Material("relaxed", 4.17, 0.49, (), ())
    shear, bulk = paper_rubber.instantaneous_shear_modulus, paper_rubber.long_term_bulk_modulus
    youngs = 9.0 * bulk * shear / (3.0 * bulk + shear)
    glassy = Material("glassy", youngs, youngs / (2.0 * shear) - 1.0, (), ())
    for limit, velocity, pressure in ((relaxed, 1e-9, 0.5), (glassy, 1e16, 20.0)):
        given = {"plane": plane, "numerics": SAME_MESH}
        sliding = solve(paper_scene(velocity, pressure, **given)).contact.pressure
        elastic = solve(paper_scene(velocity, pressure, material=limit, **given)).contact.pressure
        np.testing.assert_allclose(sliding, elastic, atol=1e-5 * elastic.max())
