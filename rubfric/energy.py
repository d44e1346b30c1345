"""Friction from energy: three routes to one number, and the strain energy stored in the block.

1. Stress power (Zhou, Wang and Wei 2019, eq. 4): F v = mean over a cycle of the integral of stress x strain rate.
2. Viscous dissipation of the branches: F v = mean of the integral of sum_i 2 G_i |e - e_i|² / tau_i, never negative.
3. Contact: F = sum over the surface of pressure x slope of the road.

The friction coefficient is F / (p lambda). The means are exact sums over harmonics (Parseval).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rubfric.block import Block, Quadrature
from rubfric.material import Material
from rubfric.steady import SteadySolution

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


@dataclass(frozen=True)
class Energies:
    """What a scene dissipates and stores.

    Attributes
    ----------
    stress_power, dissipation, contact : float
        Friction coefficient by each of the three routes, dimensionless.
    depth_profile : ndarray, shape (rows + 1,)
        Mean over a wavelength of the stored strain-energy density, MPa (= N mm/mm³), at the rows of nodes.
    density : ndarray, shape (rows + 1, m)
        Stored strain-energy density at the nodes of every ``stride``-th column, MPa.
    stride : int
        Columns of cells between two columns of ``density``.
    """

    stress_power: float
    dissipation: float
    contact: float
    depth_profile: Real
    density: Real
    stride: int

    @property
    def closure(self) -> float:
        """Largest difference between two routes over the largest of them; 0 without friction."""
        routes = (self.stress_power, self.dissipation, self.contact)
        largest = max(abs(route) for route in routes)
        return (max(routes) - min(routes)) / largest if largest > 1e-14 else 0.0


@dataclass(frozen=True)
class Intensity:
    """Squared strain amplitudes of the harmonics, integrated over one cell of every row.

    Attributes
    ----------
    shear : ndarray, shape (rows, n)
        Integral of e : e* (deviator), mm².
    volume : ndarray, shape (rows, n)
        Integral of |tr|², mm².
    """

    shear: Real
    volume: Real


def evaluate(solution: SteadySolution) -> Energies:
    """Return the friction coefficient by three routes and the stored strain energy of a solved scene."""
    scene, block = solution.scene, solution.block
    displacement = solution.response.displacement(solution.surface)
    intensity = strain_intensity(block, scene.material, solution.frequencies, displacement)
    twice = np.where(solution.response.harmonics == block.columns // 2, 1.0, 2.0)
    scale = block.columns / (scene.velocity * scene.pressure * block.width)
    power = twice @ stress_power(scene.material, solution.frequencies, intensity).sum(axis=0)
    lost = twice @ viscous_dissipation(scene.material, solution.frequencies, intensity).sum(axis=0)
    slope = scene.road.slope(block.column_positions)
    rest = scene.pressure**2 / (2.0 * scene.material.confined_modulus(scene.plane))
    stored = stored_energy(scene.material, solution.frequencies, intensity) @ twice
    rows = rest + stored / (np.diff(block.row_positions) * block.column_width)
    stride = output_stride(block.columns, scene.numerics.output_columns)
    return Energies(
        stress_power=float(scale * power),
        dissipation=float(scale * lost),
        contact=float(np.mean(solution.contact.pressure * slope) / scene.pressure),
        depth_profile=_rows_to_nodes(block, rows),
        density=nodal_density(solution, displacement, stride),
        stride=stride,
    )


def strain_intensity(
    block: Block, material: Material, frequencies: Real, displacement: list[Complex]
) -> Intensity:
    """Integrate the squared strain amplitudes over the cells of one column, by quadrature.

    Parameters
    ----------
    frequencies : ndarray, shape (n,)
        rad/s.
    displacement : list of ndarray, each of shape (2, m)
        Amplitudes of the rows of nodes, mm, for the first m harmonics.
    """
    quadrature = block.quadrature()
    matrix = quadrature.strain_matrix().astype(complex)
    harmonics = frequencies / frequencies[0] if len(frequencies) else frequencies
    turn = np.exp(2j * np.pi / block.columns * harmonics)
    thickness = material.thickness_ratio(frequencies, block.plane)
    shear, volume = (np.zeros((block.rows, len(frequencies))) for _ in range(2))
    for row in range(block.rows):
        low, high = displacement[row], displacement[row + 1]
        count = low.shape[1]
        nodes = np.zeros((4, 2, count), dtype=complex)
        nodes[0], nodes[1] = low, low * turn[:count]
        nodes[2, :, : high.shape[1]] = high
        nodes[3, :, : high.shape[1]] = high * turn[: high.shape[1]]
        strain = matrix[row] @ nodes.reshape(8, count)
        weights = quadrature.weights[row]
        shear[row, :count], volume[row, :count] = _squares(strain, weights, thickness[:count], block.plane)
    return Intensity(shear, volume)


def _squares(strain: Complex, weights: Real, thickness: Complex, plane: str) -> tuple[Real, Real]:
    """Return the integrals of e : e* and |tr|² over a cell from strains of shape (points, 3, n)."""
    flat = strain[:, 0] + strain[:, 1]
    across = thickness * flat
    dilatation = flat + across
    total = _square(strain[:, 0]) + _square(strain[:, 1]) + 2.0 * _square(strain[:, 2]) + _square(across)
    shear = weights @ (total - _square(dilatation) / 3.0)
    if plane == "strain":  # dilatation acts through its mean over the cell
        return shear, weights.sum() * _square(weights @ dilatation / weights.sum())
    return shear, weights @ _square(dilatation)


def _square(amplitude: Complex) -> Real:
    return amplitude.real**2 + amplitude.imag**2


def stress_power(material: Material, frequencies: Real, intensity: Intensity) -> Real:
    """Return w Im(stress x strain*), N/s per mm of thickness and harmonic, shape (rows, n)."""
    shear, bulk = material.complex_shear_modulus(frequencies), material.complex_bulk_modulus(frequencies)
    return frequencies * (2.0 * shear.imag * intensity.shear + bulk.imag * intensity.volume)


def viscous_dissipation(material: Material, frequencies: Real, intensity: Intensity) -> Real:
    """Return sum_i (2 G_i |e - e_i|² + K_i |tr - tr_i|²) / tau_i, N/s per mm and harmonic, shape (rows, n)."""
    rates = 1.0 / np.asarray(material.relaxation_times, dtype=float)
    carried = _square(material.branch_transfer(frequencies))
    shear = (material.branch_shear_moduli * rates) @ carried
    bulk = (material.branch_bulk_moduli * rates) @ carried
    return 2.0 * shear * intensity.shear + bulk * intensity.volume


def stored_energy(material: Material, frequencies: Real, intensity: Intensity) -> Real:
    """Return the energy in all springs, N mm per mm and harmonic (twice its mean's share), shape (rows, n)."""
    carried = _square(material.branch_transfer(frequencies))
    shear = material.long_term_shear_modulus + material.branch_shear_moduli @ carried
    bulk = material.long_term_bulk_modulus + material.branch_bulk_moduli @ carried
    return shear * intensity.shear + 0.5 * bulk * intensity.volume


def _rows_to_nodes(block: Block, rows: Real) -> Real:
    """Average a quantity of the rows of cells to the rows of nodes, by area."""
    heights = np.diff(block.row_positions)
    total, area = np.zeros(block.rows + 1), np.zeros(block.rows + 1)
    for side in (slice(None, -1), slice(1, None)):
        total[side] += heights * rows
        area[side] += heights
    return total / area


def output_stride(columns: int, most: int) -> int:
    """Return the least divisor of ``columns`` that leaves at most ``most`` columns."""
    return next(stride for stride in range(1, columns + 1) if columns % stride == 0 and columns // stride <= most)


def nodal_density(solution: SteadySolution, displacement: list[Complex], stride: int) -> Real:
    """Return the stored strain-energy density, MPa, at the nodes of every ``stride``-th column.

    Each spring of the model carries its own share of the strain; their energies, at the quadrature points of
    the cells around a node, are averaged to it by area.

    Returns
    -------
    ndarray, shape (rows + 1, columns / stride)
    """
    block, material = solution.block, solution.scene.material
    quadrature = block.quadrature()
    cells = _CellsAroundNodes(block, stride)
    thickness = material.thickness_ratio(solution.frequencies, block.plane)
    energy = np.zeros((2, *quadrature.weights.shape, block.columns // stride))
    for shear, bulk, transfer, rest in _springs(solution):
        carried = cells.strain(displacement, transfer, quadrature)
        carried[:, :, :, 1] += rest[1]
        across = np.full(energy.shape, rest[2])
        if block.plane == "stress":
            across += cells.dilatation(displacement, transfer * thickness, quadrature)
        energy += _spring_energy(carried, across, shear, bulk, quadrature.weights, block.plane)
    return cells.average(energy, quadrature)


def _springs(solution: SteadySolution) -> list[tuple[float, float, Complex, tuple[float, float, float]]]:
    """Return for each spring its shear and bulk modulus, its share of the harmonics, and its strain at rest.

    Only the long-term spring carries the mean state: the block pressed between tied sides.
    """
    scene, material = solution.scene, solution.scene.material
    pressed = -scene.pressure / material.confined_modulus(scene.plane)
    across = float(material.thickness_ratio(0.0, scene.plane).real) * pressed
    ones = np.ones(len(solution.frequencies), dtype=complex)
    springs = [
        (material.long_term_shear_modulus, material.long_term_bulk_modulus, ones, (0.0, pressed, across))
    ]
    branches = zip(
        material.branch_shear_moduli,
        material.branch_bulk_moduli,
        material.branch_transfer(solution.frequencies),
        strict=True,
    )
    springs += [(float(shear), float(bulk), transfer, (0.0, 0.0, 0.0)) for shear, bulk, transfer in branches]
    return springs


def _spring_energy(
    strain: Real, across: Real, shear: float, bulk: float, weights: Real, plane: str
) -> Real:
    """Return G e : e + K tr² / 2, MPa, from strains of shape (side, rows, points, 3, m) and across (no 3)."""
    dilatation = strain[..., 0, :] + strain[..., 1, :] + across
    squared = strain[..., 0, :] ** 2 + strain[..., 1, :] ** 2 + 2.0 * strain[..., 2, :] ** 2 + across**2
    deviator = squared - dilatation**2 / 3.0
    if plane == "strain":
        share = weights / weights.sum(axis=1, keepdims=True)
        dilatation = np.einsum("rp,srpm->srm", share, dilatation)[:, :, None]
    return shear * deviator + 0.5 * bulk * dilatation**2


class _CellsAroundNodes:
    """Real fields in the cells to the left (side 0) and right (side 1) of every ``stride``-th column of nodes."""

    def __init__(self, block: Block, stride: int) -> None:
        nodes = np.arange(0, block.columns, stride)
        self._block = block
        self._left = np.stack(((nodes - 1) % block.columns, nodes))
        self._right = np.stack((nodes, (nodes + 1) % block.columns))

    def _cells(self, displacement: list[Complex], factor: Complex) -> Real:
        """Return the displacements of the cells' nodes, shape (side, rows, 8, m), mm."""
        spectrum = np.zeros((len(displacement), 2, len(factor)), dtype=complex)
        for row, amplitude in enumerate(displacement):
            spectrum[row, :, : amplitude.shape[1]] = amplitude * factor[: amplitude.shape[1]]
        field = synthesise(spectrum, self._block.columns)
        left, right = (field[..., columns].transpose(2, 0, 1, 3) for columns in (self._left, self._right))
        return np.concatenate((left[:, :-1], right[:, :-1], left[:, 1:], right[:, 1:]), axis=2)

    def strain(self, displacement: list[Complex], factor: Complex, quadrature: Quadrature) -> Real:
        """Return strains xx, yy, xy at the quadrature points, shape (side, rows, points, 3, m)."""
        matrix = quadrature.strain_matrix()
        rows, points = quadrature.weights.shape
        strain = matrix.reshape(rows, 3 * points, 8) @ self._cells(displacement, factor)
        return strain.reshape(2, rows, points, 3, -1)

    def dilatation(self, displacement: list[Complex], factor: Complex, quadrature: Quadrature) -> Real:
        """Return xx + yy at the quadrature points, shape (side, rows, points, m)."""
        matrix = quadrature.strain_matrix()
        return (matrix[:, :, 0] + matrix[:, :, 1]) @ self._cells(displacement, factor)

    def average(self, density: Real, quadrature: Quadrature) -> Real:
        """Average a density at the quadrature points, shape (side, rows, points, m), to the nodes by area."""
        share = quadrature.shapes.T[:, None] * quadrature.weights  # (corner, rows, points)
        total = np.zeros((self._block.rows + 1, density.shape[-1]))
        area = np.zeros(self._block.rows + 1)
        for side, corner in ((0, 1), (1, 0)):  # a node is the right corner of its left cell
            for level, part in ((0, slice(None, -1)), (2, slice(1, None))):
                weight = share[corner + level]
                total[part] += np.einsum("rp,rpm->rm", weight, density[side])
                area[part] += weight.sum(axis=1)
        return total / area[:, None]


def synthesise(amplitude: Complex, columns: int) -> Real:
    """Return the real field at all columns from the amplitudes of harmonics 1, 2, ... along the last axis.

    Parameters
    ----------
    amplitude : ndarray of complex, shape (..., n)
    columns : int
        N; harmonics beyond those given are zero.

    Returns
    -------
    ndarray, shape (..., columns)
    """
    spectrum = np.zeros((*amplitude.shape[:-1], columns // 2 + 1), dtype=complex)
    spectrum[..., 1 : amplitude.shape[-1] + 1] = amplitude
    return np.fft.irfft(spectrum, columns) * columns
