"""From measured moduli to a Prony series with shift factors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rubfric.dma.choice import choose_branches, without_idle
from rubfric.dma.joint import COARSE, MARGIN, Joint, follow, refine, window
from rubfric.dma.judge import Deviation, check_enough, check_gaps, check_overlap, deviation, failure
from rubfric.dma.laws import Free, free_law, law_of
from rubfric.dma.measurements import Measurements
from rubfric.dma.outliers import without_outliers, without_resonance
from rubfric.dma.result import Fit, Options, assembled
from rubfric.dma.search import search, unstick
from rubfric.dma.spectrum import grid
from rubfric.errors import InvalidInput

# Reference temperature, degC, where the user gives none and it was measured.
ROOM = 20.0
# Share by which noise may take the least storage modulus below the static one.
_ABOVE = 1.1
# Fewest points that a spectrum is fitted to.
_FEWEST = 6


def fit(data: Measurements, options: Options | None = None) -> Fit:
    """Fit a Prony series and shift factors to measured moduli.

    Parameters
    ----------
    data : Measurements
    options : Options, optional

    Raises
    ------
    InvalidInput
        For data that do not suffice, or a reference temperature outside them.
    """
    options = options or Options()
    if len(data.storage) < _FEWEST:
        raise InvalidInput(f"{data.source} has {len(data.storage)} usable points, but a fit needs at least {_FEWEST}")
    if options.static is not None and options.static > _ABOVE * data.storage.min():
        raise InvalidInput(
            f"the static modulus is {options.static:g} MPa, but must be below the least storage modulus in "
            f"{data.source}, {data.storage.min():.4g} MPa"
        )
    return _fit_master(data, options) if data.is_master else _fit_isotherms(data, options)


def _fit_master(data: Measurements, options: Options) -> Fit:
    law, nothing = Free(np.zeros((1, 1)), np.zeros(0)), np.zeros(0)
    if options.vertical != "none" or options.law != "auto":
        raise InvalidInput(f"{data.source} is a master curve, which is not shifted: leave --law and --vertical out")
    for _ in range(2):
        times = grid(*window(data, np.zeros(1)), COARSE, MARGIN)
        joint = follow(data, law, "none", 0.0, nothing, times, options.static)
        data = without_outliers(data, joint.spectrum.residuals)
    joint = follow(data, law, "none", 0.0, nothing, times, options.static)
    joint = without_idle(_even(data, choose_branches(data, joint, options.static), options))
    return assembled(data, replace(options, vertical="none"), np.nan, joint, {}, [])


def _fit_isotherms(data: Measurements, options: Options) -> Fit:
    reference = _reference(data, options)
    data, notes = check_enough(data, reference, free=options.law == "free")
    data = data.subset(np.ones(len(data.storage), dtype=bool), *notes)
    static, vertical = options.static, options.vertical
    names = [options.law] if options.law in ("wlf", "arrhenius") else ["wlf", "arrhenius"]

    def lawful_fits(data: Measurements) -> dict[str, Joint]:
        return {
            name: search(data, law_of(name, data.temperatures, reference), vertical, reference, static)
            for name in names
        }

    fits = lawful_fits(data)
    # Outliers are those of free shifts: a law that fails leaves large residuals where nothing is wrong with the data.
    count, free = len(data.storage), _free(data, fits, vertical, reference, static)
    cleaned = without_resonance(data, free.spectrum.residuals)
    if len(cleaned.storage) < len(data.storage):
        data, free = cleaned, refine(cleaned, free, COARSE, MARGIN, static)
    cleaned = without_outliers(data, free.spectrum.residuals)
    if len(cleaned.storage) < len(data.storage):
        data = cleaned
    fits = fits if len(data.storage) == count else lawful_fits(data)
    deviations: dict[str, Deviation] = {}
    for name in names:
        deviations[name] = deviation(data, fits[name], static)
        if name == options.law or not deviations[name].hopeless:
            fits[name] = choose_branches(data, fits[name], static)
            deviations[name] = deviation(data, fits[name], static)
    said = {name: failure(data, fits[name], found, free) for name, found in deviations.items()}
    holds = [name for name in names if not said[name]]
    warnings = []
    if options.law in fits:
        joint = fits[options.law]
        warnings += [f"{said[options.law]}; its shifts were taken all the same, as asked"] if said[options.law] else []
    elif options.law == "auto" and holds:
        joint = min((fits[name] for name in holds), key=lambda each: each.bic)
    else:
        check_overlap(data)
        joint = unstick(data, _free(data, fits, vertical, reference, static), static)
        joint = choose_branches(data, joint, static)
        warnings += [words for words in said.values() if words]
        warnings += ["free shifts were taken, which cannot be extrapolated beyond the measured temperatures"]
    joint = without_idle(_even(data, joint, options))
    connected, words = check_gaps(data, joint.shifts)
    if len(connected.storage) < len(data.storage):
        return _fit_isotherms(connected, options)
    warnings += words
    return assembled(data, options, reference, joint, deviations, warnings)


def _even(data: Measurements, joint: Joint, options: Options) -> Joint:
    """Return the fit with evenly spaced branches, where they are asked for."""
    if options.per_decade is None:
        return joint
    once = refine(data, joint, options.per_decade, 0.0, options.static)
    return refine(data, once, options.per_decade, 0.0, options.static)


def _free(data: Measurements, fits: dict[str, Joint], vertical: str, reference: float, static: float | None) -> Joint:
    starts = [joint.shifts for joint in fits.values()]
    return search(data, free_law(data, *starts), vertical, reference, static)


def _reference(data: Measurements, options: Options) -> float:
    if options.reference_temperature is not None:
        return options.reference_temperature
    if data.temperatures[0] <= ROOM <= data.temperatures[-1]:
        return ROOM
    raise InvalidInput(
        f"{data.source} was measured from {data.temperatures[0]:.4g} to {data.temperatures[-1]:.4g} degC, without "
        f"{ROOM:g} degC: say --reference-temperature"
    )
