"""Friction that others are judged by: against the closed form, against known laws, and what its bound counts."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from synthetic_meshes import FRICTION, Law, Solver, cell_size, power_law

from rubfric.mechanics.small.steady import SmallSolver
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.steady.solution import Friction
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.mechanics.theory.layer import full_contact_friction
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy import converged
from rubfric.studies.accuracy.converged import converge

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
START = Resolution(64, 1.2)


def exact(scene: Scene) -> float:
    return full_contact_friction(scene.material, scene.road, scene.velocity, scene.pressure, scene.height, scene.plane)


@pytest.fixture
def approaching(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Solver]:
    """Return a function that lets friction follow a law of the mesh; it returns what solves by that law."""

    def install(scene: Scene, law: Law) -> Solver:
        solver = Solver(scene, START, law)
        monkeypatch.setattr(converged, "SmallSolver", lambda given, decision: solver)
        return solver

    return install


@PLANES
@pytest.mark.parametrize("velocity", [0.1, 1.0])
def test_full_contact_is_the_closed_form_within_the_bound(paper_scene: SceneMaker, plane: str, velocity: float) -> None:
    scene = paper_scene(velocity, 9.0, plane=plane)
    found = converge(scene)
    assert abs(found.friction - exact(scene)) <= found.error
    assert 0.0 < found.error <= 1e-3 * found.friction
    assert found.kinematics == "small"


def test_much_finer_mesh_is_within_the_bound(paper_scene: SceneMaker) -> None:
    scene = paper_scene(1.0, 9.0)
    found = converge(scene)
    whole = replace(scene, numerics=Numerics(folding=0.0, columns_max=8192))
    columns, growth = 3 * found.columns, 1.007
    finer = SmallSolver(whole, Decision("small", 0.0, "asked for")).solve(Resolution(columns, growth))
    assert finer.block.rows > 2 * found.rows
    assert abs(found.friction - finer.friction.stress_power) <= found.error


def test_partial_contact_is_closer_than_the_default(paper_scene: SceneMaker) -> None:
    scene = paper_scene(1e4, 5.0)
    found = converge(scene)
    assert found.columns > 4 * scene.numerics.columns_min
    assert 0.0 < found.error < 1e-3 * found.friction
    # It does not depend on what accuracy or mesh the scene asks for.
    assert converge(replace(scene, numerics=Numerics(accuracy=0.5, contact_nodes=8, tolerance=1e-2))) == found


@pytest.mark.parametrize("order", [1.2, 1.5, 2.0, 2.5])
@pytest.mark.parametrize("constant", [-3.0, 0.3, 3.0])
@pytest.mark.parametrize("contact", [1.0, 0.5, 0.0, -1.0])
def test_bound_covers_the_error_of_known_laws(
    paper_scene: SceneMaker, approaching: Callable[..., Solver], order: float, constant: float, contact: float
) -> None:
    scene, law = paper_scene(1.0, 9.0), power_law(constant, order, contact)
    solver = approaching(scene, law)
    found = converge(scene)
    finest = law(solver.seen[-1])
    routes = abs(finest.stress_power - finest.contact)
    error = abs(found.friction - FRICTION)
    assert error <= found.error
    # And tells of convergence: not much more than the finest mesh is off by.
    assert found.error <= 2.0 * max(abs(finest.stress_power - FRICTION), routes) + finest.resolution


def test_steady_approach_of_the_second_order_is_extrapolated(
    paper_scene: SceneMaker, approaching: Callable[..., Solver]
) -> None:
    scene, law = paper_scene(1.0, 9.0), power_law(3.0, 2.0, contact=1.0)
    solver = approaching(scene, law)
    off = abs(converge(scene).friction - FRICTION)
    assert off < 0.2 * abs(law(solver.seen[-1]).stress_power - FRICTION)


def test_unsteady_approach_is_not_extrapolated(paper_scene: SceneMaker, approaching: Callable[..., Solver]) -> None:
    scene = paper_scene(1.0, 9.0)

    def wavering(resolution: Resolution) -> Friction:
        value = FRICTION * (1.0 + 1e-3 * math.cos(math.pi * len(solver.seen)))
        return Friction(value, value, 0.0)

    solver = approaching(scene, wavering)
    found = converge(scene)
    assert found.friction == wavering(START).stress_power
    assert found.error == pytest.approx(2e-3 * FRICTION, rel=1e-9)


def test_routes_that_stay_apart_are_in_the_bound(paper_scene: SceneMaker, approaching: Callable[..., Solver]) -> None:
    scene = paper_scene(1.0, 9.0)
    approaching(scene, lambda _: Friction(0.99 * FRICTION, 1.01 * FRICTION, 0.0))
    found = converge(scene)
    assert found.friction == pytest.approx(FRICTION, rel=1e-12)
    assert found.error == pytest.approx(0.01 * FRICTION, rel=1e-9)  # either may be the right one


def test_three_meshes_are_of_one_family_and_each_finer(
    paper_scene: SceneMaker, approaching: Callable[..., Solver]
) -> None:
    scene = paper_scene(1.0, 9.0)
    solver = approaching(scene, power_law(1.0, 2.0, 1.0))
    found = converge(scene)
    family = solver.seen[-3:]
    sizes = [cell_size(resolution) for resolution in family]
    np.testing.assert_allclose([sizes[0] / sizes[1], sizes[1] / sizes[2]], 1.5, rtol=0.05)
    assert [resolution.columns for resolution in family] == sorted({resolution.columns for resolution in family})
    assert found.columns == family[-1].columns
    assert found.rows == family[-1].block(scene).rows
    assert family[0].columns >= 4 * Numerics().columns_min
    assert family[0].growth - 1.0 <= 0.25 * (Numerics().row_growth - 1.0) * (1.0 + 1e-12)


def test_bound_doubles_where_there_are_no_more_columns(
    paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = paper_scene(1.0, 9.0)
    found = converge(scene)
    monkeypatch.setattr(converged, "most_columns", lambda given, finite: found.columns)
    assert converge(scene) == replace(found, error=2.0 * found.error)


def test_bound_holds_on_capped_columns(paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = paper_scene(1.0, 9.0)
    free = converge(scene)
    monkeypatch.setattr(converged, "_BASE", replace(converged._BASE, columns_max=512))
    capped = converge(scene)
    assert capped.columns == 512
    assert capped.error > free.error
    assert abs(capped.friction - exact(scene)) <= capped.error


@pytest.mark.parametrize(("asked", "used"), [("small", "small"), ("auto", "finite"), ("finite", "finite")])
def test_finite_strain_unless_small_strain_is_asked_for(
    paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch, asked: str, used: str
) -> None:
    made: list[Scene] = []

    def solver(kind: str) -> Callable[[Scene, Decision], Solver]:
        def make(given: Scene, decision: Decision) -> Solver:
            made.append(given)
            assert given.kinematics == decision.kinematics == kind
            return Solver(given, START, power_law(1.0, 2.0, 1.0), finite=kind == "finite")

        return make

    monkeypatch.setattr(converged, "SmallSolver", solver("small"))
    monkeypatch.setattr(converged, "FiniteSolver", solver("finite"))
    scene = paper_scene(1.0, 9.0, kinematics=asked, numerics=Numerics(dilatation="mean", first_row=0.5))
    assert converge(scene).kinematics == used
    (given,) = made
    assert given.numerics.folding == 0.0
    assert (given.numerics.dilatation, given.numerics.first_row) == ("mean", 0.5)
