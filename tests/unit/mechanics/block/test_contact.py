from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.errors import NotConverged
from rubfric.mechanics.block import contact as contact_module
from rubfric.mechanics.block.contact import Contact, full_contact, pivot, solve_contact
from rubfric.mechanics.block.surface import Convolution
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
ROAD = SineScale(0.015, 35.0)
HEIGHT = 0.75 * ROAD.wavelength


def spectrum(material: Material, nodes: int, velocity: float = 300.0) -> Complex:
    """Return the compliance of a layer, mm/MPa; of a sliding one it is not symmetric."""
    harmonics = np.arange(1, nodes // 2 + 1)
    return np.append(0.0, layer_compliance(material, ROAD.wavenumber * harmonics, velocity, HEIGHT, "strain"))


def sine(nodes: int) -> Real:
    return ROAD.height(ROAD.wavelength / nodes * np.arange(nodes))


def rough(nodes: int, rng: np.random.Generator) -> Real:
    """Return a random periodic profile, mm, with a dozen harmonics."""
    harmonics = np.arange(1, 13)
    angle = 2.0 * np.pi * np.outer(harmonics, np.arange(nodes) / nodes) + rng.uniform(0.0, 2.0 * np.pi, (12, 1))
    return 0.015 * (rng.standard_normal(12) / harmonics**1.8) @ np.sin(angle)


def everywhere(nodes: int) -> NDArray[np.bool_]:
    return np.ones(nodes, dtype=bool)


def surface_gap(compliance: Complex, profile: Real, solved: Contact) -> Real:
    """Return C p + d - s by a dense matrix rather than by the Fourier transform that the solver uses."""
    nodes = len(profile)
    kernel = np.fft.irfft(compliance, nodes)
    matrix = np.array([np.roll(kernel, shift) for shift in range(nodes)]).T
    return matrix @ solved.pressure + solved.offset - profile


def assert_complementary(compliance: Complex, profile: Real, nominal: float, solved: Contact) -> None:
    gap = surface_gap(compliance, profile, solved)
    scale = np.ptp(profile)
    assert np.all(solved.pressure >= 0.0)
    assert np.all(solved.gap >= 0.0)
    np.testing.assert_allclose(gap, solved.gap, atol=1e-9 * scale)
    assert np.all(solved.gap[solved.touching] == 0.0)
    assert solved.pressure.mean() == pytest.approx(nominal, rel=1e-12)


@pytest.mark.parametrize("nominal", [1e-6, 0.01, 1.0, 5.0])
def test_sliding_contact_is_complementary_and_carries_the_load(paper_rubber: Material, nominal: float) -> None:
    compliance, profile = spectrum(paper_rubber, 256), sine(256)
    solved = solve_contact(compliance, profile, nominal, everywhere(256))
    assert 0 < np.count_nonzero(solved.touching) < 256
    assert_complementary(compliance, profile, nominal, solved)


@pytest.mark.parametrize("nodes", [255, 256])
def test_rough_profiles_are_solved(paper_rubber: Material, rng: np.random.Generator, nodes: int) -> None:
    for nominal in (0.05, 0.5, 2.0, 5.0):
        compliance, profile = spectrum(paper_rubber, nodes), rough(nodes, rng)
        solved = solve_contact(compliance, profile, nominal, everywhere(nodes))
        assert_complementary(compliance, profile, nominal, solved)


def test_rough_contact_falls_into_several_patches(elastic_rubber: Material) -> None:
    position = np.arange(256) / 256
    profile = 0.015 * np.sin(2 * np.pi * position) + 0.01 * np.sin(14 * np.pi * position)
    compliance = spectrum(elastic_rubber, 256)
    solved = solve_contact(compliance, profile, 0.3, everywhere(256))
    starts = np.count_nonzero(solved.touching & ~np.roll(solved.touching, 1))
    assert starts > 1
    assert_complementary(compliance, profile, 0.3, solved)


def test_solution_is_the_only_one_of_all_contact_sets(paper_rubber: Material, rng: np.random.Generator) -> None:
    nodes, nominal = 10, 1.0
    compliance, profile = spectrum(paper_rubber, nodes), rough(nodes, rng)
    kernel = np.fft.irfft(compliance, nodes)
    matrix = np.array([np.roll(kernel, shift) for shift in range(nodes)]).T
    solutions = []
    for choice in product((False, True), repeat=nodes):
        inside = np.flatnonzero(choice)
        if not len(inside):
            continue
        # C p + d = s on the contact, mean(p) = nominal
        system = np.ones((len(inside) + 1, len(inside) + 1))
        system[:-1, :-1], system[-1, -1] = matrix[np.ix_(inside, inside)], 0.0
        *held, offset = np.linalg.solve(system, np.append(profile[inside], nominal * nodes))
        pressure = np.zeros(nodes)
        pressure[inside] = held
        if pressure.min() >= 0.0 and (matrix @ pressure + offset - profile).min() >= -1e-12:
            solutions.append(pressure)
    assert len(solutions) == 1
    solved = solve_contact(compliance, profile, nominal, everywhere(nodes))
    assert 0 < np.count_nonzero(solved.touching) < nodes
    np.testing.assert_allclose(solved.pressure, solutions[0], atol=1e-9 * solutions[0].max())


def test_starting_set_does_not_matter(paper_rubber: Material, rng: np.random.Generator) -> None:
    nodes = 128
    compliance, profile = spectrum(paper_rubber, nodes), rough(nodes, rng)
    expected = solve_contact(compliance, profile, 0.5, everywhere(nodes))
    single = np.arange(nodes) == int(np.argmin(profile))
    for start in (single, rng.random(nodes) < 0.5, profile > 0.0, profile < 0.0):
        solved = solve_contact(compliance, profile, 0.5, start)
        np.testing.assert_allclose(solved.pressure, expected.pressure, atol=1e-9 * expected.pressure.max())
        assert solved.offset == pytest.approx(expected.offset, rel=1e-9)


def test_starting_set_is_left_alone(paper_rubber: Material) -> None:
    start = everywhere(64)
    solve_contact(spectrum(paper_rubber, 64), sine(64), 0.5, start)
    assert np.all(start)


def test_elastic_contact_is_symmetric_and_sliding_contact_leans_forward(
    elastic_rubber: Material, paper_rubber: Material
) -> None:
    still, sliding = (
        solve_contact(spectrum(material, 256), sine(256), nominal, everywhere(256)).pressure
        for material, nominal in ((elastic_rubber, 0.5), (paper_rubber, 5.0))
    )
    mirrored = np.roll(still[::-1], 1 + 2 * 64)  # about the crest, node 64
    np.testing.assert_allclose(still, mirrored, atol=1e-9 * still.max())
    lean = ROAD.slope(ROAD.wavelength / 256 * np.arange(256))
    assert sliding @ lean > 0.05 * sliding.sum()


def test_lightest_load_touches_one_node_of_the_crest(elastic_rubber: Material) -> None:
    solved = solve_contact(spectrum(elastic_rubber, 64), sine(64), 1e-9, everywhere(64))
    np.testing.assert_array_equal(np.flatnonzero(solved.touching), [16])
    assert solved.pressure[16] == pytest.approx(64e-9, rel=1e-12)


def test_pressure_outside_the_contact_is_zero_and_gap_inside(paper_rubber: Material) -> None:
    solved = solve_contact(spectrum(paper_rubber, 128), sine(128), 1.0, everywhere(128))
    assert np.all(solved.pressure[~solved.touching] == 0.0)
    assert np.all(solved.gap[solved.touching] == 0.0)
    assert np.all(solved.gap[~solved.touching] > 0.0)


def test_full_contact_follows_the_road(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 128, velocity=1.0), sine(128) + 0.2
    solved = full_contact(compliance, profile, 5.0)
    assert solved is not None
    assert solved.iterations == 0
    assert np.all(solved.touching)
    assert solved.offset == pytest.approx(0.2, rel=1e-12)
    assert solved.pressure.mean() == pytest.approx(5.0, rel=1e-12)
    np.testing.assert_allclose(surface_gap(compliance, profile, solved), 0.0, atol=1e-12)


def test_solver_finds_full_contact_too(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 128, velocity=1.0), sine(128)
    recognised, solved = full_contact(compliance, profile, 5.0), solve_contact(compliance, profile, 5.0, profile > 0.0)
    assert recognised is not None
    np.testing.assert_allclose(solved.pressure, recognised.pressure, rtol=1e-8)


def test_full_contact_is_refused_where_it_would_pull(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 128), sine(128)
    filled = 0.015 / abs(compliance[1])
    assert full_contact(compliance, profile, 0.98 * filled) is None
    assert full_contact(compliance, profile, 1.02 * filled) is not None


def test_flat_profile_is_pressed_evenly(paper_rubber: Material) -> None:
    solved = full_contact(spectrum(paper_rubber, 64), np.zeros(64), 2.0)
    assert solved is not None
    np.testing.assert_allclose(solved.pressure, 2.0, rtol=1e-12)
    assert solved.offset == 0.0


def test_scale_of_heights_and_moduli_does_not_matter(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 128), sine(128)
    solved = solve_contact(compliance, profile, 1.0, everywhere(128))
    softer = solve_contact(1e6 * compliance, profile, 1e-6, everywhere(128))
    larger = solve_contact(1e-6 * compliance, 1e-6 * profile, 1.0, everywhere(128))
    np.testing.assert_allclose(softer.pressure, 1e-6 * solved.pressure, rtol=1e-9)
    np.testing.assert_allclose(larger.pressure, solved.pressure, rtol=1e-9)


def test_heavier_loads_touch_more(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 256), sine(256)
    touching = [
        np.count_nonzero(solve_contact(compliance, profile, nominal, everywhere(256)).touching)
        for nominal in (0.01, 0.1, 1.0, 3.0)
    ]
    assert np.all(np.diff(touching) > 0)


def test_running_out_of_steps_raises_with_label_step_and_residual(
    paper_rubber: Material, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contact_module, "MOST_STEPS", 1)
    with pytest.raises(NotConverged, match=r"^rough: not converged after 1 steps, number of surface nodes") as caught:
        solve_contact(spectrum(paper_rubber, 256), sine(256), 0.1, everywhere(256), "rough")
    assert (caught.value.scene, caught.value.step) == ("rough", 1)
    assert caught.value.residual >= 1


def test_pivoting_gives_up_when_told(paper_rubber: Material) -> None:
    surface = Convolution(spectrum(paper_rubber, 256), 256)
    with pytest.raises(NotConverged, match=r"^rough: not converged after 3 steps"):
        pivot(surface, sine(256), 0.1, everywhere(256), "rough", most_steps=3)


def test_single_pivots_alone_reach_the_same_contact(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    compliance, profile = spectrum(paper_rubber, 64), rough(64, rng)
    expected = solve_contact(compliance, profile, 0.5, everywhere(64))
    monkeypatch.setattr(contact_module, "_PATIENCE", 0)
    solved = solve_contact(compliance, profile, 0.5, everywhere(64))
    assert solved.iterations > expected.iterations
    np.testing.assert_allclose(solved.pressure, expected.pressure, atol=1e-9 * expected.pressure.max())


class Uneven:
    """A surface that is not the same everywhere: its compliance is any matrix."""

    def __init__(self, matrix: Real) -> None:
        self.whole = matrix

    def matrix(self, inside: NDArray[np.intp]) -> Real:
        return self.whole[np.ix_(inside, inside)]

    def deflection(self, pressure: Real) -> Real:
        return self.whole @ pressure

    def pressing(self, deflection: Real) -> Real:
        return np.linalg.solve(self.whole, deflection)


def test_any_positive_surface_can_be_pivoted(rng: np.random.Generator) -> None:
    nodes, nominal = 40, 0.7
    factor, twist = rng.standard_normal((2, nodes, nodes))
    matrix = factor @ factor.T / nodes + 0.1 * np.eye(nodes) + 0.2 * (twist - twist.T)
    profile = rng.standard_normal(nodes)
    solved = pivot(Uneven(matrix), profile, nominal, everywhere(nodes))
    assert 0 < np.count_nonzero(solved.touching) < nodes
    gap = matrix @ solved.pressure + solved.offset - profile
    np.testing.assert_allclose(gap, solved.gap, atol=1e-10)
    assert solved.pressure.min() == 0.0
    assert np.all(solved.gap[solved.touching] == 0.0)
    assert solved.pressure.mean() == pytest.approx(nominal, rel=1e-12)


def test_solve_contact_pivots_a_convolution(paper_rubber: Material) -> None:
    compliance, profile = spectrum(paper_rubber, 64), sine(64)
    one = solve_contact(compliance, profile, 0.5, everywhere(64))
    other = pivot(Convolution(compliance, 64), profile, 0.5, everywhere(64))
    np.testing.assert_array_equal(one.pressure, other.pressure)
    assert (one.offset, one.iterations) == (other.offset, other.iterations)


def test_flat_surface_without_a_mean_compliance_is_pressed_evenly(paper_rubber: Material) -> None:
    # Where all nodes touch, only the load tells the mean pressure.
    solved = solve_contact(spectrum(paper_rubber, 64), np.full(64, 0.3), 2.0, everywhere(64))
    np.testing.assert_allclose(solved.pressure, 2.0, rtol=1e-7)
    assert solved.offset == pytest.approx(0.3, rel=1e-12)


def test_what_is_not_finite_is_no_solution() -> None:
    compliance = np.r_[0.0, np.full(4, np.nan)].astype(complex)
    with pytest.raises(NotConverged, match="contact pressure or gap is nan"):
        solve_contact(compliance, np.sin(np.arange(8.0)), 1.0, np.ones(8, dtype=bool))


def test_singular_contact_is_no_solution() -> None:
    with pytest.raises(NotConverged, match="condition of the contact system"):
        solve_contact(np.zeros(5, dtype=complex), np.sin(np.arange(8.0)), 1.0, np.ones(8, dtype=bool))


@pytest.mark.parametrize("nominal", np.geomspace(0.08, 0.45, 7))
def test_one_branch_far_from_symmetric_is_solved(nominal: float) -> None:
    rubber, wavenumber = Material("one", 1.0, 0.49, (0.999,), (1e-4,)), 80.0 * np.arange(1, 65)
    compliance = np.append(0.0, layer_compliance(rubber, wavenumber, 0.0375, 0.06, "stress"))
    profile = SineScale(0.006, 80.0).height(2.0 * np.pi / 80.0 / 128 * np.arange(128))
    solved = solve_contact(compliance, profile, float(nominal), everywhere(128))
    assert np.mean(solved.pressure) == pytest.approx(nominal, rel=1e-9)
    gap = surface_gap(compliance, profile, solved)
    assert gap.min() > -1e-9 * np.ptp(profile)
    np.testing.assert_allclose(gap[solved.touching], 0.0, atol=1e-9 * np.ptp(profile))
