from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from rubfric.figures.peaks import mark_peak, peak, peak_handles, rings

NAN = float("nan")


@pytest.mark.parametrize(
    ("values", "place"),
    [
        ([0.0, 1.0, 0.5], 1),
        ([0.0, 0.2, 0.9, 0.1], 2),
        ([NAN, 0.2, NAN, 0.9, 0.1], 3),
        ([0.0, 1.0, 2.0], None),
        ([2.0, 1.0, 0.0], None),
        ([0.0, 1.0, NAN], None),
        ([0.0, 0.0, 0.0], None),
        ([1.0, 0.0, 1.0], None),
        ([1.0], None),
        ([NAN, NAN, NAN], None),
    ],
)
def test_only_a_maximum_between_others_is_a_peak(values: list[float], place: int | None) -> None:
    assert peak(np.array(values)) == place


def test_ring_is_at_the_peak_and_in_the_legend() -> None:
    axes = Figure().subplots()
    mark_peak(axes, np.array([1.0, 10.0, 100.0]), np.array([0.1, 0.4, 0.2]), "red")
    (ring,) = rings(axes)
    assert (ring.get_xdata()[0], ring.get_ydata()[0]) == (10.0, 0.4)
    assert [handle.get_label() for handle in peak_handles(axes)] == ["sampled peak"]
