"""What the sensors of the rig record of a simulated run: noise, offsets, drift and steps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.signal import lfilter

from rubfric.arrays import Real
from rubfric.files import whole
from rubfric.results.friction_map import FrictionCurve
from rubfric.rig.record import SIMULATED, SIMULATED_MARK, Record, ordered
from rubfric.rig.sled import GRAVITY, Motion, Sled

# The run, s: unloaded, loading, under load at rest, at rest after the slide, unloading, unloaded again.
_BEFORE, _LOADING, _HOLD, _REST, _UNLOADING, _AFTER = 1.0, 0.5, 0.5, 0.2, 0.3, 0.7
# Most samples of a run: a slow one is sampled more slowly.
MOST_SAMPLES = 20000
HEADINGS = ("time (s)", "normal force (N)", "traction (N)", "displacement (mm)")


@dataclass(frozen=True)
class Sensors:
    """Imperfections of the sensors, and how often they are read.

    Attributes
    ----------
    sampling : float
        Hz, at most.
    force_noise : float
        Standard deviation, N, of both forces.
    force_memory : float
        Time over which that noise is correlated, s.
    displacement_noise, displacement_step : float
        Standard deviation, and step of the reading, mm.
    normal_offset, traction_offset : float
        Readings without a load, N.
    drift : float
        Of both offsets over a run, N.
    traction : {"rubber", "rope"}
        Where the sensor of traction sits.
    """

    sampling: float = 5000.0
    force_noise: float = 0.2
    force_memory: float = 0.5e-3
    displacement_noise: float = 0.002
    displacement_step: float = 0.005
    normal_offset: float = 1.5
    traction_offset: float = -0.8
    drift: float = 0.1
    traction: str = "rubber"


@dataclass(frozen=True)
class Ideal:
    """What perfect sensors would record of a simulated run, and its true motion.

    Attributes
    ----------
    time, normal, traction, displacement : numpy.ndarray, shape (samples,)
        s, N, N, mm.
    motion : Motion
    release : float
        When the sled is released, s.
    """

    time: Real
    normal: Real
    traction: Real
    displacement: Real
    motion: Motion
    release: float

    def speed(self, time: Real | float) -> Real:
        """Return the true speed, mm/s, at times (s) of the record at which the sled slides."""
        return self.motion.state(np.asarray(time) - self.release)[1]


def ideal(sled: Sled, curve: FrictionCurve, motion: Motion, pressure: float, weight: float, sensors: Sensors) -> Ideal:
    """Return what perfect sensors would record of a run: unloaded, loaded, released, stopped and unloaded again.

    The weight is hung on the rope and taken off together with the normal force; but for the slide, the sled is held.

    Parameters
    ----------
    sled : Sled
    curve : FrictionCurve
        Friction over speed at ``pressure``.
    motion : Motion
        After the release.
    pressure, weight : float
        MPa, kg.
    sensors : Sensors
        How often they are read, and which traction.
    """
    release = _BEFORE + _LOADING + _HOLD
    stop = release + motion.duration
    end = stop + _REST + _UNLOADING + _AFTER
    rate = min(sensors.sampling, MOST_SAMPLES / end)
    time = np.arange(int(end * rate)) / rate
    on = np.clip((time - _BEFORE) / _LOADING, 0.0, 1.0)
    off = np.clip((time - stop - _REST) / _UNLOADING, 0.0, 1.0)
    load = np.sin(0.5 * np.pi * (on - off)) ** 2
    place, speed = motion.state(np.clip(time - release, 0.0, motion.duration))
    full, pull = pressure * sled.area, 1e-3 * weight * GRAVITY
    friction = curve(speed) * full
    drag = sled.drag(speed, full)
    acceleration = (pull - friction - drag) / (1e-3 * (sled.mass + weight))
    sliding = (time >= release) & (time <= stop)
    if sensors.traction == "rope":
        traction = np.where(sliding, friction + drag + 1e-3 * sled.mass * acceleration, pull * load)
    else:
        traction = np.where(sliding, friction, 0.0)
    return Ideal(time, full * load, traction, place, motion, release)


def recorded(run: Ideal, sensors: Sensors, rng: np.random.Generator) -> Real:
    """Return what the sensors record of a run.

    Parameters
    ----------
    run : Ideal
    sensors : Sensors
    rng : numpy.random.Generator

    Returns
    -------
    numpy.ndarray, shape (4, samples)
        Time (s), normal force (N), traction (N), displacement (mm).
    """
    drift = sensors.drift * run.time / run.time[-1]
    normal = run.normal + sensors.normal_offset + drift + _noise(run.time, sensors, rng)
    traction = run.traction + sensors.traction_offset + drift + _noise(run.time, sensors, rng)
    place = run.displacement + sensors.displacement_noise * rng.standard_normal(run.time.size)
    if sensors.displacement_step > 0.0:
        place = sensors.displacement_step * np.round(place / sensors.displacement_step)
    return np.stack([run.time, normal, traction, place])


def _noise(time: Real, sensors: Sensors, rng: np.random.Generator) -> Real:
    """Return noise of the forces that is correlated over their memory: a first-order autoregression, stationary."""
    kept = float(np.exp(-(time[1] - time[0]) / sensors.force_memory)) if sensors.force_memory > 0.0 else 0.0
    fresh = rng.standard_normal(time.size)
    fresh[1:] *= np.sqrt(1.0 - kept**2)
    return sensors.force_noise * lfilter([1.0], [1.0, -kept], fresh)


def as_record(name: str, values: Real) -> Record:
    """Return a simulated run as a record for the reduction.

    Parameters
    ----------
    name : str
    values : numpy.ndarray, shape (4, samples)
        As ``recorded`` returns it.
    """
    return ordered(name, SIMULATED, values)


def write_run(values: Real, path: str | Path, about: list[str]) -> None:
    """Write a simulated record as a CSV file, whole or not at all; its first lines say that it is simulated.

    Parameters
    ----------
    values : numpy.ndarray, shape (4, samples)
        As ``recorded`` returns it.
    path : path-like
    about : list of str
        Lines above the headings.
    """
    table = pd.DataFrame(dict(zip(HEADINGS, values, strict=True)))
    with whole(path) as part, part.open("w", encoding="utf-8", newline="") as stream:
        stream.writelines(f"# {line}\n" for line in [f"rubfric {SIMULATED_MARK}: no measurement", *about])
        table.to_csv(stream, index=False, float_format="%.9g")
