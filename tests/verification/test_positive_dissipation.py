"""Viscous dissipation rebuilt in real space, point by point and branch by branch."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
Real = NDArray[np.float64]
Complex = NDArray[np.complex128]


def strain_amplitudes(solution: SteadySolution) -> tuple[Complex, Complex]:
    """Return deviator (xx, yy, zz, xy) and dilatation at the quadrature points of one column of cells.

    Shapes (rows, points, 4, harmonics) and (rows, points, harmonics).
    """
    scene, block, harmonics = solution.scene, solution.block, solution.response.harmonics
    quadrature = block.quadrature()
    displacement = solution.response.displacement(solution.surface)
    turn = np.exp(2j * np.pi * harmonics / block.columns)
    nodes = np.stack((displacement[:-1], displacement[:-1] * turn, displacement[1:], displacement[1:] * turn), axis=1)
    strain = np.einsum("rpsj,rjn->rpsn", quadrature.strain_matrix(), nodes.reshape(block.rows, 8, -1))
    xx, yy, xy = strain[:, :, 0], strain[:, :, 1], strain[:, :, 2]
    zz = scene.material.thickness_ratio(solution.frequencies, scene.plane) * (xx + yy)
    trace = xx + yy + zz
    deviator = np.stack((xx - trace / 3.0, yy - trace / 3.0, zz - trace / 3.0, xy), axis=2)
    if scene.plane == "strain":
        share = quadrature.weights / quadrature.weights.sum(axis=1, keepdims=True)
        trace = np.broadcast_to(np.einsum("rp,rpn->rn", share, trace)[:, None], trace.shape)
    return deviator, trace


def in_space(amplitudes: Complex, solution: SteadySolution) -> Real:
    """Return the real field at all columns."""
    columns, harmonics = solution.block.columns, solution.response.harmonics
    spectrum = np.zeros((*amplitudes.shape[:-1], columns // 2 + 1), dtype=complex)
    spectrum[..., harmonics] = amplitudes
    return np.fft.irfft(spectrum, columns, norm="forward")


def branch_dissipation(solution: SteadySolution) -> Iterator[Real]:
    """Yield stress x rate of flow of each branch's dashpot, MPa/s, shape (rows, points, columns)."""
    rubber, frequency = solution.scene.material, solution.frequencies
    deviator, trace = strain_amplitudes(solution)
    for time, shear, bulk in zip(
        rubber.relaxation_times, rubber.branch_shear_moduli, rubber.branch_bulk_moduli, strict=True
    ):
        flow = 1.0 / (1.0 + 1j * frequency * time)  # viscous part of the strain; the spring carries the rest
        rate = 1j * frequency * flow
        stretch, flowing = (in_space(deviator * part, solution) for part in (1.0 - flow, rate))
        weights = np.array([1.0, 1.0, 1.0, 2.0])
        dissipated = 2.0 * shear * np.einsum("s,rpsc,rpsc->rpc", weights, stretch, flowing)
        yield dissipated + bulk * in_space(trace * (1.0 - flow), solution) * in_space(trace * rate, solution)


def without_last_harmonic(solution: SteadySolution) -> SteadySolution:
    """Drop the harmonic whose phase the columns do not show, columns / 2."""
    surface = np.where(solution.response.harmonics == solution.block.columns // 2, 0.0, solution.surface)
    return replace(solution, surface=surface)


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
@pytest.mark.parametrize(
    ("scale", "velocity", "pressure"), [(1, 1.0, 5.0), (1, 500.0, 5.0), (1, 30.0, 0.3), (4, 1e4, 5.0)]
)
def test_every_branch_dissipates_everywhere_and_all_add_up_to_the_friction(
    paper_scene: SceneMaker,
    paper_rubber: Material,
    plane: str,
    bulk: str,
    scale: int,
    velocity: float,
    pressure: float,
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    exact = Numerics(folding=0.0)  # every branch counts
    solved = solve(paper_scene(velocity, pressure, scale=scale, plane=plane, material=rubber, numerics=exact))
    solution = without_last_harmonic(solved)
    weights = solution.block.quadrature().weights
    power = 0.0  # N mm/s per mm of thickness
    for dissipated in branch_dissipation(solution):
        assert dissipated.min() >= -1e-13 * dissipated.max()
        assert dissipated.max() > 0.0
        power += np.einsum("rp,rpc->", weights, dissipated)
    friction = power / (velocity * pressure * solution.block.width)
    assert friction == pytest.approx(evaluate(solution).dissipation, rel=1e-10)
    assert friction == pytest.approx(evaluate(solved).dissipation, rel=1e-3)
