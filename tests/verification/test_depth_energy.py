"""Strain energy below a filled elastic road: the closed form of a half-space under a harmonic pressure.

With p_1 cos(k x) on y = 0 the stresses are (Johnson, Contact Mechanics, 1985, section 13.2)

    sigma_yy, sigma_xx = -p_1 (1 ± k y) exp(-k y) cos(k x),    tau_xy = -p_1 k y exp(-k y) sin(k x).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
WAVENUMBER = 35.0
SHEAR = 4.17 / 2.98  # MPa


def planar_ratio(plane: str) -> float:
    return 0.49 if plane == "strain" else 0.49 / 1.49


def harmonic_pressure(plane: str) -> float:
    """Return p_1, MPa, that bends a half-space into the road: E* k a / 2."""
    modulus = 4.17 / (1.0 - 0.49**2) if plane == "strain" else 4.17
    return modulus * 0.525 / 2.0


def deep_scene(paper_scene: SceneMaker, rubber: Material, plane: str) -> Scene:
    numerics = Numerics(**fineness(1.0) | {"row_growth": 1.04}, output_columns=256)
    return paper_scene(1.0, 5.0, plane=plane, aspect=2.0, material=rubber, numerics=numerics)


@PLANES
def test_mean_energy_over_depth(paper_scene: SceneMaker, elastic_rubber: Material, plane: str) -> None:
    solution = solve(deep_scene(paper_scene, elastic_rubber, plane))
    assert solution.contact_fraction == 1.0
    depth = WAVENUMBER * solution.block.row_positions
    ratio, peak = planar_ratio(plane), harmonic_pressure(plane)
    wave = peak**2 / (4.0 * SHEAR) * np.exp(-2.0 * depth) * (1.0 + 2.0 * depth**2 - 2.0 * ratio)
    profile = evaluate(solution).depth_profile
    rest = 25.0 / (2.0 * elastic_rubber.confined_modulus(plane))
    np.testing.assert_allclose(profile[1:], (rest + wave)[1:], atol=0.01 * wave.max())
    # The surface has the mean of the first row of cells, half a cell below.
    assert profile[0] == pytest.approx(rest + wave[0], abs=0.03 * wave.max())


@PLANES
def test_energy_at_every_node(paper_scene: SceneMaker, elastic_rubber: Material, plane: str) -> None:
    solution = solve(deep_scene(paper_scene, elastic_rubber, plane))
    density = evaluate(solution).density
    x = 2.0 * np.pi * np.arange(density.shape[1]) / density.shape[1]
    depth = WAVENUMBER * solution.block.row_positions[:, None]
    wave = harmonic_pressure(plane) * np.exp(-depth)
    ratio = planar_ratio(plane)
    # The road is a sine; the uniform load adds its confined state.
    yy = -5.0 - wave * (1.0 + depth) * np.sin(x)
    xx = -5.0 * ratio / (1.0 - ratio) - wave * (1.0 - depth) * np.sin(x)
    xy = wave * depth * np.cos(x)
    expected = (xx**2 + yy**2 + 2.0 * xy**2 - ratio * (xx + yy) ** 2) / (4.0 * SHEAR)
    np.testing.assert_allclose(density, expected, atol=0.01 * expected.max())


def test_energy_of_nearly_incompressible_rubber_is_largest_below_the_road(
    paper_scene: SceneMaker, elastic_rubber: Material
) -> None:
    solution = solve(deep_scene(paper_scene, elastic_rubber, "strain"))
    deepest = solution.block.row_positions[np.argmax(evaluate(solution).depth_profile)]
    assert WAVENUMBER * deepest == pytest.approx(1.0, abs=0.1)
