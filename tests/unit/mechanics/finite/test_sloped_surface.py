"""The surface of a deformed block on steep flanks: GMRES finds the pressures of the dense system."""

from __future__ import annotations

import numpy as np
import pytest
from finite_fields import WIDTH, coarse, flat
from numpy.typing import NDArray

from rubfric.mechanics.block import surface as surface_module
from rubfric.mechanics.block.contact import pivot
from rubfric.mechanics.block.surface import Equilibrium
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import SlopedSurface

Real = NDArray[np.float64]
COLUMNS = 256
X = WIDTH / COLUMNS * np.arange(COLUMNS)


class Counted(SlopedSurface):
    """A surface that counts how often C is applied."""

    applied = 0

    def deflection(self, pressure: Real) -> Real:
        self.applied += 1
        return super().deflection(pressure)


def rough() -> tuple[Real, Real]:
    """Return the height, mm, and the slope, up to 2, of a road of two waves."""
    wavenumber = 2.0 * np.pi / WIDTH
    height = 0.015 * np.sin(wavenumber * X) + 0.004 * np.sin(9.0 * wavenumber * X + 1.0)
    return height, wavenumber * (0.015 * np.cos(wavenumber * X) + 0.036 * np.cos(9.0 * wavenumber * X + 1.0))


def sloped(plane: str, slope: Real) -> Counted:
    finite = coarse(plane, columns=COLUMNS)
    fields = flat(finite, 1.0)
    circulant = Circulant(finite, finite.stiffness(fields, finite.stressed(fields)), 1.0)
    return Counted(circulant.compliance, slope, finite.block.column_width)


@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_level_surface_is_pressed_by_what_deflects_it(plane: str, rng: np.random.Generator) -> None:
    surface = sloped(plane, np.zeros(COLUMNS))
    smooth = np.cos(2.0 * np.pi * 60.0 / COLUMNS * np.arange(COLUMNS))  # so short a wave feels no top
    again = surface.pressing(surface.deflection(smooth))
    assert 0.5 < again @ smooth / (smooth @ smooth) < 2.0


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("load", [0.0, 2.0 * COLUMNS])
def test_gmres_finds_the_pressures_of_the_dense_system(
    plane: str, load: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    height, slope = rough()
    assert np.abs(slope).max() > 1.5
    surface, inside = sloped(plane, slope), np.flatnonzero(height > 0.0)
    found = []
    for dense in (np.inf, 0.0):
        monkeypatch.setattr(surface_module, "_DENSE", dense)
        surface.applied = 0
        found.append(Equilibrium(surface, COLUMNS, inside).solve(height[inside], load))
    assert 5 < surface.applied < 70
    np.testing.assert_allclose(found[1][0], found[0][0], atol=1e-10 * np.abs(found[0][0]).max())
    assert found[1][1] == pytest.approx(found[0][1], abs=1e-12)


@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_contact_is_the_same_with_gmres(plane: str, monkeypatch: pytest.MonkeyPatch) -> None:
    height, slope = rough()
    surface, found = sloped(plane, slope), []
    for dense in (np.inf, 0.0):
        monkeypatch.setattr(surface_module, "_DENSE", dense)
        found.append(pivot(surface, height, 1.0, height > 0.0))
    expected, other = found
    assert 40 < np.count_nonzero(expected.touching) < 200
    np.testing.assert_array_equal(other.touching, expected.touching)
    np.testing.assert_allclose(other.pressure, expected.pressure, atol=1e-10 * expected.pressure.max())
