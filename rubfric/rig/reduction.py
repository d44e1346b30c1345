"""From the records of runs to friction over speed and pressure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from rubfric.arrays import Flags
from rubfric.errors import InvalidInput
from rubfric.rig.bearing import Drag, given_drag, measured_drag
from rubfric.rig.clipping import clipped
from rubfric.rig.points import Loaded, Point, Rejected, evaluate
from rubfric.rig.record import Record, read_record
from rubfric.rig.settings import Settings
from rubfric.rig.speed import cells
from rubfric.rig.tare import Zero, find_zero
from rubfric.rig.windows import Window, find_windows

# field of a point: heading
COLUMNS = {
    "kind": "kind",
    "start": "start_s",
    "end": "end_s",
    "samples": "samples",
    "effective_samples": "effective_samples",
    "travel": "travel_mm",
    "acceleration": "acceleration_mm_per_s2",
    "speed": "speed_mm_per_s",
    "speed_ci95": "speed_ci95_mm_per_s",
    "pressure": "pressure_MPa",
    "pressure_ci95": "pressure_ci95_MPa",
    "friction_coefficient": "friction_coefficient",
    "friction_coefficient_ci95": "friction_coefficient_ci95",
}
REJECTED_COLUMNS = {
    "start": "start_s",
    "end": "end_s",
    "samples": "samples",
    "speed": "speed_mm_per_s",
    "pressure": "pressure_MPa",
    "reason": "reason",
}
# Pressures, MPa, between which rubber is usually pressed onto a road, and above which none is.
_LOWEST, _HIGHEST, _UNBEARABLE = 1e-4, 20.0, 200.0
# Part of the traction in sliding by which its zero may move.
_LARGEST_DRIFT = 0.5


@dataclass(frozen=True)
class Reduced:
    """The outcome of one run.

    Attributes
    ----------
    name : str
    source : {"measured", "simulated"}
    points : tuple of Point
    rejected : tuple of Rejected
    notes : tuple of str
        What was changed in its record.
    """

    name: str
    source: str
    points: tuple[Point, ...]
    rejected: tuple[Rejected, ...]
    notes: tuple[str, ...]


def reduce_files(paths: Iterable[str], settings: Settings) -> list[Reduced]:
    """Reduce the files of some runs as ``reduce_record`` does.

    Parameters
    ----------
    paths : iterable of str
        Text files (CSV), one for each run.
    settings : Settings
    """
    drag = find_drag(settings)
    return [reduce_record(read_record(path, settings), settings, drag) for path in paths]


def find_drag(settings: Settings) -> Drag:
    """Return the drag of the bearings as given, or from the record of an unloaded pull."""
    if settings.bearing.file and settings.traction == "rope":
        return measured_drag(read_record(settings.bearing.file, settings), settings)
    return given_drag(settings.bearing)


def reduce_record(record: Record, settings: Settings, drag: Drag) -> Reduced:
    """Return the points of a run, and its rejected windows with the reasons.

    Parameters
    ----------
    record : Record
    settings : Settings
    drag : Drag
        Of the bearings; for a sensor in the rope.

    Raises
    ------
    InvalidInput
        Where the area of the rubber is not known, or the run has no unloaded stretch to tare from.
    """
    if settings.area <= 0.0:
        raise InvalidInput(
            "area is not given, but pressure needs the nominal area of the rubber, mm²: write it in the YAML file of "
            "--columns, or give --area"
        )
    zero = find_zero(record, settings.tare)
    pieces = cells(record, settings.windows.least_travel)
    windows = find_windows(record, pieces, settings.windows)
    loaded, notes = _loaded(record, settings, zero, windows)
    notes += _check_area(record, settings.area, loaded.plateau)
    found = [evaluate(loaded, window, settings, drag) for window in windows]
    points = tuple(one for one in found if isinstance(one, Point))
    rejected = tuple(one for one in found if isinstance(one, Rejected))
    if not windows:
        rejected = (_no_window(record, settings),)
    bearings = _about_bearings(settings, drag)
    return Reduced(record.name, record.source, points, rejected, (*record.notes, *zero.notes, *notes, *bearings))


def _loaded(record: Record, settings: Settings, zero: Zero, windows: Sequence[Window]) -> tuple[Loaded, list[str]]:
    """Return the forces, tared and with the usual signs."""
    notes = []
    normal, traction = record.normal - zero.normal, record.traction - zero.traction
    sliding = np.zeros(normal.size, dtype=bool)
    way = 0.0
    for window in windows:
        part = slice(window.start, window.end)
        sliding[part] = True
        place = record.displacement[part]
        way += float(np.sign(place[-1] - place[0])) * float(traction[part].sum())
    if settings.tare.how == "auto" and sliding.any():
        _check_zero(record, zero, sliding, settings.traction == "rope")
    levels = normal[sliding] if sliding.any() else normal
    plateau = float(np.percentile(np.abs(levels), 75.0)) * (1.0 if np.median(levels) >= 0.0 else -1.0)
    if plateau == 0.0:
        raise InvalidInput(
            f"{record.name} has no normal force in sliding: {np.median(record.normal):.4g} N, of which the tare takes "
            "all; a known constant load is given as normal: and the force in N in the YAML file of --columns"
        )
    if plateau < 0.0:
        normal, plateau = -normal, -plateau
        notes.append("sign of the normal force turned: it is negative under load")
    if way < 0.0:
        traction = -traction
        notes.append("sign of the traction turned: it points along the motion")
    flags = record.overloaded.copy()
    for name, readings in (("normal", record.normal), ("traction", record.traction)):
        beyond = clipped(readings, settings.range.get(name))
        if beyond[sliding].any():
            notes.append(f"the {name} force is clipped in {np.count_nonzero(beyond)} samples")
        flags |= beyond
    return Loaded(record, normal, traction, flags, plateau, zero), notes


def _check_zero(record: Record, zero: Zero, sliding: Flags, rope: bool) -> None:
    """Raise InvalidInput where the zero of traction drifts too far, or is the tension of a rope that was not slack."""
    tension, reading = (float(np.abs(force[sliding]).mean()) for force in (zero.traction, record.traction))
    drift = abs(float(zero.traction[-1] - zero.traction[0]))
    pulled = float(np.abs((record.traction - zero.traction)[sliding]).mean())
    if drift > _LARGEST_DRIFT * pulled:
        raise InvalidInput(
            f"{record.name} has a zero of traction that moves by {drift:.3g} N from before the load to after it, too "
            f"much beside {pulled:.3g} N in sliding: say under tare in the YAML file of --columns when it was unloaded"
        )
    if rope and tension > reading:
        raise InvalidInput(
            f"{record.name} has a traction of {tension:.4g} N before the load, more than the {reading:.4g} N "
            "in sliding: was the rope slack then? If it was, say from when to when under tare in the YAML of --columns"
        )


def _check_area(record: Record, area: float, plateau: float) -> list[str]:
    """Return a note on a pressure that is far from any rubber's; raise InvalidInput where none bears it."""
    pressure = plateau / area
    metres = f" ({area:g} m² would be {1e6 * area:g} mm²)" if area < 1.0 else ""
    what = f"{plateau:.4g} N on an area of {area:g} mm² make {pressure:.3g} MPa"
    if pressure > _UNBEARABLE:
        raise InvalidInput(f"{record.name}: {what}, more than any rubber bears: give area in mm²{metres}")
    if not _LOWEST <= pressure <= _HIGHEST:
        return [f"{what}, far from usual pressures of rubber on a road: is area in mm²{metres}, and the load in N?"]
    return []


def _no_window(record: Record, settings: Settings) -> Rejected:
    travel = float(np.ptp(record.displacement))
    least = settings.windows.least_travel
    reason = f"the sled slid only {travel:.3g} mm in all, less than {least:g} mm"
    if travel >= least:
        reason = f"the displacement changes by {travel:.3g} mm, but in no stretch as a sliding sled's does"
    return Rejected(float(record.time[0]), float(record.time[-1]), record.time.size, np.nan, np.nan, reason)


def _about_bearings(settings: Settings, drag: Drag) -> tuple[str, ...]:
    bearing = settings.bearing
    if settings.traction == "rubber":
        given = bearing.file or bearing.force or bearing.coefficient
        return ("bearing drag not subtracted: the sensor at the rubber does not read it",) if given else ()
    if not (bearing.file or bearing.force or bearing.coefficient):
        return ("no bearing drag given: what the bearings take counts as friction",)
    return drag.notes


def point_table(runs: Sequence[Reduced]) -> pd.DataFrame:
    """Return the points of some runs, one row each, units in the headings."""
    rows = [
        {
            "run": run.name,
            **{heading: getattr(point, name) for name, heading in COLUMNS.items()},
            "source": run.source,
        }
        for run in runs
        for point in run.points
    ]
    return pd.DataFrame(rows, columns=["run", *COLUMNS.values(), "source"])


def rejected_table(runs: Sequence[Reduced]) -> pd.DataFrame:
    """Return the rejected windows of some runs and the reasons, one row each, units in the headings."""
    rows = [
        {"run": run.name}
        | {heading: getattr(window, name) for name, heading in REJECTED_COLUMNS.items()}
        | {"source": run.source}
        for run in runs
        for window in run.rejected
    ]
    return pd.DataFrame(rows, columns=["run", *REJECTED_COLUMNS.values(), "source"])
