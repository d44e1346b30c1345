"""The record of one run: time, forces and displacement, in order, with notes on what was changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import median_filter

from rubfric.arrays import Flags, Real
from rubfric.columns.textfile import read_text, readable
from rubfric.errors import InvalidInput
from rubfric.rig.headings import recognise, unused_loads
from rubfric.rig.names import QUANTITIES, expected
from rubfric.rig.settings import Settings

MEASURED, SIMULATED = "measured", "simulated"
# What the virtual rig writes above the headings of its files.
SIMULATED_MARK = "virtual rig (simulated)"
FEWEST_SAMPLES = 50
# What to do about an encoding that was guessed.
_ANOTHER = "; encoding in the YAML file of --columns names another"
# Share of samples that may lack a value, and that may be spikes.
_MOST_MISSING, _MOST_SPIKES = 0.2, 0.02
# Stretches of rising time, in samples, that may be runs of their own.
_LONG_STRETCH = 10
# How often such stretches may alternate in time, for each of them.
_CHANGES = 4
# A pause of so many median intervals is a gap.
_GAP = 8.0
# Half the width of the running median, samples, and how many robust standard deviations from it are a spike.
_HALF, _SPIKE = 3, 12.0


@dataclass(frozen=True)
class Record:
    """One run.

    Attributes
    ----------
    name : str
        Of the file or the simulated run.
    source : {"measured", "simulated"}
    time, normal, traction, displacement : numpy.ndarray, shape (samples,)
        s, N, N, mm; time rises.
    overloaded : numpy.ndarray of bool, shape (samples,)
        Where the logger wrote an overload instead of a force.
    notes : tuple of str
        What was changed in the record.
    """

    name: str
    source: str
    time: Real
    normal: Real
    traction: Real
    displacement: Real
    overloaded: Flags
    notes: tuple[str, ...] = ()

    def noted(self, *notes: str) -> Record:
        """Return the record with more notes."""
        return replace(self, notes=(*self.notes, *notes))

    def stretches(self) -> list[slice]:
        """Return the stretches without gaps in time."""
        steps = np.diff(self.time)
        ends = np.flatnonzero(steps > _GAP * np.median(steps)) + 1
        return [slice(int(a), int(b)) for a, b in zip([0, *ends], [*ends, self.time.size], strict=True)]


def read_record(path: str, settings: Settings) -> Record:
    """Read and order the file of one run.

    Parameters
    ----------
    path : str
        Text file (CSV).
    settings : Settings
        Columns, units, separator and decimal mark, where they are not recognised.

    Raises
    ------
    InvalidInput
        Where the file cannot be read without guessing.
    FileNotFoundError
        For a missing file.
    """
    table = read_text(path, settings.form, expected(settings.columns))
    known: dict[str, Real] = {"normal": np.full(len(table.values), settings.normal)} if settings.normal > 0.0 else {}
    known |= {"time": np.arange(len(table.values)) / settings.sampling} if settings.sampling > 0.0 else {}
    wanted = [name for name in QUANTITIES if name not in known]
    try:
        columns = recognise(path, table, settings.columns, settings.units, wanted)
        good, left_out = readable(path, table, [column.place for column in columns.values()])
    except InvalidInput as error:
        guesses = [note for note in table.notes if "guessed" in note]
        raise InvalidInput(" - ".join([str(error), *guesses])) from error
    read = [f"{note}{_ANOTHER}" if note.endswith("guessed") else note for note in table.notes]
    notes = [*read, *left_out, *(note for column in columns.values() for note in column.notes)]
    if "normal" in known:
        notes += [f"the column {name!r} is not used: normal gives the load" for name in unused_loads(table, columns)]
    known |= {name: table.values[:, column.place] * column.factor for name, column in columns.items()}
    values = np.stack([known[name] for name in QUANTITIES])
    source = SIMULATED if any(SIMULATED_MARK in line for line in table.preamble) else MEASURED
    return ordered(path, source, values[:, good], tuple(notes))


def ordered(name: str, source: str, values: Real, notes: tuple[str, ...] = ()) -> Record:
    """Return a record in the order of time, without samples that lack a value and without spikes.

    Parameters
    ----------
    name, source : str
    values : numpy.ndarray, shape (4, samples)
        Time, normal force, traction and displacement (s, N, N, mm), as they were recorded; NaN is a gap, infinity an
        overload.
    notes : tuple of str

    Raises
    ------
    InvalidInput
        Where too little is left, or the clock began again.
    """
    done = list(notes)
    whole = np.isfinite(values[0]) & np.isfinite(values[3]) & ~np.isnan(values[1:3]).any(axis=0)
    lost = int(np.count_nonzero(~whole))
    if lost > _MOST_MISSING * whole.size:
        worst = list(QUANTITIES)[int(np.argmax(np.isnan(values).sum(axis=1)))]
        raise InvalidInput(
            f"{name} lacks a value in {lost} of its {whole.size} rows, more than {100 * _MOST_MISSING:g} %, most often "
            f"of {worst}: export all columns at the same times"
        )
    if lost:
        done.append(f"{lost} rows that lack a value left out")
    values = _in_order(name, values[:, whole], done)
    _check_length(name, values, done)
    overloaded = np.asarray(~np.isfinite(values[1:3]).all(axis=0))
    values = np.where(np.isfinite(values), values, 0.0)
    spiky = _spikes(values, overloaded)
    if np.count_nonzero(spiky) > _MOST_SPIKES * spiky.size:
        raise InvalidInput(f"{name} has spikes in {np.count_nonzero(spiky)} of its {spiky.size} rows: mend the sensor")
    if spiky.any():
        done.append(f"{np.count_nonzero(spiky)} rows with spikes left out")
        values, overloaded = values[:, ~spiky], overloaded[~spiky]
    time, normal, traction, place = values
    record = Record(name, source, time, normal, traction, place, overloaded)
    gaps = len(record.stretches()) - 1
    if gaps:
        done.append(f"{gaps} gaps in time, which no window spans")
    return record.noted(*done)


def _check_length(name: str, values: Real, done: Sequence[str]) -> None:
    if values.shape[1] >= FEWEST_SAMPLES:
        return
    why = f" ({'; '.join(done)})" if done else ""
    if any("share" in note for note in done):
        why += (
            ": export times with fractions of a second, or write sampling: and the number of rows per second in the "
            "YAML file of --columns"
        )
    raise InvalidInput(f"{name} has {values.shape[1]} usable rows, but must have at least {FEWEST_SAMPLES}{why}")


def _in_order(name: str, values: Real, done: list[str]) -> Real:
    """Return samples by time, repeated rows once, and the mean of samples of one time."""
    if np.unique(values[0]).size < values.shape[1]:
        _, first = np.unique(values, axis=1, return_index=True)
        if first.size < values.shape[1]:
            done.append(f"{values.shape[1] - first.size} repeated rows left out")
            values = values[:, np.sort(first)]
    time = values[0]
    if np.any(np.diff(time) < 0.0):
        _check_clock(name, time)
        done.append("rows put in the order of time")
        values = values[:, np.argsort(time, kind="stable")]
    stamps, place, count = np.unique(values[0], return_inverse=True, return_counts=True)
    if stamps.size < values.shape[1]:
        done.append(f"{values.shape[1]} rows share {stamps.size} time stamps: means taken")
        finite = np.isfinite(values)
        sums = np.stack(
            [np.bincount(place, np.where(known, row, 0.0)) for row, known in zip(values, finite, strict=True)]
        )
        lost = np.stack([np.bincount(place, ~known) for known in finite])
        values = np.where(lost > 0.0, np.inf, sums / count)
        values[0] = stamps
    return values


def _check_clock(name: str, time: Real) -> None:
    """Raise InvalidInput where the clock began again: to sort by time would mix two runs.

    Late packets fill the holes that they left. Runs of one clock lie between one another's samples instead.
    """
    falls = np.flatnonzero(np.diff(time) < 0.0) + 1
    stretches = [part for part in np.split(time, falls) if part.size >= _LONG_STRETCH]
    labels = np.repeat(np.arange(len(stretches)), [part.size for part in stretches])
    order = np.argsort(np.concatenate(stretches), kind="stable") if stretches else labels
    changes = int(np.count_nonzero(np.diff(labels[order])))
    if changes > _CHANGES * len(stretches):
        fall = int(falls[0])
        raise InvalidInput(
            f"{name} has a clock that begins again, at {time[fall]:g} s after {time[fall - 1]:g} s: "
            "keep one run in a file"
        )


def _spikes(values: Real, overloaded: Flags) -> Flags:
    """Return which samples lie far from the running median: single readings that no motion or force explains.

    The running median follows ramps and steps, so that only a change that lasts for at most three samples is a spike
    (Hampel's rule).
    """
    found = np.zeros(values.shape[1], dtype=bool)
    for channel in values[1:]:
        distance = np.abs(channel - median_filter(channel, 2 * _HALF + 1, mode="nearest"))
        usual = 1.4826 * np.median(distance)
        changes = np.abs(np.diff(channel))
        moving = changes[changes > 0.0]
        # Smallest change of a reading, for channels that are at rest most of the time.
        least = float(np.percentile(moving, 75.0)) if moving.size else 0.0
        found |= distance > _SPIKE * max(usual, least)
    return found & ~overloaded
