"""Finite strain tends to small strain as the road becomes flat and the load light."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from rubfric.mechanics.theory.layer import full_contact_pressure
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]

SAME_MESH = Numerics(contact_nodes=16, finite_contact_nodes=16, columns_min=256, finite_columns_min=256, refinements=0)


@pytest.fixture(scope="module")
def difference(paper_scene: SceneMaker, paper_rubber: Material):
    """Return a function: relative difference of friction for a slope, a load over that which fills the road, ..."""

    def between(slope: float, load: float, plane: str, poisson: float) -> float:
        material, road = replace(paper_rubber, poissons_ratio=poisson), SineScale(slope / 35.0, 35.0)
        scene = paper_scene(10.0, 1.0, road=road, material=material, plane=plane, numerics=SAME_MESH)
        filling = full_contact_pressure(material, road, scene.velocity, scene.height, plane)
        small, finite = (
            evaluate(solve(replace(scene, pressure=load * filling, kinematics=kinematics))).contact
            for kinematics in ("small", "finite")
        )
        return finite / small - 1.0

    return between


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("load", [0.3, 1.3])
def test_flat_roads_agree_to_a_thousandth(difference, plane: str, load: float) -> None:
    assert abs(difference(1e-3, load, plane, 0.49)) < 1e-3


def test_difference_falls_with_the_square_of_the_slope(difference) -> None:
    # All but incompressible plane strain: the load, which falls with the slope, squeezes the block by nothing.
    # What is left on a road all but flat is the difference of the two quadratures.
    flat, fine, coarse = (difference(slope, 1.3, "strain", 0.499999) for slope in (1e-3, 0.025, 0.05))
    assert abs(flat) < 1e-4
    assert (coarse - flat) / (fine - flat) == pytest.approx(4.0, rel=0.1)


@pytest.mark.thorough
@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_difference_falls_with_the_compression_under_the_load(difference, plane: str) -> None:
    fine, coarse = difference(0.02, 1.3, plane, 0.49), difference(0.04, 1.3, plane, 0.49)
    assert coarse / fine == pytest.approx(2.0, rel=0.1)
