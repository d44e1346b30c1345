"""From mesh to mesh: the way to the contact, and on until the estimated error is within the accuracy."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace

import pytest
from synthetic_meshes import FRICTION, Solver, Synthetic, cell_size, power_law

from rubfric.errors import NotConverged
from rubfric.mechanics.steady.error import allowance, discretisation_error
from rubfric.mechanics.steady.refinement import refined
from rubfric.mechanics.steady.resolution import MOST_CELLS, Resolution, most_columns, needed
from rubfric.mechanics.steady.solution import Friction
from rubfric.road.waves import WaveRoad
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
EXACT = power_law(0.0, 1.0)
START = Resolution(64, 1.2)
# A mesh of 256 columns at least, 64 nodes in contact and rows that grow by a tenth.
FINE = fineness(1.0)
# Columns are rounded up to a number that suits the transform.
ROUNDING = 1.12


def ratios(columns: list[int]) -> list[float]:
    return [fine / coarse for coarse, fine in itertools.pairwise(columns)]


def columns_of(solver: Solver) -> list[int]:
    return [resolution.columns for resolution in solver.seen]


def test_exact_friction_takes_a_coarse_mesh_and_the_one_needed(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(**FINE))
    target = needed(scene, 1.0, False)
    solver = Solver(scene, target.coarser(scene, False), EXACT)
    solution = refined(scene, solver)
    assert solver.seen == [target.coarser(scene, False), target]
    assert [mesh.columns for mesh in solution.meshes] == [128, 256]


@pytest.mark.parametrize("finite", [False, True])
def test_small_contacts_are_reached_in_strides(paper_scene: SceneMaker, finite: bool) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(refinements=0))
    solver = Solver(scene, START, EXACT, fraction=lambda _: 0.01, finite=finite)
    seen = refined(scene, solver).meshes[-2]
    target = needed(scene, seen.contact_nodes / seen.columns, finite)  # 0.01, by whole nodes
    coarse = target.coarser(scene, finite)
    assert solver.seen[0] == START
    assert solver.seen[-1] == target
    columns = columns_of(solver)
    assert columns == sorted(set(columns))
    assert max(ratios(columns)) <= 6.0 * ROUNDING
    # The last but one is about twice as coarse, in both directions.
    before = solver.seen[-2]
    assert coarse.columns / 1.5 <= before.columns <= coarse.columns
    assert 1.8 <= cell_size(before) / cell_size(target) <= 2.5
    assert all(resolution.growth == coarse.growth for resolution in solver.seen[1:-1])


@pytest.mark.parametrize("columns", [90, 128, 160, 256])
def test_mesh_like_the_coarse_one_stands_in_for_it(paper_scene: SceneMaker, columns: int) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(**FINE))  # 128 columns are the coarse mesh
    solver = Solver(scene, Resolution(columns, 1.2), EXACT)
    refined(scene, solver)
    assert solver.seen == [Resolution(columns, 1.2), needed(scene, 1.0, False)]


def test_contact_found_on_the_way_decides_how_far_it_goes(paper_scene: SceneMaker) -> None:
    # Coarse meshes see more contact than there is.
    scene = paper_scene(100.0, 0.5, numerics=Numerics(**FINE, refinements=0))
    solver = Solver(scene, START, EXACT, fraction=lambda columns: 0.01 + 8.0 / columns)
    solution = refined(scene, solver)
    assert solution.resolved
    columns = columns_of(solver)
    assert columns == sorted(columns)
    assert 0.9 * 64 <= solution.meshes[-1].contact_nodes <= 1.5 * 64


def test_mesh_that_misses_nodes_is_followed_by_a_finer_one(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(**FINE, refinements=0))
    start = Resolution(512, 1.2)
    solver = Solver(scene, start, EXACT, fraction=lambda columns: 0.1 if columns <= 512 else 0.05)
    solution = refined(scene, solver)
    assert len(solver.seen) == 3
    assert solver.seen[1] == needed(scene, 51 / 512, False)
    assert solver.seen[2].columns > 64 / 0.05
    assert solution.resolved


def test_contact_of_few_nodes_on_any_mesh_ends_at_the_finest(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(columns_max=2048))
    solver = Solver(scene, START, power_law(10.0, 1.0), fraction=lambda columns: 10.0 / columns)
    solution = refined(scene, solver)
    assert solver.seen[-1].columns == 2048
    assert columns_of(solver).count(2048) == 1
    assert not solution.resolved


def test_finite_strain_ends_at_a_bound_of_its_own(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    solver = Solver(scene, START, EXACT, fraction=lambda columns: 10.0 / columns, finite=True)
    refined(scene, solver)
    assert solver.seen[-1].columns == most_columns(scene, True) < scene.numerics.columns_max


def test_refinement_in_finite_strain_ends_where_a_mesh_has_too_many_cells(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=1e-6, refinements=12))
    law = power_law(0.1, 1.0, contact=1.0)
    for finite in (True, False):
        solver = Solver(scene, START, law, finite=finite)
        refined(scene, solver)
        finest = solver.seen[-1]
        cells = finest.columns * finest.block(scene).rows
        assert (cells <= MOST_CELLS) == finite
        if finite:
            assert not finest.finer(scene, 2.0, finite).affordable(scene, finite)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("accuracy", [0.02, 0.005, 0.002])
def test_refinement_goes_on_until_the_accuracy_is_met(paper_scene: SceneMaker, order: float, accuracy: float) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=accuracy, refinements=12))
    start = needed(scene, 1.0, False).coarser(scene, False)
    law = power_law(0.01 / cell_size(start) ** order, order, contact=1.0)  # off by a hundredth on the first mesh
    solver = Solver(scene, start, law)
    solution = refined(scene, solver)
    assert discretisation_error(solution.meshes) <= allowance(solution)
    assert abs(solution.friction.stress_power / FRICTION - 1.0) <= accuracy
    assert len(solver.seen) < 12
    # And no further: the mesh before did not suffice, unless it was the coarse one.
    if len(solver.seen) > 2:
        assert discretisation_error(solution.meshes[:-1]) > accuracy * solution.meshes[-2].friction.stress_power


def test_loose_accuracy_asks_for_no_finer_mesh(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=0.1))
    start = needed(scene, 1.0, False).coarser(scene, False)
    solver = Solver(scene, start, power_law(0.01 / cell_size(start), 1.0))
    refined(scene, solver)
    assert len(solver.seen) == 2


@pytest.mark.parametrize("error", [0.03, 0.3])
def test_step_of_refinement_has_its_bounds(paper_scene: SceneMaker, error: float) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(refinements=4))
    target = needed(scene, 1.0, False)
    start = target.coarser(scene, False)
    solver = Solver(scene, start, power_law(error / cell_size(start), 1.0))
    refined(scene, solver)
    finer = solver.seen[1:]
    assert len(finer) > 1
    for coarse, fine in itertools.pairwise(finer):
        ratio = fine.columns / coarse.columns
        assert 1.25 <= ratio <= 2.0 * ROUNDING
        # Rows follow.
        assert (coarse.growth - 1.0) / (fine.growth - 1.0) == pytest.approx(ratio, rel=ROUNDING - 1.0)


@pytest.mark.parametrize("refinements", [0, 1, 3, 5])
def test_no_more_refinements_than_asked_for(paper_scene: SceneMaker, refinements: int) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=1e-5, refinements=refinements))
    start = needed(scene, 1.0, False).coarser(scene, False)
    solver = Solver(scene, start, power_law(1.0, 1.0))
    solution = refined(scene, solver)
    assert len(solver.seen) == 2 + refinements
    assert discretisation_error(solution.meshes) > allowance(solution)


def test_no_mesh_beyond_the_most_columns(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=1e-5, refinements=12, columns_max=1000))
    start = needed(scene, 1.0, False).coarser(scene, False)
    solver = Solver(scene, start, power_law(1.0, 1.0))
    refined(scene, solver)
    columns = columns_of(solver)
    assert max(columns) == columns[-1] == 1000
    assert columns.count(1000) == 1


@pytest.mark.parametrize("friction", [0.0, 1e-9])
def test_nothing_is_refined_for_friction_that_the_solver_cannot_tell_from_zero(
    paper_scene: SceneMaker, friction: float
) -> None:
    scene = paper_scene(100.0, 0.5)
    start = needed(scene, 1.0, False).coarser(scene, False)
    solver = Solver(scene, start, lambda _: Friction(friction, 0.0, 1e-6))
    refined(scene, solver)
    assert len(solver.seen) == 2


def test_nothing_is_refined_where_the_model_alone_exceeds_the_accuracy(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    start = needed(scene, 1.0, False).coarser(scene, False)
    solver = Solver(scene, start, power_law(1.0, 1.0), bound=0.011)
    refined(scene, solver)
    assert len(solver.seen) == 2


def test_model_takes_its_share_of_the_accuracy(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(refinements=12))
    start = needed(scene, 1.0, False).coarser(scene, False)
    law = power_law(0.01 / cell_size(start) ** 1.5, 1.5)
    finest = []
    for bound in (0.0, 0.009):
        solver = Solver(scene, start, law, bound=bound)
        refined(scene, solver)
        finest.append(solver.seen[-1].columns)
    assert finest[1] > finest[0]


def test_solution_is_the_last_and_knows_every_mesh(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    law = power_law(1.0, 1.5, contact=0.5)
    solver = Solver(scene, START, law, fraction=lambda _: 0.02)
    solution = refined(scene, solver)
    assert isinstance(solution, Synthetic)
    assert solution.friction == law(solver.seen[-1])
    assert solution.block.columns == solver.seen[-1].columns
    assert len(solution.meshes) == len(solver.seen)
    for mesh, resolution in zip(solution.meshes, solver.seen, strict=True):
        assert (mesh.columns, mesh.growth) == (resolution.columns, resolution.growth)
        assert mesh.rows == resolution.block(scene).rows
        assert mesh.contact_nodes == max(1, round(0.02 * mesh.columns))
        assert mesh.friction == law(resolution)


@pytest.mark.parametrize("at", [0, 1, 2])
def test_scene_that_does_not_converge_on_a_mesh_has_no_solution(paper_scene: SceneMaker, at: int) -> None:
    scene = paper_scene(100.0, 0.5, numerics=Numerics(accuracy=1e-5))
    law = power_law(1.0, 1.0)

    def failing(resolution: Resolution) -> Friction:
        if len(solver.seen) > at:
            raise NotConverged(scene.name, 7, 0.5, "something")
        return law(resolution)

    solver = Solver(scene, needed(scene, 1.0, False).coarser(scene, False), failing)
    with pytest.raises(NotConverged, match=rf"^{scene.name}: not converged after 7 steps, something is 0\.5$"):
        refined(scene, solver)
    assert len(solver.seen) == at + 1


def test_on_many_waves_the_friction_that_there_is_counts_where_a_finer_mesh_has_none(paper_scene: SceneMaker) -> None:
    waves = WaveRoad((0.015, 0.006), (35.0, 140.0), (0.0, 0.0))
    scene = replace(paper_scene(100.0, 0.5, numerics=Numerics(**FINE)), scale="all", road=waves)
    law = power_law(0.05 * 256**0.5 * 10.0, 1.0)

    def failing(resolution: Resolution) -> Friction:
        if resolution.columns > needed(scene, 1.0, False).columns:
            raise NotConverged(scene.name, 7, 0.5, "something")
        return law(resolution)

    solver = Solver(scene, needed(scene, 1.0, False).coarser(scene, False), failing)
    solution = refined(scene, solver)
    assert [mesh.columns for mesh in solution.meshes] == columns_of(solver)[:-1]
    assert solution.unsolved == columns_of(solver)[-1] > solution.meshes[-1].columns
    assert discretisation_error(solution.meshes) > allowance(solution)
