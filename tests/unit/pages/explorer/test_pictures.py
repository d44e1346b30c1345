"""Pictures of blocks, thinned and packed."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.deformation import deform
from rubfric.pages.explorer.pictures import STEPS, Picture, Store, picture, stretch

ResultMaker = Callable[..., xr.Dataset]


def unpacked(text: str) -> np.ndarray:
    """Return the numbers, as the browser has them."""
    high, low = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).reshape(2, -1).astype(np.int64)
    return np.cumsum(256 * high + low) % 2**16


def opened(about: dict[str, Any], values: np.ndarray) -> dict[str, np.ndarray]:
    """Return the parts of a picture in their units."""
    nodes, lines, touching = about["rows"] * about["columns"], sum(about["net"]), about["touching"]
    parts = {
        "x": nodes,
        "net_x": lines,
        "y": nodes,
        "net_y": lines,
        "energy": nodes,
        "touching": touching,
        "load": touching,
    }
    spans = {"net_x": "x", "net_y": "y", "touching": "x", "load": "pressure"}
    found, begin = {}, 0
    for name, size in parts.items():
        low, high = about[spans.get(name, name)]
        found[name] = low + (high - low) * values[begin : begin + size] / STEPS
        begin += size
    assert begin == values.size
    return found


@pytest.mark.parametrize("finite", [True, False])
def test_picture_is_the_deformed_block(make_result: ResultMaker, finite: bool) -> None:
    result = make_result(finite=finite)
    made = picture(result, 100, 100)
    found, block = opened(made.about, made.values), deform(result, *stretch(result))
    shape, width = (made.about["rows"], made.about["columns"]), 2.0 * np.pi / 35.0
    assert shape == block.x.shape
    assert made.about["finite"] is finite
    assert bool(made.about["net"]) is finite
    for name, field in (("x", block.x), ("y", block.y), ("energy", np.log10(block.density))):
        assert np.abs(found[name].reshape(shape) - field).max() <= (np.ptp(field) + 1e-12) / STEPS
    left, right = stretch(result)
    assert right - left == pytest.approx(1.25 * width)
    assert found["x"].min() <= left < right <= found["x"].max()


def test_contact_is_where_the_result_has_it(make_result: ResultMaker) -> None:
    result = make_result(touching=0.3)
    made = picture(result, 100, 100)
    found = opened(made.about, made.values)
    load, width = result["contact_pressure"].values, 2.0 * np.pi / 35.0
    assert found["load"].max() == load.max()
    assert np.count_nonzero(found["load"]) == np.count_nonzero(load)
    assert found["load"][0] == found["load"][-1] == 0.0
    on = found["touching"][found["load"] > 0.0]
    assert 0.1 * width <= on.min() < on.max() <= 0.4 * width


def test_thinned_picture_keeps_the_ends_and_the_largest_pressure(make_result: ResultMaker) -> None:
    result = make_result()
    whole, thin = (opened(made.about, made.values) for made in (picture(result, 100, 100), picture(result, 4, 8)))
    small = picture(result, 4, 8)
    assert (small.about["rows"], small.about["columns"]) == (4, 10)
    assert thin["load"].max() == whole["load"].max()
    for name in ("x", "y"):
        assert [thin[name].min(), thin[name].max()] == pytest.approx([whole[name].min(), whole[name].max()], abs=2e-3)


def test_many_pictures_come_back_from_one_text(make_result: ResultMaker) -> None:
    made = [picture(make_result(pressure=pressure), 10, 20) for pressure in (0.5, 1.0, 5.0)]
    store = Store()
    about = [store.add(one) for one in made]
    values = unpacked(store.packed())
    for one, one_about in zip(made, about, strict=True):
        assert np.array_equal(values[one_about["begin"] : one_about["begin"] + one.values.size], one.values)


def test_jumps_of_any_size_survive_packing(rng: np.random.Generator) -> None:
    values = rng.integers(0, 2**16, 5000).astype(np.uint16)
    store = Store()
    store.add(Picture({}, values))
    assert np.array_equal(unpacked(store.packed()), values)
    assert Store().packed() == base64.b64encode(zlib.compress(b"", 9)).decode()


def test_block_without_strain_has_a_picture(make_result: ResultMaker) -> None:
    result = make_result()
    result["strain_energy_density"] = 0.0 * result["strain_energy_density"]
    result["contact_pressure"] = 0.0 * result["contact_pressure"]
    made = picture(result, 10, 20)
    assert np.isfinite(made.about["energy"]).all()
    assert made.about["touching"] == 0


def test_result_that_lacks_something_is_refused(make_result: ResultMaker) -> None:
    with pytest.raises(InvalidInput, match=r"the result made up lacks displacement_x, contact_pressure"):
        picture(make_result().drop_vars(["contact_pressure", "displacement_x"]), 10, 20)


def test_picture_of_the_whole_road_is_a_period_with_more_columns(make_whole_result: ResultMaker) -> None:
    result = make_whole_result()
    period = float(np.ptp(result["mesh_node_x"].values))
    assert stretch(result) == (0.0, period)
    made = picture(result, 100, 8)
    found = opened(made.about, made.values)
    assert made.about["columns"] == 48
    assert found["x"].min() <= 0.0 < period <= found["x"].max()
    load = result["contact_pressure"].values > 0.0
    spots = np.count_nonzero(load & ~np.roll(load, 1))
    on = found["load"] > 0.0
    assert spots > 1
    assert np.count_nonzero(on[1:] & ~on[:-1]) + int(on[0]) >= spots
