"""Drag of the sled's bearings, which a sensor in the rope reads along with the rubber's friction."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric.errors import InvalidInput
from rubfric.rig.estimate import mean, noise_of, weights
from rubfric.rig.record import Record
from rubfric.rig.settings import Bearing, Settings
from rubfric.rig.speed import cells
from rubfric.rig.tare import find_zero
from rubfric.rig.windows import find_windows

# Fewest windows for a dependence on speed, and the factor by which their speeds must differ.
_FEWEST, _SPAN = 4, 3.0


@dataclass(frozen=True)
class Drag:
    """Drag of the bearings: ``force`` + ``damping`` times speed + ``coefficient`` times the normal force.

    Attributes
    ----------
    force : float
        N.
    damping : float
        N s/mm.
    coefficient : float
        Dimensionless.
    error : float
        Standard error of the drag, N; of a drag with damping, at the speed ``middle``.
    notes : tuple of str
    middle, damping_error : float
        Mean speed of what the damping was taken from, mm/s, and its standard error, N s/mm.
    """

    force: float
    damping: float
    coefficient: float
    error: float
    notes: tuple[str, ...] = ()
    middle: float = 0.0
    damping_error: float = 0.0

    def __call__(self, speed: float, normal: float) -> float:
        """Return the drag, N.

        Parameters
        ----------
        speed : float
            mm/s, positive.
        normal : float
            Normal force, N.
        """
        return self.force + self.damping * speed + self.coefficient * normal

    def error_at(self, speed: float) -> float:
        """Return the standard error of the drag (N) at a speed (mm/s); it grows away from the measured ones."""
        return math.hypot(self.error, self.damping_error * (speed - self.middle))


def given_drag(bearing: Bearing) -> Drag:
    """Return the drag that the user gives; the uncertainty given counts as two standard errors."""
    return Drag(bearing.force, 0.0, bearing.coefficient, 0.5 * bearing.uncertainty)


def measured_drag(pull: Record, settings: Settings) -> Drag:
    """Return the drag from an unloaded pull, with the sensor in the rope.

    The rope accelerates the sled, too: its mass times its acceleration is subtracted. A straight line over speed is
    fitted where the windows differ enough in speed, and otherwise a constant.

    Parameters
    ----------
    pull : Record
        Of the unloaded pull.
    settings : Settings
        Mass of the sled (kg), bearings, tare and windows.

    Raises
    ------
    InvalidInput
        Where the sled does not slide in the record.
    """
    zero = find_zero(pull, settings.tare, loading="traction")
    traction = pull.traction - zero.traction
    speeds, forces, errors = [], [], []
    for window in find_windows(pull, cells(pull, settings.windows.least_travel), settings.windows):
        part = slice(window.start, window.end)
        if window.end - window.start < settings.windows.least_samples:
            continue
        time, place, over = pull.time[part], pull.displacement[part], weights(pull.time[part])
        noise = noise_of(time, place, 1)
        speed, acceleration = mean(place, over.rate, noise), mean(place, over.bend, noise)
        pulled = mean(traction[part], over.mean, noise_of(time, traction[part], 1, longer=zero.longer))
        inertia = 1e-3 * settings.sled_mass * acceleration.value * np.sign(speed.value)
        speeds.append(abs(speed.value))
        forces.append(abs(pulled.value) - inertia)
        errors.append(np.hypot(pulled.error, 1e-3 * settings.sled_mass * acceleration.error))
    if not speeds:
        raise InvalidInput(f"{pull.name} shows no unloaded sliding from which the drag of the bearings could be taken")
    trust = 1.0 / np.maximum(errors, 1e-12 * max(1.0, *map(abs, forces)))
    sloped = len(speeds) >= _FEWEST and max(speeds) >= _SPAN * min(speeds)
    powers = np.vander(speeds, 2 if sloped else 1, increasing=True)
    found, *_ = np.linalg.lstsq(powers * trust[:, None], np.array(forces) * trust, rcond=None)
    spread = np.array(forces) - powers @ found
    freedom = max(len(speeds) - found.size, 1)
    doubt = max(
        float(np.sqrt(spread @ spread / freedom / len(speeds))), float(np.min(errors)), float(zero.traction_error.max())
    )
    force, damping = float(found[0]), float(found[1]) if sloped else 0.0
    middle = float(np.average(speeds, weights=trust**2))
    # At least the scatter about the line, and at least the errors of its points.
    unit = max(1.0, float(np.sqrt(np.sum((spread * trust) ** 2) / freedom)))
    tilt = unit / float(np.linalg.norm(trust * (np.array(speeds) - middle))) if sloped else 0.0
    words = f"bearing drag {force:.4g} N{f' + {damping:.3g} N s/mm v' if sloped else ''} +- {2.0 * doubt:.2g} N"
    notes = (f"{words}, from {pull.name} at {min(speeds):.3g} to {max(speeds):.3g} mm/s",)
    return Drag(force, damping, settings.bearing.coefficient, doubt, notes, middle, tilt)
