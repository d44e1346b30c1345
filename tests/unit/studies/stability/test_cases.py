"""The matrix of stability covers what it promises, and is the same every time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.studies.stability.cases import PANELS, Case, cases

MATRIX = cases()


def test_cases_are_distinct_by_name_and_belong_to_a_panel() -> None:
    assert len({case.name for case in MATRIX}) == len(MATRIX)
    assert {case.panel for case in MATRIX} == set(PANELS)


def test_matrix_is_the_same_every_time() -> None:
    assert cases() == MATRIX


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("velocity", 1e-9, 1e9),
        ("pressure", 1e-6, 1e3),
        ("aspect", 0.02, 20.0),
        ("slope", 0.0, 3.0),
        ("waves", 0, 64),
        ("wavelength", 1e-6, 1e3),
        ("poissons_ratio", -0.9, 0.4999),
        ("branches", 0, 40),
        ("long_term_fraction", 1e-9, 1.0),
    ],
)
def test_every_parameter_reaches_both_ends(name: str, low: float, high: float) -> None:
    values = [getattr(case, name) for case in MATRIX]
    assert (min(values), max(values)) == (low, high)


@pytest.mark.parametrize("motion", ["steady", "march"])
@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("kinematics", ["small", "finite"])
def test_every_way_of_solving_is_tried(motion: str, plane: str, kinematics: str) -> None:
    ways = [case for case in MATRIX if (case.motion, case.plane, case.kinematics) == (motion, plane, kinematics)]
    assert len(ways) >= 15


def test_scene_is_what_the_case_says() -> None:
    case = Case("corners", velocity=3.0, pressure=0.2, aspect=2.0, slope=0.7, wavelength=5.0, plane="strain")
    scene = case.scene()
    assert (scene.velocity, scene.pressure, scene.aspect, scene.plane) == (3.0, 0.2, 2.0, "strain")
    assert scene.road.steepest_slope == pytest.approx(0.7, rel=1e-10)
    assert scene.road.wavelength == pytest.approx(5.0, rel=1e-10)


@pytest.mark.parametrize("branches", [0, 1, 2, 40])
def test_rubber_has_its_branches_spread_evenly_over_its_decades(branches: int) -> None:
    share = 1e-9 if branches else 1.0
    rubber = Case("corners", branches=branches, long_term_fraction=share, slowest=1e4, decades=20.0).material()
    assert len(rubber.relaxation_times) == branches
    assert rubber.long_term_fraction == pytest.approx(share, rel=1e-2)
    if branches > 1:
        assert rubber.relaxation_times[0] / rubber.relaxation_times[-1] == pytest.approx(1e20, rel=1e-9)
        assert len(set(rubber.shear_fractions)) == 1


def test_every_scene_of_the_matrix_is_legal() -> None:
    for case in MATRIX:
        assert math.isfinite(case.scene().height)


def test_what_no_scene_may_be_is_refused() -> None:
    with pytest.raises(InvalidInput, match="poissons_ratio"):
        Case("corners", poissons_ratio=0.5).scene()


@pytest.mark.parametrize("waves", [1, 2, 4, 16, 64])
def test_roads_of_many_waves_are_rough_as_given_and_their_phases_are_random(waves: int) -> None:
    case = Case("waves", waves=waves, slope=3.0, wavelength=0.5)
    road = case.scene().road
    assert case.scene() == case.scene()
    x = road.period / 4096 * np.arange(4096)
    assert np.sqrt(np.mean(road.slope(x) ** 2)) == pytest.approx(3.0, rel=1e-9)
    assert road.wavelength == pytest.approx(0.5, rel=1e-9)
    assert len(np.unique(road.waves.wavenumbers)) == len(np.unique(road.waves.phases)) == waves


def test_roads_of_many_waves_are_tried_in_every_way() -> None:
    own = [case for case in MATRIX if case.panel == "waves"]
    axes = ("waves", "slope", "velocity", "pressure", "plane", "kinematics")
    seen = {name: {getattr(case, name) for case in own} for name in axes}
    assert seen["waves"] == {1, 2, 4, 16, 64}
    assert len(own) == math.prod(len(values) for values in seen.values())
    assert [len(seen[name]) for name in axes[2:]] == [2, 2, 2, 2]
