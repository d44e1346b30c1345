"""What a fit gives: the rubber at its reference temperature, its shift factors, and how well the data are met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.joint import Joint, window
from rubfric.dma.judge import Deviation
from rubfric.dma.laws import LN10
from rubfric.dma.measurements import Measurements
from rubfric.dma.spectrum import kernel
from rubfric.rubber.shift import Shift

# Residuals worth a word, and what to do.
_POOR = 0.05
_REMEDY = "see its residuals and the van Gurp-Palmen plot, and try --vertical or more branches a decade"


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
            c1, c2 = (float(f"{each:.6g}") for each in (self.c1, self.c2))
            return Shift("wlf", reference, c1=c1, c2=c2, vertical=vertical, **table)
        if self.law == "arrhenius":
            energy = float(f"{self.activation_energy:.6g}")
            return Shift("arrhenius", reference, activation_energy=energy, vertical=vertical, **table)
        return Shift("table", reference, vertical=vertical, **table)


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
