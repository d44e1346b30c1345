"""A rubber that was fitted to measured moduli, and what the measurement leaves open: its window and its scatter."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from rubfric import checks
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber

# Digits of the moduli and times of samples, which show a scatter of per cents.
_DIGITS = 5
# Least share of the modulus at rest that a sample keeps.
_LEAST_SHARE = 1e-8


@dataclass(frozen=True)
class Sample:
    """A Prony series that the measurement allows as well: one of the bootstrap, in shear.

    Attributes
    ----------
    static : float
        Shear modulus at rest, MPa.
    moduli : tuple of float
        Shear moduli of the branches, MPa.
    times : tuple of float
        Their relaxation times, s.
    """

    static: float
    moduli: tuple[float, ...]
    times: tuple[float, ...]

    def material(self, fitted: Material) -> Material:
        """Return the rubber with this series, and with what else the fitted one has.

        Poisson's ratio is that of the fitted rubber where its bulk modulus relaxes in proportion; else the bulk modulus
        is.

        Parameters
        ----------
        fitted : Material
        """
        static = max(self.static, _LEAST_SHARE * math.fsum(self.moduli))
        total = static + math.fsum(self.moduli)
        modulus = static if fitted.moduli == "long_term" else total
        poisson = fitted.poissons_ratio
        if fitted.bulk == "elastic":
            bulk = fitted.long_term_bulk_modulus
            poisson = (3.0 * bulk - 2.0 * modulus) / (2.0 * (3.0 * bulk + modulus))
        kept = [place for place, each in enumerate(self.moduli) if each > 0.0]
        return replace(
            fitted,
            youngs_modulus=2.0 * (1.0 + poisson) * modulus,
            poissons_ratio=poisson,
            shear_fractions=tuple(self.moduli[place] / total for place in kept),
            relaxation_times=tuple(self.times[place] for place in kept),
        )

    def shifted(self, time: float, modulus: float) -> Sample:
        """Return the series with times and moduli multiplied by a_T and b_T, to five digits."""

        def scaled(values: tuple[float, ...], factor: float) -> tuple[float, ...]:
            return tuple(checks.rounded(factor * value, _DIGITS) for value in values)

        (static,) = scaled((self.static,), modulus)
        return Sample(static, scaled(self.moduli, modulus), scaled(self.times, time))


@dataclass(frozen=True)
class Measured:
    """What measured moduli leave open of a rubber at its temperature.

    Attributes
    ----------
    window : tuple of float
        Lowest and highest angular frequency at which moduli were measured, shifted to that temperature, rad/s.
    samples : tuple of Sample
        Series that the scatter of the data allows; none where they were not asked for.
    """

    window: tuple[float, float]
    samples: tuple[Sample, ...] = ()

    def __repr__(self) -> str:
        low, high = self.window
        return f"<Measured: {low:.3g} to {high:.3g} rad/s, {len(self.samples)} samples>"

    @classmethod
    def from_parameters(cls, given: Mapping[str, Any]) -> Measured:
        """Return it from plain values, as ``dataclasses.asdict`` gives them."""
        low, high = given["window"]
        samples = (Sample(one["static"], tuple(one["moduli"]), tuple(one["times"])) for one in given["samples"])
        return cls((low, high), tuple(samples))


@dataclass(frozen=True)
class FittedRubber:
    """A rubber that was fitted to measured moduli.

    Attributes
    ----------
    material : Material
        At the reference temperature.
    shift : Shift or None
        Its shift factors; None for a master curve.
    measured : Measured
        At the reference temperature.
    shifts : tuple of Shift
        Those of the samples.
    warnings : tuple of str
        What the fit says of itself, and what of the data was left out.
    source : str
        The file that it was fitted to.
    """

    material: Material
    shift: Shift | None
    measured: Measured
    shifts: tuple[Shift, ...] = ()
    warnings: tuple[str, ...] = ()
    source: str = ""

    def __repr__(self) -> str:
        return f"<FittedRubber: {self.words}>"

    def at(self, temperature: float | None = None) -> tuple[Material, Measured]:
        """Return the rubber at a temperature in degC, and what the measurement leaves open there.

        Each sample is shifted by its own factors, so that their uncertainty counts too.

        Parameters
        ----------
        temperature : float, optional
            The reference temperature by default.

        Raises
        ------
        InvalidInput
            For a temperature that the shift factors do not reach.
        """
        if temperature is None or self.shift is None or temperature == self.shift.reference_temperature:
            return self.material, self.measured
        low, high = self.measured.window
        factor = self.shift.factor(temperature)
        samples = tuple(
            sample.shifted(shift.factor(temperature), shift.modulus_factor(temperature))
            for sample, shift in zip(self.measured.samples, self.shifts, strict=True)
        )
        window = (checks.rounded(low / factor), checks.rounded(high / factor))
        return ShiftedRubber(self.material, self.shift).at(temperature), Measured(window, samples)

    @property
    def words(self) -> str:
        """The fit in a sentence: to what, how many branches, which law, which window."""
        low, high = self.measured.window
        laws = {"wlf": "WLF shifts", "arrhenius": "Arrhenius shifts", "table": "free shifts"}
        how = f"{laws[self.shift.law]}, " if self.shift else "a master curve, "
        where = f" at {self.shift.reference_temperature:g} degC" if self.shift else ""
        return (
            f"rubber {self.material.name} is fitted to {self.source}: {len(self.material.relaxation_times)} branches, "
            f"{how}measured from {low:.3g} to {high:.3g} rad/s{where}"
        )

    def parameters(self) -> dict[str, Any]:
        """Return plain values that ``from_parameters`` reads back."""
        return asdict(self)

    @classmethod
    def from_parameters(cls, given: Mapping[str, Any]) -> FittedRubber:
        """Return it from plain values."""

        def shift(held: Mapping[str, Any]) -> Shift:
            own: dict[str, Any] = {name: tuple(of) if isinstance(of, list) else of for name, of in held.items()}
            return Shift(**own)

        material = Material(**given["material"])
        own = given["shift"] and shift(given["shift"])
        measured = Measured.from_parameters(given["measured"])
        shifts, warnings = tuple(map(shift, given["shifts"])), tuple(given["warnings"])
        return cls(material, own, measured, shifts, warnings, given["source"])
