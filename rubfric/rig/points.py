"""Friction, pressure and speed of a window, with confidence intervals, or the reason why it has none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.rig.bearing import Drag
from rubfric.rig.estimate import halfwidth, mean, noise_of, weights
from rubfric.rig.record import Record
from rubfric.rig.settings import Settings, Windows
from rubfric.rig.tare import Zero
from rubfric.rig.windows import STEADY, Window

# Independent samples that an interval of confidence needs, and windows below this part of the run's load.
_FEWEST_EFFECTIVE, _UNLOADED = 10.0, 0.1
# Part of the independent samples expected that a window may lack by chance.
_CONSISTENT = 0.5
# Mean friction differs from friction at the mean speed by half its second derivative over ln(speed), times the variance
# of ln(speed): (change of ln(speed) / 2)² / 7 under the weight. Of a Maxwell element's friction, ~ 1 / cosh(ln(speed)),
# that derivative is no larger than friction itself; nor is it, at a given contact, of a sum of elements and scales.
_SPREAD = 0.5 / 4.0 / 7.0
# Friction coefficients of rubber on a road are smaller.
_LARGEST = 5.0


@dataclass(frozen=True)
class Loaded:
    """A record whose forces are tared.

    Attributes
    ----------
    record : Record
    normal : numpy.ndarray, shape (samples,)
        N, positive under load.
    traction : numpy.ndarray, shape (samples,)
        N; positive where it resists a displacement that grows.
    clipped : numpy.ndarray of bool, shape (samples,)
    plateau : float
        Normal force of the loaded run, N.
    zero : Zero
    """

    record: Record
    normal: Real
    traction: Real
    clipped: Flags
    plateau: float
    zero: Zero


@dataclass(frozen=True)
class Point:
    """Friction measured in a window; every ``_ci95`` is the half-width of a 95 % confidence interval.

    Attributes
    ----------
    kind : {"steady", "sweep"}
    start, end : float
        s.
    samples : int
    effective_samples : float
        Number of independent samples that are worth as much.
    travel : float
        mm.
    acceleration : float
        mm/s².
    speed, speed_ci95 : float
        mm/s.
    pressure, pressure_ci95 : float
        MPa.
    friction_coefficient, friction_coefficient_ci95 : float
    """

    kind: str
    start: float
    end: float
    samples: int
    effective_samples: float
    travel: float
    acceleration: float
    speed: float
    speed_ci95: float
    pressure: float
    pressure_ci95: float
    friction_coefficient: float
    friction_coefficient_ci95: float


@dataclass(frozen=True)
class Rejected:
    """A window without a point.

    Attributes
    ----------
    start, end : float
        s.
    samples : int
    speed, pressure : float
        mm/s and MPa, where they are known; else NaN.
    reason : str
    """

    start: float
    end: float
    samples: int
    speed: float
    pressure: float
    reason: str


def evaluate(loaded: Loaded, window: Window, settings: Settings, drag: Drag) -> Point | Rejected:
    """Return the point of a window, or the first reason against it.

    All values are means with one weight (``rubfric.rig.estimate``), so that friction belongs to the speed that is
    given with it, however the speed changes within the window. Friction is the ratio of the mean forces, and its
    variance that of traction - mu normal force, so that what both sensors share does not count twice.

    A sensor at the rubber reads the rubber's friction. One in the rope also reads what accelerates the sled and what
    its bearings take, which is subtracted.

    Parameters
    ----------
    loaded : Loaded
    window : Window
    settings : Settings
        Area (mm²), place of the sensor of traction, mass of the sled (kg), calibration and limits of windows.
    drag : Drag
        Of the bearings; for a sensor in the rope.
    """
    part = slice(window.start, window.end)
    time, place, pressing = loaded.record.time[part], loaded.record.displacement[part], loaded.normal[part]
    speed = (place[-1] - place[0]) / (time[-1] - time[0])
    reason = _unfit(loaded, window, settings.windows)
    if reason:
        return _rejected(loaded, window, abs(speed), float(pressing.mean()) / settings.area, reason)
    weight, longer, way = weights(time), loaded.zero.longer, float(np.sign(speed))
    along, pulling = way * (place - place[0]), way * loaded.traction[part]
    shaking, pushing = noise_of(time, along, 1), noise_of(time, pressing, 0, longer=longer)
    motion, acceleration = mean(along, weight.rate, shaking), mean(along, weight.bend, shaking)
    normal, traction = mean(pressing, weight.mean, pushing), float(weight.mean @ pulling)
    friction, besides, errors = traction, 0.0, []
    if settings.traction == "rope":
        friction -= 1e-3 * settings.sled_mass * acceleration.value + drag(motion.value, normal.value)
        errors = [1e-3 * settings.sled_mass * acceleration.error, drag.error_at(motion.value)]
        besides = drag.coefficient
    ratio = friction / normal.value
    left = pulling - (ratio + besides) * pressing
    trend = noise_of(time, left, 0, longer=longer)
    tared, pulled = (float(part_of[part].mean()) for part_of in (loaded.zero.normal_error, loaded.zero.traction_error))
    errors += [mean(left, weight.mean, trend).error, pulled, (ratio + besides) * tared]
    length = time[-1] - time[0]
    gains = {name: settings.calibration.get(name, 0.0) for name in ("normal", "traction", "displacement")}
    doubts = [
        halfwidth(float(np.linalg.norm(errors)), trend.freedom) / normal.value,
        # A sensor in the rope has the gain of all that it reads, not of the rubber's part alone.
        gains["normal"] * (ratio + besides),
        gains["traction"] * traction / normal.value,
        ratio * _SPREAD * (acceleration.value * length / motion.value) ** 2,
    ]
    pressed = halfwidth(float(np.hypot(normal.error, tared)), normal.freedom)
    point = Point(
        kind=window.kind,
        start=float(time[0]),
        end=float(time[-1]),
        samples=time.size,
        effective_samples=trend.effective,
        travel=float(along[-1]),
        acceleration=acceleration.value,
        speed=motion.value,
        speed_ci95=float(np.hypot(halfwidth(motion.error, motion.freedom), gains["displacement"] * motion.value)),
        pressure=normal.value / settings.area,
        pressure_ci95=float(np.hypot(pressed, gains["normal"] * normal.value)) / settings.area,
        friction_coefficient=ratio,
        friction_coefficient_ci95=float(np.linalg.norm(doubts)),
    )
    changes = (abs(pushing.slope) * length / normal.value, abs(trend.slope) * length / max(abs(friction), 1e-30))
    clear = abs(trend.slope) > 3.0 * trend.slope_error
    reason = _doubt(point, _independent(point, longer), changes, clear, settings.windows)
    return _rejected(loaded, window, point.speed, point.pressure, reason) if reason else point


def _unfit(loaded: Loaded, window: Window, limits: Windows) -> str:
    """Return why a window cannot be evaluated; empty if it can."""
    part = slice(window.start, window.end)
    samples = window.end - window.start
    travel = float(np.ptp(loaded.record.displacement[part]))
    reading = int(np.count_nonzero(loaded.clipped[part]))
    pressing = float(loaded.normal[part].mean())
    if reading:
        return f"a force is clipped in {reading} of {samples} samples"
    if pressing < _UNLOADED * loaded.plateau:
        return f"not loaded: {pressing:.3g} N, less than {100 * _UNLOADED:g} % of the {loaded.plateau:.4g} N of the run"
    if travel < limits.least_travel:
        why = "" if window.kind == STEADY else f" while its speed changed by {100 * limits.sweep_range:g} %"
        return f"slid only {travel:.3g} mm{why}, less than {limits.least_travel:g} mm"
    if samples < limits.least_samples:
        why = "" if window.kind == STEADY else f" while the speed changes by {100 * limits.sweep_range:g} %"
        return f"only {samples} samples{why}, fewer than {limits.least_samples}"
    return ""


def _independent(point: Point, longer: float) -> float:
    """Return the number of independent samples by which a window is judged.

    That of the unloaded sensors' noise, unless the window's own is far smaller. The number estimated in a short window
    is noisy: a selection by it would keep the windows whose errors are underestimated.
    """
    known = point.samples / longer
    return known if point.effective_samples > _CONSISTENT * known else point.effective_samples


def _doubt(point: Point, independent: float, changes: tuple[float, float], clear: bool, limits: Windows) -> str:
    """Return why the point of a window is rejected; empty if it is not."""
    friction, doubt = point.friction_coefficient, point.friction_coefficient_ci95
    if independent < _FEWEST_EFFECTIVE:
        return (
            f"its {point.samples} samples are so correlated that they count for {independent:.1f} "
            f"independent ones, fewer than {_FEWEST_EFFECTIVE:g}"
        )
    if changes[0] > limits.load_range:
        return f"the normal force changes by {100 * changes[0]:.2g} %, more than {100 * limits.load_range:g} %"
    if friction + doubt <= 0.0:
        return f"friction would be {friction:.3g}: traction points along the motion, or its zero is wrong"
    if friction - doubt > _LARGEST:
        return f"friction would be {friction:.3g}, more than any rubber's: look at the units and at the zero"
    if doubt > limits.largest_uncertainty * friction:
        return f"friction is not resolved: {friction:.2g} +- {doubt:.2g}"
    if point.kind == STEADY and clear and changes[1] > limits.drift:
        return f"friction changes by {100 * changes[1]:.2g} % at a steady speed, more than {100 * limits.drift:g} %"
    return ""


def _rejected(loaded: Loaded, window: Window, speed: float, pressure: float, reason: str) -> Rejected:
    time = loaded.record.time
    return Rejected(
        float(time[window.start]), float(time[window.end - 1]), window.end - window.start, speed, pressure, reason
    )
