"""The page of an areal road holds its maps, numbers and table, and needs nothing else."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.pages.areal import areal_page, maps

Y, X = np.mgrid[0:32, 0:64]


def result(velocity: float, nodes: int = 1) -> xr.Dataset:
    """Return a result of which the left is touched, at twice the nominal pressure, on finer nodes if asked for."""
    pressure = np.where(X < 32, 0.6 * velocity, 0.0).repeat(nodes, 0).repeat(nodes, 1)
    fields = {"road_height": 0.1 * Y + 0.0 * X, "contact_pressure": pressure}
    fields["road_height"] = fields["road_height"].repeat(nodes, 0).repeat(nodes, 1)
    axes = {"x": np.arange(64 * nodes) / (32.0 * nodes), "y": np.arange(32 * nodes) / (32.0 * nodes)}
    variables = {name: (("y", "x"), field) for name, field in fields.items()}
    about = {"velocity": velocity, "pressure": 0.3, "direction": 0.0, "rubber": "black"}
    return xr.Dataset(variables | axes | {"rms_height": 0.01, "rms_slope": 0.2}, attrs=about)


TABLE = pd.DataFrame(
    {
        "velocity_mm_per_s": [1.0, 10.0],
        "pressure_MPa": 0.3,
        "friction_coefficient": [0.1, 0.2],
        "friction_error": 0.01,
        "plane_over_surface": [0.9, 1.1],
        "plane_over_surface_error": 0.05,
        "contact_fraction": 0.5,
        "note": ["", "profile 3: <refused>"],
    }
)


def test_maps_are_the_fields_on_one_scale() -> None:
    held = maps([result(1.0), result(10.0, 2)], TABLE, (2.0, 1.0))
    assert held["shape"] == [32, 64]
    heights = np.frombuffer(base64.b64decode(held["heights"]), np.uint8).reshape(held["shape"])
    np.testing.assert_array_equal(heights[:, 0], np.rint(255.0 * np.arange(32) / 31))
    slow, fast = (np.frombuffer(base64.b64decode(one["pressure"]), np.uint8).reshape(32, 64) for one in held["scenes"])
    assert held["scale"] == [0.3, pytest.approx(6.0)]
    assert (slow[:, 32:] == 0).all()
    assert (slow[:, :32] == 1 + round(254 * np.log(2.0) / np.log(20.0))).all()
    assert (fast[:, :32] == 255).all()
    assert held["scenes"][1]["numbers"]["friction_coefficient"] == 0.2


def test_page_needs_nothing_else_and_says_how_far_the_plane_is_off() -> None:
    page = areal_page([result(1.0), result(10.0)], TABLE, "runway")
    assert "0.90 ± 0.05 (1 mm/s, 0.3 MPa) to 1.10 ± 0.05 (10 mm/s, 0.3 MPa) times that of the surface" in page
    assert "profile 3: &lt;refused&gt;" in page
    assert not re.search(r"(src|href)=|https?:", page)
    held = json.loads(re.findall(r'<script type="application/json" id="maps">(.*?)</script>', page, re.DOTALL)[0])
    assert held["periods"] == [2.0, 1.0]
