from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.errors import NotConverged
from rubfric.mechanics.block import contact as contact_module
from rubfric.mechanics.small import steady as smallsteady
from rubfric.mechanics.small.steady import SmallSolution, solve_small
from rubfric.mechanics.small.strain import synthesise
from rubfric.mechanics.theory import layer as reference
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DECISION = Decision("small", 0.25, "small strain was asked for")
# The mesh that the contact needs is the last; it has 64 nodes in contact.
AS_NEEDED = Numerics(**fineness(1.0), refinements=0)


def solve(scene: Scene) -> SmallSolution:
    return solve_small(scene, DECISION)


@PLANES
def test_full_contact_takes_one_harmonic_and_no_pivots(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1.0, 5.0, plane=plane, numerics=AS_NEEDED)
    solution = solve(scene)
    assert solution.iterations == 0
    assert solution.resolved
    assert solution.contact_fraction == 1.0
    assert solution.block.columns == scene.numerics.columns_min
    np.testing.assert_array_equal(solution.response.harmonics, [1])
    surface = 2.0 * np.real(solution.surface[0] * np.exp(1j * scene.road.wavenumber * solution.block.column_positions))
    np.testing.assert_allclose(surface, scene.road.height(solution.block.column_positions), atol=1e-12)


@PLANES
def test_surface_stands_on_the_road_and_above_it_by_the_gap(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(1000.0, 5.0, plane=plane)
    solution = solve(scene)
    surface = (
        synthesise(solution.surface, solution.response.harmonics, solution.block.columns) + solution.contact.offset
    )
    road = scene.road.height(solution.block.column_positions)
    np.testing.assert_allclose(surface, road + solution.contact.gap, atol=1e-10 * scene.road.amplitude)
    assert solution.contact.pressure.mean() == pytest.approx(5.0, rel=1e-12)


@PLANES
@pytest.mark.parametrize(("velocity", "pressure"), [(1e4, 5.0), (1000.0, 0.5), (1000.0, 0.02)])
def test_mesh_follows_the_contact(paper_scene: SceneMaker, plane: str, velocity: float, pressure: float) -> None:
    solution = solve(paper_scene(velocity, pressure, plane=plane, numerics=AS_NEEDED))
    inside = np.count_nonzero(solution.contact.touching)
    assert solution.resolved
    assert 0.9 * 64 <= inside <= 1.35 * 64
    assert solution.block.columns % 8 == 0
    assert solution.contact_fraction == inside / solution.block.columns


def test_mesh_has_the_proportions_asked_for(paper_scene: SceneMaker) -> None:
    block = solve(paper_scene(1e4, 5.0, numerics=Numerics(row_growth=1.3, first_row=0.5, refinements=0))).block
    heights = np.diff(block.row_positions)
    assert heights[0] == pytest.approx(0.5 * block.column_width, rel=1e-9)
    assert 1.25 < heights[1] / heights[0] <= 1.3
    assert block.row_positions[-1] == pytest.approx(0.75 * block.width, rel=1e-12)


def test_more_contact_nodes_make_a_finer_mesh(paper_scene: SceneMaker) -> None:
    coarse, fine = (
        solve(paper_scene(1e4, 5.0, numerics=Numerics(contact_nodes=nodes, refinements=0))) for nodes in (64, 128)
    )
    assert fine.block.columns == pytest.approx(2 * coarse.block.columns, rel=0.1)
    assert np.count_nonzero(fine.contact.touching) >= 0.9 * 128


def test_mesh_is_refined_where_the_first_guess_was_too_coarse(
    paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = paper_scene(1000.0, 0.5, numerics=AS_NEEDED)
    found = solve(scene)
    monkeypatch.setattr(smallsteady, "scout", lambda *_: (np.ones(256, dtype=bool), 3))
    refined = solve(scene)
    assert refined.resolved
    assert np.count_nonzero(refined.contact.touching) >= 0.9 * 64
    assert refined.iterations > 3 + refined.contact.iterations  # all solves count
    assert refined.contact_fraction == pytest.approx(found.contact_fraction, rel=0.03)


def test_contact_too_small_for_the_finest_mesh_is_not_resolved(paper_scene: SceneMaker) -> None:
    solution = solve(paper_scene(1000.0, 0.02, numerics=Numerics(**fineness(1.0), columns_max=512)))
    assert solution.block.columns == 512
    assert 1 <= np.count_nonzero(solution.contact.touching) < 0.9 * 64
    assert not solution.resolved


def test_coarsest_mesh_asked_for_is_kept(paper_scene: SceneMaker) -> None:
    assert solve(paper_scene(1e4, 5.0, numerics=Numerics(columns_min=1024, refinements=0))).block.columns == 1024


@PLANES
def test_contact_does_not_depend_on_how_the_mesh_was_found(paper_scene: SceneMaker, plane: str) -> None:
    found = solve(paper_scene(1e4, 5.0, plane=plane, numerics=AS_NEEDED))
    columns = found.block.columns
    same = replace(AS_NEEDED, columns_min=columns, contact_nodes=16)
    asked = solve(paper_scene(1e4, 5.0, plane=plane, numerics=same))
    assert asked.block.columns == columns
    largest = found.contact.pressure.max()
    np.testing.assert_allclose(asked.contact.pressure, found.contact.pressure, atol=1e-9 * largest)


def test_same_scene_gives_the_same_bits(paper_scene: SceneMaker) -> None:
    one, two = (solve(paper_scene(1000.0, 0.5)) for _ in range(2))
    np.testing.assert_array_equal(one.contact.pressure, two.contact.pressure)
    np.testing.assert_array_equal(one.surface, two.surface)


def test_frequencies_are_the_harmonics_of_the_road_at_speed(paper_scene: SceneMaker) -> None:
    solution = solve(paper_scene(1000.0, 5.0))
    np.testing.assert_allclose(solution.frequencies, 35000.0 * np.arange(1, solution.block.columns // 2 + 1))


@PLANES
def test_contact_fills_continuously(paper_scene: SceneMaker, plane: str) -> None:
    scene = paper_scene(10.0, 5.0, plane=plane)
    filled = reference.full_contact_pressure(scene.material, scene.road, 10.0, scene.height, plane)
    below, above = (solve(paper_scene(10.0, share * filled, plane=plane)) for share in (0.99, 1.01))
    assert 0.85 < below.contact_fraction < 1.0
    assert below.iterations > 0
    assert above.contact_fraction == 1.0
    np.testing.assert_allclose(below.contact.pressure, above.contact.pressure, atol=0.05 * filled)


def test_scene_that_does_not_converge_raises_with_its_name(
    paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contact_module, "MOST_STEPS", 1)
    with pytest.raises(NotConverged, match=r"^scale1_v10000_p5_aspect0\.75_strain: not converged after 1 steps"):
        solve(paper_scene(1e4, 5.0))


def test_solution_tells_how_it_was_found(paper_scene: SceneMaker) -> None:
    full, partial = (solve(paper_scene(velocity, 5.0)) for velocity in (1.0, 1e4))
    assert full.decision is partial.decision is DECISION
    assert full.krylov == partial.krylov == 0
    for solution in (full, partial):
        assert len(solution.history) == len(solution.meshes) >= 2
        for line, mesh in zip(solution.history, solution.meshes, strict=True):
            assert line.startswith(f"{mesh.columns} columns: ")
        last = solution.meshes[-1]
        assert (last.columns, last.rows) == (solution.block.columns, solution.block.rows)
        assert last.friction == solution.friction
        assert last.contact_nodes == np.count_nonzero(solution.contact.touching)
    assert all(line.endswith(" columns: full contact, no contact solve") for line in full.history)
    assert partial.history[-1].endswith(f" columns: contact found in {partial.contact.iterations} pivoting steps")


def test_surface_is_that_of_the_block_as_it_was_made(paper_scene: SceneMaker) -> None:
    solution = solve(paper_scene(1000.0, 5.0))
    np.testing.assert_array_equal(solution.surface_position, solution.block.column_positions)
    np.testing.assert_array_equal(solution.surface_stretch, 1.0)


@PLANES
def test_compression_is_load_over_confined_modulus(paper_scene: SceneMaker, plane: str) -> None:
    solution = solve(paper_scene(1.0, 9.0, plane=plane))
    assert solution.compression == pytest.approx(9.0 / solution.scene.material.confined_modulus(plane), rel=1e-12)


@PLANES
@pytest.mark.parametrize("velocity", [0.1, 1e4])
def test_folded_branches_do_not_change_the_contact(paper_scene: SceneMaker, plane: str, velocity: float) -> None:
    scene = paper_scene(velocity, 0.5, plane=plane, numerics=Numerics(accuracy=0.5, refinements=0))
    folded, exact = solve(scene), solve(replace(scene, numerics=Numerics(accuracy=1e-6, refinements=0)))
    assert folded.folding.relaxed if velocity < 1.0 else folded.folding.frozen
    assert exact.folding.bound <= 1e-8 < folded.folding.bound <= 0.005
    largest = exact.contact.pressure.max()
    np.testing.assert_allclose(folded.contact.pressure, exact.contact.pressure, atol=0.005 * largest)
