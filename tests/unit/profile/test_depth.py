"""Mean profile depth of profiles whose depth is known."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.profile.depth import low_passed, mean_profile_depth

SPACING = 0.1
PLACE = SPACING * np.arange(3000)


@pytest.mark.parametrize("tilt", [0.0, 0.02])
def test_depth_is_the_mean_of_the_peaks_of_two_halves_over_the_mean(tilt: float) -> None:
    # Two peaks a segment, of 1 and 2 mm in its halves, as broad parabolas; then the halves of 100 mm average 1.5 mm.
    within = PLACE % 50.0 - 25.0
    peaks = np.where((PLACE // 50.0) % 2, 2.0, 1.0) * np.clip(1.0 - (within / 10.0) ** 2, 0.0, None)
    found = mean_profile_depth(peaks + tilt * PLACE, SPACING)
    part = peaks[:1000]
    level = part - np.polyval(np.polyfit(PLACE[:1000], part, 1), PLACE[:1000])
    known = 0.5 * (level[:500].max() + level[500:].max())
    assert found.segments == pytest.approx([known] * 3, rel=0.01)
    assert found.mean == pytest.approx(1.1, abs=0.01)  # 1.5 mm less the mean of the parabolas, 0.4 mm
    assert found.scatter < 0.01


def test_a_sine_has_its_amplitude_and_short_waves_are_filtered_out() -> None:
    for wavelength in (20.0, 10.0, 5.0):
        gain = 1.0 / np.sqrt(1.0 + (2.4 / wavelength) ** 4)
        heights = np.cos(2.0 * np.pi * PLACE / wavelength)
        assert mean_profile_depth(heights, SPACING).mean == pytest.approx(gain, rel=0.01)
    # -3 dB at 2.4 mm.
    short = low_passed(np.cos(2.0 * np.pi * PLACE / 2.4), SPACING)[200:-200]
    assert np.abs(short).max() == pytest.approx(np.sqrt(0.5), rel=0.01)


def test_segments_that_are_bridged_or_missing_have_no_depth() -> None:
    heights = np.cos(2.0 * np.pi * PLACE / 20.0)
    bridged = np.zeros(3000, dtype=bool)
    bridged[1000:1110] = True
    found = mean_profile_depth(heights, SPACING, bridged)
    assert np.isnan(found.segments).tolist() == [False, True, False]
    assert found.mean == pytest.approx(1.0, rel=0.01)
    assert len(mean_profile_depth(heights[:999], SPACING).segments) == 0
