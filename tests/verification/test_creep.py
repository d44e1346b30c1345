"""Creep and relaxation of a block that is the same everywhere, against closed forms over the whole curve."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.march import FiniteStepper
from rubfric.mechanics.finite.state import Branches
from rubfric.mechanics.small.march import SmallStepper
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.rubber.maxwell import Relaxation
from rubfric.scene.scene import Scene

Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
TIME, FRACTION = 0.01, 0.8
ONE = Material("one", 4.17, 0.45, (FRACTION,), (TIME,))
BOTH = Material("both", 4.17, 0.45, (FRACTION,), (TIME,), bulk="proportional")
PRESSURE = 0.5
# A step so short that no time passes.
INSTANT = 1e-9 * TIME


def block(plane: str) -> Block:
    return Block.graded(0.18, 0.135, 8, plane, growth=1.6)


def scene(plane: str, material: Material) -> Scene:
    return Scene(1, SineScale(0.0, 35.0), 10.0, PRESSURE, 0.75, material, plane)


def element(relaxed: float, branch: float, times: Real) -> Real:
    """Return the creep compliance of a spring beside one Maxwell branch."""
    stiff = relaxed + branch
    return (1.0 - branch / stiff * np.exp(-times * relaxed / (stiff * TIME))) / relaxed


def creep(plane: str, material: Material, times: Real) -> Real:
    """Return the strain of a confined block under a pressure that stays."""
    shear, bulk = material.long_term_shear_modulus, material.long_term_bulk_modulus
    branch, swell = float(material.branch_shear_moduli[0]), float(material.branch_bulk_moduli[0])
    if plane == "strain":
        return -PRESSURE * element(bulk + 4.0 * shear / 3.0, swell + 4.0 * branch / 3.0, times)
    # 1 / M = 1 / (4 G) + 1 / (4 G / 3 + 4 K), without stress across the thickness.
    swelling = element(4.0 * shear / 3.0 + 4.0 * bulk, 4.0 * branch / 3.0 + 4.0 * swell, times)
    return -PRESSURE * (element(4.0 * shear, 4.0 * branch, times) + swelling)


def crept(model: SmallStepper | FiniteStepper, count: int) -> tuple[Real, Real]:
    """Return times and the strain of a block under a sudden load, over five relaxation times."""
    length = 5.0 * TIME / count
    strains = []
    for duration in (INSTANT, *[length] * count):
        bottom = model.advance(duration, 0.0, PRESSURE).top - lowest(model)
        strains.append(bottom / model.block.height)
    return length * np.arange(count + 1), np.array(strains)


def lowest(model: SmallStepper | FiniteStepper) -> float:
    if isinstance(model, SmallStepper):
        return float(model.state.surface.mean())
    return float(model.state.fields.displacement[1, 0].mean())


@PLANES
@pytest.mark.parametrize("material", [ONE, BOTH], ids=["elastic bulk", "both"])
def test_creep_in_small_strain_follows_the_closed_form_at_order_two(plane: str, material: Material) -> None:
    errors = []
    for count in (40, 80, 160):
        times, strain = crept(SmallStepper(scene(plane, material), block(plane)), count)
        expected = creep(plane, material, times)
        errors.append(np.abs(strain - expected).max() / np.abs(expected[-1]))
    assert errors[-1] < 1e-4
    assert np.all(np.log2(np.array(errors[:-1]) / np.array(errors[1:])) > 1.8)


def test_creep_in_finite_strain_follows_its_differential_equation_at_order_two() -> None:
    """Plane strain: one stretch l, A diagonal, dA/dt = (Cb^-1 - A) / tau, and the nominal stress stays -p."""
    shear, bulk, branch = (
        ONE.long_term_shear_modulus,
        ONE.long_term_bulk_modulus,
        float(ONE.branch_shear_moduli[0]),
    )

    def isochoric(stretch: float) -> Real:
        return stretch ** (-2.0 / 3.0) * np.array([1.0, stretch * stretch, 1.0])

    def excess(stretch: float, tensor: Real) -> float:
        """Return dW/dl + p, W at constant A, by the derivative of Cb."""
        squared = isochoric(stretch)
        slope = squared * np.array([-2.0 / 3.0, 4.0 / 3.0, -2.0 / 3.0]) / stretch
        change = 0.5 * (shear + branch * tensor) @ slope
        return float(change + 0.5 * bulk * (stretch - 1.0 / stretch) + PRESSURE)

    def stretched(tensor: Real) -> float:
        return float(brentq(excess, 0.2, 1.5, (tensor,), xtol=1e-15))

    def flow(_: float, tensor: Real) -> Real:
        return (1.0 / isochoric(stretched(tensor)) - tensor) / TIME

    errors = []
    for count in (40, 80, 160):
        times, strain = crept(FiniteStepper(scene("strain", ONE), block("strain")), count)
        exact = solve_ivp(flow, (0.0, 5.0 * TIME), np.ones(3), t_eval=times, rtol=1e-10, atol=1e-12)
        expected = np.array([stretched(tensor) - 1.0 for tensor in exact.y.T])
        errors.append(np.abs(strain - expected).max() / np.abs(expected[-1]))
    assert errors[-1] < 1e-4
    assert np.all(np.log2(np.array(errors[:-1]) / np.array(errors[1:])) > 1.8)


@PLANES
def test_light_creep_in_finite_strain_is_that_in_small_strain(plane: str) -> None:
    finite, small = (kind(scene(plane, ONE), block(plane)) for kind in (FiniteStepper, SmallStepper))
    light = 1e-5
    for duration in (INSTANT, *[0.1 * TIME] * 20):
        outcomes = [model.advance(duration, 0.0, light) for model in (finite, small)]
        tops = [outcome.top - lowest(model) for outcome, model in zip(outcomes, (finite, small), strict=True)]
        assert tops[0] == pytest.approx(tops[1], rel=1e-4)
        assert outcomes[0].dissipated == pytest.approx(outcomes[1].dissipated, rel=1e-3, abs=1e-18)
        assert outcomes[0].stored == pytest.approx(outcomes[1].stored, rel=1e-3)


@PLANES
def test_stress_of_a_held_block_relaxes_as_the_prony_series(plane: str) -> None:
    """Q - G_inf 1 = -sum_i G_i exp(-t / tau_i) (Cb^-1 - 1): any steps, to round-off."""
    rubber = Material("three", 4.17, 0.45, (0.3, 0.4, 0.2), (1e-2, 1e-4, 1e-6))
    transient = FiniteStepper(scene(plane, rubber), block(plane))
    finite, branches, state = transient.finite, Branches(transient.finite), transient.state
    held = finite.at_rest()
    held.displacement[0] = 0.4 * finite.block.row_positions[:, None]
    held.displacement[1] = -0.2 * finite.block.row_positions[:, None]
    held = sealed(finite, held)
    inverse = finite.stressed(held).deformation.inverse
    expected_jump = inverse - state.inverse
    instant, passed = 1e-14, 0.0
    behind, _ = branches.follow(state, Relaxation(instant, branches.times), inverse, held.volume)
    for length in (3e-8, 1e-6, 2e-5, 1e-4, 3e-3, 0.02):
        passed += length
        decay = np.exp(-length / branches.times).reshape(-1, 1, 1, 1)
        behind = decay * behind
        relaxed = rubber.shear_relaxation(passed) - rubber.long_term_shear_modulus
        driving = np.tensordot(rubber.branch_shear_moduli, behind, axes=(0, 1))
        np.testing.assert_allclose(driving, -relaxed * expected_jump, rtol=1e-6, atol=1e-12)


def sealed(finite: FiniteBlock, fields: Fields) -> Fields:
    """Return fields whose volume ratio is that of the deformation."""
    return Fields(fields.displacement, fields.log_thickness, fields.volume - finite.stressed(fields).volume_excess)
