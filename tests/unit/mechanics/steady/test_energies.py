"""Three routes to one number, and what is averaged to nodes and thinned for the result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.steady.energies import Energies, output_stride, rows_to_nodes
from rubfric.road.waves import WaveRoad
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]


def energies(stress_power: float, dissipation: float, contact: float) -> Energies:
    nothing = np.zeros(0)
    return Energies(stress_power, dissipation, contact, nothing, nothing, nothing)


def test_closure_is_the_largest_difference_over_the_largest_route() -> None:
    assert energies(0.2, 0.19, 0.198).closure == pytest.approx(0.05, rel=1e-12)
    assert energies(0.19, 0.2, 0.1).closure == pytest.approx(0.5, rel=1e-12)
    assert energies(0.3, 0.3, 0.3).closure == 0.0


def test_closure_counts_routes_of_opposite_sign() -> None:
    assert energies(0.1, 0.1, -0.1).closure == pytest.approx(2.0, rel=1e-12)


def test_closure_without_friction_is_zero() -> None:
    assert energies(0.0, 0.0, 0.0).closure == 0.0


def test_round_off_of_the_contact_route_is_no_friction() -> None:
    assert energies(0.0, 0.0, 3e-14).closure <= 0.01


def test_rows_to_nodes_weighs_the_rows_by_their_height() -> None:
    nodes = rows_to_nodes(np.array([1.0, 3.0]), np.array([10.0, 2.0]))
    np.testing.assert_allclose(nodes, [10.0, (10.0 + 3.0 * 2.0) / 4.0, 2.0], rtol=1e-12)


def test_rows_to_nodes_keeps_what_is_the_same_in_every_row(rng: np.random.Generator) -> None:
    np.testing.assert_allclose(rows_to_nodes(rng.random(7), np.full(7, 0.3)), 0.3, rtol=1e-12)


@pytest.mark.parametrize(
    ("columns", "most", "stride"),
    [
        (256, 128, 2),
        (256, 256, 1),
        (256, 4096, 1),
        (360, 128, 3),
        (600, 128, 5),
        (264, 128, 3),
        (1000, 128, 10),
        (16, 8, 2),
    ],
)
def test_output_stride_is_the_least_that_suffices_and_keeps_the_crest(
    paper_scene: SceneMaker, columns: int, most: int, stride: int
) -> None:
    assert output_stride(paper_scene(100.0, 1.0, numerics=Numerics(output_columns=most)), columns, 20) == stride


@pytest.mark.parametrize(("columns", "rows", "kept"), [(1920, 40, 1920), (3840, 40, 1920), (3840, 100, 960)])
def test_output_of_many_waves_keeps_the_finest_and_is_bounded(
    paper_scene: SceneMaker, columns: int, rows: int, kept: int
) -> None:
    road = WaveRoad(amplitudes=(0.01, 0.002), wavenumbers=(35.0, 300.0), phases=(0.0, 0.0))
    scene = replace(paper_scene(100.0, 1.0), scale="all", road=road)
    assert columns // output_stride(scene, columns, rows) == kept
