"""Time-temperature superposition: the rubber at one temperature is that at another with its times and moduli scaled.

A thermorheologically simple rubber has G*(w, T) = b_T G*(a_T w, T_ref): every relaxation time is multiplied by a_T,
every modulus by b_T. Williams, Landel and Ferry (J. Am. Chem. Soc. 77, 3701, 1955) and Arrhenius give

    log10 a_T = -C1 (T - T_ref) / (C2 + T - T_ref),    ln a_T = E_a / R (1 / T - 1 / T_ref),

with T in K in the second. The entropy of rubber elasticity gives b_T = T / T_ref (T in K); often b_T = 1 suffices.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.rubber.material import COLDEST, HOTTEST, Material
from rubfric.rules import Choice, Items, Number, check_fields

LAWS = ("wlf", "arrhenius", "table")
VERTICAL = ("none", "entropic", "table")
# 0 degC in K, and the gas constant in kJ/(mol K).
KELVIN, GAS = 273.15, 8.314462618e-3
# By how much the reference may lie beyond a table, K: isotherms stray from their nominal temperature.
_BEYOND = 1.01

_NEEDS = {"wlf": ("c1", "c2"), "arrhenius": ("activation_energy",), "table": ("temperatures", "log_factors")}


def _temperature(about: str) -> Number:
    return Number(about, "degC", COLDEST, HOTTEST)


def _column(about: str, low: float, high: float, unit: str = "") -> Items:
    return Items(about, Number(unit=unit, low=low, high=high), least=0, distinct=False, ascending=False)


@dataclass(frozen=True)
class Shift:
    """Shift factors a_T and b_T over temperature.

    Meaning, unit and bounds of each field are written beside it.

    Raises
    ------
    InvalidInput
        For a value outside these bounds, one that the law needs and has not, or one that it has no use for.
    """

    law: Annotated[str, Choice("The law of a_T.", LAWS)]
    reference_temperature: Annotated[float, _temperature("Temperature at which a_T = b_T = 1.")]
    c1: Annotated[float | None, Number("C1 of the WLF equation, in decades (base 10).", low=1e-3, high=1e4)] = None
    c2: Annotated[float | None, Number("C2 of the WLF equation.", "K", 1e-3, 1e6)] = None
    activation_energy: Annotated[float | None, Number("Activation energy E_a.", "kJ/mol", 1e-3, 1e5)] = None
    temperatures: Annotated[
        tuple[float, ...], _column("Temperatures of a table, ascending.", COLDEST, HOTTEST, "degC")
    ] = ()
    log_factors: Annotated[
        tuple[float, ...], _column("Logarithms (base 10) of a_T at these temperatures, descending.", -100.0, 100.0)
    ] = ()
    vertical: Annotated[str, Choice("Moduli: b_T = 1, T over T_ref in K, or those of a table.", VERTICAL)] = "none"
    log_moduli: Annotated[
        tuple[float, ...], _column("Logarithms (base 10) of b_T at these temperatures.", -10.0, 10.0)
    ] = ()

    def __post_init__(self) -> None:
        check_fields(self, "shift.")
        needed = set(_NEEDS[self.law]) | ({"temperatures", "log_moduli"} if self.vertical == "table" else set())
        for name in ("c1", "c2", "activation_energy", "temperatures", "log_factors", "log_moduli"):
            given = getattr(self, name) not in (None, ())
            if given != (name in needed):
                what = "is missing, but" if not given else "is given, but"
                wanted = "needs it" if not given else "has no use for it"
                why = f"law: {self.law}" + (f" with vertical: {self.vertical}" if self.vertical != "none" else "")
                raise InvalidInput(f"shift.{name} {what} {why} {wanted}")
        self._check_table()

    def _check_table(self) -> None:
        if not self.temperatures:
            return
        count = len(self.temperatures)
        for name in ("log_factors", "log_moduli"):
            if getattr(self, name) and len(getattr(self, name)) != count:
                raise InvalidInput(
                    f"shift.{name} has {len(getattr(self, name))} numbers, but must have as many as "
                    f"shift.temperatures, {count}"
                )
        if count < 2 or min(np.diff(self.temperatures)) <= 0.0:
            raise InvalidInput("shift.temperatures must be at least two, in ascending order")
        if self.log_factors and max(np.diff(self.log_factors)) > 0.0:
            raise InvalidInput("shift.log_factors rise with temperature, but rubber relaxes faster when it is warmer")
        low, high, reference = self.temperatures[0], self.temperatures[-1], self.reference_temperature
        if not low - _BEYOND <= reference <= high + _BEYOND:
            raise InvalidInput(
                f"shift.reference_temperature is {reference:g} degC, but must lie within shift.temperatures, "
                f"{low:g} to {high:g} degC"
            )

    def log_factor(self, temperature: float) -> float:
        """Return log10 a_T at a temperature in degC; a table is interpolated linearly.

        Raises
        ------
        InvalidInput
            For a temperature that the law does not reach: beyond the table, or at or below T_ref - C2.
        """
        at = _temperature("").check("temperature", temperature)
        change = at - self.reference_temperature
        if self.law == "wlf":
            c1, c2 = self.c1 or 0.0, self.c2 or 0.0
            if c2 + change <= 0.0:
                raise InvalidInput(
                    f"temperature is {at:g} degC, but the WLF equation holds above T_ref - C2 = "
                    f"{self.reference_temperature - c2:g} degC only"
                )
            return -c1 * change / (c2 + change)
        if self.law == "arrhenius":
            inverse = 1.0 / (at + KELVIN) - 1.0 / (self.reference_temperature + KELVIN)
            return (self.activation_energy or 0.0) / GAS * inverse / math.log(10.0)
        return self._interpolated(at, self.log_factors)

    def factor(self, temperature: float) -> float:
        """Return a_T, by which relaxation times are multiplied, at a temperature in degC."""
        return 10.0 ** self.log_factor(temperature)

    def modulus_factor(self, temperature: float) -> float:
        """Return b_T, by which moduli are multiplied, at a temperature in degC."""
        at = _temperature("").check("temperature", temperature)
        if self.vertical == "table":
            return 10.0 ** self._interpolated(at, self.log_moduli)
        return (at + KELVIN) / (self.reference_temperature + KELVIN) if self.vertical == "entropic" else 1.0

    def _interpolated(self, at: float, values: tuple[float, ...]) -> float:
        low, high = self.temperatures[0], self.temperatures[-1]
        if not low <= at <= high:
            raise InvalidInput(
                f"temperature is {at:g} degC, but shift factors are given from {low:g} to {high:g} degC only"
            )
        here, reference = np.interp([at, self.reference_temperature], self.temperatures, values)
        return float(here - reference)


@dataclass(frozen=True)
class ShiftedRubber:
    """A rubber whose Prony series is that at the reference temperature of its shift factors.

    Parameters
    ----------
    material : Material
        The rubber at ``shift.reference_temperature``.
    shift : Shift
    """

    material: Material
    shift: Shift

    def at(self, temperature: float) -> Material:
        """Return the rubber at a temperature in degC: times multiplied by a_T, moduli by b_T.

        Raises
        ------
        InvalidInput
            For a temperature that the shift factors do not reach, or at which times leave the range of the model.
        """
        log_factor, modulus = self.shift.log_factor(temperature), self.shift.modulus_factor(temperature)
        try:
            factor = 10.0**log_factor
            times = tuple(factor * time for time in self.material.relaxation_times)
            return replace(self.material, youngs_modulus=modulus * self.material.youngs_modulus, relaxation_times=times)
        except (InvalidInput, OverflowError) as error:
            raise InvalidInput(
                f"temperature is {checks.written(temperature)} degC, but there a_T = 1e{log_factor:.4g} takes the "
                f"relaxation times of {self.material.name} out of the model's range"
            ) from error
