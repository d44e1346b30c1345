"""Friction from energy in small strain: three routes to one number, and the strain energy stored in the block.

1. Stress power (Zhou, Wang and Wei 2019, eq. 4): F v = mean over a cycle of the integral of stress x strain rate.
2. Viscous dissipation of the branches: F v = mean of the integral of sum_i 2 G_i |e - e_i|² / tau_i, never negative.
3. Contact: F = sum over the surface of pressure x slope of the road.

The friction coefficient is F / (p lambda). The means are exact sums over harmonics (Parseval), so the first two
routes, complex moduli against Maxwell elements one by one, differ by round-off. The third differs from them by the
discretisation of the contact: their difference shows whether the mesh resolves its edges, not how well the rows of
cells resolve the depth.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rubfric.arrays import Complex, Real
from rubfric.mechanics.small.steady import SmallSolution
from rubfric.mechanics.small.strain import StrainHarmonics, harmonic_strain, synthesise
from rubfric.mechanics.steady.energies import Energies, output_stride, rows_to_nodes
from rubfric.rubber.material import Material


def evaluate_small(solution: SmallSolution) -> Energies:
    """Return the friction coefficient by three routes and the stored strain energy of a solved scene."""
    scene, block, frequencies = solution.scene, solution.block, solution.frequencies
    material = solution.folding.material
    displacement = solution.response.displacement(solution.surface)
    thickness = material.thickness_ratio(frequencies, scene.plane)
    strain = harmonic_strain(block, solution.response, thickness, displacement)
    # An amplitude counts for a harmonic and for its conjugate.
    scale = 2.0 * block.columns / (scene.velocity * scene.pressure * block.width)
    power = stress_power(material, frequencies, strain).sum()
    lost = viscous_dissipation(material, frequencies, strain).sum()
    stored = 2.0 * stored_energy(material, frequencies, strain).sum(axis=1)
    heights = np.diff(block.row_positions)
    rest = scene.pressure**2 / (2.0 * material.confined_modulus(scene.plane))
    slope = scene.road.slope(block.column_positions)
    stride = output_stride(scene, block.columns, block.rows + 1)
    return Energies(
        stress_power=float(scale * power),
        dissipation=float(scale * lost),
        contact=float(np.mean(solution.contact.pressure * slope) / scene.pressure),
        depth_profile=rows_to_nodes(heights, rest + stored / (heights * block.column_width)),
        density=nodal_density(solution, strain, thickness, block.columns // stride),
        displacement=_displacement(solution, displacement, block.columns // stride),
    )


def stress_power(material: Material, frequencies: Real, strain: StrainHarmonics) -> Real:
    """Return w Im(stress x strain*), N/s per mm of thickness and harmonic, shape (rows, n).

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        Of the harmonics, rad/s.
    strain : StrainHarmonics
    """
    shear, bulk = material.complex_shear_modulus(frequencies), material.complex_bulk_modulus(frequencies)
    return frequencies * (2.0 * shear.imag * strain.shear_square + bulk.imag * strain.volume_square)


def viscous_dissipation(material: Material, frequencies: Real, strain: StrainHarmonics) -> Real:
    """Return sum_i (2 G_i |e - e_i|² + K_i |tr - tr_i|²) / tau_i, N/s per mm and harmonic, shape (rows, n).

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        Of the harmonics, rad/s.
    strain : StrainHarmonics
    """
    rates = 1.0 / np.asarray(material.relaxation_times, dtype=float)
    carried = np.abs(material.branch_transfer(frequencies)) ** 2
    shear = (material.branch_shear_moduli * rates) @ carried
    bulk = (material.branch_bulk_moduli * rates) @ carried
    return 2.0 * shear * strain.shear_square + bulk * strain.volume_square


def stored_energy(material: Material, frequencies: Real, strain: StrainHarmonics) -> Real:
    """Return the energy G |e|² + K |tr|² / 2 of all springs, N mm per mm and harmonic, shape (rows, n).

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        Of the harmonics, rad/s.
    strain : StrainHarmonics
    """
    carried = np.abs(material.branch_transfer(frequencies)) ** 2
    shear = material.long_term_shear_modulus + material.branch_shear_moduli @ carried
    bulk = material.long_term_bulk_modulus + material.branch_bulk_moduli @ carried
    return shear * strain.shear_square + 0.5 * bulk * strain.volume_square


def nodal_density(solution: SmallSolution, strain: StrainHarmonics, thickness: Complex, columns: int) -> Real:
    """Return the stored strain-energy density, MPa, at the nodes of evenly spread columns.

    Each spring of the model carries its own share of the nodal strains, which are recovered from the
    quadrature points; the long-term spring also carries the mean state, the block pressed between tied sides.

    Parameters
    ----------
    solution : SmallSolution
    strain : StrainHarmonics
    thickness : ndarray of complex, shape (n,)
        Strain across the thickness over in-plane dilatation.
    columns : int
        Of the output.

    Returns
    -------
    ndarray, shape (rows + 1, columns)
    """
    scene, material = solution.scene, solution.folding.material
    pressed = -scene.pressure / material.confined_modulus(scene.plane)
    across = float(material.thickness_ratio(0.0, scene.plane).real) * pressed
    ones = np.ones_like(solution.frequencies)[None]
    transfer = np.concatenate((ones, material.branch_transfer(solution.frequencies)))[:, None]
    shear = np.concatenate(([material.long_term_shear_modulus], material.branch_shear_moduli))
    bulk = np.concatenate(([material.long_term_bulk_modulus], material.branch_bulk_moduli))
    density = np.zeros((len(strain.nodal), columns))
    for rows, count in _node_bands(solution):
        amplitude = strain.nodal[rows, :, :count].swapaxes(0, 1)
        springs = transfer[..., :count]
        xx, yy, xy, dilatation = (synthesise(component * springs, strain.harmonics, columns) for component in amplitude)
        zz = np.zeros_like(xx)
        if scene.plane == "stress":
            zz = synthesise(amplitude[3] * (springs * thickness[:count]), strain.harmonics, columns)
        yy[0] += pressed
        zz[0] += across
        dilatation[0] += pressed
        deviator = xx * xx + yy * yy + 2.0 * xy * xy + zz * zz - (xx + yy + zz) ** 2 / 3.0
        density[rows] = np.tensordot(shear, deviator, 1) + 0.5 * np.tensordot(bulk, (dilatation + zz) ** 2, 1)
    return density


def _node_bands(solution: SmallSolution) -> Iterator[tuple[slice, int]]:
    """Group the rows of nodes as ``HarmonicResponse.bands`` groups the rows of cells; the last has the top."""
    for rows, count in solution.response.bands():
        top = rows.stop == solution.block.rows
        yield slice(rows.start, rows.stop + 1 if top else rows.stop), count


def _displacement(solution: SmallSolution, displacement: Complex, columns: int) -> Real:
    """Return the displacement, mm, at the nodes of evenly spread columns, shape (rows + 1, 2, columns)."""
    scene, block = solution.scene, solution.block
    field = synthesise(displacement, solution.response.harmonics, columns)
    pressed = -scene.pressure / scene.material.confined_modulus(scene.plane)
    field[:, 1] += solution.contact.offset + pressed * block.row_positions[:, None]
    return field
