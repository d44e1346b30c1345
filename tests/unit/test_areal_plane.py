"""Profiles of an areal road in the plane model: on ridges they are the surface, whichever way it is slid over."""

from __future__ import annotations

import math

import numpy as np
import pytest

import rubfric
from rubfric.areal_plane import profile_heights, slide_profiles
from rubfric.errors import InvalidInput
from rubfric.results.areal_table import areal_table, plane_words
from rubfric.rubber.material import Material

K = 2.0 * math.pi


def ridges(turned: float) -> rubfric.ArealWaves:
    """Return ridges that are steeper on one side, so that it matters from which they are met."""
    return rubfric.ArealWaves((0.02, 0.01), (K, 2.0 * K), (turned, turned), (0.0, 1.0))


@pytest.mark.parametrize(("turned", "direction", "other"), [(0.0, 0.0, 180.0), (90.0, 270.0, 90.0)])
def test_profiles_of_ridges_are_the_surface(
    paper_rubber: Material, turned: float, direction: float, other: float
) -> None:
    frictions = []
    for each in (direction, other):
        scene = rubfric.ArealScene(
            ridges(turned), 100.0, 0.3, paper_rubber, each, numerics=rubfric.ArealNumerics(nodes_max=128)
        )
        row = areal_table([rubfric.simulate_areal(scene)], [slide_profiles(scene, 2)]).iloc[0]
        assert row["plane_over_surface"] == pytest.approx(1.0, abs=row["plane_over_surface_error"])
        assert row["plane_over_surface_error"] < 0.03
        assert row["contact_plane"] == pytest.approx(row["contact_fraction"], abs=0.01)
        frictions.append(row["friction_plane"])
    assert abs(frictions[0] - frictions[1]) > 0.1 * frictions[0]


def test_profiles_that_do_not_repeat_are_refused_and_the_table_says_why(paper_rubber: Material) -> None:
    road = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.25, rms_slope=0.25)
    scene = rubfric.ArealScene(road, 10.0, 0.5, paper_rubber, 30.0, numerics=rubfric.ArealNumerics(nodes_max=32))
    with pytest.raises(InvalidInput, match="the direction is 30 degrees, but profiles repeat along 0, 90"):
        profile_heights(scene, 4)
    table = areal_table([rubfric.simulate_areal(scene)], [slide_profiles(scene, 4)])
    assert table.loc[0, "note"].startswith("the direction is 30 degrees")
    assert np.isnan(table.loc[0, "plane_over_surface"])
    assert plane_words(table) == ""


def test_profiles_are_evenly_spread_over_the_road(paper_rubber: Material) -> None:
    road = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.125, rms_slope=0.25)
    lines = profile_heights(rubfric.ArealScene(road, 10.0, 0.5, paper_rubber), 5)
    fine = road.spectrum.heights((20, lines.shape[1]))
    np.testing.assert_allclose(lines, fine[::4], atol=1e-15)
