"""Steady sliding of one scene in small strain: which mesh it needs, its contact, and its displacements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Complex, Flags, Real
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.contact import Contact, full_contact, solve_contact
from rubfric.mechanics.small.response import HarmonicResponse, respond
from rubfric.mechanics.steady.refinement import SHORTFALL, refined
from rubfric.mechanics.steady.resolution import Resolution, count_spots, fit, needed, wanted_nodes
from rubfric.mechanics.steady.solution import Friction, SteadySolution, fold_scene
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.mechanics.theory.layer import full_contact_pressure, layer_compliance
from rubfric.mechanics.theory.limits import estimated_fraction, near_crests
from rubfric.road.road import finest_waves, fourier_series
from rubfric.rubber.pruning import Folding
from rubfric.scene.scene import Scene

# The search for a mesh starts at this many columns and doubles until this many nodes touch.
_SCOUT_COLUMNS = 64
_SCOUT_NODES = 16
# On a road of many waves it starts at so many columns to the finest.
_PER_WAVE = 8
# The first guess of the contact: that of an elastic half-space, this much wider.
_FIRST_GUESS = 1.2
# Full contact is not looked for below this share of the pressure that fills the road under a closed-form layer.
_FULL_CONTACT_FROM = 0.9


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
        return self.block.wavenumbers[self.response.harmonics] * self.scene.velocity

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

    Full contact needs the harmonics of the road and no contact solve; otherwise a closed-form layer scouts the
    contact. The mesh follows from it, and is refined as ``rubfric.mechanics.steady.refinement`` says.

    Parameters
    ----------
    scene : Scene
    decision : Decision

    Raises
    ------
    NotConverged
        With the scene's name, step and residual.
    """
    return refined(scene, SmallSolver(scene, decision))


class SmallSolver:
    """Solves one scene on one mesh after the other, each from the contact found before.

    Parameters
    ----------
    scene : Scene
    decision : Decision
    start : SmallSolution, optional
        Of a scene nearly the same, whose contact is the first guess.
    """

    finite = False

    def __init__(self, scene: Scene, decision: Decision, start: SmallSolution | None = None) -> None:
        self.scene = scene
        self.decision = decision
        filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
        self._may_fill = scene.pressure >= _FULL_CONTACT_FROM * filling
        self._touching: Flags | None = start.contact.touching if start else None
        self._iterations = 0
        self._history: tuple[str, ...] = ()

    def first(self) -> Resolution:
        """Return the mesh to begin with, coarser than the one that the contact seems to need."""
        if self._may_fill:
            return needed(self.scene, 1.0, self.finite).coarser(self.scene, self.finite)
        touching = self._scouted()
        wanted = needed(self.scene, float(np.mean(touching)), self.finite, count_spots(self.scene, touching))
        return wanted.coarser(self.scene, self.finite)

    def solve(self, resolution: Resolution) -> SmallSolution:
        """Return the solution on a mesh."""
        filled = self._full(resolution) if self._may_fill else None
        return filled or self._partial(resolution)

    def _partial(self, resolution: Resolution) -> SmallSolution:
        """Return the solution of the complementarity problem."""
        scene, columns = self.scene, resolution.columns
        block = resolution.block(scene)
        folding = fold_scene(scene, block.wavenumbers[1:])
        response = respond(block, folding.material, scene.velocity, block.harmonics[1:])
        spectrum = np.concatenate(([0.0], response.compliance))
        profile = scene.road.height(block.column_positions)
        contact = solve_contact(spectrum, profile, scene.pressure, _carry(self._scouted(), columns), scene.name)
        surface = response.compliance * np.fft.rfft(contact.pressure)[1:] / columns
        surface[-1] = 0.5 * surface[-1].real  # the last harmonic is its own conjugate
        self._touching = contact.touching
        self._iterations += contact.iterations
        self._history += (f"{columns} columns: contact found in {contact.iterations} pivoting steps",)
        return self._solution(block, folding, response, contact, surface)

    def _full(self, resolution: Resolution) -> SmallSolution | None:
        """Return the solution in full contact, where the surface has the harmonics of the road only, or None."""
        scene, block = self.scene, resolution.block(self.scene)
        harmonics, surface = fourier_series(scene.road)
        folding = fold_scene(scene, block.wavenumbers[harmonics])
        response = respond(block, folding.material, scene.velocity, harmonics)
        spectrum = np.zeros(len(block.harmonics), dtype=complex)
        spectrum[harmonics] = response.compliance
        contact = full_contact(spectrum, scene.road.height(block.column_positions), scene.pressure)
        if contact is None:
            return None
        self._history += (f"{block.columns} columns: full contact, no contact solve",)
        return self._solution(block, folding, response, contact, surface)

    def _solution(
        self, block: Block, folding: Folding, response: HarmonicResponse, contact: Contact, surface: Complex
    ) -> SmallSolution:
        touching, scene = contact.touching, self.scene
        wanted = min(wanted_nodes(scene, self.finite, count_spots(scene, touching)), block.columns)
        return SmallSolution(
            scene=self.scene,
            decision=self.decision,
            folding=folding,
            block=block,
            friction=_friction(self.scene, block, response, contact, surface),
            contact=contact,
            iterations=self._iterations,
            resolved=bool(np.count_nonzero(touching) >= (1.0 - SHORTFALL) * wanted),
            history=self._history,
            response=response,
            surface=surface,
        )

    def _scouted(self) -> Flags:
        """Return the contact found last, or that of a closed-form layer."""
        if self._touching is None:
            self._touching, self._iterations = scout(self.scene)
        return self._touching


def _friction(scene: Scene, block: Block, response: HarmonicResponse, contact: Contact, surface: Complex) -> Friction:
    """Return the friction coefficient by the power that the contact puts into the surface, and by its slopes.

    The former is the stress power of the block, by virtual work.
    """
    pressure = np.fft.rfft(contact.pressure)[response.harmonics] / block.columns
    wavenumber = block.wavenumbers[response.harmonics]
    power = float(np.sum(2.0 * wavenumber * (pressure.conj() * 1j * surface).real))
    slope = scene.road.slope(block.column_positions)
    return Friction(power / scene.pressure, float(np.mean(contact.pressure * slope)) / scene.pressure)


def scout(scene: Scene) -> tuple[Flags, int]:
    """Return a first guess of the contact, and the steps it took.

    The layer's closed-form compliance stands in for the block; each mesh starts from the one before.
    """
    road = scene.road
    columns, iterations = fit(scene, max(_SCOUT_COLUMNS, _PER_WAVE * finest_waves(road)), False), 0
    touching = near_crests(road, columns, _FIRST_GUESS * estimated_fraction(scene))
    while True:
        wavenumber = 2.0 * np.pi / road.period * np.arange(1, columns // 2 + 1)
        compliance = layer_compliance(scene.material, wavenumber, scene.velocity, scene.height, scene.plane)
        profile = road.height(road.period / columns * np.arange(columns))
        spectrum = np.concatenate(([0.0], compliance))
        contact = solve_contact(spectrum, profile, scene.pressure, _carry(touching, columns), scene.name)
        iterations += contact.iterations
        touching = contact.touching
        count = int(np.count_nonzero(touching))
        if count >= _SCOUT_NODES or columns >= scene.numerics.columns_max:
            return touching, iterations
        columns = min(2 * columns, scene.numerics.columns_max)


def _carry(touching: Flags, columns: int) -> Flags:
    """Return a contact on another number of columns, widened by one of its own nodes on either side."""
    wide = touching | np.roll(touching, 1) | np.roll(touching, -1)
    return wide[np.arange(columns) * len(wide) // columns]
