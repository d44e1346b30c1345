from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.deformation import deform, wavelength

Maker = Callable[..., xr.Dataset]


def road(x: np.ndarray) -> np.ndarray:
    return 0.015 * np.sin(2.0 * np.pi * x / 0.2)


def test_wavelength_is_the_width_of_the_mesh(make_result: Maker) -> None:
    assert wavelength(make_result()) == pytest.approx(0.2, rel=1e-12)


@pytest.mark.parametrize("kinematics", ["small", "finite"])
@pytest.mark.parametrize("pressure", [0.1, 1.0, 5.0])
def test_lower_face_stays_on_the_road_whatever_the_pressure(
    make_result: Maker, pressure: float, kinematics: str
) -> None:
    x, y = deform(make_result(pressure, kinematics=kinematics), -0.1, 0.3).lower_face
    np.testing.assert_allclose(y, road(x), atol=1e-12)


@pytest.mark.parametrize(("kinematics", "shear"), [("small", 0.0), ("finite", 0.3), ("finite", 2.5), ("finite", -1.5)])
@pytest.mark.parametrize(("left", "right"), [(-0.1, 0.3), (0.0, 0.2), (0.05, 0.1), (-0.5, -0.25)])
def test_copies_cover_the_window_without_a_seam(
    make_result: Maker, left: float, right: float, kinematics: str, shear: float
) -> None:
    block = deform(make_result(kinematics=kinematics, shear=shear), left, right)
    np.testing.assert_allclose(np.diff(block.x, axis=1), 0.2 / 16, rtol=1e-9)
    # At every height, and with no more than is seen at some height.
    assert block.x[:, 0].max() < left
    assert block.x[:, -1].min() > right
    assert block.x[:, 2].max() > left
    assert block.x[:, -3].min() < right
    assert block.x.shape == block.y.shape == block.density.shape


def test_finite_strain_shows_displacements_as_they_are(make_result: Maker) -> None:
    result = make_result(5.0, kinematics="finite", shear=1.5)
    block = deform(result, 0.0, 0.2)
    x = (result["mesh_node_x"] + result["displacement_x"]).values.reshape(6, 17)
    y = (result["mesh_node_y"] + result["displacement_y"]).values.reshape(6, 17)
    density = result["strain_energy_density"].values.reshape(6, 17)
    # Node 3 of the mesh stands a wavelength apart in every copy, and the copies have one period.
    found = np.flatnonzero(np.isclose((block.x[0] - x[0, 3]) % 0.2, 0.0, atol=1e-9))
    assert found.size >= 2
    for column in found:
        np.testing.assert_allclose(block.x[:, column] - block.x[0, column], x[:, 3] - x[0, 3], atol=1e-12)
        np.testing.assert_allclose(block.y[:, column], y[:, 3], atol=1e-12)
        np.testing.assert_array_equal(block.density[:, column], density[:, 3])


@pytest.mark.parametrize("pressure", [0.5, 5.0])
def test_mean_compression_shows_in_finite_strain_only(make_result: Maker, pressure: float) -> None:
    # A block 0.15 mm high.
    heights = {
        kinematics: deform(make_result(pressure, kinematics=kinematics), 0.0, 0.2).upper_face[1].mean()
        for kinematics in ("small", "finite")
    }
    assert heights["small"] == pytest.approx(0.15, rel=1e-3)
    assert heights["finite"] == pytest.approx(0.15 / (1.0 + 0.18 * pressure), rel=1e-3)


def test_horizontal_displacements_are_left_out_in_small_strain(make_result: Maker) -> None:
    result = make_result()
    result["displacement_x"] = 0.01 + 0.0 * result["displacement_x"]
    block = deform(result, 0.0, 0.2)
    np.testing.assert_allclose(block.x, np.broadcast_to(np.arange(-1, 18) * 0.2 / 16, (6, 19)), atol=1e-12)


def test_low_block_ends_where_its_upper_face_is(make_result: Maker) -> None:
    block = deform(make_result(aspect=0.25), 0.0, 0.2)
    # 0.05 mm high, give or take what the road still lifts there.
    assert block.upper_face[1].max() == pytest.approx(0.05, abs=0.004)


def test_net_was_of_squares(make_result: Maker) -> None:
    result = make_result(kinematics="finite", shear=0.0)
    for name in ("displacement_x", "displacement_y"):
        result[name] = 0.0 * result[name]
    net = deform(result, 0.0, 0.2).net
    upright = [line for line in net if np.ptp(line[0]) < 1e-12]
    level = [line for line in net if np.ptp(line[1]) < 1e-12]
    assert len(upright) + len(level) == len(net)
    np.testing.assert_allclose([line[0, 0] for line in upright], 0.025 * np.arange(9), atol=1e-12)
    # Not along the faces of a block 0.15 mm high.
    np.testing.assert_allclose([line[1, 0] for line in level], 0.025 * np.arange(1, 6), atol=1e-12)


def test_net_follows_the_nodes(make_result: Maker) -> None:
    block = deform(make_result(2.0, kinematics="finite", shear=0.8), 0.0, 0.2)
    upright = [line for line in block.net if line.shape[1] == 6]
    for line in upright:
        column = int(np.argmin(np.abs(block.x[0] - line[0, 0])))
        np.testing.assert_allclose(line, [block.x[:, column], block.y[:, column]], atol=1e-12)
    assert len(upright) >= 8


def test_small_strain_has_no_net(make_result: Maker) -> None:
    assert deform(make_result(), 0.0, 0.2).net == ()


def test_order_of_the_nodes_does_not_matter(make_result: Maker, rng: np.random.Generator) -> None:
    result = make_result(kinematics="finite")
    shuffled = result.isel(node=rng.permutation(result.sizes["node"]))
    one, other = deform(shuffled, 0.0, 0.2), deform(result, 0.0, 0.2)
    for name in ("x", "y", "density"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_mesh_without_rows_is_refused(make_result: Maker) -> None:
    result = make_result()
    with pytest.raises(InvalidInput, match=r"^the mesh of 101 nodes cannot be drawn, but must be made of rows and"):
        deform(result.isel(node=slice(1, None)), 0.0, 0.2)
