"""The estimated error of friction: it covers the true one where that is known, and by no more than a few times.

Estimates are calibrated for the orders that are observed, 1.2 to 2; at order 1 they are within a factor of two. None is
smaller than the size of the cells allows.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from synthetic_meshes import FRICTION, on_mesh, power_law, synthetic

from rubfric.mechanics.steady.error import allowance, discretisation_error, friction_error
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.steady.solution import Friction, OnMesh
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
COARSE, FINE = Resolution(128, 1.2), Resolution(256, 1.1)  # cells half as large
MOST = 5.0
ORDERS = pytest.mark.parametrize("order", [1.2, 1.25, 1.5, 1.75, 2.0])
FACTORS = pytest.mark.parametrize("factor", [1.25, 1.5, 1.75, 2.0])


def meshes(constant: float, order: float, *resolutions: Resolution, contact: float = 0.0) -> list[OnMesh]:
    law = power_law(constant, order, contact)
    return [on_mesh(resolution, law(resolution)) for resolution in resolutions]


def floor(resolution: Resolution, friction: float = FRICTION) -> float:
    """Return the least error that cells so large allow: a sixteenth of their size squared, in the wave's measure."""
    return (2.0 * math.pi / resolution.columns + resolution.growth - 1.0) ** 2 / 16.0 * friction


def finer(factor: float) -> Resolution:
    """Return the mesh with cells smaller than those of ``COARSE`` by a factor."""
    return Resolution(round(128 * factor), 1.0 + 0.2 / factor)


def true_error(found: list[OnMesh]) -> float:
    return abs(found[-1].friction.stress_power - FRICTION)


@ORDERS
@pytest.mark.parametrize("constant", [-3.0, -0.1, 0.1, 3.0])
@pytest.mark.parametrize("contact", [1.0, 0.5, 0.0, -0.5, -1.0])
def test_estimate_covers_the_error_and_not_much_more(order: float, constant: float, contact: float) -> None:
    found = meshes(constant, order, COARSE, FINE, contact=contact)
    estimate, error = discretisation_error(found), true_error(found)
    least = floor(FINE, found[-1].friction.stress_power)
    assert error <= estimate
    # Not much more than the error, or just what the cells allow.
    assert estimate <= MOST * error or estimate == pytest.approx(least, rel=1e-6)


@ORDERS
@FACTORS
@pytest.mark.parametrize("constant", [-3.0, 0.5, 3.0])
def test_estimate_covers_the_error_for_whatever_ratio_of_cells(order: float, factor: float, constant: float) -> None:
    found = meshes(constant, order, COARSE, finer(factor), contact=1.0)
    assert discretisation_error(found) >= true_error(found)


@FACTORS
@pytest.mark.parametrize("constant", [-3.0, 0.5, 3.0])
@pytest.mark.parametrize("contact", [1.0, 0.5, 0.0])
def test_estimate_is_within_a_factor_of_two_where_the_order_is_one(
    factor: float, constant: float, contact: float
) -> None:
    found = meshes(constant, 1.0, COARSE, finer(factor), contact=contact)
    estimate, error = discretisation_error(found), true_error(found)
    assert 0.5 * error <= estimate <= 2.0 * error


@pytest.mark.parametrize(
    "resolution", [COARSE, FINE, Resolution(256, 1.4), Resolution(32, 1.1), Resolution(4096, 1.01)]
)
def test_meshes_that_agree_leave_the_error_that_their_cells_allow(resolution: Resolution) -> None:
    same = Friction(FRICTION, FRICTION, 0.0)
    coarser = Resolution(resolution.columns // 2, 1.0 + 2.0 * (resolution.growth - 1.0))
    found = [on_mesh(coarser, same), on_mesh(resolution, same)]
    assert discretisation_error(found) == pytest.approx(floor(resolution), rel=1e-12)
    assert discretisation_error(found[-1:]) == discretisation_error(found)


def test_least_error_is_of_the_second_order_and_of_both_directions() -> None:
    def alone(resolution: Resolution) -> float:
        return discretisation_error([on_mesh(resolution, Friction(FRICTION, FRICTION, 0.0))])

    assert alone(COARSE) == pytest.approx(4.0 * alone(FINE), rel=1e-12)
    assert alone(Resolution(COARSE.columns, FINE.growth)) < alone(COARSE)
    assert alone(Resolution(FINE.columns, COARSE.growth)) < alone(COARSE)
    # Neither direction alone makes a mesh exact.
    assert alone(Resolution(2**20, COARSE.growth)) > 1e-3 * FRICTION
    assert alone(Resolution(16, 1.00001)) > 1e-3 * FRICTION


@pytest.mark.parametrize(
    ("waves", "spots", "nodes", "length"),
    [
        (1, 1, 8, 1.0 / 256.0),  # one wave: its period
        (16, 4, 8, 16.0 / 256.0),  # spots of two nodes: the finest wave has sixteen columns
        (16, 4, 128, 4.0 / 128.0),  # spots of 32 nodes hold more than one finest wave
        (16, 1, 256, 1.0 / 256.0),  # full contact
    ],
)
def test_least_error_counts_the_columns_of_the_finest_wave_or_of_a_spot(
    waves: int, spots: int, nodes: int, length: float
) -> None:
    same = Friction(FRICTION, FRICTION, 0.0)
    found = replace(on_mesh(FINE, same), waves=waves, spots=spots, contact_nodes=nodes)
    least = (2.0 * math.pi * length + FINE.growth - 1.0) ** 2 / 16.0 * FRICTION
    assert discretisation_error([on_mesh(COARSE, same), found]) == pytest.approx(least, rel=1e-12)


def test_edges_of_spots_count_where_no_mesh_has_fewer_columns() -> None:
    same = Friction(FRICTION, FRICTION, 0.0)
    spots = {"waves": 16, "spots": 4, "contact_nodes": 16}
    fine = replace(on_mesh(FINE, same), **spots)
    rows_only = replace(on_mesh(Resolution(FINE.columns, COARSE.growth), same), **spots)
    edges = 3.0 * 4.0**-1.5 / 2.0 * FRICTION
    assert discretisation_error([rows_only, fine]) == pytest.approx(edges, rel=1e-12)
    # Twice the nodes in each spot.
    more = replace(fine, contact_nodes=32)
    assert discretisation_error([rows_only, more]) == pytest.approx(edges / 2.0**1.5, rel=1e-12)
    # A mesh of half the columns has seen what they change; one wave needs none.
    assert discretisation_error([replace(on_mesh(COARSE, same), **spots), fine]) < 0.2 * edges
    alone = [on_mesh(Resolution(FINE.columns, COARSE.growth), same), on_mesh(FINE, same)]
    assert discretisation_error(alone) == pytest.approx(floor(FINE), rel=1e-12)


def test_least_error_is_a_share_of_friction() -> None:
    tenth = Friction(0.1 * FRICTION, 0.1 * FRICTION, 0.0)
    assert discretisation_error([on_mesh(FINE, tenth)]) == pytest.approx(0.1 * floor(FINE), rel=1e-12)
    assert discretisation_error([on_mesh(FINE, Friction(0.0, 0.0, 0.0))]) == 0.0


def test_least_error_is_no_addition() -> None:
    # The largest of what the meshes say counts, not their sum.
    found = meshes(3.0, 1.5, COARSE, FINE, contact=1.0)
    change = abs(found[1].friction.stress_power - found[0].friction.stress_power)
    assert discretisation_error(found) == pytest.approx(1.5 * change / (2.0**1.5 - 1.0), abs=1e-9)


@ORDERS
def test_estimate_falls_with_the_cells(order: float) -> None:
    ladder = [Resolution(128 * 2**level, 1.0 + 0.2 / 2**level) for level in range(5)]
    estimates = [discretisation_error(meshes(1.0, order, *ladder[: count + 1])) for count in range(1, 5)]
    errors = [true_error(meshes(1.0, order, *ladder[: count + 1])) for count in range(1, 5)]
    assert estimates == sorted(estimates, reverse=True)
    assert all(error <= estimate for error, estimate in zip(errors, estimates, strict=True))
    assert estimates[-1] < 0.3 * estimates[0]


def test_routes_that_differ_count_where_the_meshes_agree() -> None:
    # On both meshes the same, so that nothing but the difference of the routes tells.
    apart = Friction(FRICTION, 1.01 * FRICTION)
    found = [on_mesh(resolution, apart) for resolution in (COARSE, FINE)]
    assert 0.01 * FRICTION <= discretisation_error(found) <= 0.02 * FRICTION
    assert discretisation_error(found[-1:]) == discretisation_error(found)


def test_change_of_either_route_counts() -> None:
    same = Friction(FRICTION, FRICTION)
    for other in (Friction(1.02 * FRICTION, FRICTION), Friction(FRICTION, 1.02 * FRICTION)):
        found = [on_mesh(COARSE, other), on_mesh(FINE, same)]
        assert discretisation_error(found) > 0.005 * FRICTION


def test_every_coarser_mesh_counts() -> None:
    # By chance the last two agree; the one before tells otherwise.
    values = (1.05, 1.0, 1.0)
    ladder = (Resolution(64, 1.4), COARSE, FINE)
    found = [
        on_mesh(resolution, Friction(value * FRICTION, value * FRICTION))
        for resolution, value in zip(ladder, values, strict=True)
    ]
    assert discretisation_error(found[1:]) == pytest.approx(floor(FINE), abs=1e-9)
    assert discretisation_error(found) > 0.005 * FRICTION


@pytest.mark.parametrize("other", [Resolution(256, 1.1), Resolution(264, 1.1), Resolution(288, 1.1)])
def test_mesh_hardly_finer_gives_a_finite_estimate(other: Resolution) -> None:
    found = [on_mesh(other, Friction(1.001 * FRICTION, FRICTION)), on_mesh(FINE, Friction(FRICTION, FRICTION))]
    assert 0.001 * FRICTION < discretisation_error(found) < 0.03 * FRICTION


@pytest.mark.parametrize("resolution", [1e-11, 1e-6])
def test_what_the_solver_cannot_tell_from_zero_is_part_of_the_error(resolution: float) -> None:
    same = [on_mesh(mesh, Friction(FRICTION, FRICTION, resolution)) for mesh in (COARSE, FINE)]
    assert discretisation_error(same) - floor(FINE) == pytest.approx(resolution, rel=1e-12, abs=1e-12)


def test_sign_of_friction_does_not_matter() -> None:
    forth = meshes(1.0, 1.5, COARSE, FINE, contact=0.5)
    back = [
        replace(mesh, friction=Friction(-mesh.friction.stress_power, -mesh.friction.contact, mesh.friction.resolution))
        for mesh in forth
    ]
    assert discretisation_error(back) == discretisation_error(forth)


@pytest.mark.parametrize(
    ("asked", "used", "counts"),
    [("auto", "small", True), ("small", "small", False), ("auto", "finite", False), ("finite", "finite", False)],
)
def test_finite_strain_left_out_counts_where_the_program_left_it_out(
    paper_scene: SceneMaker, asked: str, used: str, counts: bool
) -> None:
    scene, correction = paper_scene(100.0, 0.5, kinematics=asked), 0.003
    solution = synthetic(scene, FINE, Friction(FRICTION, FRICTION), decision=Decision(used, correction, "so"))
    left_out = correction * FRICTION if counts else 0.0
    assert friction_error(solution) - floor(FINE) == pytest.approx(left_out, abs=1e-9)
    assert allowance(solution) == pytest.approx(0.01 * FRICTION - left_out, rel=1e-12)


def test_folded_branches_count(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    solution = synthetic(scene, FINE, Friction(FRICTION, FRICTION), bound=0.002)
    assert friction_error(solution) - floor(FINE) == pytest.approx(0.002 * FRICTION, abs=1e-9)
    assert allowance(solution) == pytest.approx(0.008 * FRICTION, rel=1e-12)


@pytest.mark.parametrize("accuracy", [0.001, 0.05])
def test_error_is_that_of_the_meshes_and_of_the_model(paper_scene: SceneMaker, accuracy: float) -> None:
    scene = paper_scene(100.0, 0.5, kinematics="auto", numerics=Numerics(accuracy=accuracy))
    found = tuple(meshes(1.0, 1.5, COARSE, FINE))
    decision = Decision("small", 0.4 * accuracy, "so")
    solution = synthetic(scene, FINE, found[-1].friction, decision=decision, bound=0.1 * accuracy)
    whole = friction_error(replace(solution, meshes=found))
    friction = found[-1].friction.stress_power
    assert whole == pytest.approx(discretisation_error(found) + 0.5 * accuracy * friction, rel=1e-12)
    assert allowance(solution) == pytest.approx(0.5 * accuracy * friction, rel=1e-12)
