"""Press and slide, step by step: the one place that knows the march in time and both kinematics."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from rubfric.errors import NotConverged
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.march import FiniteStepper
from rubfric.mechanics.march.march import FRESH, March
from rubfric.mechanics.march.result import FEWEST_NODES, Transient
from rubfric.mechanics.march.step import Stepper
from rubfric.mechanics.small.march import SmallStepper
from rubfric.mechanics.steady.energies import MOST_CLOSURE
from rubfric.mechanics.theory.limits import require_columns
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import MECHANICS, decide_solvable

STEPPERS: dict[str, Callable[[Scene, Block], Stepper]] = {"small": SmallStepper, "finite": FiniteStepper}
# Seconds between two lines of progress.
_SILENCE = 10.0


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
    scene : Scene
    procedure : Procedure, optional
        Mesh, steps and phases; the defaults of ``Procedure`` where it is left out.
    progress : callable, optional
        Gets a line every ten seconds.
    restart : Path, optional
        File that the march goes on from where it exists, and that it leaves its state in.
    seconds_between : float
        Seconds between two writings of that file, at least.

    Raises
    ------
    InvalidInput
        Where the block has too few columns for so light a contact, the load leaves hardly anything of
        the block, or the rubber is too nearly incompressible.
    NotConverged
        With the scene, the step and the residual, where halving a step does not help, or where columns or steps turn
        out too few: hardly a node touches the road, or the routes to friction contradict each other.

    Examples
    --------
    >>> import rubfric
    >>> scene = rubfric.load().scene(scale=1, velocity=100, pressure=0.5, kinematics="small")
    >>> procedure = rubfric.Procedure(start="steady", columns=64, steps_per_wavelength=16, wavelengths=1)
    >>> marched = rubfric.march(scene, procedure)
    >>> len(marched.records["friction_work"])
    16
    >>> print(f"{marched.saturation.friction:.2f}, settled: {marched.saturation.reached}")
    0.20, settled: False
    """
    marching = begin(scene, procedure or Procedure())
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
        marching.decision.kinematics,
        marching.block,
        marching.records,
        marching.saturation,
        marching.seconds,
    )
    _require_sound(found)
    return found


def begin(scene: Scene, procedure: Procedure) -> March:
    """Return a march of which no step is done yet, in the kinematics that the scene asks for or needs.

    Parameters
    ----------
    scene : Scene
    procedure : Procedure

    Raises
    ------
    InvalidInput
        As ``march`` does.
    """
    decision = decide_solvable(scene)
    require_columns(scene, procedure.columns, FEWEST_NODES)
    return March(scene, procedure, decision, STEPPERS[decision.kinematics], MECHANICS[decision.kinematics].solve)


def _require_sound(found: Transient) -> None:
    """Refuse a march that its mesh or its steps were too coarse for: NotConverged."""
    name, steps = found.scene.name, len(found.records["time"])
    if not found.contact_nodes >= FEWEST_NODES:
        measure = f"number of surface nodes in contact, out of {found.block.columns}, on average,"
        advice = f"at least {FEWEST_NODES:g} make a contact: raise procedure.columns or the pressure"
        raise NotConverged(name, steps, found.contact_nodes, measure, advice)
    if not found.closure <= MOST_CLOSURE:  # also where it is not a number
        measure = "relative difference of friction by contact, work and energy"
        advice = "raise procedure.columns and procedure.steps_per_wavelength"
        raise NotConverged(name, steps, found.closure, measure, advice)
