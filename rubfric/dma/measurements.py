"""Measured moduli over frequency at several temperatures, read from a file and put in order."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.headings import QUANTITIES, converted, modulus_kind, recognise
from rubfric.dma.textfile import read_text
from rubfric.errors import InvalidInput

# Share of rows that may lack a modulus or have a negative one.
_MOST_BAD = 0.2
# Temperatures, K, within which rows belong to one isotherm by default.
ISOTHERM = 1.0
# Moduli of solids lie between these, MPa.
_SOFTEST, _STIFFEST = 1e-4, 1e6


@dataclass(frozen=True, eq=False)
class Measurements:
    """Moduli of one rubber, sorted by temperature, then by frequency.

    Attributes
    ----------
    source : str
        Where they come from, for messages.
    kind : {"E", "G"}
        Young's or shear moduli.
    temperatures : ndarray, shape (isotherms,)
        Mean temperature of each isotherm, ascending, degC; one NaN for a master curve.
    isotherm : ndarray of int, shape (points,)
        The isotherm of each point.
    frequency : ndarray, shape (points,)
        Angular frequency, rad/s.
    storage, loss : ndarray, shape (points,)
        E' and E'', or G' and G'', MPa, all positive.
    notes : tuple of str
        What was left out or averaged.
    """

    source: str
    kind: str
    temperatures: Real
    isotherm: np.ndarray
    frequency: Real
    storage: Real
    loss: Real
    notes: tuple[str, ...] = field(default=())

    @property
    def is_master(self) -> bool:
        """Whether this is one curve without temperatures."""
        return bool(np.isnan(self.temperatures).any())

    def subset(self, kept: np.ndarray, *notes: str) -> Measurements:
        """Return some of the points, with further notes; isotherms left empty remain in the list.

        Parameters
        ----------
        kept : ndarray of bool, shape (points,)
        *notes : str
        """
        arrays = (self.isotherm[kept], self.frequency[kept], self.storage[kept], self.loss[kept])
        return Measurements(self.source, self.kind, self.temperatures, *arrays, (*self.notes, *notes))


def read(
    path: str,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    modulus: str | None = None,
    master: bool = False,
    separator: str | None = None,
    decimal: str | None = None,
    isotherm: float = ISOTHERM,
) -> Measurements:
    """Read measured moduli from a file of text.

    Parameters
    ----------
    path : str
    columns, units : mapping, optional
        Quantity (frequency, temperature, storage, loss, complex, tan_delta, phase) to heading and to unit, where the
        file does not say.
    modulus : {"E", "G"}, optional
        Whether the moduli are Young's or shear moduli, where the headings do not say.
    master : bool
        Whether the file is a master curve, without temperatures.
    separator, decimal : str, optional
        As of ``rubfric.dma.textfile.read_text``.
    isotherm : float
        Temperatures within which rows belong to one isotherm, K.

    Raises
    ------
    InvalidInput
        For a file that cannot be read, or must be guessed at; for moduli that are no moduli.
    FileNotFoundError
        For a missing file.
    """
    table = read_text(path, separator, decimal)
    places, pair = recognise(path, table.headings, columns or {}, master)
    kind = modulus_kind(path, [table.headings[places[name]] for name in pair if QUANTITIES[name] == "modulus"], modulus)
    values = {
        name: converted(path, name, table.headings[at], table.units[at], (units or {}).get(name), table.values[:, at])
        for name, at in places.items()
    }
    storage, loss = _parts(pair, values)
    temperature = np.zeros_like(storage) if master else values["temperature"]
    kept, notes = _usable(path, values["frequency"], temperature, storage, loss)
    found = ordered(
        path, kind, values["frequency"][kept], temperature[kept], storage[kept], loss[kept], master, isotherm
    )
    _check_plausible(found)
    return Measurements(
        *(found.source, found.kind, found.temperatures, found.isotherm, found.frequency, found.storage, found.loss),
        (*table.notes, *notes, *found.notes),
    )


def _parts(pair: tuple[str, str], values: Mapping[str, Real]) -> tuple[Real, Real]:
    """Return storage and loss modulus from what was measured."""
    first, second = values[pair[0]], values[pair[1]]
    if pair == ("storage", "loss"):
        return first, second
    tangent = np.tan(second) if pair[1] == "phase" else second
    if pair[0] == "storage":
        return first, first * tangent
    if pair[0] == "loss":
        with np.errstate(divide="ignore", invalid="ignore"):
            return first / tangent, first
    cosine = 1.0 / np.sqrt(1.0 + tangent**2)
    return first * cosine, first * cosine * tangent


def _usable(path: str, frequency: Real, temperature: Real, storage: Real, loss: Real) -> tuple[np.ndarray, list[str]]:
    """Return which rows have all that is needed, and what to say of the others."""
    there = np.isfinite(frequency) & np.isfinite(temperature) & np.isfinite(storage) & np.isfinite(loss)
    with np.errstate(invalid="ignore"):
        positive = (frequency > 0.0) & (storage > 0.0) & (loss > 0.0)
    notes = []
    for kept, what in ((there, "without a value"), (positive | ~there, "with a modulus or frequency of 0 or less")):
        count = int(np.count_nonzero(~kept))
        if count > _MOST_BAD * len(kept):
            raise InvalidInput(
                f"{path} has {count} of {len(kept)} rows {what}, but at most a fifth may be: moduli are positive, so "
                "check columns and signs, or leave out what the instrument could not resolve"
            )
        if count:
            notes.append(f"{count} rows {what} left out")
    return there & positive, notes


def ordered(
    source: str,
    kind: str,
    frequency: Real,
    temperature: Real,
    storage: Real,
    loss: Real,
    master: bool = False,
    isotherm: float = ISOTHERM,
) -> Measurements:
    """Return points sorted into isotherms, double ones averaged.

    Parameters
    ----------
    source : str
        Where they come from, for messages.
    kind : {"E", "G"}
    frequency, temperature, storage, loss : ndarray, shape (points,)
        rad/s, degC, MPa, MPa.
    master : bool
        Whether the temperatures mean nothing.
    isotherm : float
        Temperatures within which points belong to one isotherm, K.

    Raises
    ------
    InvalidInput
        For temperatures that form no isotherms.
    """
    by = np.argsort(temperature, kind="stable")
    # A new isotherm begins where the temperature leaps.
    group = np.empty(len(by), dtype=np.int64)
    group[by] = np.concatenate(([0], np.cumsum(np.diff(temperature[by]) > isotherm)))
    count = np.bincount(group)
    mean = np.bincount(group, temperature) / count
    spread = max((float(np.ptp(temperature[group == one])) for one in range(len(count))), default=0.0)
    if spread > 4.0 * isotherm:
        raise InvalidInput(
            f"{source} has temperatures that run on from {temperature.min():.4g} to {temperature.max():.4g} degC "
            f"without steps of more than {isotherm:g} K: measure at constant temperatures, or say with --isotherm how "
            "far the temperature strays within one"
        )
    order = np.lexsort((frequency, group))
    group = group[order]
    frequency, storage, loss = (values[order] for values in (frequency, storage, loss))
    same = (np.diff(group) == 0) & (np.diff(frequency) <= 1e-6 * frequency[1:])
    point = np.concatenate(([0], np.cumsum(~same)))
    doubles = len(point) - 1 - int(point[-1])
    if doubles:
        counts = np.bincount(point)
        frequency, storage, loss = (np.bincount(point, values) / counts for values in (frequency, storage, loss))
        group = group[np.concatenate(([True], ~same))]
    notes = (f"{doubles} points at a temperature and frequency measured before, averaged",) if doubles else ()
    temperatures = np.full(1, np.nan) if master else mean
    return Measurements(source, kind, temperatures, group, frequency, storage, loss, notes)


def _check_plausible(found: Measurements) -> None:
    """Refuse moduli that no solid has, which are likely to be in another unit."""
    softest, stiffest = float(found.storage.min()), float(found.storage.max())
    if stiffest > _STIFFEST or softest < _SOFTEST:
        value, likely = (stiffest, "Pa") if stiffest > _STIFFEST else (softest, "GPa")
        raise InvalidInput(
            f"{found.source} has a storage modulus of {value:.3g} MPa, but a polymer's lies between {_SOFTEST:g} and "
            f"{_STIFFEST:g} MPa: the unit is likely to be {likely}; say so under units in the YAML file of --columns"
        )
