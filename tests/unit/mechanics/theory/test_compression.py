"""The block pressed on a flat road: balance, its limits for small loads, and loads beyond all reason."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.finite.law import YY, deform, stress, volumetric_energy, volumetric_stress
from rubfric.mechanics.theory.compression import pressed, pressing, stored_energy
from rubfric.rubber.material import Material

PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
LOADS = pytest.mark.parametrize("pressure", [1e-6, 0.1, 5.0, 50.0, 1e4])


def stresses(material: Material, stretch: float, thickness: float) -> np.ndarray:
    """Return P_xx, P_xy, P_yx, P_yy and C_zz S_zz of a relaxed block, MPa."""
    state = deform(np.array([1.0, 0.0, 0.0, stretch])[:, None], np.array([[np.log(thickness)]]))
    driving = np.zeros((4, 1))
    driving[[0, YY, 3]] = material.long_term_shear_modulus
    return stress(state, driving, volumetric_stress(material.long_term_bulk_modulus, state.volume)[0])[:, 0]


@PLANES
@LOADS
def test_pressed_block_carries_the_load(paper_rubber: Material, plane: str, pressure: float) -> None:
    found = stresses(paper_rubber, *pressed(paper_rubber, pressure, plane))
    assert found[3] == pytest.approx(-pressure, rel=1e-8, abs=1e-12 * paper_rubber.long_term_bulk_modulus)
    assert found[1] == found[2] == 0.0


@LOADS
def test_thickness_is_free_in_plane_stress(paper_rubber: Material, pressure: float) -> None:
    stretch, thickness = pressed(paper_rubber, pressure, "stress")
    found = stresses(paper_rubber, stretch, thickness)
    assert found[4] == pytest.approx(0.0, abs=1e-10 * max(pressure, paper_rubber.long_term_bulk_modulus))
    assert thickness > 1.0


@LOADS
def test_thickness_is_held_in_plane_strain(paper_rubber: Material, pressure: float) -> None:
    stretch, thickness = pressed(paper_rubber, pressure, "strain")
    assert 0.0 < stretch < 1.0
    assert thickness == 1.0


@PLANES
def test_small_loads_press_by_the_confined_modulus(paper_rubber: Material, plane: str) -> None:
    modulus = paper_rubber.confined_modulus(plane)
    shares = np.array([1e-3, 1e-4])
    compression = np.array([1.0 - pressed(paper_rubber, share * modulus, plane)[0] for share in shares])
    error = compression / shares - 1.0
    assert np.all(np.abs(error) < 2.0 * shares)
    assert error[0] == pytest.approx(10.0 * error[1], rel=0.01)  # first order


def test_thickness_follows_the_small_strain_ratio(paper_rubber: Material) -> None:
    stretch, thickness = pressed(paper_rubber, 1e-5, "stress")
    ratio = float(paper_rubber.thickness_ratio(0.0, "stress").real)
    assert (thickness - 1.0) / (stretch - 1.0) == pytest.approx(ratio, rel=1e-4)


@PLANES
def test_no_load_leaves_the_block_as_it_was_made(paper_rubber: Material, plane: str) -> None:
    assert pressed(paper_rubber, 0.0, plane) == pytest.approx((1.0, 1.0), abs=1e-12)


@PLANES
@pytest.mark.parametrize("pressure", [1e-300, 1e-12, 1e5, 1e8])
def test_tiny_and_huge_loads_have_an_answer(paper_rubber: Material, plane: str, pressure: float) -> None:
    stretch, thickness = pressed(paper_rubber, pressure, plane)
    assert 0.0 < stretch <= 1.0
    assert 0.0 < thickness < 10.0


@PLANES
def test_more_load_presses_more(paper_rubber: Material, plane: str) -> None:
    stretches = [pressed(paper_rubber, pressure, plane)[0] for pressure in np.logspace(-4, 6, 41)]
    assert np.all(np.diff(stretches) < 0.0)


@PLANES
@pytest.mark.parametrize("ratio", [-0.5, 0.0, 0.3, 0.49999])
def test_any_poissons_ratio_will_do(paper_rubber: Material, plane: str, ratio: float) -> None:
    rubber = replace(paper_rubber, poissons_ratio=ratio)
    found = stresses(rubber, *pressed(rubber, 2.0, plane))
    assert found[3] == pytest.approx(-2.0, rel=1e-7)


@PLANES
def test_branches_do_not_matter_to_a_relaxed_block(
    paper_rubber: Material, elastic_rubber: Material, plane: str
) -> None:
    assert pressed(paper_rubber, 5.0, plane) == pressed(elastic_rubber, 5.0, plane)


@PLANES
@LOADS
def test_stored_energy_is_the_work_of_the_load(paper_rubber: Material, plane: str, pressure: float) -> None:
    step = 1e-4
    below, above = (pressed(paper_rubber, pressure * share, plane) for share in (1.0 - step, 1.0 + step))
    work = pressure * (below[0] - above[0])
    gained = stored_energy(paper_rubber, *above) - stored_energy(paper_rubber, *below)
    assert gained == pytest.approx(work, rel=1e-5, abs=1e-12 * paper_rubber.long_term_bulk_modulus)


def test_stored_energy_is_that_of_the_free_energy(paper_rubber: Material) -> None:
    stretch, thickness = 0.7, 1.2
    state = deform(np.array([1.0, 0.0, 0.0, stretch])[:, None], np.array([[np.log(thickness)]]))
    trace = state.isochoric_squared[[0, YY, 3]].sum()
    volumetric = volumetric_energy(paper_rubber.long_term_bulk_modulus, state.volume)[0]
    expected = volumetric + 0.5 * paper_rubber.long_term_shear_modulus * (trace - 3.0)
    assert stored_energy(paper_rubber, stretch, thickness) == pytest.approx(expected, rel=1e-12)
    assert stored_energy(paper_rubber, 1.0, 1.0) == 0.0


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("pressure", [0.1, 5.0, 500.0])
def test_pressing_undoes_pressed(paper_rubber: Material, plane: str, pressure: float) -> None:
    stretch, _ = pressed(paper_rubber, pressure, plane)
    assert pressing(paper_rubber, stretch, plane) == pytest.approx(pressure, rel=1e-9)
