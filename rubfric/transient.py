"""Press and slide, step by step: the procedure of Zhou, Wang and Wei (2019) on one scene, and what it yields."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rubfric.arrays import Real
from rubfric.block import Block
from rubfric.errors import NotConverged
from rubfric.kinematics import decide
from rubfric.marching import FRESH, March, wavelength_means
from rubfric.procedure import PHASES, Procedure
from rubfric.resolvable import require_columns, require_height
from rubfric.routes import MOST_CLOSURE, ROUND_OFF, disagreement
from rubfric.saturation import Saturation
from rubfric.scene import Scene

# Seconds between two lines of progress.
_SILENCE = 10.0
# Surface nodes in contact at full speed, on average, below which a mesh does not see the contact that it moves.
_FEWEST_NODES = 2.0
# Distance from balance at which a step in finite strain is solved, and the share of what friction varies by while a
# node is passed that its mean is good for: friction below either cannot be told from zero.
_TOLERANCE, _SHARE = 1e-6, 1e-2


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
        return wavelength_means(self.records[route][self.sliding], self.procedure.steps_per_wavelength)

    @property
    def imbalance(self) -> float:
        """The first law: sum of what is missing at full speed over the work of the road there, dimensionless."""
        missing = self.records["imbalance"][self.sliding].sum()
        return float(abs(missing) / self.records["road_work"][self.sliding].sum())

    @property
    def friction(self) -> tuple[float, float, float]:
        """Friction coefficient by contact, by the work of the road and by energy: means at full speed."""
        routes = ("friction_contact", "friction_work", "friction_energy")
        contact, work, energy = (float(self.records[route][self.sliding].mean()) for route in routes)
        return contact, work, energy

    @property
    def resolution(self) -> float:
        """Friction at full speed that the march cannot tell from zero, dimensionless."""
        variation = float(self.records["friction_contact"][self.sliding].std())
        return max(_TOLERANCE * self.scene.road.steepest_slope, _SHARE * variation, ROUND_OFF)

    @property
    def closure(self) -> float:
        """Largest relative difference of the three means, or of ``resolution`` where that is larger."""
        return disagreement(self.friction, self.resolution)

    @property
    def contact_nodes(self) -> float:
        """Surface nodes in contact at full speed, on average."""
        return float(self.records["contact_fraction"][self.sliding].mean()) * self.block.columns


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
    InvalidInput
        Where the block has too few columns for so light a contact, or the load leaves hardly anything of it.
    NotConverged
        With the scene, the step and the residual, where halving a step does not help, or where columns or steps turn
        out too few: hardly a node touches the road, or the routes to friction contradict each other.
    """
    given = procedure or Procedure()
    require_columns(scene, given.columns, _FEWEST_NODES)
    if decide(scene).kinematics == "finite":
        require_height(scene)
    marching = March(scene, given)
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
        if restart is not None and marching.position % FRESH == 0 and now - written >= seconds_between:
            marching.save(restart)
            written = now
    if restart is not None:
        marching.save(restart)
    found = Transient(
        scene,
        marching.procedure,
        marching.kinematics,
        marching.block,
        marching.records,
        marching.saturation,
        marching.seconds,
    )
    _require_sound(found)
    return found


def _require_sound(found: Transient) -> None:
    """Refuse a march that its mesh or its steps were too coarse for: NotConverged."""
    name, steps = found.scene.name, len(found.records["time"])
    if not found.contact_nodes >= _FEWEST_NODES:
        measure = f"number of surface nodes in contact, out of {found.block.columns}, on average,"
        advice = f"at least {_FEWEST_NODES:g} make a contact: raise procedure.columns or the pressure"
        raise NotConverged(name, steps, found.contact_nodes, measure, advice)
    if not found.closure <= MOST_CLOSURE:  # also where it is not a number
        measure = "relative difference of friction by contact, work and energy"
        advice = "raise procedure.columns and procedure.steps_per_wavelength"
        raise NotConverged(name, steps, found.closure, measure, advice)
