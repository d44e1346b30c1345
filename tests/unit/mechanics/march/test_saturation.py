"""Whether friction has settled: small changes do not prove it where the rubber remembers long."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.mechanics.march.saturation import judge
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
MEANS = np.array([0.2, 0.21, 0.2101])


def test_short_memory_and_a_small_change_are_saturation(paper_scene: SceneMaker) -> None:
    found = judge(paper_scene(1.0, 0.5), MEANS, 0.005)
    assert found.reached
    assert (found.wavelengths, found.needed) == (3, 2)
    assert found.variation == pytest.approx(0.0001 / 0.2101)
    assert "0.2101 after 3 wavelengths: saturated (it varied by 0.05% over the last 2)" in str(found)


def test_long_memory_is_not(paper_scene: SceneMaker) -> None:
    found = judge(paper_scene(10000.0, 0.5), np.full(40, 0.2), 0.005)
    assert not found.reached
    assert found.needed == 633
    assert found.variation == 0.0
    assert "NOT saturated" in str(found)
    assert "the slowest branch remembers 632" in str(found)


def test_friction_has_to_stay_as_long_as_the_rubber_remembers(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)  # 6.3 wavelengths
    settled = np.append(0.3, np.full(8, 0.2))
    assert judge(scene, settled, 0.005).reached
    assert not judge(scene, settled[:-1], 0.005).reached
    turning = 0.2 + 0.01 * np.cos(np.arange(9))
    assert not judge(scene, turning, 0.005).reached


@pytest.mark.parametrize("means", [np.zeros(0), np.array([0.2])])
def test_one_wavelength_or_none_proves_nothing(paper_scene: SceneMaker, means: np.ndarray) -> None:
    assert not judge(paper_scene(1.0, 0.5), means, 0.005).reached


def test_elastic_rubber_remembers_nothing(paper_scene: SceneMaker, elastic_rubber: Material) -> None:
    found = judge(paper_scene(1.0, 0.5, material=elastic_rubber), np.zeros(2), 0.005)
    assert found.reached
    assert found.needed == 2
