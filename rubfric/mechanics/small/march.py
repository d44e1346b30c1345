"""The block in small strain, step by step: constant stiffness, condensed to the surface, one contact a step.

Every mode of the block (``small.modes``) is a scalar Maxwell element, updated exactly for coordinates that
follow a parabola (``rubber.maxwell``). What is left of a step is one complementarity problem of the surface, of a
compliance that depends on the lengths of this step and the last. Displacements along the road are small, also at the
surface: a node stays above its place.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rubfric.arrays import Complex, Flags, Real
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.contact import MOST_STEPS, Contact, pivot
from rubfric.mechanics.block.surface import Convolution
from rubfric.mechanics.march.step import Outcome
from rubfric.mechanics.small.modes import surface_modes
from rubfric.mechanics.small.steady import SmallSolution
from rubfric.rubber.maxwell import Relaxation
from rubfric.scene.scene import Scene


@dataclass(frozen=True)
class SmallState:
    """All that the next step depends on.

    Attributes
    ----------
    modes : ndarray of complex, shape (modes,)
        Coordinates of the modes.
    behind : ndarray of complex, shape (branches, modes)
        The part of them that the springs of the branches carry.
    change : ndarray of complex, shape (modes,)
        Change of the coordinates in the last step.
    duration : float
        Length of the last step, s; infinite where there was none.
    contact : ndarray, shape (columns,)
        Contact pressure, MPa.
    surface : ndarray, shape (columns,)
        u_y at the surface, mm.
    top : float
        u_y of the top, mm.
    offset : float
        How far the road has gone past, mm.
    pressure : float
        Nominal, MPa.
    """

    modes: Complex
    behind: Complex
    change: Complex
    duration: float
    contact: Real
    surface: Real
    top: float
    offset: float
    pressure: float


@dataclass(frozen=True)
class _Step:
    """What depends on the lengths of steps only: factors, moduli of the modes, MPa, compliance of the surface."""

    lengths: tuple[float, float]
    relaxation: Relaxation
    modulus: Real
    surface: Convolution


class SmallStepper:
    """A block in small strain that a road goes past.

    Parameters
    ----------
    scene : Scene
        Road, rubber and plane; speed and load count for a start from steady sliding only.
    block : Block
    """

    def __init__(self, scene: Scene, block: Block) -> None:
        self.scene, self.block = scene, block
        material = scene.material
        self._modes = surface_modes(block)
        self._times = np.asarray(material.relaxation_times, dtype=float)
        self._relaxed = self._modes.modulus(material.long_term_shear_modulus, material.long_term_bulk_modulus)
        self._branches = self._modes.branch_moduli(material)
        # Energy and dissipation weigh the squares of real and imaginary parts, which lie side by side.
        self._spring = np.repeat(self._relaxed * self._modes.weight, 2)
        self._viscosity = np.repeat(self._branches * self._modes.weight / self._times[:, None], 2, axis=1)
        self._step: _Step | None = None
        self.state = self.at_rest()
        self.stored = 0.0

    @property
    def offset(self) -> float:
        """How far the road has gone past, mm."""
        return self.state.offset

    @property
    def pressure(self) -> float:
        """The load, MPa."""
        return self.state.pressure

    def at_rest(self) -> SmallState:
        """Return the block as it was made, laid on the crests of the road without load."""
        height, count = self._profile(0.0).max(), len(self._modes.reach)
        columns = self.block.columns
        none = np.zeros(count, dtype=complex)
        behind = np.zeros((len(self._times), count), dtype=complex)
        flat = np.full(columns, height)
        return SmallState(none, behind, none, math.inf, np.zeros(columns), flat, float(height), 0.0, 0.0)

    def press_relaxed(self, pressure: float) -> None:
        """Bring the block into the state that infinitely slow pressing leaves, MPa."""
        surface = self._convolution(self._relaxed)
        contact = pivot(surface, self._profile(0.0), pressure, self._flags(), self.scene.name, MOST_STEPS)
        modes = self._forces(contact.pressure, pressure) / self._relaxed
        self._start(modes, np.zeros_like(self.state.behind), contact, pressure)

    def slide_steadily(self, solution: SmallSolution) -> None:
        """Bring the block into the state of a steady solution of this scene on this mesh."""
        scene, contact = self.scene, solution.contact
        transfer = scene.material.branch_transfer(self.block.wavenumbers[self._modes.harmonic] * scene.velocity)
        modulus = self._relaxed + (self._branches * transfer).sum(axis=0)
        modes = self._forces(contact.pressure, scene.pressure) / modulus
        self._start(modes, transfer * modes, contact, scene.pressure)

    def _start(self, modes: Complex, behind: Complex, contact: Contact, pressure: float) -> None:
        self.state = self._loaded(modes, behind, np.zeros_like(modes), math.inf, contact, 0.0, pressure)
        self.stored = self._stored(self.state)

    def advance(self, duration: float, offset: float, pressure: float) -> Outcome:
        """Go one step: the road to an offset, mm, and the load to a pressure, MPa, in a duration, s.

        Parameters
        ----------
        duration : float
            s.
        offset : float
            How far the road has gone past at the end, mm.
        pressure : float
            Nominal, at the end, MPa.

        Raises
        ------
        NotConverged
            Where no contact is found; the state stays what it was.
        """
        old, step = self.state, self._prepared(duration)
        relaxation = step.relaxation
        kept = relaxation.decay[:, None] * old.behind - relaxation.lag[:, None] * old.change
        history = (self._branches * kept).sum(axis=0) - (relaxation.share @ self._branches) * old.modes
        # The road less what the surface does without contact; and the nodes now where contact was on the road.
        profile = self._profile(offset) - self._surface(-history / step.modulus)
        touching = np.roll(old.contact > 0.0, -round((offset - old.offset) / self.block.column_width))
        contact = pivot(step.surface, profile, pressure, self._flags(touching), self.scene.name, MOST_STEPS)
        modes = (self._forces(contact.pressure, pressure) - history) / step.modulus
        change = modes - old.modes
        behind = kept + relaxation.share[:, None] * change
        self.state = self._loaded(modes, behind, change, duration, contact, offset, pressure)
        return self._outcome(old, step, contact)

    def _loaded(
        self,
        modes: Complex,
        behind: Complex,
        change: Complex,
        duration: float,
        contact: Contact,
        offset: float,
        pressure: float,
    ) -> SmallState:
        top = contact.offset + float(self._modes.surface(modes)[0].real) * self.block.height
        surface = contact.offset + self._surface(modes)
        return SmallState(modes, behind, change, duration, contact.pressure, surface, top, offset, pressure)

    def _outcome(self, old: SmallState, step: _Step, contact: Contact) -> Outcome:
        new, block = self.state, self.block
        before, self.stored = self.stored, self._stored(new)
        force = 0.5 * (old.contact + new.contact) * block.column_width
        slope = self.scene.road.slope(block.column_positions + new.offset)
        return Outcome(
            friction=float(np.mean(new.contact * slope) / new.pressure),
            road_work=float(force @ (new.surface - old.surface)),
            load_work=-0.5 * (old.pressure + new.pressure) * block.width * (new.top - old.top),
            stored=self.stored,
            stored_change=self.stored - before,
            dissipated=self._dissipated(old, step.relaxation),
            contact_fraction=float(np.count_nonzero(new.contact)) / block.columns,
            top=new.top,
            iterations=contact.iterations,
            krylov=0,
        )

    def _stored(self, state: SmallState) -> float:
        """Return the energy stored in the block, N mm per mm of thickness."""
        modes, behind = state.modes.view(float), state.behind.view(float)
        springs = np.einsum("bm,bm,bm->b", self._viscosity, behind, behind) @ self._times
        return float(0.5 * (self._spring @ (modes * modes) + springs))

    def _dissipated(self, old: SmallState, relaxation: Relaxation) -> float:
        """Return what the last step dissipated, N mm per mm of thickness, exactly for coordinates on parabolas."""
        start, change = old.behind.view(float), self.state.change.view(float)
        bow = relaxation.bow(change, old.change.view(float))
        weighed = self._viscosity * start
        products = np.zeros((len(self._times), 3, 3))  # the upper half, twice off the diagonal
        products[:, 0, 0] = np.einsum("bm,bm->b", weighed, start)
        products[:, 0, 1], products[:, 0, 2] = 2.0 * weighed @ change, 2.0 * weighed @ bow
        products[:, 1, 1], products[:, 2, 2] = self._viscosity @ (change * change), self._viscosity @ (bow * bow)
        products[:, 1, 2] = 2.0 * self._viscosity @ (change * bow)
        return float(relaxation.duration * np.sum(relaxation.gram * products))

    def renew(self) -> None:
        """Forget what only saves work: steps from here on do not depend on how the state was reached."""
        self._step = None

    def _prepared(self, duration: float) -> _Step:
        lengths = (duration, self.state.duration)
        if self._step is None or self._step.lengths != lengths:
            relaxation = Relaxation(duration, self._times, self.state.duration)
            modulus = self._relaxed + relaxation.share @ self._branches
            self._step = _Step(lengths, relaxation, modulus, self._convolution(modulus))
        return self._step

    def _convolution(self, modulus: Real) -> Convolution:
        """Return the surface of modes of some moduli."""
        yielding = (self._modes.reach / modulus).astype(complex)
        compliance = self._modes.surface(yielding) * self.block.column_width
        compliance[0] = 0.0
        return Convolution(compliance, self.block.columns)

    def _forces(self, contact: Real, pressure: float) -> Complex:
        spectrum = np.fft.rfft(contact) * self.block.column_width
        spectrum[0] = -pressure
        return self._modes.forces(spectrum)

    def _surface(self, modes: Complex) -> Real:
        """Return u_y at the surface less its mean, mm, shape (columns,)."""
        spectrum = self._modes.surface(modes)
        spectrum[0] = 0.0
        return np.fft.irfft(spectrum, self.block.columns)

    def _profile(self, offset: float) -> Real:
        return self.scene.road.height(self.block.column_positions + offset)

    def _flags(self, touching: Flags | None = None) -> Flags:
        """Return a first guess of the contact: the one given, unless it is empty, or everywhere."""
        if touching is None or not touching.any():
            return np.ones(self.block.columns, dtype=bool)
        return touching

    def snapshot(self) -> dict[str, Any]:
        """Return the state as arrays, from which ``restore`` goes on."""
        arrays = {part.name: np.asarray(getattr(self.state, part.name)) for part in dataclasses.fields(self.state)}
        return arrays | {"stored": np.asarray(self.stored)}

    def restore(self, arrays: Mapping[str, Any]) -> None:
        """Take over the state of a snapshot of a block on the same mesh."""
        given: dict[str, Any] = {part.name: arrays[part.name] for part in dataclasses.fields(SmallState)}
        for name in ("duration", "top", "offset", "pressure"):
            given[name] = float(given[name])
        self.state = SmallState(**given)
        self.stored = float(arrays["stored"])
