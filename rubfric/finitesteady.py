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
from rubfric.reference import full_contact_pressure, westergaard_contact_fraction
from rubfric.scene import COLUMNS_PER_HEIGHT, Scene
from rubfric.slidingcontact import Correction, Road, SlidingContact
from rubfric.solution import Decision, SteadySolution

# The first mesh: this many columns and this growth of its rows, or as many columns as put these nodes into contact.
_COARSE_COLUMNS = 64
_COARSE_GROWTH = 1.3
_COARSE_NODES = 8
# A mesh has at most this many times the columns of the one before.
_REFINEMENT = 4
_COLUMN_STEP = 8
# Share of the contact nodes asked for that a mesh may miss, since their number is known only afterwards.
_SHORTFALL = 0.1
# Distance from balance and contact at which a solution is one: root mean square, over the road's amplitude.
_TOLERANCE = 1e-5
# On a flat road displacements count by this share of a wavelength instead.
_FLAT = 1e-8


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
    # The first mesh is coarse in depth also where it has all the columns that are needed.
    final = False
    while not final or (finer := _next_columns(scene, problem, solved)) > columns:
        columns = finer if final else _next_columns(scene, problem, solved)
        final = True
        before, (problem, flat) = problem, _meshed(scene, columns, numerics.row_growth)
        guess = prolong(solved.fields, before.finite, problem.finite)
        touching = _carry(solved.correction.contact.touching, columns)
        try:
            solved = attempt(
                problem, Start(guess, touching), _road(scene), _TOLERANCE, history, f"{columns} columns, from coarser"
            )
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
        fields=solved.fields,
        correction=solved.correction,
    )


def _road(scene: Scene) -> Road:
    return Road(scene.road.amplitude, scene.road.wavenumber, scene.pressure)


def _meshed(scene: Scene, columns: int, growth: float) -> tuple[SlidingContact, Start]:
    """Return the contact problem on a mesh, and its solution on a flat road."""
    road = scene.road
    block = Block.graded(road.wavelength, scene.height, columns, scene.plane, growth, scene.numerics.first_row)
    material = fold_scene(scene, block.harmonics[1:]).material
    finite = FiniteBlock(block, material, scene.velocity)
    stretch, thickness = pressed(material, scene.pressure, scene.plane)
    fields = finite.at_rest()
    fields.displacement[1] = (stretch - 1.0) * block.row_positions[:, None]
    fields.log_thickness[:] = math.log(thickness)
    unit = max(road.amplitude, _FLAT * road.wavelength)
    problem = SlidingContact(finite, (unit, unit * road.wavenumber), scene.name)
    return problem, Start(fields, np.ones(columns, dtype=bool))


def _first_columns(scene: Scene) -> int:
    """Return the columns of the first mesh, from the contact of an elastic half-space."""
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    fraction = float(westergaard_contact_fraction(scene.pressure / filling)) if filling > 0.0 else 1.0
    needed = max(_COARSE_COLUMNS, _COARSE_NODES / fraction, COLUMNS_PER_HEIGHT / scene.aspect)
    return _fit(scene, needed)


def _next_columns(scene: Scene, problem: SlidingContact, solved: Solved) -> int:
    """Return the columns of the mesh to follow; no more than there are where the contact is resolved."""
    numerics, columns = scene.numerics, problem.finite.block.columns
    touching = np.count_nonzero(solved.correction.contact.touching)
    if columns >= numerics.finite_columns_min and touching >= (1.0 - _SHORTFALL) * min(
        numerics.finite_contact_nodes, columns
    ):
        return columns
    needed = max(numerics.finite_columns_min, numerics.finite_contact_nodes * columns / touching)
    return _fit(scene, min(needed, _REFINEMENT * columns))


def _fit(scene: Scene, columns: float) -> int:
    steps = int(next_fast_len(math.ceil(columns / _COLUMN_STEP), real=True))
    return min(_COLUMN_STEP * steps, scene.numerics.columns_max)


def _carry(touching: Flags, columns: int) -> Flags:
    """Return contact nodes on another number of columns."""
    return touching[np.arange(columns) * len(touching) // columns]


def prolong(fields: Fields, old: FiniteBlock, new: FiniteBlock) -> Fields:
    """Return fields of one mesh on another: by harmonics along the road, linearly over the height."""
    return Fields(
        _over_height(
            _along_road(fields.displacement, new.block.columns, 0.0), old.block.row_positions, new.block.row_positions
        ),
        _between_points(fields.log_thickness, old, new),
    )


def _between_points(field: Real, old: FiniteBlock, new: FiniteBlock) -> Real:
    """Return a field at the quadrature points of one mesh at those of another."""
    # The points stand half a column to the right of the nodes.
    shift = 0.5 / new.block.columns - 0.5 / old.block.columns
    along = _along_road(field, new.block.columns, shift)
    parts, columns = len(field), new.block.columns
    stacked = along.swapaxes(1, 2).reshape(parts, old.block.rows * old.points, columns)
    moved = _over_height(stacked, _point_heights(old), _point_heights(new))
    return moved.reshape(parts, new.block.rows, new.points, columns).swapaxes(1, 2)


def _point_heights(finite: FiniteBlock) -> Real:
    """Return the heights of the quadrature points, mm, upwards."""
    rows = finite.block.row_positions
    share = finite.quadrature.shapes[:, 2:].sum(axis=1)
    return (rows[:-1, None] + np.diff(rows)[:, None] * share).ravel()


def _along_road(field: Real, columns: int, shift: float) -> Real:
    """Return a periodic field on another number of columns, shifted by a share of the wavelength."""
    before = field.shape[-1]
    spectrum = np.fft.rfft(field, axis=-1)
    spectrum[..., -1] = 0.0  # its phase is unknown
    spectrum *= np.exp(2j * np.pi * shift * np.arange(before // 2 + 1))
    answer: Real = np.fft.irfft(spectrum[..., : columns // 2 + 1], columns, axis=-1)
    return answer * (columns / before)


def _over_height(field: Real, old: Real, new: Real) -> Real:
    """Return a field, rows last but one, at other heights."""
    below = np.clip(np.searchsorted(old, new, side="right") - 1, 0, len(old) - 2)
    share = ((new - old[below]) / (old[below + 1] - old[below]))[:, None]
    return field[..., below, :] * (1.0 - share) + field[..., below + 1, :] * share
