"""Surfaces, and the pressures that hold some of their nodes: GMRES against dense systems."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.errors import NotConverged
from rubfric.mechanics.block import surface as surface_module
from rubfric.mechanics.block.contact import pivot
from rubfric.mechanics.block.surface import Convolution, Equilibrium, Unsolved, gmres, inverse
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
Whole = NDArray[np.intp]


def spectrum(material: Material, nodes: int, velocity: float = 300.0) -> Complex:
    """Return the compliance of a layer, mm/MPa; of a sliding one it is not symmetric."""
    wavenumber = 5.0 * np.arange(1, nodes // 2 + 1)
    return np.append(0.0, layer_compliance(material, wavenumber, velocity, 0.13, "strain"))


def spots(nodes: int, rng: np.random.Generator) -> Whole:
    """Return nodes in contact on a rough road: spots of many widths."""
    angle = 2.0 * np.pi * np.outer(np.arange(1, 20), np.arange(nodes) / nodes) + rng.uniform(0.0, 6.0, (19, 1))
    return np.flatnonzero(np.sin(angle).sum(axis=0) > 0.5)


def held(
    monkeypatch: pytest.MonkeyPatch, dense: bool, surface: Convolution, nodes: int, inside: Whole, *given: object
) -> tuple[Real, float]:
    monkeypatch.setattr(surface_module, "_DENSE", np.inf if dense else 0.0)
    return Equilibrium(surface, nodes, inside).solve(*given)


@pytest.mark.parametrize("nodes", [63, 64])
def test_convolution_is_a_matrix_of_shifted_kernels(
    paper_rubber: Material, rng: np.random.Generator, nodes: int
) -> None:
    compliance = spectrum(paper_rubber, nodes)
    surface, kernel = Convolution(compliance, nodes), np.fft.irfft(compliance, nodes)
    dense = np.array([np.roll(kernel, shift) for shift in range(nodes)]).T
    pressure, inside = rng.random(nodes), np.array([0, 3, 4, nodes - 1])
    np.testing.assert_allclose(surface.deflection(pressure), dense @ pressure, atol=1e-12 * np.abs(dense).sum())
    np.testing.assert_array_equal(surface.matrix(inside), dense[np.ix_(inside, inside)])


@pytest.mark.parametrize("nodes", [63, 64])
def test_pressing_undoes_the_deflection_but_for_the_mean(
    paper_rubber: Material, rng: np.random.Generator, nodes: int
) -> None:
    surface, pressure = Convolution(spectrum(paper_rubber, nodes), nodes), rng.random(nodes)
    again = surface.pressing(surface.deflection(pressure))
    np.testing.assert_allclose(again - again.mean(), pressure - pressure.mean(), atol=1e-11)


def test_what_cannot_be_inverted_has_the_inverse_zero() -> None:
    found = inverse(np.array([np.nan, 2.0, 0.0, np.inf, 4.0 + 3.0j]), 8)
    np.testing.assert_array_equal(found[1:], [0.5, 0.0, 0.0, 0.25])
    assert inverse(np.array([7.0, 2.0, 4.0j]), 5)[0] == 0.25  # the mean is as soft as the softest harmonic


@pytest.mark.parametrize("velocity", [0.1, 10.0, 1e3])
@pytest.mark.parametrize("nodes", [255, 512])
def test_gmres_finds_the_pressures_of_the_dense_system(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch, nodes: int, velocity: float
) -> None:
    surface, inside = Convolution(spectrum(paper_rubber, nodes, velocity), nodes), spots(nodes, rng)
    assert 0.2 * nodes < len(inside) < 0.6 * nodes
    for load in (0.0, 3.0 * nodes):
        given = surface, nodes, inside, 0.01 * rng.standard_normal(nodes)[inside], load
        (expected, offset), (found, other) = (held(monkeypatch, dense, *given) for dense in (True, False))
        np.testing.assert_allclose(found, expected, atol=1e-10 * np.abs(expected).max())
        assert other == pytest.approx(offset, abs=1e-12)
        assert found.sum() == pytest.approx(load, abs=1e-9 * np.abs(found).sum())


@pytest.mark.parametrize("dense", [True, False])
def test_held_nodes_are_where_they_should_be(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch, dense: bool
) -> None:
    nodes = 256
    surface, inside, height = Convolution(spectrum(paper_rubber, nodes), nodes), spots(nodes, rng), np.zeros(nodes)
    height[inside] = 0.01 * np.cos(0.3 * inside)
    pressure = np.zeros(nodes)
    pressure[inside], offset = held(monkeypatch, dense, surface, nodes, inside, height[inside], 500.0)
    reached = surface.deflection(pressure) + offset
    np.testing.assert_allclose(reached[inside], height[inside], atol=1e-12)
    assert pressure.sum() == pytest.approx(500.0, rel=1e-12)


class Counted(Convolution):
    """A surface that counts how often C is applied."""

    applied = 0

    def deflection(self, pressure: Real) -> Real:
        self.applied += 1
        return super().deflection(pressure)


def test_whole_surface_is_held_after_one_iteration(paper_rubber: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    nodes = 1000
    surface, height = Counted(spectrum(paper_rubber, nodes), nodes), 0.01 * np.cos(np.arange(nodes))
    found, _ = held(monkeypatch, False, surface, nodes, np.arange(nodes), height, 1.0 * nodes)
    np.testing.assert_allclose(surface.deflection(found), height - height.mean(), atol=1e-14)
    assert surface.applied <= 5


def test_iterations_hardly_grow_with_the_mesh(paper_rubber: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    counts = []
    for nodes in (512, 2048, 8192):
        surface = Counted(spectrum(paper_rubber, nodes), nodes)
        x = 2.0 * np.pi * np.arange(nodes) / nodes
        height = 0.015 * np.sin(7.0 * x) + 0.006 * np.sin(16.0 * x) + 0.003 * np.sin(40.0 * x)
        inside = np.flatnonzero(height > 0.004)
        held(monkeypatch, False, surface, nodes, inside, height[inside], 5.0 * nodes)
        counts.append(surface.applied)
    assert counts[0] < 50
    assert counts[2] < 1.6 * counts[0]


def test_surface_that_gmres_does_not_solve_is_solved_densely(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    surface, inside = Convolution(spectrum(paper_rubber, 128), 128), spots(128, rng)
    given = surface, 128, inside, 0.01 * np.cos(0.3 * inside), 100.0
    expected, offset = held(monkeypatch, True, *given)
    monkeypatch.setattr(surface_module, "_MOST_KRYLOV", 2)
    found, other = held(monkeypatch, False, *given)
    np.testing.assert_array_equal(found, expected)
    assert other == offset


def test_dense_system_of_too_many_nodes_is_refused_before_it_fills_the_memory(
    paper_rubber: Material, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in (("_DENSE", 0.0), ("_MOST_KRYLOV", 1), ("_MOST_NODES", 7)):
        monkeypatch.setattr(surface_module, name, value)
    surface, profile = Convolution(spectrum(paper_rubber, 64), 64), np.sin(2.0 * np.pi * np.arange(64) / 64)
    expected = r"^rough: not converged after 1 steps, number of nodes in contact \(where GMRES fails at most 7\) is 31$"
    with pytest.raises(NotConverged, match=expected):
        pivot(surface, profile, 1.0, profile > 1e-9, "rough")


@pytest.mark.parametrize("dense", [True, False])
def test_surface_that_yields_nowhere_is_singular(monkeypatch: pytest.MonkeyPatch, dense: bool) -> None:
    surface = Convolution(np.zeros(33, dtype=complex), 64)
    with pytest.raises(Unsolved) as caught:
        held(monkeypatch, dense, surface, 64, np.arange(10, 30), np.ones(20), 1.0)
    assert caught.value.args == (np.inf, "condition of the contact system")


@pytest.mark.parametrize("dense", [True, False])
def test_compliance_that_is_not_finite_gives_no_numbers(monkeypatch: pytest.MonkeyPatch, dense: bool) -> None:
    compliance = np.append(0.0, np.full(32, np.nan))
    found, _ = held(monkeypatch, dense, Convolution(compliance, 64), 64, np.arange(10, 30), np.ones(20), 1.0)
    assert np.isnan(found).all()


def test_gmres_solves_a_system_far_from_symmetric(rng: np.random.Generator) -> None:
    twist = rng.standard_normal((30, 30))
    matrix, right = np.eye(30) + 0.5 * (twist - twist.T), rng.standard_normal(30)
    found = gmres(lambda vector: matrix @ vector, right, 1e-12, 30)
    assert found is not None
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), atol=1e-11)


def test_gmres_stops_at_the_residual_asked_for(rng: np.random.Generator) -> None:
    matrix, right = np.eye(40) + 0.05 * rng.standard_normal((40, 40)), rng.standard_normal(40)
    sizes = []
    for tolerance in (1e-1, 1e-4, 1e-8):
        found = gmres(lambda vector: matrix @ vector, right, tolerance, 40)
        assert found is not None
        sizes.append(float(np.linalg.norm(right - matrix @ found)))
        assert 1e-4 * tolerance < sizes[-1] <= 1.01 * tolerance


def test_gmres_says_where_it_finds_nothing(rng: np.random.Generator) -> None:
    matrix, right = rng.standard_normal((30, 30)), rng.standard_normal(30)
    assert gmres(lambda vector: matrix @ vector, right, 1e-12, 10) is None
    assert gmres(lambda vector: 0.0 * vector, right, 1e-12, 10) is None
    assert gmres(lambda vector: np.nan * vector, right, 1e-12, 10) is None


def test_nothing_to_solve_takes_no_iteration() -> None:
    def applied(vector: Real) -> Real:
        raise AssertionError("not to be applied")

    found = gmres(applied, np.zeros(5), 0.0, 5)
    np.testing.assert_array_equal(found, np.zeros(5))
