"""Steady sliding of one scene in finite strain: a coarse mesh first, then the one that the contact needs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.fft import next_fast_len

from rubfric.arrays import Flags, Real
from rubfric.block import Block
from rubfric.continuation import History, Start, attempt, reach
from rubfric.finiteblock import Fields, FiniteBlock
from rubfric.folding import fold_scene
from rubfric.homogeneous import pressed, stored_energy
from rubfric.newton import Solved, Stalled
from rubfric.prolongation import prolong
from rubfric.resolvable import estimated_fraction, near_crest
from rubfric.routes import ROUND_OFF, disagreement
from rubfric.scene import COLUMNS_PER_HEIGHT, Scene
from rubfric.slidingcontact import Correction, Road, SlidingContact, measures
from rubfric.solution import Decision, SteadySolution

# The first mesh: this many columns and this growth of its rows, or as many columns as put these nodes into contact.
_COARSE_COLUMNS = 64
_COARSE_GROWTH = 1.3
_COARSE_NODES = 8
# A mesh has at most this many times the columns of the one before.
_REFINEMENT = 6
_COLUMN_STEP = 8
# The first guess of the contact: that of an elastic half-space, so many times as wide.
_FIRST_GUESS = 3.0
# Two routes to friction that differ by more than this share of the accuracy ask for so many times the columns.
_CLOSURE, _FINER = 0.7, 1.5
_MOST_FINER = 3
# Columns beyond which a mesh in finite strain takes gigabytes.
MOST_COLUMNS = 4096
# Share of the contact nodes asked for that a mesh may miss, since their number is known only afterwards.
_SHORTFALL = 0.1
# Distance from balance and contact at which a solution is one: root mean square, over the road's amplitude.
_TOLERANCE = 1e-6


@dataclass(frozen=True)
class Friction:
    """The friction coefficient by stress power and by contact, and what the solver cannot tell from zero."""

    stress_power: float
    contact: float
    resolution: float

    @property
    def disagreement(self) -> float:
        """Difference of the two over the larger one."""
        return disagreement((self.stress_power, self.contact), self.resolution)


@dataclass(frozen=True, kw_only=True)
class FiniteSolution(SteadySolution):
    """Steady sliding in finite strain.

    Attributes
    ----------
    finite : FiniteBlock
        The block with its rubber, folded.
    friction : Friction
        The friction coefficient by two routes.
    fields : Fields
        Displacement and thickness.
    correction : Correction
        The state of the points, and the contact along the deformed surface.
    """

    finite: FiniteBlock
    friction: Friction
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

    @cached_property
    def _pressed(self) -> tuple[float, float]:
        return pressed(self.scene.material, self.scene.pressure, self.scene.plane)


def solve_finite(scene: Scene, decision: Decision) -> FiniteSolution:
    """Slide a block steadily over its scale of the road, in finite strain.

    Raises
    ------
    NotConverged
        Where no way leads to a solution, with the scene's name, steps and residual.
    """
    history = History()
    numerics = scene.numerics
    columns = _first_columns(scene)
    problem, flat = _meshed(scene, columns, max(numerics.row_growth, _COARSE_GROWTH))
    solved = reach(problem, flat, _road(scene), _TOLERANCE, history)
    # The first mesh is coarse in depth, also where it has all the columns that are needed.
    final, refined = numerics.row_growth >= _COARSE_GROWTH, 0
    while (finer := _next_columns(scene, problem.finite, solved, refined)) > columns or not final:
        columns, final, refined = finer, True, refined + 1
        before, (problem, flat) = problem, _meshed(scene, columns, numerics.row_growth)
        start = Start(
            prolong(solved.fields, before.finite, problem.finite), _carry(solved.correction.contact.touching, columns)
        )
        try:
            what = f"{columns} columns, from {before.finite.block.columns}"
            solved = attempt(problem, start, _road(scene), _TOLERANCE, history, what)
        except Stalled:
            solved = reach(problem, flat, _road(scene), _TOLERANCE, history)
    contact = solved.correction.contact
    wanted = (1.0 - _SHORTFALL) * min(numerics.finite_contact_nodes, columns)
    block = problem.finite.block
    return FiniteSolution(
        scene=scene,
        decision=decision,
        folding=fold_scene(scene, block.harmonics[1:]),
        block=block,
        contact=contact,
        iterations=history.steps,
        krylov=history.krylov,
        resolved=bool(np.count_nonzero(contact.touching) >= wanted),
        history=tuple(history.lines),
        finite=problem.finite,
        friction=_friction(scene, problem.finite, solved),
        fields=solved.fields,
        correction=solved.correction,
    )


def _friction(scene: Scene, finite: FiniteBlock, solved: Solved) -> Friction:
    correction, block = solved.correction, finite.block
    power = (finite.stress_power(solved.fields, correction.state) * finite.weights).sum()
    return Friction(
        stress_power=float(power / (scene.velocity * scene.pressure * block.width)),
        contact=float(np.mean(correction.contact.pressure * correction.slope) / scene.pressure),
        resolution=max(_TOLERANCE * scene.road.steepest_slope, ROUND_OFF),
    )


def _road(scene: Scene) -> Road:
    return Road(scene.road.amplitude, scene.road.wavenumber, scene.pressure)


def _meshed(scene: Scene, columns: int, growth: float) -> tuple[SlidingContact, Start]:
    """Return the contact problem on a mesh, and its solution on a flat road."""
    road = scene.road
    block = Block.graded(road.wavelength, scene.height, columns, scene.plane, growth, scene.numerics.first_row)
    material = fold_scene(scene, block.harmonics[1:]).material
    finite = FiniteBlock(block, material, scene.velocity)
    problem = SlidingContact(finite, measures(road), scene.name)
    return problem, Start(finite.pressed(scene.pressure), near_crest(columns, _FIRST_GUESS * estimated_fraction(scene)))


def _first_columns(scene: Scene) -> int:
    """Return the columns of the first mesh, from the contact of an elastic half-space."""
    needed = max(_COARSE_COLUMNS, _COARSE_NODES / estimated_fraction(scene), COLUMNS_PER_HEIGHT / scene.aspect)
    return _fit(scene, needed)


def _next_columns(scene: Scene, finite: FiniteBlock, solved: Solved, refined: int) -> int:
    """Return the columns of the mesh to follow; no more than there are where the contact is resolved.

    ``refined`` meshes have followed the first one already.
    """
    numerics, columns = scene.numerics, finite.block.columns
    touching = int(np.count_nonzero(solved.correction.contact.touching))
    needed = float(numerics.finite_columns_min)
    if touching < (1.0 - _SHORTFALL) * min(numerics.finite_contact_nodes, columns):
        needed = max(needed, numerics.finite_contact_nodes * columns / touching)
    elif refined <= _MOST_FINER and _friction(scene, finite, solved).disagreement > _CLOSURE * numerics.accuracy:
        needed = max(needed, _FINER * columns)
    return max(columns, _fit(scene, min(needed, _REFINEMENT * columns)))


def _fit(scene: Scene, columns: float) -> int:
    steps = int(next_fast_len(math.ceil(columns / _COLUMN_STEP), real=True))
    return min(_COLUMN_STEP * steps, scene.numerics.columns_max, MOST_COLUMNS)


def _carry(touching: Flags, columns: int) -> Flags:
    """Return contact nodes on another number of columns."""
    return touching[np.arange(columns) * len(touching) // columns]
