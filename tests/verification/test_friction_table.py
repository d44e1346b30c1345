"""Friction of the paper's scales in plane strain at 5 MPa, against boundary-element solutions.

Two boundary-element codes, written apart from this one, gave the printed table; a third is written here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from boundary_element import friction_coefficient

from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
VELOCITIES = (0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 1e4)  # mm/s
TABLE = {
    1: (0.0014, 0.0127, 0.0291, 0.1617, 0.3006, 0.2621, 0.1140),
    2: (0.0027, 0.0169, 0.0439, 0.2130, 0.2340, 0.1810, 0.0790),
    3: (0.0103, 0.0311, 0.1452, 0.3384, 0.1924, 0.1526, 0.0752),
    4: (0.0147, 0.0353, 0.1922, 0.3045, 0.1688, 0.1297, 0.0689),
}
PRINTED = 2.5e-4  # two in the last digit, and half of one for rounding
FINE = Numerics(**fineness(1.0), refinements=0)
FINER = Numerics(contact_nodes=256, columns_min=1024, row_growth=1.05)
SCALES = pytest.mark.parametrize("scale", TABLE)


def cases(paper_scene: SceneMaker, scale: int, numerics: Numerics, **changes: object) -> Iterator[tuple[Scene, float]]:
    for velocity, printed in zip(VELOCITIES, TABLE[scale], strict=True):
        yield paper_scene(velocity, 5.0, scale=scale, numerics=numerics, **changes), printed


@SCALES
def test_default_numerics_agree_with_the_table_and_the_boundary_elements(paper_scene: SceneMaker, scale: int) -> None:
    for scene, printed in cases(paper_scene, scale, Numerics()):
        friction = evaluate(solve(scene)).stress_power
        assert abs(friction - printed) <= 0.01 * printed + PRINTED
        assert friction == pytest.approx(friction_coefficient(scene), rel=5e-3)


@SCALES
def test_mesh_twice_as_fine_agrees_with_the_boundary_elements(paper_scene: SceneMaker, scale: int) -> None:
    for scene, _ in cases(paper_scene, scale, FINE):
        assert evaluate(solve(scene)).stress_power == pytest.approx(friction_coefficient(scene), rel=2e-3)


@SCALES
def test_finer_numerics_agree_with_the_table_and_the_boundary_elements(paper_scene: SceneMaker, scale: int) -> None:
    for scene, printed in cases(paper_scene, scale, FINER):
        friction = evaluate(solve(scene)).stress_power
        assert abs(friction - printed) <= 0.002 * printed + PRINTED
        assert friction == pytest.approx(friction_coefficient(scene), rel=3e-4)


@SCALES
def test_plane_stress_agrees_with_the_boundary_elements(paper_scene: SceneMaker, scale: int) -> None:
    for scene, _ in cases(paper_scene, scale, Numerics(), plane="stress"):
        assert evaluate(solve(scene)).stress_power == pytest.approx(friction_coefficient(scene), rel=5e-3)


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize(("velocity", "pressure"), [(0.1, 0.02), (100.0, 0.05), (1e4, 1.0)])
@pytest.mark.parametrize("aspect", [0.25, 1.5])
def test_light_loads_and_other_aspects_agree_with_the_boundary_elements(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float, aspect: float
) -> None:
    scene = paper_scene(velocity, pressure, plane=plane, aspect=aspect)
    expected = friction_coefficient(scene, nodes=8192)
    assert evaluate(solve(scene)).stress_power == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("scale", [1, 4])
def test_boundary_elements_have_converged(paper_scene: SceneMaker, scale: int) -> None:
    for scene, _ in cases(paper_scene, scale, Numerics()):
        assert friction_coefficient(scene, nodes=1024) == pytest.approx(friction_coefficient(scene), rel=1e-4)


@SCALES
def test_friction_peaks_inside_the_range_of_speeds(paper_scene: SceneMaker, scale: int) -> None:
    friction = [evaluate(solve(scene)).stress_power for scene, _ in cases(paper_scene, scale, Numerics())]
    peak = friction.index(max(friction))
    assert VELOCITIES[peak] == {1: 500.0, 2: 500.0, 3: 100.0, 4: 100.0}[scale]
    assert max(friction[0], friction[-1]) < 0.5 * friction[peak]


def test_friction_rises_and_falls_with_pressure(paper_scene: SceneMaker) -> None:
    for pressure, expected in zip((0.05, 0.5, 2.0, 5.0, 10.0), (0.054, 0.183, 0.249, 0.162, 0.081), strict=True):
        friction = evaluate(solve(paper_scene(100.0, pressure))).stress_power
        assert friction == pytest.approx(expected, abs=7e-4)
