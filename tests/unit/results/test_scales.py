"""The friction of a road from that of its scales: all of them, or unknown."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from rubfric.results.scales import total_error, total_friction


def friction(values: list[list[float]]) -> xr.DataArray:
    """Return friction over scale and velocity."""
    array = np.array(values)
    coordinates = {"scale": np.arange(1, len(array) + 1), "velocity": 10.0 ** np.arange(array.shape[1])}
    return xr.DataArray(array, coordinates, ("scale", "velocity"), attrs={"units": "1", "long_name": "one scale"})


def test_total_is_the_sum_over_scales() -> None:
    total = total_friction(friction([[0.1, 0.2], [0.3, 0.05]]))
    assert total.dims == ("velocity",)
    assert total.values == pytest.approx([0.4, 0.25])
    assert total.attrs == {"units": "1", "long_name": "friction coefficient, sum over the scales"}


@pytest.mark.parametrize("missing", [[np.nan, 0.2], [0.2, np.nan], [np.nan, np.nan]])
def test_total_is_never_partial(missing: list[float]) -> None:
    total = total_friction(friction([[one, 0.1] for one in missing]))
    assert np.isnan(total.values[0])
    assert total.values[1] == pytest.approx(0.2)


def test_errors_of_scales_add_up_to_a_bound() -> None:
    total = total_error(friction([[0.01, 0.02], [0.03, 0.005]]))
    assert total.values == pytest.approx([0.04, 0.025])
    assert total.attrs["units"] == "1"
    assert "bound" in total.attrs["long_name"]


def test_unknown_error_of_a_scale_makes_the_bound_unknown() -> None:
    total = total_error(friction([[np.nan, 0.02], [0.03, 0.005]]))
    assert np.isnan(total.values[0])
    assert total.values[1] == pytest.approx(0.025)
