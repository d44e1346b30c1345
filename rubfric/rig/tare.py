"""Readings of the sensors without a load, and their standard errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.errors import InvalidInput
from rubfric.rig.estimate import plain_mean
from rubfric.rig.record import Record
from rubfric.rig.settings import Tare

_FEWEST = 20
# Blocks into which the record is divided, and the part of the load above which a block is loaded.
_BLOCKS, _LOADED = 200, 0.1
# Above this part of the load an offset is none: the record begins under load.
_LARGEST_OFFSET = 0.25
# Least ratio of the load to the noise.
_RISE = 10.0
# Share of an unloaded stretch, next to the load, that is left out.
_GUARD = 0.2


@dataclass(frozen=True)
class Zero:
    """Readings of the unloaded sensors over time.

    Attributes
    ----------
    normal, traction : numpy.ndarray, shape (samples,)
        What to subtract, N.
    normal_error, traction_error : numpy.ndarray, shape (samples,)
        Standard errors of that, N.
    longer : float
        Samples that are worth one independent one: as correlated as the noise of the unloaded sensors.
    notes : tuple of str
    """

    normal: Real
    traction: Real
    normal_error: Real
    traction_error: Real
    longer: float
    notes: tuple[str, ...]


def find_zero(record: Record, tare: Tare, loading: str = "normal") -> Zero:
    """Return the zeros of both forces.

    Parameters
    ----------
    record : Record
    tare : Tare
        ``auto`` takes the means over the stretch before the load, and where there is one after it too, the straight
        line between both. A constant normal force is a known load: it has no zero, and traction rises from its own.
    loading : {"normal", "traction"}
        The force by which the unloaded stretches are found.

    Raises
    ------
    InvalidInput
        Where there is no unloaded stretch, or too short a one.
    """
    nothing = np.zeros(record.time.size)
    held = bool(np.ptp(record.normal) == 0.0)
    if tare.how == "none":
        return Zero(nothing, nothing, nothing, nothing, 1.0, ("not tared, as asked for",))
    if tare.how == "given":
        return Zero(nothing + np.nan_to_num(tare.normal), nothing + tare.traction, nothing, nothing, 1.0, ())
    if tare.how == "times":
        inside = (record.time >= tare.start) & (record.time <= tare.end)
        if np.count_nonzero(inside) < _FEWEST:
            raise InvalidInput(
                f"{record.name} has {np.count_nonzero(inside)} samples from {tare.start:g} to {tare.end:g} s, "
                f"but needs {_FEWEST} to tare from"
            )
        stretches = [inside]
    elif held:
        # After the pull, rubber at rest under load still holds the rope taut.
        stretches = _unloaded(record, record.traction, "traction")[:1]
    else:
        stretches = _unloaded(record, getattr(record, loading), loading)
    traction, traction_error, longer = _line(record.time, record.traction, stretches)
    if held:
        note = f"normal force constant, {record.normal[0]:.4g} N, taken as known; traction tared by {traction[0]:.4g} N"
        return Zero(nothing, traction, nothing, traction_error, longer, (note,))
    normal, normal_error, other = _line(record.time, record.normal, stretches)
    notes = _described(normal, traction, len(stretches))
    return Zero(normal, traction, normal_error, traction_error, 0.5 * (longer + other), (notes,))


def _unloaded(record: Record, force: Real, name: str) -> list[Flags]:
    """Return the unloaded stretches at the beginning and, where there is one, at the end."""
    size = max(force.size // _BLOCKS, 5)
    count = force.size // size
    blocks = np.median(force[: count * size].reshape(count, size), axis=1)
    noise = 1.4826 * float(np.median(np.abs(np.diff(force)))) / np.sqrt(2.0)
    height = float(np.max(np.abs(blocks - blocks[0])))
    ask = "say under tare in the YAML file of --columns when the rig was unloaded, or what its sensors read then"
    ask += "; a known constant load is given as normal: and the force in N there" if name == "normal" else ""
    if height <= _RISE * noise:
        raise InvalidInput(f"{record.name} has no stretch before loading: the {name} force never rises; {ask}")
    low = np.abs(blocks - blocks[0]) < _LOADED * height
    begin = int(np.argmin(low))
    end = count - int(np.argmin(low[::-1]))
    if abs(float(blocks[0])) > _LARGEST_OFFSET * height:
        raise InvalidInput(
            f"{record.name} begins with a {name} force of {blocks[0]:.4g} N, too much beside the {height:.4g} N by "
            f"which it changes to be an offset; {ask}"
        )
    places = np.arange(force.size)
    first = places < (1.0 - _GUARD) * begin * size
    if np.count_nonzero(first) < _FEWEST:
        raise InvalidInput(
            f"{record.name} has {np.count_nonzero(first)} samples before loading, but needs {_FEWEST}; {ask}"
        )
    last = places >= end * size + _GUARD * (force.size - end * size)
    return [first, last] if np.count_nonzero(last) >= _FEWEST else [first]


def _line(time: Real, force: Real, stretches: list[Flags]) -> tuple[Real, Real, float]:
    """Return the zero of a force over time, a constant or the line through two means, and its standard errors.

    Also how many samples are worth an independent one.
    """
    means = [plain_mean(time[part], force[part]) for part in stretches]
    longer = float(
        np.mean([np.count_nonzero(part) / one.effective for part, one in zip(stretches, means, strict=True)])
    )
    if len(means) == 1:
        return np.full(force.size, means[0].value), np.full(force.size, means[0].error), longer
    first, last = (float(time[part].mean()) for part in stretches)
    share = (time - first) / (last - first)
    line = (1.0 - share) * means[0].value + share * means[1].value
    return line, np.hypot((1.0 - share) * means[0].error, share * means[1].error), longer


def _described(normal: Real, traction: Real, stretches: int) -> str:
    ends = "before and after the load" if stretches > 1 else "in one stretch, so that a drift of the zero is not seen"
    drift = ""
    if stretches > 1:
        drift = f", drift {normal[-1] - normal[0]:.3g} and {traction[-1] - traction[0]:.3g} N"
    return f"tared by {normal[0]:.4g} N (normal) and {traction[0]:.4g} N (traction), read {ends}{drift}"
