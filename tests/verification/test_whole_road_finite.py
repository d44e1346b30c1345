"""Finite strain on the whole road tends to small strain as all heights and the load shrink together."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from whole_road import ROAD, pinned, scaled, whole_scene

from rubfric.simulation import solve

pytestmark = pytest.mark.thorough

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
LOADS = pytest.mark.parametrize(("velocity", "pressure"), [(1000.0, 5.0), (10.0, 0.5)])


def difference(velocity: float, pressure: float, heights: float, plane: str, columns: int = 960) -> float:
    """Return the relative difference of friction, finite less small strain, on one mesh."""
    numerics = dataclasses.replace(pinned(columns, 1.4), tolerance=1e-8)
    # The load falls with the heights: contact in small strain stays the same.
    road = scaled(ROAD, heights=heights)
    scene = whole_scene(velocity, heights * pressure, road=road, plane=plane, numerics=numerics)
    small, finite = (
        solve(dataclasses.replace(scene, kinematics=kinematics)).friction.contact for kinematics in ("small", "finite")
    )
    return finite / small - 1.0


@PLANES
@LOADS
def test_difference_falls_with_the_slope(velocity: float, pressure: float, plane: str) -> None:
    # Slopes of 0.04 to 0.18. What is left on a road all but flat is the difference of the two quadratures.
    flat = difference(velocity, pressure, 1e-3, plane)
    assert abs(flat) < 0.01
    heights = np.array([0.02, 0.04, 0.08])
    left = [abs(difference(velocity, pressure, each, plane) - flat) for each in heights]
    assert left[0] < 0.005
    assert 0.8 < np.polyfit(np.log(heights), np.log(left), 1)[0] < 2.2


@PLANES
def test_difference_of_the_two_on_a_flat_road_is_that_of_the_mesh(plane: str) -> None:
    coarse, fine = (abs(difference(1000.0, 5.0, 1e-3, plane, columns)) for columns in (960, 1920))
    assert fine < 0.004
    assert np.log2(coarse / fine) > 1.0
