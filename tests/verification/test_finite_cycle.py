"""The first law in finite strain, point by point: stress power is stored at once or dissipated, never won back.

In steady sliding every material point of a row goes through all states of the row once a wavelength: the rate of
what it stores is v times the derivative along the row, and what it stores returns. Stress knows nothing of W and D:
that the three balance says that the stress follows from the one and the flow of the branches makes the other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.energy import dissipated_and_stored
from rubfric.mechanics.finite.layers import even_cells
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import solve

SceneMaker = Callable[..., Scene]
Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
BULK = pytest.mark.parametrize("bulk", ["elastic", "proportional"])
WIDTH = 2.0 * np.pi / 35.0
FILLED = (10.0, 5.0)
PART = [(100.0, 0.5), (1000.0, 2.0)]


class Balance:
    """Stress power, its excess over storage and dissipation, and dissipation, MPa/s: means of the cells.

    Of the cells, because in plane strain the pressure works on the mean dilatation of a cell.
    """

    def __init__(self, finite: FiniteBlock, fields: Fields) -> None:
        state = finite.stressed(fields)
        power = finite.stress_power(fields, state)
        self.points_lost, stored = dissipated_and_stored(finite, state.deformation)
        rate = 1j * finite.frequencies
        rate[-1] = 0.0  # the phase of the last harmonic is unknown

        weights = finite.quadrature.weights.T[:, :, None]

        def cells(field: Real) -> Real:
            return (even_cells(finite.layers, field) * weights).sum(axis=0) / self.area

        self.area = weights.sum(axis=0)
        self.lost, self.power = cells(self.points_lost), cells(power)
        self.excess = cells(power - finite.convolve(rate, stored) - self.points_lost)

    def worst(self, rows: slice | NDArray[np.bool_] = slice(None)) -> float:
        """Return the largest excess in some rows over the largest stress power there."""
        return float(np.abs(self.excess[rows]).max() / np.abs(self.power[rows]).max())

    @property
    def worst_row(self) -> float:
        """Largest difference between mean stress power and mean dissipation of a row, over that of the largest row."""
        power, lost = self.power.mean(axis=1), self.lost.mean(axis=1)
        return float(np.abs(power - lost).max() / lost.max())


def smooth(plane: str, material: Material, columns: int, velocity: float, rng: np.random.Generator) -> Balance:
    """Return the balance of a smooth periodic deformation that no load holds: strains of about a half."""
    finite = FiniteBlock(Block.graded(WIDTH, 0.75 * WIDTH, columns, plane, 1.3), material, velocity)
    fields, block = finite.at_rest(), finite.block
    height = (block.row_positions / block.height)[:, None]
    fields.displacement[1] = -0.2 * block.row_positions[:, None]
    for harmonic in (1, 2, 3):
        for component in fields.displacement:
            slope, phase, turn = rng.uniform(0.02, 0.12), rng.uniform(0.0, 2.0 * np.pi), rng.uniform(-1.0, 1.0)
            wave = harmonic * 35.0
            component += slope / wave * (1.0 - height) * np.sin(wave * block.column_positions + phase + turn * height)
    fields.log_thickness[:] = 0.1 + 0.1 * np.sin(35.0 * block.column_positions + rng.uniform(0.0, 2.0 * np.pi))
    missed = finite.stressed(fields).volume_excess
    return Balance(finite, replace(fields, volume=fields.volume - missed))


def slide(
    paper_scene: SceneMaker, load: tuple[float, float], plane: str, material: Material, columns: int
) -> FiniteSolution:
    """Solve one scene on so many columns; the rest of the mesh follows."""
    pinned = Numerics(
        accuracy=0.5,
        finite_contact_nodes=4,
        columns_min=8,
        finite_columns_min=columns,
        columns_max=columns,
        row_growth=1.15,
    )
    scene = paper_scene(*load, plane=plane, material=material, numerics=pinned, kinematics="finite")
    solution = solve(scene)
    assert isinstance(solution, FiniteSolution)
    return solution


@PLANES
@BULK
@pytest.mark.parametrize("velocity", [10.0, 1000.0])
def test_holds_at_every_point_of_any_smooth_deformation(
    paper_rubber: Material, plane: str, bulk: str, velocity: float
) -> None:
    # As fast as Fourier series converge: 6e-3 on 16 columns, 3e-6 on 32, round-off on 64.
    rubber = replace(paper_rubber, bulk=bulk)
    coarse, fine = (smooth(plane, rubber, columns, velocity, np.random.default_rng(1)) for columns in (32, 64))
    assert coarse.worst() < 1e-5
    assert fine.worst() < 1e-10
    assert fine.worst_row < 1e-12


@PLANES
@BULK
def test_any_smooth_deformation_dissipates_at_every_point(
    paper_rubber: Material, plane: str, bulk: str, rng: np.random.Generator
) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    for velocity in (1e-2, 1.0, 1e2, 1e4, 1e6):
        lost = smooth(plane, rubber, 32, velocity, rng).points_lost
        assert lost.min() >= 0.0
        assert lost.max() > 0.0


@PLANES
@BULK
@pytest.mark.parametrize("load", [FILLED, *PART])
def test_sliding_dissipates_at_every_point(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str, load: tuple[float, float]
) -> None:
    solution = slide(paper_scene, load, plane, replace(paper_rubber, bulk=bulk), 64)
    assert Balance(solution.finite, solution.fields).points_lost.min() > 0.0


@PLANES
@BULK
def test_filled_road_balances_at_every_point_to_the_solvers_tolerance(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str
) -> None:
    solution = slide(paper_scene, FILLED, plane, replace(paper_rubber, bulk=bulk), 64)
    assert solution.contact_fraction == 1.0
    balance = Balance(solution.finite, solution.fields)
    assert balance.worst() < 1e-4
    assert balance.worst_row < 1e-4


@PLANES
@BULK
@pytest.mark.parametrize("load", PART)
def test_partial_contact_balances_as_the_mesh_is_refined(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, bulk: str, load: tuple[float, float]
) -> None:
    # At the ends of the contact the rate of strain has no bound: there a column of cells is off on any mesh.
    worst, shares, rows = [], [], []
    for columns in (64, 128, 256):
        solution = slide(paper_scene, load, plane, replace(paper_rubber, bulk=bulk), columns)
        assert solution.contact_fraction < 0.3
        balance = Balance(solution.finite, solution.fields)
        worst.append(balance.worst(solution.block.row_positions[:-1] > WIDTH / 32.0))
        shares.append(np.sum(np.abs(balance.excess) * balance.area) / np.sum(np.abs(balance.power) * balance.area))
        rows.append(balance.worst_row)
    assert worst[1] < worst[0] / 8.0
    assert worst[2] < worst[0] / 64.0
    assert worst[2] < 1e-4
    assert shares[2] < shares[0] / 3.0
    assert shares[2] < 5e-3
    assert max(rows[1:]) < 0.01
