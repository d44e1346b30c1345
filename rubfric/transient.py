"""Press and slide, step by step: the paper's procedure on one scene, in the kinematics that it asks for or needs.

Every step is recorded with the friction coefficient by three routes, and the first law is checked on it: the work of
the road and of the load is what the block stores and what it dissipates. A step that finds no contact is halved.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rubfric import checkpoint
from rubfric.arrays import Real
from rubfric.block import Block
from rubfric.errors import NotConverged
from rubfric.finitesteady import FiniteSolution
from rubfric.finitetransient import FiniteTransient
from rubfric.kinematics import decide
from rubfric.marching import Outcome, together
from rubfric.newton import Stalled
from rubfric.procedure import PHASES, Procedure, Steps
from rubfric.saturation import Saturation, judge
from rubfric.scene import Scene
from rubfric.smallsteady import SmallSolution
from rubfric.smalltransient import SmallTransient
from rubfric.steady import solve

# A step that finds no contact is halved so many times before it is given up.
_MOST_HALVINGS = 6
# Seconds between two lines of progress, and steps between two chances to write a checkpoint.
_SILENCE, _EVERY = 10.0, 32

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


@dataclass(frozen=True)
class Transient:
    """A block pressed and slid.

    Attributes
    ----------
    scene : Scene
    procedure : Procedure
    kinematics : {"small", "finite"}
    block : Block
    records : dict of ndarray, each of shape (steps,)
        By name: ``time`` s; ``slid`` mm; ``pressure`` MPa; ``phase`` (index in ``PHASES``); friction coefficients
        ``friction_contact`` (at the end of the step), ``friction_work`` (work of the road) and ``friction_energy``
        (stored and dissipated energy less the work of the load), both means of the step and NaN where nothing
        slides; ``stored_energy``, ``dissipated``, ``road_work``, ``load_work`` and ``imbalance`` (of the first law, in
        the step), N mm per mm of thickness; ``contact_fraction``; ``top_displacement`` mm; ``iterations``,
        ``krylov`` and ``halvings``.
    saturation : Saturation
        Whether friction has settled, and on what.
    seconds : float
        Wall time of the steps.
    """

    scene: Scene
    procedure: Procedure
    kinematics: str
    block: Block
    records: dict[str, Real]
    saturation: Saturation
    seconds: float

    @property
    def sliding(self) -> slice:
        """The steps at full speed."""
        return slice(int(np.searchsorted(self.records["phase"], PHASES.index("slide"))), None)

    def means(self, route: str = "friction_contact") -> Real:
        """Return friction averaged over each whole wavelength at full speed, shape (wavelengths,)."""
        return _means(self.records[route][self.sliding], self.procedure.steps_per_wavelength)

    @property
    def imbalance(self) -> float:
        """The first law: sum of what is missing at full speed over the work of the road there, dimensionless."""
        missing = self.records["imbalance"][self.sliding].sum()
        return float(abs(missing) / self.records["road_work"][self.sliding].sum())


def march(
    scene: Scene,
    procedure: Procedure | None = None,
    progress: Callable[[str], None] | None = None,
    restart: Path | None = None,
    seconds_between: float = 60.0,
) -> Transient:
    """Press a block onto its road and slide it, step by step.

    Parameters
    ----------
    progress : callable, optional
        Gets a line every ten seconds.
    restart : Path, optional
        File that the march goes on from where it exists, and that it leaves its state in.
    seconds_between : float
        Seconds between two writings of that file, at least.

    Raises
    ------
    NotConverged
        With the scene, the step and the residual, where halving a step does not help.
    """
    marching = March(scene, procedure or Procedure())
    if restart is not None and restart.exists():
        marching.restore(restart)
    started = said = written = time.perf_counter()
    first = marching.position
    while not marching.ended:
        marching.step()
        now = time.perf_counter()
        if progress is not None and (now - said > _SILENCE or marching.ended):
            progress(marching.line((marching.position - first) / (now - started)))
            said = now
        if restart is not None and marching.position % _EVERY == 0 and now - written >= seconds_between:
            marching.save(restart)
            written = now
    if restart is not None:
        marching.save(restart)
    return marching.result()


class March:
    """A march that can be stopped after any step; ``march`` runs it to its end."""

    def __init__(self, scene: Scene, procedure: Procedure) -> None:
        self.scene, self.procedure = scene, procedure
        self.kinematics = decide(scene).kinematics
        numerics, road = scene.numerics, scene.road
        self.block = Block.graded(
            road.wavelength, scene.height, procedure.columns, scene.plane, numerics.row_growth, numerics.first_row
        )
        self.position = 0
        self._steps: Steps = procedure.steps(scene)
        self._records: list[tuple[float, ...]] = []
        self._seconds = 0.0
        self._model: SmallTransient | FiniteTransient = (
            SmallTransient(scene, self.block) if self.kinematics == "small" else FiniteTransient(scene, self.block)
        )
        if procedure.start == "relaxed":
            self._model.press_relaxed(scene.pressure)
        elif procedure.start == "steady":
            self._slide_steadily()
        # Where along the road the block begins: a start from steady sliding may need another place than 0.
        self._begin = self._model.state.offset

    def _slide_steadily(self) -> None:
        """Start from the steady solver's solution on the same mesh."""
        scene, columns = self.scene, self.procedure.columns
        numerics = dataclasses.replace(
            scene.numerics,
            columns_min=columns,
            finite_columns_min=columns,
            columns_max=columns,
        )
        solution = solve(dataclasses.replace(scene, numerics=numerics, kinematics=self.kinematics))
        if isinstance(solution, FiniteSolution) and isinstance(self._model, FiniteTransient):
            self._model.slide_steadily(solution.fields, solution.correction, scene.pressure, scene.velocity)
        elif isinstance(solution, SmallSolution) and isinstance(self._model, SmallTransient):
            self._model.slide_steadily(solution.contact, scene.pressure, scene.velocity)

    @property
    def ended(self) -> bool:
        """Whether all steps are done, or friction has saturated."""
        if self.position == len(self._steps.duration):
            return True
        slid = self._slid
        whole = slid > 0 and slid % self.procedure.steps_per_wavelength == 0
        return whole and self.procedure.saturation > 0.0 and self._judged().reached

    @property
    def _slid(self) -> int:
        """Steps done at full speed."""
        return self.position - int(np.searchsorted(self._steps.phase, PHASES.index("slide")))

    def _judged(self) -> Saturation:
        friction = np.array([record[COLUMNS.index("friction_contact")] for record in self._records])
        means = _means(friction[len(friction) - max(self._slid, 0) :], self.procedure.steps_per_wavelength)
        return judge(self.scene, means, self.procedure.saturation)

    def step(self) -> None:
        """Go one step."""
        steps, at, model = self._steps, self.position, self._model
        started = time.perf_counter()
        if at % _EVERY == 0:
            model.renew()
        before = model.state.offset
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
        self._seconds += time.perf_counter() - started

    def _advance(self, duration: float, offset: float, pressure: float, depth: int) -> tuple[Outcome, int]:
        """Return what a step does, and into how many halves it had to be divided."""
        state = self._model.state
        try:
            return self._model.advance(duration, offset, pressure), 0
        except (Stalled, NotConverged) as error:
            if depth == _MOST_HALVINGS:
                raise NotConverged(
                    self.scene.name,
                    self.position + 1,
                    error.residual,
                    "in the smallest of the halved steps of time, distance from balance and contact",
                ) from error
        middle = 0.5 * (state.offset + offset), 0.5 * (state.pressure + pressure)
        first, some = self._advance(0.5 * duration, *middle, depth + 1)
        second, more = self._advance(0.5 * duration, offset, pressure, depth + 1)
        return together(first, second), 1 + some + more

    def line(self, pace: float) -> str:
        """Return a line of progress."""
        at = self.position
        last = dict(zip(COLUMNS, self._records[-1], strict=True))
        return (
            f"{self.scene.name}: step {at} of at most {len(self._steps.duration)} ({PHASES[int(last['phase'])]}), "
            f"slid {last['slid'] / self.scene.road.wavelength:.2f} wavelengths, "
            f"friction {last['friction_contact']:.4f}, {pace:.1f} steps/s"
        )

    def result(self) -> Transient:
        """Return what has been recorded."""
        table = np.array(self._records).reshape(-1, len(COLUMNS)).T
        records = dict(zip(COLUMNS, table, strict=True))
        return Transient(
            self.scene, self.procedure, self.kinematics, self.block, records, self._judged(), self._seconds
        )

    def save(self, path: Path) -> None:
        """Leave the march in a file; ``restore`` goes on from there."""
        arrays = {f"model.{name}": array for name, array in self._model.snapshot().items()}
        arrays["records"] = np.array(self._records).reshape(-1, len(COLUMNS))
        arrays["marched"] = np.array((self.position, self._seconds, self._begin))
        checkpoint.write(path, self._label, arrays)

    def restore(self, path: Path) -> None:
        """Take over a march that ``save`` left.

        Raises
        ------
        BrokenResult
            Where the file is not that of the same scene and procedure.
        """
        arrays = checkpoint.read(path, self._label)
        position, self._seconds, self._begin = (float(value) for value in arrays["marched"])
        self.position = int(position)
        self._records = [tuple(float(value) for value in record) for record in arrays["records"]]
        self._model.restore(
            {name.removeprefix("model."): array for name, array in arrays.items() if name.startswith("model.")}
        )

    @property
    def _label(self) -> str:
        # More wavelengths, or others to stop after, leave the steps so far as they are.
        fixed = dataclasses.replace(self.procedure, wavelengths=1, saturation=0.0)
        return f"{self.scene.digest} {self.kinematics} {fixed}"


def _means(values: Real, steps: int) -> Real:
    whole = len(values) // steps
    means: Real = values[: whole * steps].reshape(whole, steps).mean(axis=1)
    return means
