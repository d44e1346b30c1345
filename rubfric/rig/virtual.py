"""The virtual rig: runs under weights chosen so that they span the simulated speeds and pressures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rubfric.config.rig import VirtualRig
from rubfric.errors import InvalidInput
from rubfric.results.friction_map import FrictionMap
from rubfric.rig.bearing import Drag
from rubfric.rig.points import Rejected
from rubfric.rig.record import SIMULATED
from rubfric.rig.reduction import Reduced, reduce_record
from rubfric.rig.sensors import Ideal, Sensors, as_record, ideal, recorded, write_run
from rubfric.rig.settings import Bearing, Settings
from rubfric.rig.sled import Sled, choose_weight, slide
from rubfric.rules import Number

# Least duration, s, and least travel, mm, of a run that settles.
_LASTS, _SLIDES = 2.0, 3.0
# No run takes longer, s.
_LONGEST = 1000.0


@dataclass(frozen=True)
class Run:
    """A run to simulate.

    Attributes
    ----------
    pressure : float
        Nominal, MPa.
    weight : float
        On the rope, kg.
    speed : float
        The slowest speed that it is for, mm/s.
    settles : bool
        Whether the sled settles at that speed.
    """

    pressure: float
    weight: float
    speed: float
    settles: bool

    @property
    def name(self) -> str:
        """What the run is called in tables."""
        return f"virtual rig, {self.pressure:.4g} MPa, {self.weight:.4g} kg"


def plan(
    friction: FrictionMap, sled: Sled, targets: Iterable[tuple[float, float]], heaviest: float
) -> tuple[list[Run], list[Reduced]]:
    """Choose the weights that bring the sled to some speeds and pressures.

    Parameters
    ----------
    friction : FrictionMap
    sled : Sled
    targets : iterable of tuple of float
        Speed (mm/s) and pressure (MPa).
    heaviest : float
        Weight, kg.

    Returns
    -------
    list of Run
        Each once, by pressure and weight.
    list of Reduced
        The targets that cannot be reached, and why.
    """
    runs: dict[tuple[float, float], Run] = {}
    beyond = []
    for speed, pressure in sorted(set(targets), key=lambda target: (target[1], target[0])):
        reason = _outside(friction, speed, pressure)
        found = reason or choose_weight(sled, friction.at(pressure), pressure, speed, heaviest)
        if isinstance(found, str):
            rejected = Rejected(np.nan, np.nan, 0, speed, pressure, found)
            beyond.append(Reduced("virtual rig, no run", SIMULATED, (), (rejected,), ()))
        else:
            weight = float(f"{found.mass:.6g}")  # one run, where rounding alone would make two
            runs.setdefault((pressure, weight), Run(pressure, weight, speed, found.settles))
    return [runs[key] for key in sorted(runs)], beyond


def _outside(friction: FrictionMap, speed: float, pressure: float) -> str:
    if not friction.holds(pressure):
        return f"outside the pressures simulated, {friction.pressures[0]:g} to {friction.pressures[-1]:g} MPa"
    if not friction.speeds[0] <= speed <= friction.speeds[-1]:
        return f"outside the speeds simulated, {friction.speeds[0]:g} to {friction.speeds[-1]:g} mm/s"
    return ""


def make(run: Run, friction: FrictionMap, sled: Sled, sensors: Sensors) -> Ideal:
    """Return a run as perfect sensors would record it.

    Parameters
    ----------
    run : Run
    friction : FrictionMap
    sled : Sled
    sensors : Sensors
    """
    curve = friction.at(run.pressure)
    distance = min(sled.travel, max(_SLIDES, _LASTS * run.speed)) if run.settles else sled.travel
    motion = slide(sled, curve, run.pressure, run.weight, _LONGEST, distance)
    return ideal(sled, curve, motion, run.pressure, run.weight, sensors)


def measure(runs: Iterable[Run], friction: FrictionMap, sled: Sled, sensors: Sensors, seed: int) -> Iterator[Reduced]:
    """Simulate some runs and reduce them as measured ones; each has its own random numbers.

    Parameters
    ----------
    runs : iterable of Run
    friction : FrictionMap
    sled : Sled
    sensors : Sensors
    seed : int
    """
    settings = settings_of(sled, sensors)
    drag = Drag(sled.bearing_force, sled.bearing_damping, sled.bearing_coefficient, 0.0)
    for number, run in enumerate(runs):
        values = recorded(make(run, friction, sled, sensors), sensors, np.random.default_rng([seed, number]))
        try:
            yield reduce_record(as_record(run.name, values), settings, drag)
        except InvalidInput as error:  # sensors so poor that the run cannot be read
            start, end = float(values[0, 0]), float(values[0, -1])
            rejected = Rejected(start, end, values.shape[1], run.speed, run.pressure, str(error))
            yield Reduced(run.name, SIMULATED, (), (rejected,), ())


def settings_of(sled: Sled, sensors: Sensors) -> Settings:
    """Return the settings by which runs of the virtual rig are reduced.

    Parameters
    ----------
    sled : Sled
    sensors : Sensors
    """
    bearing = Bearing(sled.bearing_force, sled.bearing_coefficient) if sensors.traction == "rope" else Bearing()
    return Settings(area=sled.area, traction=sensors.traction, sled_mass=sled.mass, bearing=bearing)


def parts_of(rig: VirtualRig) -> tuple[Sled, Sensors]:
    """Return the sled and the sensors that a config describes."""
    sled = Sled(rig.area, rig.sled_mass, rig.travel, rig.bearing_force, rig.bearing_coefficient)
    sensors = Sensors(
        sampling=rig.sampling,
        force_noise=rig.force_noise,
        displacement_noise=rig.displacement_noise,
        displacement_step=rig.displacement_step,
        traction=rig.traction,
    )
    return sled, sensors


def targets(friction: FrictionMap, pressures: Iterable[float], speeds: Iterable[float]) -> set[tuple[float, float]]:
    """Return the speeds (mm/s) and pressures (MPa) at which to measure.

    Parameters
    ----------
    friction : FrictionMap
    pressures : iterable of float
        MPa; each at the simulated speeds and half-way between them.
    speeds : iterable of float
        mm/s; each at the simulated pressures and half-way between them.
    """
    along_speed, along_pressure = between(friction.speeds), between(friction.pressures)
    found = {(speed, pressure) for pressure in pressures for speed in (*along_speed, *speeds)}
    return found | {(speed, pressure) for speed in speeds for pressure in (*along_pressure, *pressures)}


def between(values: np.ndarray) -> tuple[float, ...]:
    """Return ascending positive numbers, shape (count,), and the geometric mean of each with the next."""
    middles = np.sqrt(values[:-1] * values[1:])
    return tuple(float(f"{value:.6g}") for value in np.sort(np.concatenate((values, middles))))


def simulate(
    friction: FrictionMap, rig: VirtualRig, pressure: float, weight: float | None, speed: float | None, path: Path
) -> str:
    """Simulate one run, write what the sensors record, and return a summary in words.

    Parameters
    ----------
    friction : FrictionMap
    rig : VirtualRig
    pressure : float
        Nominal, MPa.
    weight, speed : float or None
        The weight on the rope (kg), or else the speed (mm/s) for which to choose one.
    path : pathlib.Path
        CSV file to write.

    Raises
    ------
    InvalidInput
        For a pressure or a speed outside of what was simulated, or a weight that does not move the sled.
    """
    sled, sensors = parts_of(rig)
    curve = friction.at(Number(unit="MPa").check("pressure", pressure))
    if weight is None:
        wanted = Number(unit="mm/s").check("speed", speed)
        reason = _outside(friction, wanted, pressure)
        found = reason or choose_weight(sled, curve, pressure, wanted, rig.heaviest_weight)
        if isinstance(found, str):
            raise InvalidInput(f"speed is {wanted:g} mm/s, but that is {found}")
        run = Run(pressure, found.mass, wanted, found.settles)
    else:
        run = Run(pressure, Number(unit="kg").check("weight", weight), float(friction.speeds[-1]), False)
    made = make(run, friction, sled, sensors)
    fastest = float(made.speed(made.release + np.linspace(0.0, made.motion.duration, 1001)).max())
    about = [
        f"{run.pressure:g} MPa, weight {run.weight:.6g} kg, seed {rig.seed}",
        *(f"{name}: {value}" for name, value in rig if name != "seed"),
    ]
    write_run(recorded(made, sensors, np.random.default_rng(rig.seed)), path, about)
    return (
        f"virtual rig (simulated): {run.weight:.4g} kg pull the sled to {fastest:.4g} mm/s in "
        f"{made.motion.duration:.3g} s; {made.motion.end}\nWritten to {path}"
    )
