"""The block in finite strain, step by step: the road goes past, and the branches follow by their exact update.

Over a step Cb^-1 and J follow a parabola, so that the branch tensors at its end are a known number times Cb^-1 there,
plus what is left of the state before (``rubber.maxwell``). What has to be solved is one contact of a hyperelastic
block (``finite.newton``). In the frame of the road fields change little: from there they are extrapolated.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy import fft

from rubfric.arrays import Flags, Real
from rubfric.errors import NotConverged
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.block import Fields, FiniteBlock, Stressed
from rubfric.mechanics.finite.circulant import Circulant
from rubfric.mechanics.finite.contact import Correction, Load, SlidingContact, measures
from rubfric.mechanics.finite.continuation import AttemptLog, Start, reach
from rubfric.mechanics.finite.law import Inverted
from rubfric.mechanics.finite.layers import even_cells
from rubfric.mechanics.finite.memory import StepHistory, branch_transfers, convolve
from rubfric.mechanics.finite.newton import Solved, Stalled, newton
from rubfric.mechanics.finite.prolongation import on_all_columns
from rubfric.mechanics.finite.state import Branches, FiniteState
from rubfric.mechanics.finite.steady import FiniteSolution
from rubfric.mechanics.march.step import Outcome
from rubfric.rubber.maxwell import Relaxation
from rubfric.scene.scene import Scene

# Distance from balance and contact at which a step is solved: root mean square, over the road's amplitude.
_TOLERANCE = 1e-6
# Directions that take more Krylov iterations are worth a new average of the tangent.
_WORTH = 12
# What a step that is not solved has left, for the message.
_MEASURE = "distance from balance and contact"


class FiniteStepper:
    """A block in finite strain that a road goes past.

    Parameters
    ----------
    scene : Scene
        Road, rubber and plane; speed and load count for a start from steady sliding only.
    block : Block
    tolerance : float
        Distance from balance and contact at which a step is solved, over the road's amplitude.
    """

    def __init__(self, scene: Scene, block: Block, tolerance: float = _TOLERANCE) -> None:
        self.scene, self.block = scene, block
        self.finite = FiniteBlock(block, scene.material, 0.0)
        self._scale = measures(scene.road)
        self._tolerance = tolerance
        self._branches = Branches(self.finite)
        self._circulant: tuple[tuple[float, float], Circulant] | None = None
        self.state = self.at_rest()

    @property
    def offset(self) -> float:
        """How far the road has gone past, mm."""
        return self.state.offset

    @property
    def pressure(self) -> float:
        """The load, MPa."""
        return self.state.pressure

    @property
    def stored(self) -> float:
        """Strain energy, N mm per mm of thickness."""
        return self.state.stored

    def at_rest(self) -> FiniteState:
        """Return the block as it was made, laid on the crests of the road without load."""
        fields = self.finite.at_rest()
        height = self.scene.road.height(self.block.column_positions)
        fields.displacement[1] = height.max()
        return self._relaxed(fields, height >= height.max(), np.zeros((2, self.block.columns)), 0.0)

    def press_relaxed(self, pressure: float) -> None:
        """Bring the block into the state that infinitely slow pressing leaves, MPa.

        Raises
        ------
        NotConverged
        """
        still = StepHistory(0.0, 0.0, np.zeros((4, 1, 1, 1)), 0.0, len(self.block.harmonics))
        problem = SlidingContact(self.finite.with_history(still), self._scale, self.scene.name)
        flat = Start(self.finite.pressed(pressure), np.ones(self.block.columns, dtype=bool))
        solved = reach(problem, flat, Load(self.scene.road, pressure), self._tolerance, AttemptLog())
        force = self._force(solved.correction)
        self.state = self._relaxed(solved.fields, solved.correction.contact.touching, force, pressure)

    def slide_steadily(self, solution: FiniteSolution) -> None:
        """Bring the block into the state of a steady solution of this scene on this mesh."""
        fields, correction = on_all_columns(solution.fields, solution.finite), solution.correction
        inverse = even_cells(solution.finite.layers, correction.state.deformation.inverse)
        frequencies = self.block.wavenumbers * self.scene.velocity
        behind, volume_behind = self._branches.none(fields, inverse)
        for branch, transfer in enumerate(branch_transfers(self.scene.material, frequencies)):
            behind[:, branch] = -convolve(transfer, inverse)
            if len(volume_behind):
                volume_behind[branch] = convolve(transfer, fields.volume)
        # The top is held where it was made: the road is moved instead.
        offset = float(fields.displacement[0, -1].mean())
        displacement = fields.displacement.copy()
        displacement[0] -= offset
        held = Fields(displacement, fields.log_thickness, fields.volume)
        touching = correction.contact.touching
        self.state = self._unmoved(
            held, inverse, behind, volume_behind, touching, self._force(correction), offset, self.scene.pressure
        )

    def _relaxed(self, fields: Fields, touching: Flags, force: Real, pressure: float) -> FiniteState:
        inverse = self.finite.stressed(fields).deformation.inverse
        return self._unmoved(fields, inverse, *self._branches.none(fields, inverse), touching, force, 0.0, pressure)

    def _unmoved(
        self,
        fields: Fields,
        inverse: Real,
        behind: Real,
        volume_behind: Real,
        touching: Flags,
        force: Real,
        offset: float,
        pressure: float,
    ) -> FiniteState:
        """Return a state without a step before it."""
        self._circulant = None
        squared = self.finite.stressed(fields).deformation.isochoric_squared
        return FiniteState(
            fields=fields,
            before=fields,
            inverse=inverse,
            inverse_change=np.zeros_like(inverse),
            volume_change=np.zeros_like(fields.volume),
            behind=behind,
            volume_behind=volume_behind,
            touching=touching,
            force=force,
            duration=math.inf,
            advance=0.0,
            offset=offset,
            pressure=pressure,
            stored=self._branches.stored(squared, inverse, fields.volume, behind, volume_behind),
        )

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
        lengths = (duration, self.state.duration)
        relaxation = Relaxation(duration, self._branches.times, self.state.duration)
        finite = self.finite.with_history(self._branches.history(self.state, relaxation))
        problem = SlidingContact(finite, self._scale, self.scene.name)
        kept = self._circulant[1] if self._circulant is not None and self._circulant[0] == lengths else None
        load = Load(self.scene.road, pressure, offset)
        steps, residual = 0, math.inf
        try:
            solved = newton(problem, *self._guess(relaxation, load), self._tolerance, kept, _WORTH)
            steps, residual = solved.steps, solved.residuals[-1]
            outcome = self._commit(solved, relaxation, load)
        except Stalled as error:
            raise NotConverged(self.scene.name, error.steps, error.residual, _MEASURE) from error
        except Inverted as error:
            raise NotConverged(self.scene.name, steps, residual, _MEASURE) from error
        self._circulant = (lengths, solved.circulant)
        return outcome

    def renew(self) -> None:
        """Forget what only saves work: steps from here on do not depend on how the state was reached."""
        self._circulant = None

    def _guess(self, relaxation: Relaxation, load: Load) -> tuple[Fields, Load, Flags]:
        """Return fields extrapolated in the frame of the road, the load, and the contact nodes moved with it."""
        state = self.state
        moved = load.offset - state.offset
        touching = np.roll(state.touching, -round(moved / self.block.column_width))
        fields = self._shifted(state.fields, moved)
        if relaxation.follows:
            change = fields.moved(self._shifted(state.before, moved + state.advance), -1.0)
            fields = fields.moved(change, relaxation.duration / relaxation.before)
        return fields, load, touching

    def _shifted(self, fields: Fields, distance: float) -> Fields:
        """Return the fields of a block that is so much further along the road, mm, and does the same there."""
        if distance == 0.0:
            return fields
        turn = np.exp(1j * distance * self.block.wavenumbers)
        parts = (fields.displacement, fields.log_thickness, fields.volume)
        return Fields(*(fft.irfft(fft.rfft(part, axis=-1) * turn, self.block.columns, axis=-1) for part in parts))

    def _force(self, correction: Correction) -> Real:
        normal = np.stack((-correction.slope, np.ones_like(correction.slope)))
        return normal * correction.contact.pressure * self.block.column_width

    def _commit(self, solved: Solved, relaxation: Relaxation, load: Load) -> Outcome:
        old, fields, contact = self.state, solved.fields, solved.correction.contact
        stressed: Stressed = solved.correction.state
        inverse, squared = stressed.deformation.inverse, stressed.deformation.isochoric_squared
        behind, volume_behind = self._branches.follow(old, relaxation, inverse, fields.volume)
        new = FiniteState(
            fields=fields,
            before=old.fields,
            inverse=inverse,
            inverse_change=inverse - old.inverse,
            volume_change=fields.volume - old.fields.volume,
            behind=behind,
            volume_behind=volume_behind,
            touching=contact.touching,
            force=self._force(solved.correction),
            duration=relaxation.duration,
            advance=load.offset - old.offset,
            offset=load.offset,
            pressure=load.pressure,
            stored=self._branches.stored(squared, inverse, fields.volume, behind, volume_behind),
        )
        moved = fields.displacement - old.fields.displacement
        lost = self._branches.dissipated(old, relaxation, inverse, fields.volume)
        self.state = new
        return Outcome(
            friction=float(np.mean(contact.pressure * solved.correction.slope) / load.pressure),
            road_work=float(0.5 * ((old.force + new.force) * moved[:, 0]).sum()),
            load_work=-0.5 * (old.pressure + new.pressure) * self.block.width * float(moved[1, -1].mean()),
            stored=new.stored,
            stored_change=new.stored - old.stored,
            dissipated=lost,
            contact_fraction=float(np.count_nonzero(contact.touching)) / self.block.columns,
            top=float(fields.displacement[1, -1].mean()),
            iterations=solved.steps,
            krylov=solved.krylov,
        )

    def snapshot(self) -> dict[str, Real]:
        """Return the state as arrays, from which ``restore`` goes on."""
        return self.state.arrays()

    def restore(self, arrays: Mapping[str, Real]) -> None:
        """Take over the state of a snapshot of a block on the same mesh."""
        self.state = FiniteState.from_arrays(arrays)
        self.renew()
