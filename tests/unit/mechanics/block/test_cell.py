"""Four-node cells: integrals known in closed form, and fields that they represent exactly."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.mechanics.block.cell import cell_products, cell_quadrature, dilatation_product, strain_product

HEIGHTS = np.array([0.25, 1.0, 3.0])
# Nodes left low, right low, left high, right high.
X, Y = np.array([0.0, 1.0, 0.0, 1.0]), np.array([0.0, 0.0, 1.0, 1.0])


def test_products_of_the_unit_square_are_the_textbook_ones() -> None:
    products = cell_products(np.ones(1))
    along = np.array([[2, -2, 1, -1], [-2, 2, -1, 1], [1, -1, 2, -2], [-1, 1, -2, 2]]) / 6.0
    np.testing.assert_allclose(products.full[0, 0, 0], along, atol=1e-15)
    gradient = np.array([[-1, 1, -1, 1], [-1, -1, 1, 1]]) / 2.0
    np.testing.assert_allclose(products.mean[:, :, 0], np.einsum("ai,bj->abij", gradient, gradient), atol=1e-15)


def test_products_scale_with_the_height() -> None:
    products = cell_products(HEIGHTS)
    for form in (products.full, products.mean):
        np.testing.assert_allclose(form[0, 0] / HEIGHTS[:, None, None], form[0, 0, 1] + 0.0 * form[0, 0], atol=1e-15)
        np.testing.assert_allclose(form[1, 1] * HEIGHTS[:, None, None], form[1, 1, 1] + 0.0 * form[1, 1], atol=1e-15)


@pytest.mark.parametrize("mean", [False, True])
def test_energies_of_uniform_strain(mean: bool) -> None:
    """u = (a x + b y, c x + d y): eps : eps = a² + d² + (b + c)² / 2 and tr = a + d, times the area."""
    a, b, c, d = 0.3, -0.7, 0.2, 0.5
    products = cell_products(HEIGHTS)
    form = products.mean if mean else products.full
    for row, height in enumerate(HEIGHTS):
        u = np.stack((a * X + b * Y * height, c * X + d * Y * height), axis=1)
        squared = np.einsum("ia,iajb,jb->", u, strain_product(form)[row], u)
        assert squared == pytest.approx(height * (a * a + d * d + 0.5 * (b + c) ** 2), rel=1e-13)
        volume = np.einsum("ia,iajb,jb->", u, dilatation_product(form)[row], u)
        assert volume == pytest.approx(height * (a + d) ** 2, rel=1e-13)


def test_mean_dilatation_does_not_see_bending() -> None:
    """A cell bent by u_x = (x - 1/2)(y - 1/2) has dilatation at its points, but none on average."""
    u = np.stack(((X - 0.5) * (Y - 0.5), np.zeros(4)), axis=1)
    products = cell_products(np.ones(1))
    assert np.einsum("ia,iajb,jb->", u, dilatation_product(products.full)[0], u) == pytest.approx(1.0 / 12.0)
    assert np.einsum("ia,iajb,jb->", u, dilatation_product(products.mean)[0], u) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("centred", [False, True])
def test_quadrature_has_the_area_and_the_strains_of_linear_fields(centred: bool) -> None:
    quadrature = cell_quadrature(0.5, HEIGHTS, centred)
    assert quadrature.weights.shape == (3, 2 if centred else 4)
    np.testing.assert_allclose(quadrature.weights.sum(axis=1), 0.5 * HEIGHTS, rtol=1e-14)
    np.testing.assert_allclose(quadrature.shapes.sum(axis=1), 1.0, rtol=1e-14)
    for row, height in enumerate(HEIGHTS):
        u = np.stack((0.3 * 0.5 * X - 0.7 * height * Y, 0.2 * 0.5 * X + 0.5 * height * Y), axis=1).ravel()
        strains = quadrature.strain_matrix()[row] @ u
        np.testing.assert_allclose(strains, np.broadcast_to([0.3, 0.5, -0.25], strains.shape), rtol=1e-13)
