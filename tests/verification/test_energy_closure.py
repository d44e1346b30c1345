"""Three routes to one friction coefficient, from light loads to filled roads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
SCALES = pytest.mark.parametrize("scale", [1, 4])
WORST = 5e-3
DEFAULT, FINE = Numerics(), Numerics(**fineness(1.0), refinements=0)


@PLANES
@SCALES
@pytest.mark.parametrize("velocity", [0.1, 10.0, 1000.0, 1e4])
@pytest.mark.parametrize(
    ("numerics", "most"),
    [(DEFAULT, DEFAULT.accuracy), pytest.param(FINE, WORST, marks=pytest.mark.thorough)],
    ids=["default", "fine"],
)
def test_routes_agree_whatever_the_load(
    paper_scene: SceneMaker, plane: str, scale: int, velocity: float, numerics: Numerics, most: float
) -> None:
    fractions = []
    for pressure in (0.02, 0.2, 1.0, 5.0, 20.0):
        solution = solve(paper_scene(velocity, pressure, scale=scale, plane=plane, numerics=numerics))
        result = evaluate(solution)
        assert result.stress_power > 0.0
        assert result.closure < most
        fractions.append(solution.contact_fraction)
    assert fractions[0] < 0.1


@PLANES
@pytest.mark.parametrize(("velocity", "pressure", "largest"), [(1000.0, 0.05, 0.02), (100.0, 0.001, 0.004)])
def test_routes_agree_in_the_tiniest_contacts(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float, largest: float
) -> None:
    solution = solve(paper_scene(velocity, pressure, plane=plane))
    assert solution.contact_fraction < largest
    assert evaluate(solution).closure < WORST


@PLANES
def test_routes_agree_for_relaxing_bulk_and_for_other_aspects(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str
) -> None:
    rubber = replace(paper_rubber, bulk="proportional")
    for aspect in (0.1, 0.25, 3.0):
        for pressure in (0.05, 5.0):
            scene = paper_scene(1000.0, pressure, plane=plane, aspect=aspect, material=rubber)
            assert evaluate(solve(scene)).closure < WORST


@PLANES
@DILATATIONS
def test_routes_of_a_filled_road_agree_to_round_off(paper_scene: SceneMaker, plane: str, dilatation: str) -> None:
    scene = paper_scene(10.0, 5.0, plane=plane, numerics=Numerics(dilatation=dilatation))
    assert evaluate(solve(scene)).closure < 1e-11


@PLANES
@DILATATIONS
@pytest.mark.parametrize("pressure", [0.2, 5.0])
def test_routes_agree_however_dilatation_is_integrated(
    paper_scene: SceneMaker, plane: str, dilatation: str, pressure: float
) -> None:
    scene = paper_scene(1000.0, pressure, plane=plane, numerics=Numerics(dilatation=dilatation))
    assert evaluate(solve(scene)).closure < WORST


@PLANES
@DILATATIONS
@pytest.mark.parametrize(("velocity", "pressure", "most"), [(1000.0, 2.0, 0.01), (10.0, 5.0, 1e-5)])
def test_routes_of_finite_strain_agree_however_dilatation_is_integrated(
    paper_scene: SceneMaker, plane: str, dilatation: str, velocity: float, pressure: float, most: float
) -> None:
    numerics = Numerics(dilatation=dilatation, refinements=0)
    scene = paper_scene(velocity, pressure, plane=plane, numerics=numerics, kinematics="finite")
    assert evaluate(solve(scene)).closure < most


@PLANES
def test_closure_tells_a_coarse_mesh(paper_scene: SceneMaker, plane: str) -> None:
    coarse = Numerics(columns_min=16, finite_columns_min=16, columns_max=16, output_columns=16)
    solution = solve(paper_scene(1000.0, 5.0, plane=plane, numerics=coarse))
    assert not solution.resolved
    assert evaluate(solution).closure > 0.01
