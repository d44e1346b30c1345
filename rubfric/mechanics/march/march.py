"""The march of one scene through its steps of time, in the kinematics that it asks for or needs: one step at a time.

Every step is recorded with the friction coefficient by three routes, and with what the first law misses in it: the
work of the road and of the load is what the block stores and what it dissipates. A step that finds no contact is
halved.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import NotConverged
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.march import checkpoint
from rubfric.mechanics.march.saturation import Saturation, judge, wavelength_means
from rubfric.mechanics.march.step import Outcome, Stepper, combine_steps
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.scene.procedure import PHASES, Procedure, Steps
from rubfric.scene.scene import Scene

# A step that finds no contact is halved so many times before it is given up.
_MOST_HALVINGS = 6
# Steps after which models start afresh from their states, so that a march may be taken up again there.
FRESH = 32


class Record(NamedTuple):
    """What is recorded of one step; works and energies in N mm per mm of thickness.

    Attributes
    ----------
    time : float
        Since the begin of the march, at the end of the step, s.
    slid : float
        Distance, mm.
    pressure : float
        Nominal, MPa.
    phase : float
        Index in ``PHASES``.
    friction_contact : float
        Friction coefficient by the contact force at the end of the step.
    friction_work, friction_energy : float
        Mean friction coefficient of the step by the work of the road, and by stored and dissipated energy less the
        work of the load; NaN where nothing slides.
    stored_energy : float
        At the end of the step.
    dissipated, road_work, load_work, imbalance : float
        In the step; ``imbalance`` is what the first law misses.
    contact_fraction : float
    top_displacement : float
        Mean u_y of the top, mm.
    iterations, krylov, halvings : float
        Newton or pivoting steps, applications of the tangent, and how often the step was halved.
    """

    time: float
    slid: float
    pressure: float
    phase: float
    friction_contact: float
    friction_work: float
    friction_energy: float
    stored_energy: float
    dissipated: float
    road_work: float
    load_work: float
    imbalance: float
    contact_fraction: float
    top_displacement: float
    iterations: float
    krylov: float
    halvings: float


class March:
    """A march that can be left and taken up again.

    Parameters
    ----------
    scene : Scene
    procedure : Procedure
    decision : Decision
        The kinematics to march in.
    stepper : callable
        Returns what goes one step after the other in that kinematics, for a scene and a block.
    solve : callable
        Solves steady sliding in that kinematics, for a march that starts from it.

    Attributes
    ----------
    block : Block
    position : int
        Steps done.
    seconds : float
        Wall time that they took.
    """

    def __init__(
        self,
        scene: Scene,
        procedure: Procedure,
        decision: Decision,
        stepper: Callable[[Scene, Block], Stepper],
        solve: Callable[[Scene, Decision], SteadySolution],
    ) -> None:
        self.scene, self.procedure, self.decision = scene, procedure, decision
        numerics, road = scene.numerics, scene.road
        self.block = Block.graded(
            road.period,
            scene.height,
            procedure.columns,
            scene.plane,
            numerics.row_growth,
            numerics.first_row,
            numerics.dilatation,
        )
        self.position = 0
        self._steps: Steps = procedure.steps(scene)
        self._records: list[Record] = []
        self.seconds = 0.0
        self._model = stepper(scene, self.block)
        if procedure.start == "relaxed":
            self._model.press_relaxed(scene.pressure)
        elif procedure.start == "steady":
            self._model.slide_steadily(solve(self._on_own_mesh(), decision))
        # Where along the road the block begins: a start from steady sliding may need another place than 0.
        self._begin = self._model.offset

    def _on_own_mesh(self) -> Scene:
        """Return the scene with the mesh of the march."""
        columns = self.procedure.columns
        numerics = dataclasses.replace(
            self.scene.numerics, columns_min=columns, finite_columns_min=columns, columns_max=columns
        )
        return dataclasses.replace(self.scene, numerics=numerics)

    @property
    def ended(self) -> bool:
        """Whether all steps are done, or friction has saturated."""
        if self.position == len(self._steps.duration):
            return True
        slid = self._slid
        whole = slid > 0 and slid % self.procedure.steps_per_period(self.scene.road) == 0
        return whole and self.procedure.until_saturated and self.saturation.reached

    @property
    def _slid(self) -> int:
        """Steps done at full speed."""
        return self.position - int(np.searchsorted(self._steps.phase, PHASES.index("slide")))

    @property
    def saturation(self) -> Saturation:
        """Whether friction has settled, and on what."""
        friction = np.array([record.friction_contact for record in self._records])
        means = wavelength_means(
            friction[len(friction) - max(self._slid, 0) :], self.procedure.steps_per_period(self.scene.road)
        )
        return judge(self.scene, means, self.procedure.saturation)

    def step(self) -> None:
        """Go one step."""
        steps, at, model = self._steps, self.position, self._model
        started = time.perf_counter()
        if at % FRESH == 0:
            model.renew()
        before = model.offset
        offset = self._begin + float(steps.offset[at])
        pressure, duration = float(steps.pressure[at]), float(steps.duration[at])
        outcome, halvings = self._advance(duration, offset, pressure, 0)
        force = pressure * self.block.width * (offset - before)  # times the distance: what friction of 1 would do
        elapsed = self._records[-1].time if self._records else 0.0
        internal = outcome.stored_change + outcome.dissipated - outcome.load_work
        self._records.append(
            Record(
                time=elapsed + duration,
                slid=float(steps.offset[at]),
                pressure=pressure,
                phase=float(steps.phase[at]),
                friction_contact=outcome.friction,
                friction_work=outcome.road_work / force if force else np.nan,
                friction_energy=internal / force if force else np.nan,
                stored_energy=outcome.stored,
                dissipated=outcome.dissipated,
                road_work=outcome.road_work,
                load_work=outcome.load_work,
                imbalance=outcome.imbalance,
                contact_fraction=outcome.contact_fraction,
                top_displacement=outcome.top,
                iterations=float(outcome.iterations),
                krylov=float(outcome.krylov),
                halvings=float(halvings),
            )
        )
        self.position += 1
        self.seconds += time.perf_counter() - started

    def _advance(self, duration: float, offset: float, pressure: float, depth: int) -> tuple[Outcome, int]:
        """Return what a step does, and into how many halves it had to be divided."""
        model = self._model
        try:
            return model.advance(duration, offset, pressure), 0
        except NotConverged as error:
            if depth == _MOST_HALVINGS:
                raise NotConverged(
                    self.scene.name,
                    self.position + 1,
                    error.residual,
                    "in the smallest of the halved steps of time, distance from balance and contact",
                ) from error
        middle = 0.5 * (model.offset + offset), 0.5 * (model.pressure + pressure)
        first, some = self._advance(0.5 * duration, *middle, depth + 1)
        second, more = self._advance(0.5 * duration, offset, pressure, depth + 1)
        return combine_steps(first, second), 1 + some + more

    def line(self, pace: float) -> str:
        """Return a line of progress."""
        at = self.position
        last = self._records[-1]
        return (
            f"{self.scene.name}: step {at} of at most {len(self._steps.duration)} ({PHASES[int(last.phase)]}), "
            f"slid {last.slid / self.scene.road.period:.2f} wavelengths, "
            f"friction {last.friction_contact:.4f}, {pace:.1f} steps/s"
        )

    @property
    def records(self) -> dict[str, Real]:
        """What has been recorded, by the names in ``Record``, each of shape (steps,)."""
        return dict(zip(Record._fields, self._table.T, strict=True))

    @property
    def _table(self) -> Real:
        return np.array(self._records).reshape(-1, len(Record._fields))

    def save(self, path: Path) -> None:
        """Leave the march in a file; ``restore`` goes on from there."""
        arrays = {f"model.{name}": array for name, array in self._model.snapshot().items()}
        arrays["records"] = self._table
        arrays["marched"] = np.array((self.position, self.seconds, self._begin))
        checkpoint.write(path, self._label, arrays)

    def restore(self, path: Path) -> None:
        """Take over a march that ``save`` left.

        Raises
        ------
        BrokenResult
            Where the file is not that of the same scene and procedure.
        """
        arrays = checkpoint.read(path, self._label)
        position, self.seconds, self._begin = (float(value) for value in arrays["marched"])
        self.position = int(position)
        self._records = [Record(*(float(value) for value in record)) for record in arrays["records"]]
        self._model.restore(
            {name.removeprefix("model."): array for name, array in arrays.items() if name.startswith("model.")}
        )

    @property
    def _label(self) -> str:
        # More wavelengths, or another end, leave the steps so far as they are.
        fixed = dataclasses.replace(self.procedure, wavelengths=1, saturation=0.0, until_saturated=True)
        return f"{self.scene.digest} {self.decision.kinematics} {fixed}"
