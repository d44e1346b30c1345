"""Elastic half-space on a sine: Westergaard's contact fraction and pressure."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory import layer as reference
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
FRACTIONS = pytest.mark.parametrize("fraction", [0.005, 0.02, 0.1, 0.3, 0.6, 0.9])


def pressed(
    paper_scene: SceneMaker, rubber: Material, plane: str, fraction: float, numerics: Numerics
) -> SteadySolution:
    """Press a deep elastic block with the load that Westergaard gives for a contact fraction."""
    modulus = rubber.plane_modulus(0.0, plane).real
    pressure = modulus * 0.525 / 2.0 * np.sin(0.5 * np.pi * fraction) ** 2
    return solve(paper_scene(1.0, pressure, plane=plane, aspect=2.0, material=rubber, numerics=numerics))


@PLANES
@FRACTIONS
def test_contact_ends_within_a_node_on_either_side(
    paper_scene: SceneMaker, elastic_rubber: Material, plane: str, fraction: float
) -> None:
    solution = pressed(paper_scene, elastic_rubber, plane, fraction, Numerics())
    columns = solution.block.columns
    assert solution.resolved
    assert abs(solution.contact_fraction - fraction) * columns <= 2.0
    # One patch, about the crest at a quarter of the wavelength.
    from_trough = np.roll(solution.contact.touching, columns // 4)
    touching = np.flatnonzero(from_trough)
    assert np.all(np.diff(touching) == 1)
    assert touching[0] + touching[-1] == columns


@PLANES
@pytest.mark.parametrize("fraction", [0.02, 0.3, 0.9])
def test_more_nodes_sharpen_the_contact_fraction(
    paper_scene: SceneMaker, elastic_rubber: Material, plane: str, fraction: float
) -> None:
    solution = pressed(paper_scene, elastic_rubber, plane, fraction, Numerics(contact_nodes=512))
    assert solution.contact_fraction == pytest.approx(fraction, rel=4e-3)


@PLANES
@FRACTIONS
def test_pressure_is_westergaards(
    paper_scene: SceneMaker, elastic_rubber: Material, plane: str, fraction: float
) -> None:
    solution = pressed(paper_scene, elastic_rubber, plane, fraction, Numerics(**fineness(1.0)))
    # Angle from the crest, half a wavelength being pi / 2.
    angle = np.pi * ((solution.block.column_positions / solution.block.width + 0.25) % 1.0 - 0.5)
    edge = np.sin(0.5 * np.pi * fraction)
    root = np.sqrt(np.maximum(edge**2 - np.sin(angle) ** 2, 0.0))
    expected = 2.0 * solution.scene.pressure * np.cos(angle) / edge**2 * root
    expected[np.abs(angle) > 0.5 * np.pi * fraction] = 0.0
    # The root is steep at the edge, where a shift by half a node shows.
    error = solution.contact.pressure - expected
    assert np.sqrt(np.mean(error**2) / np.mean(expected**2)) < 0.02
    crest = solution.block.columns // 4
    assert solution.contact.pressure[crest] == pytest.approx(expected[crest], rel=5e-3)


def test_speed_means_nothing_to_an_elastic_block(paper_scene: SceneMaker, elastic_rubber: Material) -> None:
    slow, fast = (
        solve(paper_scene(velocity, 0.5, material=elastic_rubber)).contact.pressure for velocity in (1e-3, 1e6)
    )
    np.testing.assert_array_equal(slow, fast)


def test_load_of_full_contact_is_that_of_the_closed_form(paper_scene: SceneMaker, elastic_rubber: Material) -> None:
    scene = paper_scene(1.0, 1.0, aspect=2.0, material=elastic_rubber, numerics=Numerics(row_growth=1.05))
    fills = reference.full_contact_pressure(elastic_rubber, scene.road, 1.0, scene.height, "strain")
    below, above = (
        solve(paper_scene(1.0, share * fills, aspect=2.0, material=elastic_rubber, numerics=scene.numerics))
        for share in (0.997, 1.003)
    )
    assert below.contact_fraction < 1.0
    assert above.contact_fraction == 1.0
