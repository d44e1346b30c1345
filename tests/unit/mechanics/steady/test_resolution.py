"""Meshes of one family: how many columns a contact needs, and what is coarser and finer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.mechanics.small.steady import SmallSolver
from rubfric.mechanics.steady.refinement import refined
from rubfric.mechanics.steady.resolution import COLUMN_STEP, Resolution, fit, most_columns, needed
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.road.waves import WaveRoad
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import COLUMNS_PER_HEIGHT, Scene

SceneMaker = Callable[..., Scene]
KINDS = pytest.mark.parametrize("finite", [False, True])
# What one scene may have: enough columns for every test here, few enough for a mesh in finite strain.
NUMERICS = Numerics(contact_nodes=64, finite_contact_nodes=32, columns_min=256, finite_columns_min=128)


@pytest.fixture
def scene(paper_scene: SceneMaker) -> Scene:
    return paper_scene(100.0, 0.5, numerics=NUMERICS)


def smooth(count: int) -> bool:
    """Return whether a number has no prime factor above 5."""
    for prime in (2, 3, 5):
        while count % prime == 0:
            count //= prime
    return count == 1


@KINDS
@pytest.mark.parametrize("fraction", [1e-3, 0.01, 0.03, 0.123, 0.5, 1.0])
def test_mesh_needed_puts_as_many_nodes_into_the_contact(scene: Scene, fraction: float, finite: bool) -> None:
    nodes, least = (32, 128) if finite else (64, 256)
    resolution = needed(scene, fraction, finite)
    assert resolution.growth == scene.numerics.row_growth
    asked = max(least, nodes / fraction)
    if asked <= most_columns(scene, finite):
        assert asked <= resolution.columns <= 1.12 * asked + COLUMN_STEP
    else:
        assert resolution.columns == most_columns(scene, finite)


@pytest.mark.parametrize("aspect", [0.01, 0.02, 0.5])
def test_flat_blocks_have_cells_no_wider_than_they_are_high(paper_scene: SceneMaker, aspect: float) -> None:
    flat = paper_scene(100.0, 0.5, aspect=aspect, numerics=NUMERICS)
    for resolution in (needed(flat, 1.0, False), needed(flat, 1.0, False).coarser(flat, False)):
        block = resolution.block(flat)
        assert block.height >= 0.4 * COLUMNS_PER_HEIGHT * block.column_width


@KINDS
@pytest.mark.parametrize("columns", [1.0, 8.0, 9.0, 255.0, 257.0, 1000.5, 3001.0])
def test_columns_suit_the_road_and_the_transform(scene: Scene, columns: float, finite: bool) -> None:
    count = fit(scene, columns, finite)
    assert count >= columns
    assert count - columns <= COLUMN_STEP + 0.12 * columns
    assert count % COLUMN_STEP == 0
    assert smooth(count // COLUMN_STEP)


@KINDS
def test_columns_have_a_bound(paper_scene: SceneMaker, finite: bool) -> None:
    bounded = paper_scene(100.0, 0.5, numerics=Numerics(columns_max=1000))
    assert fit(bounded, 1e5, finite) == most_columns(bounded, finite) == 1000


def test_finite_strain_has_a_bound_of_its_own(scene: Scene) -> None:
    assert most_columns(scene, False) == 32768
    assert most_columns(scene, True) == fit(scene, 1e9, True) < 32768
    # Twice 24 for the finest wave, of a window with 200 of them.
    window = replace(scene, scale="all", road=WaveRoad((0.1, 1e-3), (np.pi / 20.0, 10.0 * np.pi), (0.0, 0.0)))
    assert most_columns(window, True) == 9600
    assert needed(window, 1.0, True).columns == 4800


@KINDS
@pytest.mark.parametrize("factor", [1.25, 1.5, 2.0, 6.0])
def test_finer_mesh_has_cells_smaller_in_both_directions(scene: Scene, factor: float, finite: bool) -> None:
    coarse = Resolution(128, 1.2)
    fine = coarse.finer(scene, factor, finite)
    assert factor * 128 <= fine.columns <= 1.12 * factor * 128 + COLUMN_STEP
    assert fine.growth == pytest.approx(1.0 + 0.2 / factor, rel=1e-12)
    rows, more = (resolution.block(scene).rows for resolution in (coarse, fine))
    assert more >= 0.9 * factor * rows


@KINDS
def test_coarser_mesh_has_cells_about_twice_as_large(scene: Scene, finite: bool) -> None:
    fine = Resolution(512, 1.1)
    coarse = fine.coarser(scene, finite)
    assert 256 <= coarse.columns <= 288
    assert coarse.growth == pytest.approx(1.2, rel=1e-12)
    # There and back.
    assert coarse.finer(scene, 2.0, finite).growth == pytest.approx(1.1, rel=1e-12)


@KINDS
def test_coarser_mesh_has_its_bounds(scene: Scene, finite: bool) -> None:
    assert Resolution(32, 1.1).coarser(scene, finite).columns == 32
    assert Resolution(40, 1.1).coarser(scene, finite).columns >= 32
    assert Resolution(8, 1.1).coarser(scene, finite).columns == 8  # never finer
    assert Resolution(512, 2.9).coarser(scene, finite).growth == 2.0


@KINDS
def test_mesh_halfway_is_between_two_others_and_there_is_none_between_neighbours(scene: Scene, finite: bool) -> None:
    coarse, fine = Resolution(128, 1.5), Resolution(512, 1.1)
    between = coarse.halfway(fine, scene, finite)
    assert between is not None
    assert 256 <= between.columns <= 288
    assert coarse.block(scene).rows < between.block(scene).rows < fine.block(scene).rows
    assert coarse.halfway(coarse, scene, finite) is None
    deeper = coarse.halfway(Resolution(128, 1.2), scene, finite)
    assert deeper is not None
    assert deeper.columns == 128


@KINDS
def test_rows_never_grow_by_less_than_a_mesh_can_tell(scene: Scene, finite: bool) -> None:
    even = Resolution(64, 1.00001)
    fine = even.finer(scene, 2.0, finite)
    assert fine.growth == 1.00001
    heights = np.diff(fine.block(scene).row_positions)
    np.testing.assert_allclose(heights, heights[0], rtol=2e-3)


@pytest.mark.parametrize("dilatation", ["auto", "pointwise", "mean"])
def test_block_is_that_of_the_scene(paper_scene: SceneMaker, dilatation: str) -> None:
    scene = paper_scene(100.0, 0.5, plane="stress", numerics=Numerics(first_row=0.5, dilatation=dilatation))
    block = Resolution(200, 1.25).block(scene)
    assert (block.columns, block.plane, block.dilatation) == (200, "stress", dilatation)
    assert (block.width, block.height) == (scene.road.wavelength, scene.height)
    heights = np.diff(block.row_positions)
    assert heights[0] == pytest.approx(0.5 * block.column_width, rel=1e-9)
    assert 1.2 < heights[1] / heights[0] <= 1.25


def test_more_cells_than_memory_holds_are_refused_before_they_are_meshed_finely(paper_scene: SceneMaker) -> None:
    numerics = Numerics(row_growth=1.00001, columns_min=32768, columns_max=32768)
    scene = paper_scene(100.0, 0.5, kinematics="small", numerics=numerics)
    with pytest.raises(InvalidInput, match=r"^numerics.row_growth of .* is 1.00001, but must be larger: with 16384 "):
        refined(scene, SmallSolver(scene, Decision("small", 0.0, "")))
