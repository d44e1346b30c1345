"""Branches from step to step: their exact update, the energy that they store and dissipate, and the way to a file."""

from __future__ import annotations

from dataclasses import fields as fields_of
from dataclasses import replace

import numpy as np
import pytest
from finite_fields import PROPORTIONAL, RUBBER, coarse, everywhere, uniform
from numpy.typing import NDArray

from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.law import Inverted
from rubfric.mechanics.finite.state import Branches, FiniteState
from rubfric.rubber.material import Material
from rubfric.rubber.maxwell import Relaxation

Real = NDArray[np.float64]
RUBBERS = pytest.mark.parametrize("rubber", [RUBBER, PROPORTIONAL], ids=["elastic bulk", "both"])
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])


def strained(finite: FiniteBlock, behind: bool = True) -> FiniteState:
    """Return a block stretched at once, so that its branches are behind their equilibrium, or relaxed."""
    fields = uniform(finite, 0.8, 0.3, 1.1)
    inverse = finite.stressed(fields).deformation.inverse
    none, no_volume = Branches(finite).none(fields, inverse)
    at_rest = finite.stressed(finite.at_rest()).deformation.inverse
    return FiniteState(
        fields=fields,
        before=fields,
        inverse=inverse,
        inverse_change=np.zeros_like(inverse),
        volume_change=np.zeros_like(fields.volume),
        behind=none + (at_rest - inverse)[:, None] if behind else none,
        volume_behind=no_volume + (fields.volume - 1.0) if behind else no_volume,
        touching=everywhere(finite),
        force=np.zeros((2, finite.block.columns)),
        duration=np.inf,
        advance=0.0,
        offset=0.0,
        pressure=1.0,
        stored=0.0,
    )


def step(state: FiniteState, finite: FiniteBlock, ratio: float) -> tuple[Relaxation, Real, Real]:
    """Return what branches are behind after a step of unchanged deformation, as long as a share of the fastest."""
    branches = Branches(finite)
    relaxation = Relaxation(ratio * float(branches.times.min()), branches.times, state.duration)
    return relaxation, *branches.follow(state, relaxation, state.inverse, state.fields.volume)


def stored(state: FiniteState, finite: FiniteBlock, behind: Real, volume_behind: Real) -> float:
    squared = finite.stressed(state.fields).deformation.isochoric_squared
    return Branches(finite).stored(squared, state.inverse, state.fields.volume, behind, volume_behind)


@PLANES
@RUBBERS
def test_branches_relax_exponentially_under_a_fixed_deformation(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    state = strained(finite)
    relaxation, behind, volume_behind = step(state, finite, 0.7)
    decay = np.exp(-relaxation.duration / np.array(rubber.relaxation_times)).reshape(-1, 1, 1, 1)
    np.testing.assert_allclose(behind, decay * state.behind, rtol=1e-13)
    np.testing.assert_allclose(volume_behind, decay[: len(volume_behind)] * state.volume_behind, rtol=1e-13)


@PLANES
@RUBBERS
def test_energy_that_leaves_the_springs_is_dissipated(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    state = strained(finite)
    relaxation, behind, volume_behind = step(state, finite, 0.3)
    lost = Branches(finite).dissipated(state, relaxation, state.inverse, state.fields.volume)
    gone = stored(state, finite, state.behind, state.volume_behind) - stored(state, finite, behind, volume_behind)
    assert lost > 0.0
    assert lost == pytest.approx(gone, rel=1e-6)


@PLANES
@RUBBERS
def test_relaxed_branches_neither_move_nor_dissipate(plane: str, rubber: Material) -> None:
    finite = coarse(plane, rubber)
    state = strained(finite, behind=False)
    relaxation, behind, volume_behind = step(state, finite, 5.0)
    assert not behind.any()
    assert not volume_behind.any()
    assert Branches(finite).dissipated(state, relaxation, state.inverse, state.fields.volume) == 0.0


@PLANES
@RUBBERS
def test_stress_at_the_end_of_a_step_is_that_of_the_branches(plane: str, rubber: Material) -> None:
    """Q = G_inf 1 + sum_i G_i D_i, by the history that the solver sees and by the branches themselves."""
    finite = coarse(plane, rubber)
    state = strained(finite)
    relaxation, behind, _ = step(state, finite, 0.7)
    found = finite.with_history(Branches(finite).history(state, relaxation)).stressed(state.fields).driving
    expected = np.einsum("b,ibprc->iprc", rubber.branch_shear_moduli, behind)
    expected[[0, 1, 3]] += rubber.long_term_shear_modulus
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


def test_branch_that_turns_inside_out_is_refused() -> None:
    finite = coarse("strain")
    state = strained(finite, behind=False)
    with pytest.raises(Inverted, match="smallest determinant of a branch tensor"):
        step(replace(state, behind=state.behind - 10.0 * state.inverse[:, None]), finite, 0.1)


@RUBBERS
def test_state_returns_from_its_arrays(rubber: Material) -> None:
    state = strained(coarse("stress", rubber))
    again = FiniteState.from_arrays(state.arrays())
    for name in (field.name for field in fields_of(FiniteState)):
        one, other = getattr(state, name), getattr(again, name)
        if name in ("fields", "before"):
            one, other = one.displacement, other.displacement
        np.testing.assert_array_equal(one, other)
        assert type(one) is type(other)
