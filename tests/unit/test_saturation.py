"""Whether friction has settled: small changes do not prove it where the rubber remembers long."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rubfric.saturation import judge
from rubfric.scene import Scene

SceneMaker = Callable[..., Scene]
MEANS = np.array([0.2, 0.21, 0.2101])


def test_short_memory_and_a_small_change_are_saturation(paper_scene: SceneMaker) -> None:
    found = judge(paper_scene(1.0, 0.5), MEANS, 0.005)
    assert found.reached
    assert found.wavelengths == 3
    assert found.change == found.to_come == pytest.approx(0.0001 / 0.2101)
    assert "saturated" in str(found)


def test_long_memory_is_not(paper_scene: SceneMaker) -> None:
    found = judge(paper_scene(10000.0, 0.5), MEANS, 0.005)
    assert not found.reached
    assert found.memory == pytest.approx(0.01134034 * 1e4 * 35.0 / (2.0 * np.pi))
    assert found.to_come == pytest.approx(found.memory * found.change)
    assert "NOT saturated" in str(found)
    assert "remembers 632" in str(found)


@pytest.mark.parametrize("means", [np.zeros(0), np.array([0.2])])
def test_one_wavelength_or_none_proves_nothing(paper_scene: SceneMaker, means: np.ndarray) -> None:
    found = judge(paper_scene(1.0, 0.5), means, 0.005)
    assert not found.reached
    assert np.isnan(found.change)


def test_elastic_rubber_remembers_nothing(paper_scene: SceneMaker, elastic_rubber: object) -> None:
    found = judge(paper_scene(1.0, 0.5, material=elastic_rubber), np.zeros(2), 0.005)
    assert found.reached
    assert found.memory == 0.0
