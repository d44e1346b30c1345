"""Steady sliding of one scene in finite strain: a coarse mesh first, then the one that the contact needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact, measures
from rubfric.mechanics.finite.continuation import ON_THE_WAY, AttemptLog, Start, attempt, reach
from rubfric.mechanics.finite.layers import divided
from rubfric.mechanics.finite.newton import Solved, Stalled
from rubfric.mechanics.finite.prolongation import prolong
from rubfric.mechanics.steady.energies import ROUND_OFF
from rubfric.mechanics.steady.refinement import SHORTFALL, refined
from rubfric.mechanics.steady.resolution import Resolution, count_spots, fit, needed, wanted_nodes
from rubfric.mechanics.steady.solution import Friction, SteadySolution, fold_scene
from rubfric.mechanics.theory.compression import pressed, stored_energy
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.mechanics.theory.limits import estimated_fraction, near_crests
from rubfric.road.road import finest_waves
from rubfric.rubber.pruning import Folding
from rubfric.scene.scene import Scene

# The first mesh puts this share of the nodes asked for into contact, but no fewer than so many.
_NODES, _FEWEST_NODES = 0.25, 6
# The first guess of the contact: that of an elastic half-space, so many times as wide.
_FIRST_GUESS = 3.0
# Meshes between two that may be tried where a solution cannot be carried from one to the other at once.
_BETWEEN = 2


@dataclass(frozen=True)
class _Found:
    """A solution to start from on the next mesh."""

    resolution: Resolution
    finite: FiniteBlock
    fields: Fields
    touching: Flags


@dataclass(frozen=True, kw_only=True)
class FiniteSolution(SteadySolution):
    """Steady sliding in finite strain.

    Attributes
    ----------
    finite : FiniteBlock
        The block with its rubber, folded.
    fields : Fields
        Displacement and thickness.
    correction : Correction
        The state of the points, and the contact along the deformed surface.
    """

    finite: FiniteBlock
    fields: Fields
    correction: Correction

    @property
    def surface_position(self) -> Real:
        """Where the surface nodes are, mm along the road, shape (columns,)."""
        return self.correction.position

    @property
    def surface_stretch(self) -> Real:
        """Area of the surface at its nodes, along the road and across, over that as it was made."""
        spacing = np.diff(self.correction.position, append=self.correction.position[0] + self.block.width)
        along = 0.5 * (spacing + np.roll(spacing, 1)) / self.block.column_width
        if not len(self.fields.log_thickness):
            return along
        lowest = np.exp(self.fields.log_thickness[0, 0, 0])
        return along * 0.5 * (lowest + np.roll(lowest, 1))

    @property
    def compression(self) -> float:
        """Share of its height that the load takes from the relaxed block on a flat road, dimensionless."""
        return 1.0 - self._pressed[0]

    @property
    def pressed_energy(self) -> float:
        """Strain-energy density of the relaxed block on a flat road under the load, MPa."""
        return stored_energy(self.scene.material, *self._pressed)

    @property
    def _pressed(self) -> tuple[float, float]:
        return pressed(self.scene.material, self.scene.pressure, self.scene.plane)


def solve_finite(scene: Scene, decision: Decision) -> FiniteSolution:
    """Slide a block steadily over its scale of the road, in finite strain.

    The mesh follows from the contact, and is refined as ``rubfric.mechanics.steady.refinement`` says.

    Parameters
    ----------
    scene : Scene
    decision : Decision

    Raises
    ------
    NotConverged
        Where no way leads to a solution, with the scene's name, steps and residual.
    """
    return refined(scene, FiniteSolver(scene, decision))


class FiniteSolver:
    """Solves one scene on one mesh after the other, each from the solution on the one before.

    Parameters
    ----------
    scene : Scene
    decision : Decision
    start : FiniteSolution, optional
        Of a scene nearly the same, to begin with. A mesh of as many columns and rows has its layers.
    """

    finite = True

    def __init__(self, scene: Scene, decision: Decision, start: FiniteSolution | None = None) -> None:
        self.scene = scene
        self.decision = decision
        self._load = Load(scene.road, scene.pressure)
        self._log = AttemptLog()
        self._before: _Found | None = None
        self._start = start
        if start:
            mesh = Resolution(start.block.columns, start.meshes[-1].growth)
            self._before = _Found(mesh, start.finite, start.fields, start.contact.touching)

    def first(self) -> Resolution:
        """Return the mesh to begin with, from the contact of an elastic half-space."""
        scene = self.scene
        nodes = max(_FEWEST_NODES, _NODES * scene.numerics.finite_contact_nodes)
        coarse = needed(scene, 1.0, self.finite).coarser(scene, self.finite)
        if finest_waves(scene.road) > 1:
            # On a coarser mesh, nodes that are pressed on the crest of a fine wave may slide off either way.
            return Resolution(needed(scene, 1.0, self.finite).columns, coarse.growth)
        return Resolution(
            fit(scene, max(coarse.columns, nodes / estimated_fraction(scene)), self.finite), coarse.growth
        )

    def solve(self, resolution: Resolution) -> FiniteSolution:
        """Return the solution on a mesh."""
        scene, log = self.scene, self._log
        problem, folding = self._meshed(resolution)
        finite, block = problem.finite, problem.finite.block
        solved = self._warm(problem, resolution)
        if solved is None:
            near = near_crests(scene.road, block.columns, _FIRST_GUESS * estimated_fraction(scene))
            flat = Start(finite.pressed(scene.pressure), near)
            solved = reach(problem, flat, self._load, scene.numerics.tolerance, log)
        contact = solved.correction.contact
        self._before = _Found(resolution, finite, solved.fields, contact.touching)
        wanted = min(wanted_nodes(scene, self.finite, count_spots(scene, contact.touching)), block.columns)
        return FiniteSolution(
            scene=scene,
            decision=self.decision,
            folding=folding,
            block=block,
            friction=_friction(scene, finite, solved),
            contact=contact,
            iterations=log.steps,
            krylov=log.krylov,
            resolved=bool(np.count_nonzero(contact.touching) >= (1.0 - SHORTFALL) * wanted),
            history=tuple(log.lines),
            finite=finite,
            fields=solved.fields,
            correction=solved.correction,
        )

    def _meshed(self, resolution: Resolution) -> tuple[SlidingContact, Folding]:
        """Return the contact problem on a mesh, and how the branches were folded for it."""
        scene, block = self.scene, resolution.block(self.scene)
        folding = fold_scene(scene, block.wavenumbers[1:])
        stretch, _ = pressed(scene.material, scene.pressure, scene.plane)
        start = self._start and self._start.finite
        same = start and (start.block.rows, start.block.columns) == (block.rows, block.columns)
        layers = start.layers if start and same else divided(block, stretch)
        finite = FiniteBlock(block, folding.material, scene.velocity, layers)
        return SlidingContact(finite, measures(scene.road), scene.name), folding

    def _warm(self, problem: SlidingContact, resolution: Resolution) -> Solved | None:
        """Return the solution reached from that on the mesh before, by way of meshes between if need be, or None."""
        for _ in range(_BETWEEN + 1):
            if self._before is None:
                return None
            try:
                return self._carried(problem, self._before, self.scene.numerics.tolerance)
            except Stalled:
                between = self._before.resolution.halfway(resolution, self.scene, self.finite)
                if between is None:
                    return None
                nearer, _ = self._meshed(between)
            try:
                found = self._carried(nearer, self._before, ON_THE_WAY)
            except Stalled:
                return None
            self._before = _Found(between, nearer.finite, found.fields, found.correction.contact.touching)
        return None

    def _carried(self, problem: SlidingContact, before: _Found, tolerance: float) -> Solved:
        columns = problem.finite.block.columns
        start = Start(prolong(before.fields, before.finite, problem.finite), _carry(before.touching, columns))
        what = f"{columns} columns, from {before.finite.block.columns}"
        return attempt(problem, start, self._load, tolerance, self._log, what)


def _friction(scene: Scene, finite: FiniteBlock, solved: Solved) -> Friction:
    correction, block = solved.correction, finite.block
    power = (finite.stress_power(solved.fields, correction.state) * finite.weights).sum()
    return Friction(
        stress_power=float(power / (scene.velocity * scene.pressure * block.width)),
        contact=float(np.mean(correction.contact.pressure * correction.slope) / scene.pressure),
        resolution=max(scene.numerics.tolerance * scene.road.steepest_slope, ROUND_OFF),
    )


def _carry(touching: Flags, columns: int) -> Flags:
    """Return contact nodes on another number of columns."""
    return touching[np.arange(columns) * len(touching) // columns]
