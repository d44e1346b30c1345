"""Homogeneous states in finite strain: the block on a flat road against the minimum of its energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import FiniteBlock
from rubfric.mechanics.finite.contact import Load, SlidingContact
from rubfric.mechanics.finite.continuation import History, Start, attempt
from rubfric.mechanics.theory.compression import pressed, stored_energy
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

GLASSY = "glassy"
RELAXED = "relaxed"


@pytest.fixture(params=[RELAXED, GLASSY])
def rubber(request: pytest.FixtureRequest, paper_rubber: Material) -> Material:
    """Return the rubber as it is, or with its instantaneous shear modulus for good."""
    if request.param == RELAXED:
        return paper_rubber
    shear, bulk = paper_rubber.instantaneous_shear_modulus, paper_rubber.long_term_bulk_modulus
    return replace(
        paper_rubber,
        youngs_modulus=9.0 * bulk * shear / (3.0 * bulk + shear),
        poissons_ratio=(3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)),
        shear_fractions=(),
        relaxation_times=(),
    )


def least_energy(material: Material, pressure: float, plane: str) -> tuple[float, float]:
    """Return the stretches, along the height and across, that minimise stored energy plus the load's."""

    def potential(logarithms: np.ndarray) -> float:
        stretch, thickness = np.exp(logarithms[0]), np.exp(logarithms[1]) if plane == "stress" else 1.0
        return stored_energy(material, stretch, thickness) + pressure * stretch

    found = minimize(potential, np.zeros(2), method="Nelder-Mead", options={"xatol": 1e-11, "fatol": 1e-16})
    stretch, thickness = np.exp(found.x)
    return float(stretch), float(thickness) if plane == "stress" else 1.0


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("pressure", [0.1, 5.0])
def test_closed_form_is_the_least_energy(rubber: Material, pressure: float, plane: str) -> None:
    assert pressed(rubber, pressure, plane) == pytest.approx(least_energy(rubber, pressure, plane), rel=2e-6)


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("pressure", [0.5, 3.0])
def test_block_finds_it_from_the_shape_it_was_made_in(rubber: Material, pressure: float, plane: str) -> None:
    block = Block.graded(0.2, 0.15, 16, plane, 1.3)
    problem = SlidingContact(FiniteBlock(block, rubber, 10.0), (0.01, 0.3), "flat")
    touching = np.ones(16, dtype=bool)
    fields = problem.finite.at_rest()
    for share in (0.25, 0.5, 0.75, 1.0):
        load = Load(SineScale(0.0, 30.0), share * pressure)
        solved = attempt(problem, Start(fields, touching), load, 1e-12, History(), "flat road")
        fields = solved.fields
    stretch, thickness = pressed(rubber, pressure, plane)
    np.testing.assert_allclose(
        fields.displacement[1], np.outer((stretch - 1.0) * block.row_positions, np.ones(16)), atol=1e-10
    )
    np.testing.assert_allclose(fields.displacement[0], 0.0, atol=1e-10)
    if plane == "stress":
        np.testing.assert_allclose(np.exp(fields.log_thickness), thickness, rtol=1e-10)
    np.testing.assert_allclose(solved.correction.contact.pressure, pressure, rtol=1e-9)
