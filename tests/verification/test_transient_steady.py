"""Press and slide, step by step, ends in what the steady solver finds at once: each confirms the other.

The two share the block and the contact, but nothing in time: branch tensors in steps against one convolution.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.marching import begin
from rubfric.mechanics.march.saturation import wavelength_means
from rubfric.road.sine import SineScale
from rubfric.scene.numerics import Numerics
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import solve

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


def scene_of(paper_scene: SceneMaker, columns: int, growth: float, *given: float, **changes: object) -> Scene:
    """Return a scene that the steady solver solves on so many columns, all branches kept."""
    numerics = Numerics(
        accuracy=1e-6,
        contact_nodes=4,
        finite_contact_nodes=4,
        columns_min=columns,
        finite_columns_min=columns,
        columns_max=columns,
        row_growth=growth,
    )
    return paper_scene(*given, numerics=numerics, **changes)


def steady(scene: Scene) -> float:
    solution = solve(scene)
    slope = scene.road.slope(solution.surface_position)
    return float(np.mean(solution.contact.pressure * slope) / scene.pressure)


def mean(scene: Scene, start: str, columns: int, steps: int, wavelengths: int) -> float:
    """Return friction averaged over the last wavelength of a march."""
    march = begin(
        scene,
        Procedure(
            start=start,
            columns=columns,
            steps_per_wavelength=steps,
            wavelengths=wavelengths,
            until_saturated=False,
        ),
    )
    while not march.ended:
        march.step()
    return float(wavelength_means(march.records["friction_contact"][-steps:], steps)[0])


@PLANES
@pytest.mark.parametrize(
    ("scale", "velocity", "pressure", "wavelengths"),
    [(1, 1.0, 1.0, 2), (1, 10.0, 0.5, 4), (1, 100.0, 0.5, 12), (2, 10.0, 2.0, 6), (3, 10.0, 1.0, 12), (4, 1.0, 0.5, 3)],
)
def test_pressed_and_slid_in_small_strain(
    paper_scene: SceneMaker, plane: str, scale: int, velocity: float, pressure: float, wavelengths: int
) -> None:
    scene = scene_of(paper_scene, 64, 1.15, velocity, pressure, scale, plane=plane)
    assert mean(scene, "pressed", 64, 64, wavelengths) == pytest.approx(steady(scene), rel=0.01)


@PLANES
@pytest.mark.parametrize(("scale", "velocity", "pressure"), [(1, 500.0, 5.0), (2, 1000.0, 5.0), (3, 1000.0, 10.0)])
def test_steady_sliding_in_small_strain_goes_on_so_at_high_speed(
    paper_scene: SceneMaker, plane: str, scale: int, velocity: float, pressure: float
) -> None:
    scene = scene_of(paper_scene, 64, 1.15, velocity, pressure, scale, plane=plane)
    assert mean(scene, "steady", 64, 64, 2) == pytest.approx(steady(scene), rel=0.01)


@PLANES
@pytest.mark.parametrize(
    ("velocity", "pressure", "wavelengths"), [(1.0, 1.0, 1), pytest.param(10.0, 0.5, 3, marks=pytest.mark.thorough)]
)
def test_pressed_and_slid_in_finite_strain(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float, wavelengths: int
) -> None:
    # On 32 columns already the place of the nodes on the road would change friction by 2 %.
    scene = scene_of(paper_scene, 64, 1.3, velocity, pressure, plane=plane, kinematics="finite")
    assert mean(scene, "pressed", 64, 64, wavelengths) == pytest.approx(steady(scene), rel=0.01)


@PLANES
@pytest.mark.parametrize(
    ("velocity", "pressure"), [(100.0, 0.5), pytest.param(1000.0, 5.0, marks=pytest.mark.thorough)]
)
def test_steady_sliding_in_finite_strain_goes_on_so(
    paper_scene: SceneMaker, plane: str, velocity: float, pressure: float
) -> None:
    scene = scene_of(paper_scene, 64, 1.3, velocity, pressure, plane=plane, kinematics="finite")
    assert mean(scene, "steady", 64, 64, 2) == pytest.approx(steady(scene), rel=0.01)


@PLANES
@pytest.mark.parametrize("velocity", [10.0, 1000.0])
def test_where_the_road_is_filled_the_difference_falls_at_order_two(
    paper_scene: SceneMaker, plane: str, velocity: float
) -> None:
    """Without edges of contact nothing but the steps of time is left between the two, on any mesh."""
    low = SineScale(1e-4, 35.0)
    scene = scene_of(paper_scene, 16, 1.3, velocity, 5.0, plane=plane, road=low)
    exact = steady(scene)
    errors = [abs(mean(scene, "steady", 16, steps, 2) / exact - 1.0) for steps in (32, 64, 128)]
    assert errors[-1] < 0.005
    assert np.all(np.log2(np.array(errors[:-1]) / np.array(errors[1:])) > 1.7)
