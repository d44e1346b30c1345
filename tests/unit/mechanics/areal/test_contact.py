"""Contact in the plane, against a dense system pivoted node by node; splitting where pivots cycle; refusals."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.arrays import Complex, Real
from rubfric.errors import NotConverged
from rubfric.mechanics.areal import contact as contact_module
from rubfric.mechanics.areal import pivoting
from rubfric.mechanics.areal.compliance import ArealCompliance
from rubfric.mechanics.areal.contact import ArealContact, solve_contact
from rubfric.mechanics.areal.splitting import Splitting
from rubfric.mechanics.areal.surface import TOLERANCE, ArealSurface
from rubfric.mechanics.block.contact import even_contact, follow
from rubfric.road.self_affine import SelfAffine
from rubfric.rubber.material import Material

SHAPE = (12, 16)
ROAD = SelfAffine(0.8, 1.0, 0.25, rms_slope=0.25).spectrum


class Dense:
    """The same surface as a matrix, written with the sum over waves."""

    def __init__(self, compliance: Complex, shape: tuple[int, int]) -> None:
        ny, nx = shape
        row, column = np.meshgrid(np.arange(ny), np.arange(nx), indexing="ij")
        n, m = np.meshgrid(np.arange(ny), np.arange(nx // 2 + 1), indexing="ij")
        weight = np.where((m == 0) | (2 * m == nx), 1.0, 2.0) / (ny * nx)
        kernel = np.zeros(shape)
        for share, wave, ky, kx in zip(*(part.ravel() for part in (weight, compliance, n, m)), strict=True):
            if ky or kx:
                kernel += share * (wave * np.exp(2j * np.pi * (ky * row / ny + kx * column / nx))).real
        place = np.stack((row.ravel(), column.ravel()))
        away = place[:, :, None] - place[:, None, :]
        self.full = kernel[away[0] % ny, away[1] % nx]

    def matrix(self, inside: Real) -> Real:
        return self.full[np.ix_(inside, inside)]

    def deflection(self, pressure: Real) -> Real:
        return self.full @ pressure

    def pressing(self, deflection: Real) -> Real:
        return np.linalg.pinv(self.full) @ deflection


def surface_of(rubber: Material, velocity: float, shape: tuple[int, int] = SHAPE) -> ArealSurface:
    return ArealCompliance(rubber, velocity, 20.0, 0.75, (1.0, 1.0), shape).surface(shape)


@pytest.mark.parametrize(("velocity", "pressure"), [(10.0, 0.3), (1000.0, 2.0), (1000.0, 10.0)])
def test_contact_is_that_of_a_dense_system_pivoted_exactly(
    paper_rubber: Material, velocity: float, pressure: float
) -> None:
    surface, profile = surface_of(paper_rubber, velocity), ROAD.heights(SHAPE)
    dense = Dense(surface.compliance, SHAPE)
    start = even_contact(profile.ravel() >= np.median(profile), pressure)
    expected = follow(dense, profile.ravel(), pressure, start)
    found = solve_contact(surface, profile, pressure)
    largest = expected.pressure.max()
    assert 0.0 < expected.touching.mean() < 1.0
    np.testing.assert_allclose(found.pressure.ravel(), expected.pressure, atol=1e-6 * largest)
    np.testing.assert_allclose(found.gap.ravel(), expected.gap, atol=1e-6 * np.ptp(profile))
    assert found.pressure.mean() == pytest.approx(pressure, rel=1e-12)
    assert found.offset == pytest.approx(expected.offset, abs=1e-6 * np.ptp(profile))
    # From a contact nearby, by pivots, to the same.
    near = solve_contact(surface, 1.1 * profile, pressure)
    again = solve_contact(surface, profile, pressure, near)
    assert again.splittings == near.splittings
    np.testing.assert_allclose(again.pressure, found.pressure, atol=1e-6 * largest)


def test_splitting_alone_solves_rubber_far_softer_along_ridges() -> None:
    """Pivots tend to cycle where waves along y, which do not move, are 1e6 times softer than all others."""
    rubber = Material("r", 4.0, 0.0, (1.0 - 1e-6,), (1e3,))
    shape, load = (32, 32), 5e4
    surface, profile = surface_of(rubber, 1e4, shape), ROAD.heights(shape)
    splitting = Splitting(surface, profile, load)
    assert splitting.run(20_000)
    assert splitting.residual <= TOLERANCE
    uniform = ArealContact(np.full(shape, load), np.zeros(shape), 0.0)
    found = solve_contact(surface, profile, load, uniform)
    assert 0.02 < found.fraction < 0.98
    np.testing.assert_allclose(found.pressure, splitting.pressure, atol=1e-5 * found.pressure.max())


def test_full_contact_takes_no_steps(paper_rubber: Material) -> None:
    surface, profile = surface_of(paper_rubber, 1.0), ROAD.heights(SHAPE)
    found = solve_contact(surface, profile, 50.0)
    assert (found.pivots, found.splittings, found.fraction) == (0, 0, 1.0)
    np.testing.assert_allclose(surface.deflection(found.pressure), profile - profile.mean(), atol=1e-12)


def test_surface_that_does_not_converge_is_refused(paper_rubber: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pivoting, "MOST_PIVOTS", 1)
    monkeypatch.setattr(contact_module, "_FIRST_TURN", 4)
    monkeypatch.setattr(contact_module, "_TURNS", 2)
    with pytest.raises(NotConverged, match=r"^spot: not converged after 12 steps, .*a higher pressure"):
        solve_contact(surface_of(paper_rubber, 1000.0), ROAD.heights(SHAPE), 2.0, label="spot")


@pytest.mark.parametrize("seed", range(12))
def test_contact_of_rubbers_at_random_is_balanced_to_the_tolerance(seed: int) -> None:
    """Up to seven branches, ratios of the moduli up to 1e6, loads from spots to nearly full contact."""
    draw = np.random.default_rng(seed)
    branches = int(draw.integers(1, 8))
    weights = 10.0 ** draw.uniform(-6.0, 0.0, branches)
    share = float(draw.choice([0.3, 0.9, 0.999, 1.0 - 1e-6]))
    times = 10.0 ** draw.uniform(-8.0, 2.0, branches)
    rubber = Material("r", 4.0, float(draw.choice([0.0, 0.4999])), tuple(share * weights / weights.sum()), tuple(times))
    velocity = 10.0 ** draw.uniform(-1.0, 4.0)
    pressure = float(np.abs(rubber.plane_modulus(25.0 * velocity, "strain"))) * 0.1 * 10.0 ** draw.uniform(-2.0, 0.0)
    shape = (32, 32)
    surface, profile = surface_of(rubber, velocity, shape), ROAD.heights(shape)
    found = solve_contact(surface, profile, pressure)
    # Gaps in the unit in which they weigh as much as the pressures: where either is zero, as it should be.
    gap = surface.deflection(found.pressure) + found.offset - profile
    step = np.linalg.norm(found.pressure) / np.linalg.norm(np.maximum(gap, 0.0))
    moved = np.maximum(found.pressure - step * gap, 0.0)
    assert np.linalg.norm(moved - found.pressure) < 1e-5 * np.linalg.norm(found.pressure)
    assert found.pressure.mean() == pytest.approx(pressure, rel=1e-12)
    assert (found.pressure >= 0.0).all()
