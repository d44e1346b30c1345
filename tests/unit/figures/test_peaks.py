from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from rubfric.figures.peaks import mark_peak, peak_handles, rings


def test_ring_is_at_the_peak_and_in_the_legend() -> None:
    axes = Figure().subplots()
    mark_peak(axes, np.array([1.0, 10.0, 100.0]), np.array([0.1, 0.4, 0.2]), "red")
    (ring,) = rings(axes)
    assert (ring.get_xdata()[0], ring.get_ydata()[0]) == (10.0, 0.4)
    assert [handle.get_label() for handle in peak_handles(axes)] == ["Sampled peak"]
