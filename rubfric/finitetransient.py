"""The block in finite strain, step by step: the road goes past, and the branches follow by their exact update.

Over a step Cb^-1 and J vary linearly, so that the branch tensors at its end are known numbers times Cb^-1 there, plus
what is left of the state before (``rubfric.relaxation``). What has to be solved is one contact of a hyperelastic block
(``rubfric.newton``). In the frame of the road fields change little: from there they are extrapolated.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from scipy import fft

from rubfric.arrays import Flags, Real
from rubfric.block import Block
from rubfric.branches import elongation, excess, inverted, trace
from rubfric.circulant import Circulant
from rubfric.continuation import History, Start, reach
from rubfric.finiteblock import Fields, FiniteBlock, Stressed
from rubfric.finitestrain import Deformation, volumetric_energy
from rubfric.homogeneous import pressed
from rubfric.marching import Outcome
from rubfric.newton import Solved, newton
from rubfric.past import StepPast
from rubfric.relaxation import Relaxation, mean_square
from rubfric.scene import Scene
from rubfric.slidingcontact import Correction, Road, SlidingContact

# Distance from balance and contact at which a step is solved: root mean square, over the road's amplitude.
_TOLERANCE = 1e-6
# On a flat road displacements count by this share of a wavelength instead.
_FLAT = 1e-8
# Directions that take more Krylov iterations are worth a new average of the tangent.
_WORTH = 12


@dataclass(frozen=True)
class FiniteState:
    """All that the next step depends on.

    Attributes
    ----------
    fields : Fields
    inverse : ndarray, shape (4, points, rows, columns)
        Cb^-1.
    behind : ndarray, shape (4, branches, points, rows, columns)
        A_i - Cb^-1.
    volume_behind : ndarray, shape (branches or 0, ...)
        J - J_i, in the shape of ``Fields.volume``; without entries where the bulk does not relax.
    touching : ndarray of bool, shape (columns,)
    force : ndarray, shape (2, columns)
        Forces of the road on the surface nodes, N per mm of thickness.
    offset : float
        How far the road has gone past, mm.
    pressure : float
        Nominal, MPa.
    """

    fields: Fields
    inverse: Real
    behind: Real
    volume_behind: Real
    touching: Flags
    force: Real
    offset: float
    pressure: float


class FiniteTransient:
    """A block in finite strain that a road goes past.

    Parameters
    ----------
    scene : Scene
        Road, rubber and plane; its speed and load do not count.
    block : Block
    tolerance : float
        Distance from balance and contact at which a step is solved, over the road's amplitude.
    """

    def __init__(self, scene: Scene, block: Block, tolerance: float = _TOLERANCE) -> None:
        self.scene, self.block = scene, block
        self.finite = FiniteBlock(block, scene.material, 0.0)
        unit = max(scene.road.amplitude, _FLAT * scene.road.wavelength)
        self._scale = (unit, unit * scene.road.wavenumber)
        self._tolerance = tolerance
        self._times = np.asarray(scene.material.relaxation_times, dtype=float)
        self._shear = scene.material.branch_shear_moduli
        self._bulk = scene.material.branch_bulk_moduli
        self._circulant: tuple[float, Circulant] | None = None
        self._before: tuple[float, float, Fields] | None = None
        self.state = self.at_rest()
        self.stored = 0.0

    def at_rest(self) -> FiniteState:
        """Return the block as it was made, laid on the crests of the road without load."""
        fields = self.finite.at_rest()
        height = self.scene.road.height(self.block.column_positions)
        fields.displacement[1] = height.max()
        return self._relaxed(fields, height >= height.max(), np.zeros((2, self.block.columns)), 0.0, 0.0)

    def press_relaxed(self, pressure: float) -> None:
        """Bring the block into the state that infinitely slow pressing leaves, MPa.

        Raises
        ------
        NotConverged
        """
        stretch, thickness = pressed(self.scene.material, pressure, self.block.plane)
        fields = self.finite.at_rest()
        fields.displacement[1] = (stretch - 1.0) * self.block.row_positions[:, None]
        fields.log_thickness[:] = math.log(thickness)
        fields.volume[:] = stretch * thickness
        flat = Start(fields, np.ones(self.block.columns, dtype=bool))
        harmonics = len(self.block.harmonics)
        still = self.finite.remembering(StepPast(0.0, 0.0, np.zeros(1), 0.0, harmonics))
        problem = SlidingContact(still, self._scale, self.scene.name)
        solved = reach(problem, flat, self._road(pressure, 0.0), self._tolerance, History())
        contact = solved.correction.contact
        force = self._force(solved.correction)
        self.state = self._relaxed(solved.fields, contact.touching, force, 0.0, pressure)
        self.stored = self._stored(self.state, solved.correction.state.deformation)
        self._before = self._circulant = None

    def _relaxed(
        self, fields: Fields, touching: Flags, force: Real, offset: float, pressure: float
    ) -> FiniteState:
        inverse = self.finite.stressed(fields).deformation.inverse
        branches = len(self._times)
        return FiniteState(
            fields,
            inverse,
            np.zeros((4, branches, *inverse.shape[1:])),
            np.zeros((branches if self._bulk.any() else 0, *fields.volume.shape)),
            touching,
            force,
            offset,
            pressure,
        )

    def advance(self, duration: float, offset: float, pressure: float) -> Outcome:
        """Go one step: the road to an offset, mm, and the load to a pressure, MPa, in a duration, s.

        Raises
        ------
        rubfric.newton.Stalled
            Where no contact is found; the state stays what it was.
        """
        relaxation = Relaxation.over(duration, self._times)
        past = self._past(relaxation)
        problem = SlidingContact(self.finite.remembering(past), self._scale, self.scene.name)
        guess, touching = self._guess(duration, offset)
        kept = self._circulant[1] if self._circulant is not None and self._circulant[0] == duration else None
        road = self._road(pressure, offset)
        solved = newton(problem, guess, road, touching, self._tolerance, kept, _WORTH)
        return self._commit(solved, relaxation, duration, road)

    def _road(self, pressure: float, offset: float) -> Road:
        return Road(self.scene.road.amplitude, self.scene.road.wavenumber, pressure, offset)

    def _past(self, relaxation: Relaxation) -> StepPast:
        state = self.state
        kept = np.tensordot(self._shear * relaxation.decay, state.behind, axes=(0, 1))
        shear = float(self._shear @ relaxation.share)
        bulk, pressure = 0.0, 0.0
        if len(state.volume_behind):
            bulk = float(self._bulk @ relaxation.share)
            pressure = np.tensordot(self._bulk * relaxation.decay, state.volume_behind, axes=1)
            pressure -= bulk * state.fields.volume
        return StepPast(shear, bulk, kept + shear * state.inverse, pressure, len(self.block.harmonics))

    def _guess(self, duration: float, offset: float) -> tuple[Fields, Flags]:
        """Return fields extrapolated in the frame of the road, and the contact nodes moved with it."""
        state = self.state
        moved = offset - state.offset
        columns = round(moved / self.block.column_width)
        touching = np.roll(state.touching, -columns)
        fields = self._shifted(state.fields, moved)
        if self._before is not None:
            length, before, old = self._before
            change = fields.moved(self._shifted(old, offset - before), -1.0)
            fields = fields.moved(change, duration / length)
        return fields, touching

    def _shifted(self, fields: Fields, distance: float) -> Fields:
        """Return the fields of a block that is so much further along the road, mm, and does the same there."""
        if distance == 0.0:
            return fields
        turn = np.exp(2j * np.pi / self.block.width * distance * self.block.harmonics)
        parts = (fields.displacement, fields.log_thickness, fields.volume)
        return Fields(*(fft.irfft(fft.rfft(part, axis=-1) * turn, self.block.columns, axis=-1) for part in parts))

    def _force(self, correction: Correction) -> Real:
        normal = np.stack((-correction.slope, np.ones_like(correction.slope)))
        return normal * correction.contact.pressure * self.block.column_width

    def _commit(self, solved: Solved, relaxation: Relaxation, duration: float, road: Road) -> Outcome:
        old, correction = self.state, solved.correction
        stressed: Stressed = correction.state
        inverse = stressed.deformation.inverse
        wide = (-1, *(1 for _ in inverse.shape[1:]))
        decay, share = relaxation.decay.reshape(wide), relaxation.share.reshape(wide)
        behind = decay * old.behind - share * (inverse - old.inverse)[:, None]
        volume_behind, change = old.volume_behind, solved.fields.volume - old.fields.volume
        if len(volume_behind):
            volume_behind = decay * old.volume_behind + share * change
        force = self._force(correction)
        self.state = FiniteState(
            solved.fields,
            inverse,
            behind,
            volume_behind,
            correction.contact.touching,
            force,
            road.offset,
            road.pressure,
        )
        self._before = (duration, old.offset, old.fields)
        self._circulant = (duration, solved.circulant)
        before, self.stored = self.stored, self._stored(self.state, stressed.deformation)
        moved = solved.fields.displacement - old.fields.displacement
        lift = float(moved[1, -1].mean())
        return Outcome(
            friction=float(np.mean(correction.contact.pressure * correction.slope) / road.pressure),
            road_work=float(0.5 * ((old.force + force) * moved[:, 0]).sum()),
            load_work=-0.5 * (old.pressure + road.pressure) * self.block.width * lift,
            stored=self.stored,
            stored_change=self.stored - before,
            dissipated=duration * self._dissipation(old, relaxation, change),
            contact_fraction=float(np.count_nonzero(correction.contact.touching)) / self.block.columns,
            top=float(solved.fields.displacement[1, -1].mean()),
            iterations=solved.steps,
            krylov=solved.krylov,
        )

    def _stored(self, state: FiniteState, deformation: Deformation) -> float:
        """Return the energy stored in the block, N mm per mm of thickness."""
        material, squared = self.scene.material, deformation.isochoric_squared
        density = 0.5 * material.long_term_shear_modulus * (trace(squared) - 3.0)
        wide = (-1, *(1 for _ in density.shape))
        each = elongation(state.behind, squared[:, None], state.inverse[:, None])
        density = density + (0.5 * self._shear.reshape(wide) * each).sum(axis=0)
        volume = volumetric_energy(material.long_term_bulk_modulus, state.fields.volume)
        if len(state.volume_behind):
            volume = volume + (0.5 * self._bulk.reshape(wide) * state.volume_behind**2).sum(axis=0)
        return float(((density + volume) * self.finite.weights).sum())

    def _dissipation(self, old: FiniteState, relaxation: Relaxation, change: Real) -> float:
        """Return the mean dissipation over the last step, N mm/s per mm of thickness.

        Of each branch by a quadrature that is exact where it is quadratic in exp(-t / tau).
        """
        new = self.state
        if not len(self._times):
            return 0.0
        wide = (-1, *(1 for _ in new.inverse.shape[1:]))
        growth = new.inverse - old.inverse
        middle, instant = relaxation.middle.reshape(wide), relaxation.instant.reshape(wide)
        share = (instant * -np.expm1(np.log(middle)) / -np.log(middle)).reshape(wide)
        between = old.inverse[:, None] + instant * growth[:, None]
        states = (
            (old.behind, old.inverse[:, None]),
            (middle * old.behind - share * growth[:, None], between),
            (new.behind, new.inverse[:, None]),
        )
        factor = self._shear / (2.0 * self._times) * relaxation.weights
        total = 0.0
        for weight, (behind, inverse) in zip(factor, states, strict=True):
            density = excess(behind, inverted(inverse), inverse)
            total += float(weight @ (density * self.finite.weights).sum(axis=(1, 2, 3)))
        if len(new.volume_behind):
            square = mean_square(relaxation, old.volume_behind, change)
            density = np.tensordot(self._bulk / self._times, square, axes=1)
            total += float((np.broadcast_to(density, new.inverse.shape[1:]) * self.finite.weights).sum())
        return total

    def snapshot(self) -> dict[str, Real]:
        """Return the state as arrays, from which ``restore`` goes on."""
        arrays = {
            field.name: np.asarray(getattr(self.state, field.name))
            for field in dataclasses.fields(self.state)
            if field.name != "fields"
        }
        arrays |= _packed("fields", self.state.fields) | {"stored": np.asarray(self.stored)}
        if self._before is not None:
            arrays |= _packed("before", self._before[2]) | {"before": np.asarray(self._before[:2])}
        return arrays


def _packed(name: str, fields: Fields) -> dict[str, Real]:
    return {f"{name}.{part.name}": getattr(fields, part.name) for part in dataclasses.fields(fields)}
