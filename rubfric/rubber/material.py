"""Linear viscoelastic rubber: Prony series, complex moduli, and the conventions that give them meaning.

The shear modulus relaxes as G(t) = G_inf + sum_i G_i exp(-t / tau_i) (Zhou, Wang and Wei 2019, Table 1), and

    G*(w) = G_inf + sum_i G_i i w tau_i / (1 + i w tau_i).

The bulk modulus is elastic (k_i = 0 of Table 1) or relaxes in proportion, at constant Poisson's ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rubfric import checks
from rubfric.arrays import Complex, Real
from rubfric.errors import InvalidInput
from rubfric.rules import Choice, Items, Number, Word, check_fields

MODULI = ("long_term", "instantaneous")
BULK = ("elastic", "proportional")
PLANES = ("stress", "strain")
# Least share that never relaxes: twelve digits of the others give it to about one per cent.
_LEAST_SHARE = 5e-10


def _branches(about: str, unit: str = "") -> Items:
    return Items(about, Number(unit=unit), least=0, distinct=False, ascending=False)


@dataclass(frozen=True)
class Material:
    """A linear viscoelastic rubber, a spring and any number of Maxwell elements.

    Meaning, unit and bounds of each field are written beside it.

    Raises
    ------
    InvalidInput
        For any value outside these bounds.

    Examples
    --------
    >>> import rubfric
    >>> soft = rubfric.Material("soft", 2.5, 0.49, shear_fractions=[0.3, 0.6], relaxation_times=[1e-3, 1e-6])
    >>> modulus = soft.complex_shear_modulus(1e5)  # at 1e5 rad/s
    >>> print(f"{modulus.real:.1f} MPa, loss factor {modulus.imag / modulus.real:.2f}")
    3.4 MPa, loss factor 0.15
    """

    name: Annotated[str, Word("Name of the rubber, which is part of paths.")]
    youngs_modulus: Annotated[float, Number("Young's modulus E; long-term or instantaneous as moduli says.", "MPa")]
    poissons_ratio: Annotated[
        float, Number("Poisson's ratio that goes with Young's modulus.", low=-1.0, high=0.5, excluded=True)
    ]
    shear_fractions: Annotated[
        tuple[float, ...],
        _branches(
            "Shares g_i of the instantaneous shear modulus that relax, one for each Maxwell element; their sum is "
            "below 1."
        ),
    ]
    relaxation_times: Annotated[
        tuple[float, ...], _branches("Relaxation times tau_i, one for each Maxwell element.", "s")
    ]
    moduli: Annotated[str, Choice("Which modulus youngs_modulus is.", MODULI)] = "long_term"
    bulk: Annotated[
        str,
        Choice(
            "Whether the bulk modulus is constant (elastic) or relaxes as the shear modulus does (proportional).", BULK
        ),
    ] = "elastic"
    density: Annotated[
        float, Number("Mass density; it only serves to compare the speed with that of shear waves.", "t/mm³")
    ] = 1.1e-9

    def __post_init__(self) -> None:
        at = f"rubbers.{Word().check('name of the rubber', self.name)}."
        check_fields(self, at)
        fractions, times = self.shear_fractions, self.relaxation_times
        if len(fractions) != len(times):
            raise InvalidInput(
                f"{at}relaxation_times has {len(times)} numbers, but must have as many as shear_fractions, "
                f"{len(fractions)}"
            )
        # In canonical digits: in floating point ten shares of 0.1 add up to less than 1.
        total = checks.number(f"{at}shear_fractions", math.fsum(fractions))
        if total >= 1.0:
            raise InvalidInput(f"{at}shear_fractions add up to {total:g}, but must stay below 1")
        if 1.0 - total < _LEAST_SHARE:
            raise InvalidInput(
                f"{at}shear_fractions leave a share of {1.0 - total:.1g} that never relaxes, but must leave at least "
                f"{_LEAST_SHARE:g}: twelve digits of each share do not say more"
            )

    def __repr__(self) -> str:
        times = [f"{time:g}" for time in sorted(self.relaxation_times)]
        branches = (
            f", {len(times)} Maxwell branches of {' to '.join(dict.fromkeys([times[0], times[-1]]))} s" if times else ""
        )
        return (
            f"<Material {self.name}: {self.moduli.replace('_', '-')} E {self.youngs_modulus:g} MPa, nu "
            f"{self.poissons_ratio:g}{branches}, {self.bulk} bulk>"
        )

    @property
    def long_term_fraction(self) -> float:
        """g_inf = 1 - sum of g_i, the long-term share of the shear modulus."""
        return 1.0 - sum(self.shear_fractions)

    @property
    def long_term_shear_modulus(self) -> float:
        """G_inf, MPa."""
        return self._shear_modulus * (1.0 if self.moduli == "long_term" else self.long_term_fraction)

    @property
    def instantaneous_shear_modulus(self) -> float:
        """G_0, MPa."""
        return self.long_term_shear_modulus / self.long_term_fraction

    @property
    def branch_shear_moduli(self) -> Real:
        """G_i = g_i G_0, MPa, one for each branch."""
        return np.asarray(self.shear_fractions, dtype=float) * self.instantaneous_shear_modulus

    @property
    def long_term_bulk_modulus(self) -> float:
        """Bulk modulus at rest, MPa; the constant K where bulk is elastic."""
        bulk = self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
        relaxes = self.bulk == "proportional" and self.moduli == "instantaneous"
        return bulk * (self.long_term_fraction if relaxes else 1.0)

    @property
    def branch_bulk_moduli(self) -> Real:
        """K_i, MPa, one for each branch; zeros where bulk is elastic."""
        if self.bulk == "elastic":
            return np.zeros(len(self.shear_fractions))
        return self.branch_shear_moduli * (self.long_term_bulk_modulus / self.long_term_shear_modulus)

    @property
    def _shear_modulus(self) -> float:
        return self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))

    def branch_transfer(self, frequency: ArrayLike) -> Complex:
        """Return the share of the strain that each branch's spring carries, i w tau / (1 + i w tau).

        Parameters
        ----------
        frequency : array_like, shape (...)
            Angular frequency, rad/s.

        Returns
        -------
        ndarray of complex, shape (branches, ...), dimensionless
        """
        turns = 1j * np.multiply.outer(np.asarray(self.relaxation_times), np.asarray(frequency, dtype=float))
        return turns / (1.0 + turns)

    def shear_relaxation(self, time: ArrayLike) -> Real:
        """Return G(t), MPa, for times in s of any shape."""
        decay = _decay(self.relaxation_times, time)
        return self.long_term_shear_modulus + np.tensordot(self.branch_shear_moduli, decay, axes=1)

    def bulk_relaxation(self, time: ArrayLike) -> Real:
        """Return K(t), MPa, for times in s of any shape."""
        decay = _decay(self.relaxation_times, time)
        return self.long_term_bulk_modulus + np.tensordot(self.branch_bulk_moduli, decay, axes=1)

    def complex_shear_modulus(self, frequency: ArrayLike) -> Complex:
        """Return G*(w), MPa, for angular frequencies in rad/s of any shape."""
        transfer = self.branch_transfer(frequency)
        return self.long_term_shear_modulus + np.tensordot(self.branch_shear_moduli, transfer, axes=1)

    def complex_bulk_modulus(self, frequency: ArrayLike) -> Complex:
        """Return K*(w), MPa, for angular frequencies in rad/s of any shape."""
        if self.bulk == "elastic":
            return np.full(np.shape(frequency), self.long_term_bulk_modulus, dtype=np.complex128)
        transfer = self.branch_transfer(frequency)
        return self.long_term_bulk_modulus + np.tensordot(self.branch_bulk_moduli, transfer, axes=1)

    def thickness_ratio(self, frequency: ArrayLike, plane: str) -> Complex:
        """Return strain across the thickness over the in-plane dilatation: 0 in plane strain, dimensionless.

        In plane stress the stress across the thickness vanishes: -(3K - 2G) / (3K + 4G).

        Parameters
        ----------
        frequency : array_like, shape (...)
            Angular frequency, rad/s.
        plane : {"stress", "strain"}
        """
        shear = self.complex_shear_modulus(frequency)
        if plane == "strain":
            return np.zeros(shear.shape, dtype=np.complex128)
        bulk = self.complex_bulk_modulus(frequency)
        return -(3.0 * bulk - 2.0 * shear) / (3.0 * bulk + 4.0 * shear)

    def plane_modulus(self, frequency: ArrayLike, plane: str) -> Complex:
        """Return the modulus E* of plane contact, MPa: 4G(3K+G)/(3K+4G) in strain, 9KG/(3K+G) in stress.

        Parameters
        ----------
        frequency : array_like, shape (...)
            Angular frequency, rad/s.
        plane : {"stress", "strain"}
        """
        shear, bulk = self.complex_shear_modulus(frequency), self.complex_bulk_modulus(frequency)
        if plane == "strain":
            return 4.0 * shear * (3.0 * bulk + shear) / (3.0 * bulk + 4.0 * shear)
        return 9.0 * bulk * shear / (3.0 * bulk + shear)

    def confined_modulus(self, plane: str) -> float:
        """Return stress over strain, MPa, of the relaxed block pressed between tied sides."""
        shear, bulk = self.long_term_shear_modulus, self.long_term_bulk_modulus
        if plane == "strain":
            return bulk + 4.0 * shear / 3.0
        return 4.0 * shear * (3.0 * bulk + shear) / (3.0 * bulk + 4.0 * shear)

    def effective_poissons_ratio(self, frequency: ArrayLike) -> Real:
        """Return the real part of the complex Poisson's ratio (3K* - 2G*) / (2 (3K* + G*)); it may be negative.

        Frequencies in rad/s.
        """
        shear, bulk = self.complex_shear_modulus(frequency), self.complex_bulk_modulus(frequency)
        return ((3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))).real

    def shear_wave_speed(self, frequency: ArrayLike) -> Real:
        """Return the speed of shear waves, mm/s, with the size of G* at a frequency in rad/s as the stiffness."""
        return np.sqrt(np.abs(self.complex_shear_modulus(frequency)) / self.density)


def _decay(relaxation_times: tuple[float, ...], time: ArrayLike) -> Real:
    rates = 1.0 / np.asarray(relaxation_times, dtype=float)
    return np.exp(-np.multiply.outer(rates, np.asarray(time, dtype=float)))
