"""Whether data suffice for shifting, and whether a law of shifting holds: against free shifts, isotherm by isotherm."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.joint import Joint, follow, own_parameters
from rubfric.dma.laws import LN10, WIDEST_GAP, free_law
from rubfric.dma.measurements import Measurements
from rubfric.errors import InvalidInput

# Gaps of reduced frequencies, decades, that are worth a word, and what free shifts may exceed the widest by.
_GAP, _ROUND_OFF = 0.1, 1e-3
# Share of the isotherms that may be left out beyond a gap, and how many have to remain.
_MOST_ISOLATED, _FEWEST = 0.25, 3
# A law fails at an isotherm that is off by more than so many standard errors, and by more than an error of the
# temperature of 2 K or 0.1 decades explains.
_ERRORS, _KELVINS, _DECADES = 3.0, 2.0, 0.1
# Deviation, in terms of what is allowed, that coarse branches cannot cause.
_HOPELESS = 4.0
# Residuals of a law over those of coarse free shifts, at most, where their shifts differ too.
_WORSE = 1.4
# Most temperatures that are named one by one.
_MOST_NAMED = 5
# Largest C2, K, that data can tell from a straight line.
_LARGEST_C2 = 3e3


@dataclass(frozen=True, eq=False)
class Deviation:
    """Free shifts beside those of a law.

    Attributes
    ----------
    decades, errors, allowed : ndarray, shape (isotherms,)
        Free minus lawful log10 a_T, its standard error, and what is allowed.
    free : Joint
        The fit of free shifts.
    """

    decades: Real
    errors: Real
    allowed: Real
    free: Joint

    @property
    def hopeless(self) -> bool:
        """Whether the law is off by so much that no other choice of branches can save it."""
        return bool((np.abs(self.decades) > _HOPELESS * self.allowed).any())

    @property
    def fails(self) -> np.ndarray:
        """Isotherms at which the law fails."""
        return np.abs(self.decades) > self.allowed


def check_enough(data: Measurements, reference: float, free: bool) -> tuple[Measurements, list[str]]:
    """Return the isotherms that can be shifted, and a note on others.

    Parameters
    ----------
    data : Measurements
    reference : float
        Reference temperature, degC.
    free : bool
        Whether shifts have to be found without a law, so that all neighbours must overlap.

    Raises
    ------
    InvalidInput
        Where there are too few temperatures or frequencies, or the reference is outside them.
    """
    counts = np.bincount(data.isotherm, minlength=len(data.temperatures))
    if counts.max() < 2:
        raise InvalidInput(
            f"{data.source} has one frequency at each temperature, {data.frequency[0] / (2.0 * math.pi):.4g} Hz at the "
            "first, but shifting needs sweeps: measure a decade of frequencies or more at each temperature"
        )
    notes = []
    if (counts < 2).any():
        names = ", ".join(f"{data.temperatures[one]:.4g}" for one in np.flatnonzero(counts == 1))
        notes += [f"temperatures with a single frequency left out: {names} degC"] if names else []
        renumbered = np.cumsum(counts >= 2) - 1
        kept = counts[data.isotherm] >= 2
        data = Measurements(
            *(data.source, data.kind, data.temperatures[counts >= 2], renumbered[data.isotherm[kept]]),
            *(data.frequency[kept], data.storage[kept], data.loss[kept], data.notes),
        )
    if len(data.temperatures) < _FEWEST:
        raise InvalidInput(
            f"{data.source} has {len(data.temperatures)} temperatures with at least two frequencies, but shift factors "
            f"need at least {_FEWEST}"
        )
    coldest, warmest = data.temperatures[0], data.temperatures[-1]
    if not coldest - 1.0 <= reference <= warmest + 1.0:
        raise InvalidInput(
            f"the reference temperature is {reference:g} degC, but must lie within those measured in {data.source}, "
            f"{coldest:.4g} to {warmest:.4g} degC"
        )
    if free:
        check_overlap(data)
    return data, notes


def check_overlap(data: Measurements) -> None:
    """Refuse isotherms without a common range of storage moduli with their neighbours.

    Parameters
    ----------
    data : Measurements

    Raises
    ------
    InvalidInput
        Which temperatures do not overlap, and what to measure.
    """
    for one in range(len(data.temperatures) - 1):
        softest = data.storage[data.isotherm == one].min()
        stiffest = data.storage[data.isotherm == one + 1].max()
        if softest > 1.02 * stiffest:
            raise InvalidInput(
                f"{data.source} has isotherms that do not overlap: the storage modulus is at least {softest:.4g} MPa "
                f"at {data.temperatures[one]:.4g} degC and at most {stiffest:.4g} MPa at "
                f"{data.temperatures[one + 1]:.4g} degC; measure a temperature between, or more frequencies, or say "
                "--law wlf or arrhenius, which bridge a small gap"
            )


def check_gaps(data: Measurements, shifts: Real) -> tuple[Measurements, list[str]]:
    """Return the data without a few isotherms that a gap separates from the others, and a note on narrower gaps.

    Parameters
    ----------
    data : Measurements
    shifts : ndarray, shape (isotherms,)
        ln a_T.

    Raises
    ------
    InvalidInput
        For a gap of more than a decade between the reduced frequencies of neighbours, amid the data.
    """
    reduced = (np.log(data.frequency) + shifts[data.isotherm]) / LN10
    lows = np.array([reduced[data.isotherm == one].min() for one in range(len(shifts))])
    highs = np.array([reduced[data.isotherm == one].max() for one in range(len(shifts))])
    gaps = lows[:-1] - highs[1:]
    widest = int(np.argmax(gaps))
    pair = f"{data.temperatures[widest]:.4g} and {data.temperatures[widest + 1]:.4g} degC"
    if gaps[widest] > WIDEST_GAP + _ROUND_OFF:
        beyond = data.isotherm <= widest
        beyond = beyond if widest + 1 <= len(shifts) // 2 else ~beyond
        lost = np.unique(data.isotherm[beyond])
        what = f"nothing within {gaps[widest]:.2g} decades of reduced frequency between {pair}"
        if len(lost) > max(_MOST_ISOLATED * len(shifts), 1.0) or len(shifts) - len(lost) < _FEWEST:
            raise InvalidInput(
                f"{data.source} has {what}, but a fit bridges at most {WIDEST_GAP:g}: measure a temperature between, "
                "or leave out those on one side"
            )
        names = ", ".join(f"{data.temperatures[one]:.4g}" for one in lost)
        return data.subset(~beyond, f"isotherms at {names} degC left out, since there is {what}"), []
    if gaps[widest] <= _GAP:
        return data, []
    return data, [
        f"isotherms do not overlap everywhere: there are no data in {gaps[widest]:.2g} decades of reduced frequency "
        f"between {pair}, where the spectrum alone holds the shifts"
    ]


def deviation(data: Measurements, lawful: Joint, static: float | None) -> Deviation:
    """Fit free shifts from those of a law, and compare.

    Parameters
    ----------
    data : Measurements
    lawful : Joint
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    law = free_law(data, lawful.shifts)
    start = np.concatenate((law.starts[0], own_parameters(lawful)[lawful.law.bounds[0].size :]))
    times = lawful.times * np.exp(lawful.shifts[0])  # free shifts count from the coldest isotherm
    free = follow(data, law, lawful.vertical, lawful.reference, start, times, static, moving=lawful.moving)
    own = free.jacobian[:, : len(data.temperatures) - 1]
    rest = free.jacobian[:, own.shape[1] :]
    if rest.size:  # scales and times are fitted too, and widen the errors
        own = own - rest @ np.linalg.lstsq(rest, own, rcond=None)[0]
    count = max(len(free.spectrum.residuals) - free.unknowns, 1)
    steps = np.linalg.pinv(own.T @ own, rcond=1e-9) * free.cost / count
    whole = len(data.temperatures)
    # Only differences of shifts mean something: their mean is taken out.
    centred = np.eye(whole) - 1.0 / whole
    change = centred @ free.law.derivative(own_parameters(free)[: whole - 1])
    errors = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", change, steps, change), 0.0)) / LN10
    difference = (free.shifts - lawful.shifts) / LN10
    slope = np.abs(np.gradient(lawful.shifts / LN10, data.temperatures))
    allowed = np.maximum(_ERRORS * errors, np.maximum(_KELVINS * slope, _DECADES))
    # Most isotherms may follow the law while few do not: the median of the difference is no deviation.
    return Deviation(difference - np.median(difference), errors, allowed, free)


def failure(data: Measurements, lawful: Joint, found: Deviation, free: Joint) -> str:
    """Return in words where a law fails, or nothing.

    Parameters
    ----------
    data : Measurements
    lawful : Joint
    found : Deviation
    free : Joint
        The best coarse fit of free shifts, from any start.
    """
    names = {"wlf": "the WLF equation", "arrhenius": "the Arrhenius law"}
    where = np.flatnonzero(found.fails)
    if len(where):
        worst = where[np.argmax(np.abs(found.decades[where]))]
        places = ", ".join(f"{data.temperatures[one]:.4g}" for one in where)
        if len(where) > _MOST_NAMED:
            places = (
                f"{len(where)} of {len(data.temperatures)} temperatures, most of all at {data.temperatures[worst]:.4g}"
            )
        return (
            f"{names[lawful.law.name]} fails at {places} degC: free shifts differ from it by up to "
            f"{abs(found.decades[worst]):.2g} decades, where {found.allowed[worst]:.2g} would be within errors and "
            "2 K of temperature"
        )
    apart = (free.shifts - lawful.shifts) / LN10
    if lawful.cost > _WORSE**2 * free.cost and (np.abs(apart - np.median(apart)) > 2.0 * found.allowed).any():
        rms = [100.0 * (each.cost / len(each.spectrum.residuals)) ** 0.5 for each in (lawful, free)]
        return f"{names[lawful.law.name]} fails: it leaves residuals of {rms[0]:.2g} %, free shifts {rms[1]:.2g} %"
    if lawful.law.name == "wlf" and 1.0 / lawful.parameters[1] > _LARGEST_C2:
        return f"the data do not determine C1 and C2: shifts lie on a straight line, C2 is above {_LARGEST_C2:g} K"
    return ""
