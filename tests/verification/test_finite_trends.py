"""Friction in finite strain against two earlier programs with an incompressible thickness, and against small strain."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

SceneMaker = Callable[..., Scene]

# Speed in mm/s, pressure in MPa, friction in finite and in small strain; scale 1, aspect 0.75, plane stress.
EARLIER = [
    (0.1, 5.0, 0.0023, 0.0011),
    (10.0, 5.0, 0.0418, 0.0226),
    (100.0, 5.0, 0.21, 0.13),
    (0.1, 0.5, 0.0076, 0.0076),
    (100.0, 0.5, 0.199, 0.206),
]


@pytest.mark.parametrize(("velocity", "pressure", "finite", "small"), EARLIER)
def test_plane_stress(paper_scene: SceneMaker, velocity: float, pressure: float, finite: float, small: float) -> None:
    for kinematics, expected in (("finite", finite), ("small", small)):
        scene = paper_scene(velocity, pressure, plane="stress", kinematics=kinematics)
        assert float(simulate(scene)["friction_coefficient"]) == pytest.approx(expected, rel=0.04)


def test_plane_strain(paper_scene: SceneMaker) -> None:
    # The same law in another program on 48 x 16 cells, 0.02228; a transient with another law in a third, 0.0230.
    fine = Numerics(**fineness(1.0), refinements=0)
    friction = float(simulate(paper_scene(1.0, 3.0, kinematics="finite", numerics=fine))["friction_coefficient"])
    assert friction == pytest.approx(0.02228, rel=0.005)
    assert friction == pytest.approx(0.0230, rel=0.04)


@pytest.mark.parametrize("velocity", [0.1, 10.0, 1000.0])
@pytest.mark.parametrize("pressure", [0.5, 5.0])
def test_plane_strain_stays_near_small_strain(paper_scene: SceneMaker, velocity: float, pressure: float) -> None:
    finite, small = (
        float(simulate(paper_scene(velocity, pressure, kinematics=kinematics))["friction_coefficient"])
        for kinematics in ("finite", "small")
    )
    assert finite == pytest.approx(small, rel=0.15)
