"""Steady sliding of one scene in finite strain: its mesh, balance and contact along the deformed surface."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rubfric.errors import NotConverged
from rubfric.mechanics.finite import steady as finitesteady
from rubfric.mechanics.finite.contact import SlidingContact
from rubfric.mechanics.finite.newton import Solved, Stalled
from rubfric.mechanics.finite.steady import FiniteSolution, solve_finite
from rubfric.mechanics.theory.compression import pressed, stored_energy
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

RUBBER = Material("soft", 4.17, 0.49, (0.3, 0.4), (1e-3, 1e-5))
COARSE = Numerics(accuracy=0.5, finite_contact_nodes=8, finite_columns_min=64, row_growth=1.4)
PARTIAL = Scene(1, SineScale(0.015, 35.0), 100.0, 0.2, 0.75, RUBBER, "stress", COARSE, "finite")
DECISION = Decision("finite", 0.3, "finite strain was asked for")

SCENES = pytest.mark.parametrize(
    "scene",
    [replace(PARTIAL, plane=plane, pressure=pressure) for plane in ("strain", "stress") for pressure in (0.2, 5.0)],
    ids=lambda scene: scene.name,
)
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


@cache
def solve(scene: Scene) -> FiniteSolution:
    return solve_finite(scene, DECISION)


@SCENES
def test_block_is_in_balance(scene: Scene) -> None:
    solution = solve(scene)
    finite, block = solution.finite, solution.block
    forces = finite.forces(finite.stressed(solution.fields).stress[:4])
    carried = scene.pressure * block.column_width
    assert np.abs(forces[:, 1:-1]).max() < 1e-2 * carried
    np.testing.assert_allclose(forces[1, -1], -carried, atol=1e-2 * carried)
    # What the road pushes sideways, the top holds.
    pushed = -(solution.contact.pressure @ solution.correction.slope) * block.column_width
    assert -forces[0, -1].sum() == pytest.approx(pushed, rel=1e-2)


@SCENES
def test_road_carries_the_load_without_tension(scene: Scene) -> None:
    solution = solve(scene)
    contact = solution.contact
    assert contact.pressure.mean() == pytest.approx(scene.pressure, rel=1e-10)
    assert contact.pressure.min() == 0.0 or contact.touching.all()
    assert contact.gap.min() >= 0.0
    assert np.all((contact.pressure == 0.0) | (contact.gap == 0.0))
    assert contact.touching.all() == (scene.pressure > 1.0)


@SCENES
def test_road_pushes_along_its_normal(scene: Scene) -> None:
    solution = solve(scene)
    finite, block = solution.finite, solution.block
    forces = finite.forces(finite.stressed(solution.fields).stress[:4])[:, 0]
    pushed = solution.contact.pressure * block.column_width
    largest = pushed.max()
    np.testing.assert_allclose(forces[1], pushed, atol=1e-2 * largest)
    slope = scene.road.slope(solution.surface_position)
    np.testing.assert_allclose(forces[0], -slope * pushed, atol=1e-2 * largest)


@SCENES
def test_gap_is_that_of_the_deformed_surface(scene: Scene) -> None:
    solution = solve(scene)
    position = solution.block.column_positions + solution.fields.displacement[0, 0]
    np.testing.assert_array_equal(solution.surface_position, position)
    height = solution.fields.displacement[1, 0] - scene.road.height(position)
    np.testing.assert_allclose(height, solution.contact.gap, atol=1e-3 * scene.road.amplitude)
    touching = solution.contact.touching
    np.testing.assert_allclose(height[touching], 0.0, atol=1e-4 * scene.road.amplitude)


@SCENES
def test_top_moves_sideways_as_a_whole_and_thickness_is_free(scene: Scene) -> None:
    solution = solve(scene)
    assert np.ptp(solution.fields.displacement[0, -1]) < 1e-12
    across = solution.finite.stressed(solution.fields).stress[4:]
    assert len(across) == (scene.plane == "stress")
    np.testing.assert_allclose(across, 0.0, atol=1e-2 * scene.pressure)


@SCENES
def test_two_routes_agree(scene: Scene) -> None:
    friction = solve(scene).friction
    assert friction.stress_power > 0.0
    assert friction.disagreement < 0.05
    assert friction.disagreement == pytest.approx(
        abs(friction.stress_power - friction.contact) / max(friction.stress_power, friction.contact), rel=1e-12
    )


@SCENES
def test_stretch_of_the_surface_covers_it_all(scene: Scene) -> None:
    solution = solve(scene)
    along = solution.surface_stretch
    assert along.min() > 0.0
    if scene.plane == "strain":
        assert along.mean() == pytest.approx(1.0, rel=1e-12)
    else:
        # Pressed together, the rubber yields across its thickness.
        assert along.mean() > 1.0


@PLANES
def test_flat_road_leaves_the_pressed_block_without_friction(plane: str) -> None:
    scene = replace(PARTIAL, road=SineScale(0.0, 35.0), plane=plane, pressure=3.0)
    solution = solve(scene)
    stretch, thickness = pressed(RUBBER, 3.0, plane)
    rows = solution.block.row_positions[:, None]
    displacement = solution.fields.displacement
    settled = np.broadcast_to((stretch - 1.0) * rows, displacement[1].shape)
    np.testing.assert_allclose(displacement[1] - displacement[1, :1], settled, atol=1e-9)
    np.testing.assert_allclose(displacement[0], 0.0, atol=1e-9)
    np.testing.assert_allclose(solution.fields.log_thickness, np.log(thickness), atol=1e-7)
    np.testing.assert_allclose(solution.contact.pressure, 3.0, rtol=1e-7)
    assert solution.contact_fraction == 1.0
    assert abs(solution.friction.stress_power) < 1e-9
    assert solution.friction.contact == 0.0


@PLANES
def test_pressed_block_is_that_on_a_flat_road(plane: str) -> None:
    solution = solve(replace(PARTIAL, plane=plane))
    known = pressed(RUBBER, 0.2, plane)
    assert solution.compression == 1.0 - known[0]
    assert solution.pressed_energy == stored_energy(RUBBER, *known)


def test_history_tells_every_mesh() -> None:
    solution = solve(replace(PARTIAL, numerics=replace(COARSE, row_growth=1.2)))
    columns = [mesh.columns for mesh in solution.meshes]
    assert columns[-1] == solution.block.columns
    assert len(solution.history) == len(columns) >= 2
    assert solution.history[0].startswith(f"{columns[0]} columns, at once: converged in ")
    for line, before, here in zip(solution.history[1:], columns, columns[1:], strict=False):
        assert line.startswith(f"{here} columns, from {before}: converged in ")
    assert solution.iterations > 0
    assert solution.krylov >= solution.iterations


def test_first_mesh_is_refined_in_depth() -> None:
    coarse, fine = (solve(replace(PARTIAL, numerics=replace(COARSE, row_growth=growth))) for growth in (1.4, 1.1))
    assert fine.block.rows > coarse.block.rows
    heights = np.diff(fine.block.row_positions)
    assert 1.0 < heights[1] / heights[0] <= 1.1


def test_mesh_follows_the_contact() -> None:
    light = solve(replace(PARTIAL, pressure=0.02, numerics=replace(COARSE, finite_contact_nodes=16)))
    assert np.count_nonzero(light.contact.touching) >= 0.9 * 16
    assert light.resolved
    assert light.block.columns > 64


def test_columns_have_their_bounds() -> None:
    fewest = solve(replace(PARTIAL, numerics=replace(COARSE, finite_columns_min=96)))
    assert fewest.block.columns >= 96
    bound = replace(COARSE, columns_min=64, columns_max=64, finite_contact_nodes=32)
    most = solve(replace(PARTIAL, numerics=bound))
    assert most.block.columns == 64
    assert not most.resolved


def test_accuracy_asks_for_columns() -> None:
    loose, tight = (solve(replace(PARTIAL, numerics=replace(COARSE, accuracy=accuracy))) for accuracy in (0.5, 0.01))
    assert tight.block.columns > loose.block.columns
    assert tight.friction.disagreement <= 0.01


def test_decision_and_folding_are_kept() -> None:
    solution = solve(PARTIAL)
    assert solution.decision is DECISION
    assert solution.finite.material == solution.folding.material


def test_same_scene_gives_the_same_bits() -> None:
    one, two = (solve_finite(PARTIAL, DECISION) for _ in range(2))
    np.testing.assert_array_equal(one.fields.displacement, two.fields.displacement)
    assert one.history == two.history


def test_coarse_mesh_that_does_not_help_is_made_good(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = replace(PARTIAL, numerics=replace(COARSE, row_growth=1.2))
    expected = solve(scene)

    def stall(*_: object) -> None:
        raise Stalled("no luck", 1, 9, 0.1)

    monkeypatch.setattr(finitesteady, "attempt", stall)
    found = solve_finite(scene, DECISION)
    assert found.history[-1].startswith(f"{expected.block.columns} columns, at once: converged")
    np.testing.assert_allclose(
        found.contact.pressure, expected.contact.pressure, atol=1e-3 * expected.contact.pressure.max()
    )


def test_where_a_mesh_is_too_far_from_the_one_before_another_between_them_leads_to_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene, tries = replace(PARTIAL, numerics=replace(COARSE, row_growth=1.2)), []
    expected = solve(scene)
    real = finitesteady.attempt

    def stall_once(problem: SlidingContact, *rest: Any) -> Solved:
        tries.append(problem.finite.block.columns)
        if len(tries) == 1:
            raise Stalled("no luck", 1, 9, 0.1)
        return real(problem, *rest)

    monkeypatch.setattr(finitesteady, "attempt", stall_once)
    found = solve_finite(scene, DECISION)
    first, between, again = tries[:3]
    assert again == first > between
    assert found.history[-2].startswith(f"{between} columns, from ")
    assert found.history[-1].startswith(f"{first} columns, from {between}: converged")
    np.testing.assert_allclose(
        found.contact.pressure, expected.contact.pressure, atol=1e-3 * expected.contact.pressure.max()
    )


def test_scene_that_does_not_converge_raises_with_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    def stall(*_: object) -> None:
        raise Stalled("no luck", 1, 9, 0.1)

    monkeypatch.setattr("rubfric.mechanics.finite.continuation.newton", stall)
    with pytest.raises(NotConverged, match=rf"^{PARTIAL.name}: not converged after \d+ steps, .* is 0\.1; every way"):
        solve_finite(PARTIAL, DECISION)
