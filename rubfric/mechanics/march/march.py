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

COLUMNS = (
    "time",
    "slid",
    "pressure",
    "phase",
    "friction_contact",
    "friction_work",
    "friction_energy",
    "stored_energy",
    "dissipated",
    "road_work",
    "load_work",
    "imbalance",
    "contact_fraction",
    "top_displacement",
    "iterations",
    "krylov",
    "halvings",
)


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
        self._records: list[tuple[float, ...]] = []
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
        whole = slid > 0 and slid % self.procedure.steps_per_wavelength == 0
        return whole and self.procedure.until_saturated and self.saturation.reached

    @property
    def _slid(self) -> int:
        """Steps done at full speed."""
        return self.position - int(np.searchsorted(self._steps.phase, PHASES.index("slide")))

    @property
    def saturation(self) -> Saturation:
        """Whether friction has settled, and on what."""
        friction = np.array([record[COLUMNS.index("friction_contact")] for record in self._records])
        means = wavelength_means(friction[len(friction) - max(self._slid, 0) :], self.procedure.steps_per_wavelength)
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
        past = self._records[-1][0] if self._records else 0.0
        self._records.append(
            (
                past + duration,
                float(steps.offset[at]),
                pressure,
                float(steps.phase[at]),
                outcome.friction,
                outcome.road_work / force if force else np.nan,
                (outcome.stored_change + outcome.dissipated - outcome.load_work) / force if force else np.nan,
                outcome.stored,
                outcome.dissipated,
                outcome.road_work,
                outcome.load_work,
                outcome.imbalance,
                outcome.contact_fraction,
                outcome.top,
                float(outcome.iterations),
                float(outcome.krylov),
                float(halvings),
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
        last = dict(zip(COLUMNS, self._records[-1], strict=True))
        return (
            f"{self.scene.name}: step {at} of at most {len(self._steps.duration)} ({PHASES[int(last['phase'])]}), "
            f"slid {last['slid'] / self.scene.road.period:.2f} wavelengths, "
            f"friction {last['friction_contact']:.4f}, {pace:.1f} steps/s"
        )

    @property
    def records(self) -> dict[str, Real]:
        """What has been recorded, by the names in ``COLUMNS``, each of shape (steps,)."""
        table = np.array(self._records).reshape(-1, len(COLUMNS)).T
        return dict(zip(COLUMNS, table, strict=True))

    def save(self, path: Path) -> None:
        """Leave the march in a file; ``restore`` goes on from there."""
        arrays = {f"model.{name}": array for name, array in self._model.snapshot().items()}
        arrays["records"] = np.array(self._records).reshape(-1, len(COLUMNS))
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
        self._records = [tuple(float(value) for value in record) for record in arrays["records"]]
        self._model.restore(
            {name.removeprefix("model."): array for name, array in arrays.items() if name.startswith("model.")}
        )

    @property
    def _label(self) -> str:
        # More wavelengths, or another end, leave the steps so far as they are.
        fixed = dataclasses.replace(self.procedure, wavelengths=1, saturation=0.0, until_saturated=True)
        return f"{self.scene.digest} {self.decision.kinematics} {fixed}"
