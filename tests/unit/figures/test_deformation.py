from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures.deformation import deform, wavelength

HEIGHTS = np.linspace(-0.03, 0.1, 14)


def test_wavelength_is_the_width_of_the_mesh(make_result: Callable[..., xr.Dataset]) -> None:
    assert wavelength(make_result()) == pytest.approx(0.2, rel=1e-12)


@pytest.mark.parametrize("pressure", [0.1, 1.0, 5.0])
def test_lower_face_stays_on_the_road_whatever_the_pressure(
    make_result: Callable[..., xr.Dataset], pressure: float
) -> None:
    block = deform(make_result(pressure), -0.1, 0.3, HEIGHTS)
    x, y = block.lower_face
    np.testing.assert_allclose(y, 0.015 * np.sin(2.0 * np.pi * x / 0.2), atol=1e-12)


@pytest.mark.parametrize(("left", "right"), [(-0.1, 0.3), (0.0, 0.2), (0.05, 0.1), (-0.5, -0.25)])
def test_copies_cover_the_window_without_a_seam(
    make_result: Callable[..., xr.Dataset], left: float, right: float
) -> None:
    block = deform(make_result(), left, right, HEIGHTS)
    x, _ = block.lower_face
    step = 0.2 / 16
    np.testing.assert_allclose(np.diff(x), step, rtol=1e-9)
    assert block.extent[0] < left + step
    assert block.extent[1] > right - step
    # Pixels are centred on the nodes.
    assert block.extent[0] == pytest.approx(x[0] - 0.5 * step)
    assert block.density.shape == (HEIGHTS.size, x.size)


def test_mean_compression_is_left_out(make_result: Callable[..., xr.Dataset]) -> None:
    # Without it the upper face of a block 0.15 mm high lies where it was, however high the load.
    for pressure in (0.5, 5.0):
        block = deform(make_result(pressure), 0.0, 0.2, HEIGHTS)
        upper = block.outline[block.lower_face.shape[1] :, 1]
        assert upper.mean() == pytest.approx(0.15, rel=1e-9)


def test_low_block_ends_where_its_upper_face_is(make_result: Callable[..., xr.Dataset]) -> None:
    block = deform(make_result(aspect=0.25), 0.0, 0.2, HEIGHTS)
    # 0.05 mm high, give or take what the road still lifts there.
    assert block.outline[:, 1].max() == pytest.approx(0.05, abs=0.004)


def test_field_is_that_of_the_nodes(make_result: Callable[..., xr.Dataset]) -> None:
    result = make_result(aspect=0.5)
    # A density of ten times the height, which the image must keep between the rows of nodes too.
    result["strain_energy_density"] = result["mesh_node_y"] * 10.0
    result["displacement_y"] = 0.0 * result["displacement_y"]
    block = deform(result, 0.0, 0.2, np.linspace(0.0, 0.1, 11))
    np.testing.assert_allclose(block.density, np.tile(np.linspace(0.0, 1.0, 11)[:, None], 16), atol=1e-12)


def test_order_of_the_nodes_does_not_matter(make_result: Callable[..., xr.Dataset], rng: np.random.Generator) -> None:
    result = make_result()
    shuffled = result.isel(node=rng.permutation(result.sizes["node"]))
    np.testing.assert_array_equal(
        deform(shuffled, 0.0, 0.2, HEIGHTS).density, deform(result, 0.0, 0.2, HEIGHTS).density
    )


def test_mesh_without_rows_is_refused(make_result: Callable[..., xr.Dataset]) -> None:
    result = make_result()
    with pytest.raises(InvalidInput, match=r"^the mesh of 101 nodes cannot be drawn, but must be made of rows and"):
        deform(result.isel(node=slice(1, None)), 0.0, 0.2, HEIGHTS)
