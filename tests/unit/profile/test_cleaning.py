"""What is removed from a profile is found where it was put, counted, and nothing else is."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.profile.cleaning import clean
from rubfric.profile.measured import Profile
from rubfric.profile.virtual import self_affine

SPACING = 0.05
PLACE = np.arange(4000)


def road(heights: np.ndarray) -> Profile:
    return Profile("road", 10.0, SPACING, heights)


@pytest.mark.parametrize("kind", ["sine", "rough"])
def test_spikes_gaps_and_tilt_are_found_and_counted(kind: str, rng: np.random.Generator) -> None:
    true = np.sin(2.0 * np.pi * PLACE / 80.0) if kind == "sine" else self_affine(rng, 4000, SPACING, 0.8, 0.02)
    heights = true + 0.03 * SPACING * PLACE + 2.0
    at = np.arange(100, 3900, 190)
    heights[at] += np.where(at % 4, 2.0, -2.0)
    heights[at[:5] + 1] += np.where(at[:5] % 4, 2.0, -2.0)
    for begin in (920, 2040, 3080):
        heights[begin : begin + 20] = np.nan
    found = clean(road(heights))
    removed = dict(found.removed)
    assert removed["Spikes"].startswith(f"{len(at)}, of {len(at) + 5} points")
    assert removed["Gaps bridged, spikes among them"].startswith(f"{len(at) + 3}, of {len(at) + 65} points")
    assert removed["Gaps bridged, spikes among them"].endswith("the longest 1 mm")
    # Tilt is told from waves as far as a line through whole waves, and what is not bridged is kept.
    line = np.polynomial.Polynomial.fit(PLACE, true, 1)(PLACE)
    error = found.heights - (true - line)
    assert np.abs(error[~found.bridged]).max() < 0.05 * true.std()
    assert np.count_nonzero(found.bridged) == len(at) + 65
    assert not found.warnings


def test_a_clean_profile_is_left_as_it_is(rng: np.random.Generator) -> None:
    for heights in (
        np.sin(PLACE / 9.0),
        rng.standard_normal(4000),
        rng.standard_normal(4000).cumsum(),
        1.0 * (PLACE % 50 < 25),
    ):
        found = clean(road(heights), form=0)
        assert found.heights == pytest.approx(heights - heights.mean(), abs=1e-9 * np.ptp(heights))
        assert dict(found.removed)["Spikes"] == "none"


def test_plates_at_the_ends_are_cut_off_unless_they_are_road(rng: np.random.Generator) -> None:
    true = self_affine(rng, 4000, SPACING, 0.8, 0.02, longest=20.0)
    heights = true + 0.002 * rng.standard_normal(4000)
    heights[:300] = 8.0 + 0.002 * rng.standard_normal(300)
    heights[-200:] = -5.0 + 0.002 * rng.standard_normal(200)
    found = clean(road(heights))
    assert found.plates == (300, 200)
    assert found.profile.start == pytest.approx(10.0 + 300 * SPACING)
    assert dict(found.removed)["Plate at the begin"] == "15 mm, flat"
    assert clean(road(heights), keep_ends=True).plates == (0, 0)
    assert clean(road(true)).plates == (0, 0)


def test_form_is_subtracted_as_far_as_it_is_asked_for() -> None:
    place = np.linspace(-1.0, 1.0, 4000)
    heights = 3.0 + 0.7 * place + 1.5 * place**2 + 0.1 * np.sin(2.0 * np.pi * 50.0 * place)
    assert np.abs(clean(road(heights), form=2).heights).max() == pytest.approx(0.1, rel=0.02)
    words = dict(clean(road(heights), form=2).removed)["Subtracted: tilt and form"]
    assert "tilt 6.99 mm/m (1.4 mm in all), bow 1.5 mm" in words
    assert np.ptp(clean(road(heights), form=1).heights) == pytest.approx(1.7, rel=0.05)


def test_long_gaps_part_the_profile_and_that_is_said() -> None:
    heights = np.sin(PLACE / 9.0)
    heights[1000:1200] = np.nan
    found = clean(road(heights), longest_gap=5.0)
    assert (found.first, found.last) == (1200, 4000)
    assert dict(found.removed)["Left out"] == "60 mm of 200 mm, since there are 1 gaps are longer than 5 mm"
    assert clean(road(heights), longest_gap=10.0).bridged.sum() == 200
    heights[::3] = heights[1::3] = np.nan
    with pytest.raises(InvalidInput, match=r"no stretch of 64 heights without a gap longer than 0\.06 mm"):
        clean(road(heights), longest_gap=0.06)
