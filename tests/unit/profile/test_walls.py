from __future__ import annotations

import numpy as np
import pytest

from rubfric.profile.walls import walls


def test_jumps_are_walls_and_noise_slopes_and_bridges_are_not() -> None:
    rng = np.random.default_rng(5)
    x = 0.05 * np.arange(4000)
    heights = 0.5 * np.sin(x) + 1e-3 * rng.standard_normal(len(x))
    bridged = np.zeros(len(x), dtype=bool)
    assert walls(heights, 0.05, bridged).count == 0
    # Up by 2 mm at once, down by 1.5 mm over three heights; another jump is a bridge's end.
    heights[1000:] += 2.0
    heights[2000:] -= 0.5
    heights[2001:] -= 0.5
    heights[2002:] -= 0.5
    heights[3000:] += 1.0
    bridged[3000:3010] = True
    found = walls(heights, 0.05, bridged)
    assert (found.count, found.highest) == (2, pytest.approx(2.0, abs=0.06))
    steps = np.diff(heights)
    steps[2999] = 0.0
    places = [999, 1999, 2000, 2001]
    assert found.share == pytest.approx((steps[places] ** 2).sum() / (steps**2).sum(), rel=0.05)
    # Closely spaced heights are steep by noise alone.
    assert walls(1e-3 * rng.standard_normal(900), 2e-4, bridged[:900]).count == 0
