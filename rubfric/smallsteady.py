"""Steady sliding of one scene in small strain: which mesh it needs, its contact, and its displacements."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import next_fast_len

from rubfric.arrays import Complex, Flags, Real
from rubfric.block import Block
from rubfric.contact import full_contact, solve_contact
from rubfric.folding import fold_scene
from rubfric.reference import full_contact_pressure, layer_compliance, westergaard_contact_fraction
from rubfric.scene import COLUMNS_PER_HEIGHT, Scene
from rubfric.smallstrain import HarmonicResponse, respond
from rubfric.solution import Decision, SteadySolution

# The search for a mesh starts at this many columns and doubles until this many nodes touch.
_SCOUT_COLUMNS = 64
_SCOUT_NODES = 16
# A mesh is a multiple of this many columns, so that the crest, the trough and both flanks fall on nodes.
_COLUMN_STEP = 8
# The first guess of the contact: that of an elastic half-space, this much wider.
_FIRST_GUESS = 1.2
# Full contact is not looked for below this share of the pressure that fills the road under a closed-form layer.
_FULL_CONTACT_FROM = 0.9
# Share of the contact nodes asked for that a mesh may miss, since their number is known only afterwards.
_SHORTFALL = 0.1


@dataclass(frozen=True, kw_only=True)
class SmallSolution(SteadySolution):
    """Steady sliding in small strain.

    Attributes
    ----------
    response : HarmonicResponse
        The block's harmonics that take part.
    surface : ndarray of complex, shape (n,)
        Amplitudes of u_y at the surface, mm, for the harmonics of ``response``.
    """

    response: HarmonicResponse
    surface: Complex

    @property
    def frequencies(self) -> Real:
        """Angular frequencies n k v, rad/s, of the harmonics that take part, shape (n,)."""
        return self.response.harmonics * self.scene.road.excitation_frequency(self.scene.velocity)

    @property
    def compression(self) -> float:
        """P over the modulus of confined compression, dimensionless; it may exceed 1."""
        return self.scene.pressure / self.scene.material.confined_modulus(self.scene.plane)

    @property
    def pressed_energy(self) -> float:
        """Strain-energy density of the relaxed block on a flat road under the load, MPa."""
        return 0.5 * self.scene.pressure * self.compression


def solve_small(scene: Scene, decision: Decision) -> SmallSolution:
    """Slide a block steadily over its scale of the road.

    The mesh follows the scene: full contact needs one harmonic and no contact solve; otherwise a closed-form
    layer scouts the contact, and the block gets as many columns as put ``numerics.contact_nodes`` nodes in it.

    Raises
    ------
    NotConverged
        With the scene's name, step and residual.
    """
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    if scene.pressure >= _FULL_CONTACT_FROM * filling:
        filled = _solve_full(scene, decision)
        if filled is not None:
            return filled
    columns, touching, iterations = scout(scene, filling)
    while True:
        solution = _solve_partial(scene, decision, columns, touching, iterations)
        finer = columns_needed(scene, np.count_nonzero(solution.contact.touching) / columns)
        if solution.resolved or finer <= columns:
            return solution
        columns, touching, iterations = finer, solution.contact.touching, solution.iterations


def _solve_partial(scene: Scene, decision: Decision, columns: int, touching: Flags, iterations: int) -> SmallSolution:
    """Return the solution on a mesh of some columns, from a guess of the contact and the steps taken for it."""
    block = _mesh(scene, columns)
    folding = fold_scene(scene, block.harmonics[1:])
    response = respond(block, folding.material, scene.velocity, block.harmonics[1:])
    spectrum = np.concatenate(([0.0], response.compliance))
    profile = scene.road.height(block.column_positions)
    contact = solve_contact(spectrum, profile, scene.pressure, _carry(touching, columns), scene.name)
    surface = response.compliance * np.fft.rfft(contact.pressure)[1:] / columns
    surface[-1] = 0.5 * surface[-1].real  # the last harmonic is its own conjugate
    wanted = (1.0 - _SHORTFALL) * min(scene.numerics.contact_nodes, columns)
    resolved = bool(np.count_nonzero(contact.touching) >= wanted)
    return SmallSolution(
        scene=scene,
        decision=decision,
        folding=folding,
        block=block,
        contact=contact,
        iterations=iterations + contact.iterations,
        resolved=resolved,
        history=(f"{columns} columns: contact found in {contact.iterations} pivoting steps",),
        response=response,
        surface=surface,
    )


def _solve_full(scene: Scene, decision: Decision) -> SmallSolution | None:
    """Return the solution in full contact, which needs the first harmonic only, or None."""
    block = _mesh(scene, columns_needed(scene, 1.0))
    folding = fold_scene(scene, np.array([1]))
    response = respond(block, folding.material, scene.velocity, np.array([1]))
    spectrum = np.zeros(len(block.harmonics), dtype=complex)
    spectrum[1] = response.compliance[0]
    contact = full_contact(spectrum, scene.road.height(block.column_positions), scene.pressure)
    if contact is None:
        return None
    surface = np.array([-0.5j * scene.road.amplitude])
    return SmallSolution(
        scene=scene,
        decision=decision,
        folding=folding,
        block=block,
        contact=contact,
        iterations=0,
        resolved=True,
        history=("full contact: one harmonic, no contact solve",),
        response=response,
        surface=surface,
    )


def _mesh(scene: Scene, columns: int) -> Block:
    numerics = scene.numerics
    return Block.graded(
        scene.road.wavelength, scene.height, columns, scene.plane, numerics.row_growth, numerics.first_row
    )


def scout(scene: Scene, filling: float) -> tuple[int, Flags, int]:
    """Return the columns that the scene needs, a first guess of the contact, and the steps it took.

    The layer's closed-form compliance stands in for the block; each mesh starts from the one before.
    ``filling`` is the pressure, MPa, that fills the road under it.
    """
    road = scene.road
    columns, iterations = _SCOUT_COLUMNS, 0
    guess = _FIRST_GUESS * float(westergaard_contact_fraction(scene.pressure / filling))
    from_crest = np.abs((np.arange(columns) / columns + 0.25) % 1.0 - 0.5)  # in wavelengths
    touching = from_crest <= 0.5 * guess
    while True:
        harmonics = np.arange(1, columns // 2 + 1)
        compliance = layer_compliance(scene.material, road, scene.velocity, scene.height, scene.plane, harmonics)
        profile = road.height(road.wavelength / columns * np.arange(columns))
        spectrum = np.concatenate(([0.0], compliance))
        contact = solve_contact(spectrum, profile, scene.pressure, _carry(touching, columns), scene.name)
        iterations += contact.iterations
        touching = contact.touching
        count = int(np.count_nonzero(touching))
        if count >= _SCOUT_NODES or columns >= scene.numerics.columns_max:
            return columns_needed(scene, count / columns), touching, iterations
        columns = min(2 * columns, scene.numerics.columns_max)


def columns_needed(scene: Scene, fraction: float) -> int:
    """Return the columns that a scene with some contact fraction needs, fit for the mesh and for its transform."""
    numerics = scene.numerics
    needed = max(numerics.columns_min, numerics.contact_nodes / fraction, COLUMNS_PER_HEIGHT / scene.aspect)
    steps = int(next_fast_len(math.ceil(needed / _COLUMN_STEP), real=True))
    return min(_COLUMN_STEP * steps, numerics.columns_max)


def _carry(touching: Flags, columns: int) -> Flags:
    """Return a contact on another number of columns, widened by one of its own nodes on either side."""
    wide = touching | np.roll(touching, 1) | np.roll(touching, -1)
    return wide[np.arange(columns) * len(wide) // columns]
