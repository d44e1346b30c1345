"""What objects say of themselves: short, with units."""

from __future__ import annotations

import numpy as np
import pytest

import rubfric

CAMPAIGN = rubfric.load()


@pytest.mark.parametrize(
    ("shown", "parts"),
    [
        (CAMPAIGN, ("<Campaign: Rubber zhou2019", "4 scales, 0.1 to 10000 mm/s", "results in results>")),
        (
            CAMPAIGN.material,
            ("<Material zhou2019: long-term E ", " MPa, nu ", " Maxwell branches of ", " s, elastic bulk>"),
        ),
        (
            CAMPAIGN.scene(1, 100, 5),
            ("<Scene scale1_v100_p5_aspect0.75_stress: 100 mm/s, 5 MPa, rubber zhou2019", "0.015 mm"),
        ),
        (CAMPAIGN.whole_road, ("<WaveRoad: 4 waves of 0.1795 to 0.02094 mm, period 1.257 mm>",)),
        (CAMPAIGN.road[0], ("<SineScale: amplitude 0.015 mm, wavelength 0.1795 mm>",)),
        (rubfric.Numerics(refinements=0), ("Numerics(accuracy=0.01, refinements=0)",)),
        (rubfric.ScannedRoad(np.zeros((32, 64)), (0.1, 0.2)), ("<ScannedRoad: 64 x 32 heights, every 0.1 x 0.2 mm>",)),
        (rubfric.Material("solid", 1.0, 0.4, (), ()), ("<Material solid: long-term E 1 MPa, nu 0.4, elastic bulk>",)),
    ],
    ids=lambda value: type(value).__name__,
)
def test_objects_show_in_a_line_what_matters(shown: object, parts: tuple[str, ...]) -> None:
    text = repr(shown)
    assert all(part in text for part in parts), text
    assert len(text) < 320
