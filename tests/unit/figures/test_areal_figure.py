from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.areal import draw


def result(velocity: float, pressure: float, share: float) -> xr.Dataset:
    heights = np.add.outer(np.sin(np.arange(8.0)), np.cos(np.arange(16.0)))
    load = np.where(heights >= np.quantile(heights, 1.0 - share), pressure / share, 0.0)
    scalars = {"friction_coefficient": 0.1 * velocity, "friction_error": 0.01, "contact_fraction": share}
    scalars |= {"persson_friction": 0.2, "persson_friction_reduced": 0.1, "persson_contact_fraction": 0.3}
    maps = {"road_height": (("y", "x"), heights), "contact_pressure": (("y", "x"), load)}
    axes = {"x": np.arange(16) / 16.0, "y": np.arange(8) / 16.0}
    return xr.Dataset(maps | scalars | axes, attrs={"velocity": velocity, "pressure": pressure})


def test_maps_have_one_scale_and_curves_are_the_results_in_the_order_of_speeds() -> None:
    slow, fast = result(1.0, 0.3, 0.4), result(2.0, 0.3, 0.1)
    figure = draw([slow, fast], [[fast, slow]])
    upper, lower = figure.subfigs
    shown = [axes for axes in upper.axes if axes.get_title()]
    assert [axes.get_title().split("\n")[0] for axes in shown] == ["1 mm/s, 0.3 MPa", "2 mm/s, 0.3 MPa"]
    images = [axes.images[-1] for axes in shown]
    assert images[0].get_clim() == images[1].get_clim()
    assert np.ma.count(images[0].get_array()) == np.count_nonzero(slow.contact_pressure)
    friction, contact = (axes.containers[0].lines[0] for axes in lower.axes)
    np.testing.assert_allclose(np.asarray(friction.get_xydata(), dtype=float), [[1.0, 0.1], [2.0, 0.2]])
    np.testing.assert_allclose(np.asarray(contact.get_ydata(), dtype=float), [0.4, 0.1])


def test_figure_of_nothing_is_refused() -> None:
    with pytest.raises(InvalidInput, match="at least one result for a map"):
        draw([], [[]])
