"""Nearly incompressible rubber in plane strain: the mesh does not lock."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from boundary_element import friction_coefficient

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.theory import layer as reference
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
ROAD = SineScale(0.015, 35.0)
HEIGHT = 0.75 * ROAD.wavelength
HARMONICS = np.arange(1, 9)


def rubber(poissons_ratio: float, paper_rubber: Material | None = None) -> Material:
    """Return a rubber of long-term shear modulus 1.4 MPa, elastic or with the paper's branches."""
    fractions, times = (
        ((), ()) if paper_rubber is None else (paper_rubber.shear_fractions, paper_rubber.relaxation_times)
    )
    return Material("rubber", 2.8 * (1.0 + poissons_ratio), poissons_ratio, fractions, times)


def compliance_errors(material: Material, dilatation: str = "auto") -> np.ndarray:
    """Return the relative errors of the first harmonics, on 256 columns in plane strain."""
    block = Block.graded(ROAD.wavelength, HEIGHT, 256, "strain", dilatation=dilatation)
    expected = reference.layer_compliance(material, ROAD.wavenumber * HARMONICS, 10.0, HEIGHT, "strain")
    return np.abs(respond(block, material, 10.0, HARMONICS).compliance / expected - 1.0)


@pytest.mark.parametrize("poissons_ratio", [0.4999, 0.4999999])
def test_elastic_compliance_is_as_good_as_at_the_papers_ratio(poissons_ratio: float) -> None:
    near, paper = compliance_errors(rubber(poissons_ratio)), compliance_errors(rubber(0.49))
    assert near.max() < 0.01
    assert np.all(near < 1.25 * paper + 1e-4)


@pytest.mark.parametrize("poissons_ratio", [0.4999, 0.4999999])
def test_viscoelastic_compliance_is_as_good_as_at_the_papers_ratio(
    paper_rubber: Material, poissons_ratio: float
) -> None:
    near, paper = (compliance_errors(rubber(ratio, paper_rubber)) for ratio in (poissons_ratio, 0.49))
    assert near.max() < 0.01
    assert np.all(near < 1.25 * paper + 1e-4)


def test_pointwise_dilatation_would_lock_and_its_mean_does_not() -> None:
    assert compliance_errors(rubber(0.3), "pointwise").max() < 0.01
    assert compliance_errors(rubber(0.4999), "pointwise")[0] > 0.1
    assert compliance_errors(rubber(0.4999), "mean").max() < 0.01
    np.testing.assert_array_equal(compliance_errors(rubber(0.4999)), compliance_errors(rubber(0.4999), "mean"))


@pytest.mark.parametrize("poissons_ratio", [0.49, 0.4999])
@pytest.mark.parametrize(("velocity", "pressure"), [(1.0, 5.0), (10.0, 0.5), (1000.0, 5.0)])
def test_friction_agrees_with_the_boundary_elements(
    paper_scene: SceneMaker, paper_rubber: Material, poissons_ratio: float, velocity: float, pressure: float
) -> None:
    scene = paper_scene(velocity, pressure, material=rubber(poissons_ratio, paper_rubber))
    result, expected = evaluate(solve(scene)), friction_coefficient(scene)
    assert result.contact == pytest.approx(expected, rel=2e-3)
    assert result.stress_power == pytest.approx(expected, rel=1e-2)


def test_energy_routes_of_nearly_incompressible_rubber_agree(paper_scene: SceneMaker, paper_rubber: Material) -> None:
    for pressure in (0.05, 5.0):
        scene = paper_scene(100.0, pressure, material=rubber(0.4999, paper_rubber))
        assert evaluate(solve(scene)).closure < 5e-3
