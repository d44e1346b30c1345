"""From measured moduli to a Prony series with shift factors, and what there is to say of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.choice import choose_branches, without_idle
from rubfric.dma.joint import COARSE, MARGIN, Joint, follow, refine, window
from rubfric.dma.judge import Deviation, check_enough, check_gaps, check_overlap, deviation, failure
from rubfric.dma.laws import LN10, Free, free_law, law_of
from rubfric.dma.measurements import Measurements
from rubfric.dma.outliers import without_outliers, without_resonance
from rubfric.dma.search import search, unstick
from rubfric.dma.spectrum import grid, kernel
from rubfric.errors import InvalidInput
from rubfric.rubber.shift import Shift

LAWS = ("auto", "wlf", "arrhenius", "free")
VERTICAL = ("none", "entropic", "free")
# Reference temperature, degC, where the user gives none and it was measured.
ROOM = 20.0
# Share by which noise may take the least storage modulus below the static one, and residuals worth a word.
_ABOVE, _POOR = 1.1, 0.05
_REMEDY = "see its residuals and the van Gurp-Palmen plot, and try --vertical or more branches a decade"
# Fewest points that a spectrum is fitted to.
_FEWEST = 6


@dataclass(frozen=True)
class Options:
    """What the user may choose.

    Attributes
    ----------
    reference_temperature : float, optional
        degC; 20 where that was measured.
    law : {"auto", "wlf", "arrhenius", "free"}
        ``auto`` takes the law that holds, and free shifts where none does.
    vertical : {"none", "entropic", "free"}
        b_T = 1, T over T_ref in K, or one for each temperature.
    static : float, optional
        Static modulus of the measured kind, MPa, where it is known from elsewhere.
    per_decade : float, optional
        Branches a decade, evenly spaced within the measured window; by default as many as the data justify.
    samples, seed : int
        Bootstrap samples, and the seed of their random numbers.
    """

    reference_temperature: float | None = None
    law: str = "auto"
    vertical: str = "none"
    static: float | None = None
    per_decade: float | None = None
    samples: int = 200
    seed: int = 1


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted rubber at its reference temperature.

    Attributes
    ----------
    data : Measurements
        What was fitted; its notes say what was left out.
    options : Options
    reference : float
        Reference temperature, degC; NaN for a master curve.
    joint : Joint
        The fit itself.
    static : float
        Static modulus, MPa, of the measured kind, E or G.
    times, moduli : ndarray, shape (branches,)
        Relaxation times, s, ascending, and moduli, MPa.
    log_shifts, log_scales : ndarray, shape (isotherms,)
        log10 of a_T and b_T.
    deviations : dict
        Law to how free shifts deviate from it.
    warnings : tuple of str
        What the user has to know.
    """

    data: Measurements
    options: Options
    reference: float
    joint: Joint
    static: float
    times: Real
    moduli: Real
    log_shifts: Real
    log_scales: Real
    deviations: dict[str, Deviation]
    warnings: tuple[str, ...]

    @property
    def law(self) -> str:
        """The law that was taken: wlf, arrhenius or free."""
        return self.joint.law.name

    @property
    def c1(self) -> float:
        """C1 of the WLF equation."""
        return float(self.joint.parameters[0] / self.joint.parameters[1]) if self.law == "wlf" else np.nan

    @property
    def c2(self) -> float:
        """C2 of the WLF equation, K."""
        return float(1.0 / self.joint.parameters[1]) if self.law == "wlf" else np.nan

    @property
    def activation_energy(self) -> float:
        """E_a of the Arrhenius law, kJ/mol."""
        return float(self.joint.parameters[0]) if self.law == "arrhenius" else np.nan

    @property
    def window(self) -> tuple[float, float]:
        """Measured window of reduced angular frequencies at the reference temperature, rad/s."""
        return window(self.data, self.log_shifts * LN10)

    @property
    def residuals(self) -> tuple[Real, Real]:
        """Relative residuals of storage and loss moduli, each of shape (points,)."""
        count = len(self.data.storage)
        return self.joint.spectrum.residuals[:count], self.joint.spectrum.residuals[count:]

    @property
    def rms(self) -> tuple[float, float]:
        """Root mean square of the relative residuals of storage and loss moduli."""
        storage, loss = self.residuals
        return float(np.sqrt(np.mean(storage**2))), float(np.sqrt(np.mean(loss**2)))

    def moduli_at(self, frequency: Real) -> tuple[Real, Real]:
        """Return storage and loss modulus, MPa, at the reference temperature, for angular frequencies in rad/s."""
        storage, loss = kernel(frequency, self.times)
        return self.static + storage @ self.moduli, loss @ self.moduli

    def shift(self) -> Shift | None:
        """Return the shift factors; None for a master curve."""
        if self.data.is_master:
            return None
        table: dict[str, Any] = {}
        vertical = "table" if self.options.vertical == "free" else self.options.vertical
        if self.law == "free":
            table["log_factors"] = tuple(float(f"{each:.6g}") for each in self.log_shifts)
        if vertical == "table":
            table["log_moduli"] = tuple(float(f"{each:.6g}") for each in self.log_scales)
        if table:
            table["temperatures"] = tuple(float(f"{each:.6g}") for each in self.data.temperatures)
        reference = self.reference
        if self.law == "wlf":
            return Shift("wlf", reference, c1=self.c1, c2=self.c2, vertical=vertical, **table)
        if self.law == "arrhenius":
            energy = self.activation_energy
            return Shift("arrhenius", reference, activation_energy=energy, vertical=vertical, **table)
        return Shift("table", reference, vertical=vertical, **table)


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
    warnings += check_gaps(data, joint.shifts)
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


def assembled(
    data: Measurements,
    options: Options,
    reference: float,
    joint: Joint,
    deviations: dict[str, Deviation],
    warnings: list[str],
) -> Fit:
    """Return a fit whose times and moduli are those at the reference temperature.

    Parameters
    ----------
    data, options, reference, joint, deviations, warnings
        As of ``Fit``.
    """
    shifts, shift, scale = joint.shifts, 0.0, 0.0
    scales: Real = np.zeros(1) if data.is_master else joint.scales(data.temperatures)
    if not data.is_master:
        if joint.law.name == "free":
            shift = float(np.interp(reference, data.temperatures, shifts))
        if joint.vertical == "free":
            scale = float(np.interp(reference, data.temperatures, scales))
    rms = float(np.sqrt(joint.cost / len(joint.spectrum.residuals)))
    if rms > _POOR:
        warnings = [*warnings, f"the fit misses the moduli by {rms:.0%} rms: {_REMEDY}"]
    order = np.argsort(joint.times)
    static, moduli = joint.spectrum.moduli[0], joint.spectrum.moduli[1:][order]
    return Fit(
        data=data,
        options=options,
        reference=reference,
        joint=joint,
        static=float(static * np.exp(scale)),
        times=joint.times[order] * np.exp(shift),
        moduli=moduli * np.exp(scale),
        log_shifts=(shifts - shift) / LN10,
        log_scales=(scales - scale) / LN10,
        deviations=deviations,
        warnings=tuple(warnings),
    )
