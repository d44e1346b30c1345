"""Rows on fewer columns: the same block, as long as what is left out has decayed."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from finite_fields import ELASTIC, PROPORTIONAL, RUBBER, WAVENUMBER, WIDTH, random_step
from numpy.typing import NDArray

import rubfric
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.energy import evaluate_finite, nodal_density
from rubfric.mechanics.finite.layers import Layer, divided, even_cells, even_nodes, undivided
from rubfric.mechanics.finite.linearised import scaling
from rubfric.mechanics.finite.march import FiniteStepper
from rubfric.mechanics.finite.prolongation import prolong
from rubfric.mechanics.finite.steady import FiniteSolution, FiniteSolver
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.theory.kinematics import decide
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
DILATATIONS = pytest.mark.parametrize("dilatation", ["pointwise", "mean"])
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL, ELASTIC], ids=["elastic bulk", "both", "elastic"])
# Three rows of 32 columns, four of 16 and four of 8.
LAYERS = (
    Layer(slice(0, 3), slice(0, 3), 32, 1),
    Layer(slice(3, 7), slice(3, 5), 16, 2),
    Layer(slice(7, 11), slice(5, 6), 8, 4),
)


def block(plane: str, dilatation: str = "auto") -> Block:
    heights = np.cumsum(np.concatenate(([0.0], 1.3 ** np.arange(11))))
    return Block(WIDTH, 0.75 * WIDTH, 32, 0.75 * WIDTH * heights / heights[-1], plane, dilatation)


def layered(plane: str, rubber: Material = RUBBER, dilatation: str = "auto") -> FiniteBlock:
    return FiniteBlock(block(plane, dilatation), rubber, 100.0, LAYERS)


def resolved(finite: FiniteBlock, rng: np.random.Generator) -> Fields:
    """Return fields whose harmonics every layer of LAYERS resolves: three, and seven more in the lowest rows."""
    fields, columns = finite.at_rest(), np.arange(finite.block.columns) / finite.block.columns
    for harmonic in range(1, 11):
        rows = np.arange(finite.block.rows + 1) < (99 if harmonic <= 3 else 3)
        amplitude = 0.1 * finite.block.column_width * rows * rng.uniform(-1.0, 1.0, (2, len(rows)))
        wave = amplitude[..., None] * np.cos(2.0 * np.pi * (harmonic * columns - rng.uniform(size=(2, 1, 1))))
        fields.displacement[:, 0] += wave[:, 0]
        for layer in finite.layers:
            upper = wave[:, layer.rows.start + 1 : layer.rows.stop + 1, :: layer.share]
            layer.nodes_of(fields.displacement)[:] += upper
    return fields


@PLANES
@DILATATIONS
@RUBBERS
def test_step_of_a_pressed_block_is_found_exactly(
    plane: str, dilatation: str, rubber: Material, rng: np.random.Generator
) -> None:
    finite = layered(plane, rubber, dilatation)
    fields, step = finite.pressed(2.0), random_step(finite, rng)
    stiffness = finite.stiffness(fields, finite.stressed(fields))
    circulant = Circulant(finite, stiffness, 0.0)
    change, excess = finite.change(stiffness, step)
    right = circulant.right_side(finite.forces(change[:4]), change[4:], excess)
    found = circulant.solve(right, np.zeros((2, 32)))
    length = np.abs(step.displacement).max()
    np.testing.assert_allclose(found.displacement, step.displacement, atol=1e-9 * length)
    np.testing.assert_allclose(found.log_thickness, step.log_thickness, atol=1e-9)
    np.testing.assert_allclose(found.volume, step.volume, atol=1e-9)
    np.testing.assert_allclose(circulant.surface(right), step.displacement[:, 0], atol=1e-9 * length)


@PLANES
def test_forces_do_the_work_of_the_stresses(plane: str, rng: np.random.Generator) -> None:
    finite = layered(plane)
    step = rng.standard_normal(finite.at_rest().displacement.shape)
    stresses = rng.standard_normal((4, finite.points, *finite.shape))
    inside = ((stresses * finite.gradient(step)).sum(axis=0) * finite.weights).sum()
    assert (finite.forces(stresses) * step).sum() == pytest.approx(inside, rel=1e-12)
    assert finite.weights.sum() == pytest.approx(WIDTH * finite.block.height, rel=1e-12)
    assert finite.top_load(2.0).sum() == pytest.approx(2.0 * WIDTH, rel=1e-12)


@PLANES
def test_resolved_harmonics_are_those_of_all_columns(plane: str, rng: np.random.Generator) -> None:
    finite, seed = layered(plane), int(rng.integers(1000))
    whole = FiniteBlock(finite.block, RUBBER, 100.0)
    fields = resolved(finite, np.random.default_rng(seed))
    expected = resolved(whole, np.random.default_rng(seed)).displacement
    np.testing.assert_allclose(even_nodes(finite.layers, fields.displacement), expected, atol=1e-15)
    gradient, other = finite.gradient(fields.displacement), whole.gradient(expected)
    np.testing.assert_allclose(even_cells(finite.layers, gradient), other, atol=1e-13)
    memory = even_cells(finite.layers, finite.history.shear(gradient))
    np.testing.assert_allclose(memory, whole.history.shear(other), atol=1e-12 * np.abs(memory).max())
    there = prolong(prolong(fields, finite, whole), whole, finite)
    np.testing.assert_allclose(there.displacement, fields.displacement, atol=1e-14)
    np.testing.assert_allclose(there.volume, fields.volume, atol=1e-12)


@PLANES
def test_pressed_block_is_even(plane: str) -> None:
    finite = layered(plane)
    fields, whole = finite.pressed(1.0), FiniteBlock(finite.block, RUBBER, 100.0)
    expected = whole.pressed(1.0)
    np.testing.assert_allclose(even_nodes(LAYERS, fields.displacement), expected.displacement, atol=1e-15)
    np.testing.assert_allclose(prolong(expected, whole, finite).log_thickness, fields.log_thickness, atol=1e-14)
    even = scaling(finite, finite.stiffness(fields, finite.stressed(fields)), 1)
    for part in (even.displacement, even.log_thickness, even.volume):
        np.testing.assert_allclose(part, 1.0, rtol=1e-12)
    density = np.full((finite.points, *finite.shape), 0.7)
    np.testing.assert_allclose(nodal_density(finite, density), 0.7, rtol=1e-12)


@pytest.mark.parametrize("columns", [320, 864, 1000, 3888])
@pytest.mark.parametrize("stretch", [0.4, 1.0])
def test_layers_hold_every_row_once_and_leave_out_what_has_decayed(columns: int, stretch: float) -> None:
    finite = Block.graded(WIDTH, 0.75 * WIDTH, columns, "stress", 1.1)
    layers = divided(finite, stretch)
    if columns * finite.rows < 4096:
        assert layers == undivided(finite)
        return
    assert [layer.rows.start for layer in layers] == [0, *(layer.rows.stop for layer in layers[:-1])]
    assert [layer.stored.start for layer in layers] == [0, *(layer.stored.stop for layer in layers[:-1])]
    assert layers[-1].rows.stop == finite.rows
    assert layers[-1].stored.stop < 0.7 * finite.rows
    for layer in layers:
        assert layer.columns * layer.share == columns
        assert layer.columns % 2 == 0
        assert layer.rows.stop - layer.rows.start == layer.share * (layer.stored.stop - layer.stored.start)
        if layer.share > 1:
            highest = WAVENUMBER * layer.columns / 2
            assert np.exp(-highest * stretch * finite.row_positions[layer.rows.start]) < 5e-5


@PLANES
def test_friction_is_that_of_all_columns(plane: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = rubfric.load().scene(scale=2, velocity=1000, pressure=0.2)
    scene = dataclasses.replace(scene, plane=plane, kinematics="finite")

    def solved() -> FiniteSolution:
        return FiniteSolver(scene, decide(scene)).solve(Resolution(640, 1.25))

    found = solved()
    assert len(found.finite.layers) > 2
    monkeypatch.setattr("rubfric.mechanics.finite.steady.divided", lambda block, stretch: undivided(block))
    whole = solved()
    assert len(whole.finite.layers) == 1
    started = [FiniteStepper(scene, solution.block) for solution in (found, whole)]
    for stepper, solution in zip(started, (found, whole), strict=True):
        stepper.slide_steadily(solution)
    assert started[0].state.stored == pytest.approx(started[1].state.stored, rel=1e-5)
    np.testing.assert_allclose(started[0].state.behind, started[1].state.behind, atol=1e-4)
    one, other = evaluate_finite(found), evaluate_finite(whole)
    for route in ("stress_power", "dissipation", "contact"):
        assert getattr(one, route) == pytest.approx(getattr(other, route), rel=3e-5), route
    np.testing.assert_allclose(one.depth_profile, other.depth_profile, rtol=1e-3)
    np.testing.assert_allclose(one.density, other.density, atol=1e-3 * other.density.max())
    np.testing.assert_allclose(one.displacement, other.displacement, atol=1e-5 * np.abs(other.displacement).max())
