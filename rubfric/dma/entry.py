"""A fitted rubber as the config and the model take it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from rubfric.checks import SIGNIFICANT_DIGITS
from rubfric.dma.measurements import Measurements
from rubfric.dma.result import Fit
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import ShiftedRubber

# Poisson's ratio where none is given, as of the paper's Table 1: no measurement of E* or G* alone has it.
POISSONS_RATIO = 0.49
# Least static share of the modulus; where it is small, digits of shares count from the instantaneous modulus.
_LEAST_SHARE, _SMALL_SHARE = 1e-8, 1e-4
# Relaxation times, s, beyond those of any sliding.
_SHORTEST, _LONGEST = 1e-20, 1e20
# Digits of a fit that do not hang on the round-off of the machine; noise takes the others.
_DIGITS = 6


def as_shear(data: Measurements, bulk_modulus: float) -> Measurements:
    """Return Young's moduli as the shear moduli of a rubber whose bulk modulus is constant: G = 3 K E / (9 K - E).

    Parameters
    ----------
    data : Measurements
    bulk_modulus : float
        K, MPa.

    Raises
    ------
    InvalidInput
        For a bulk modulus with which the measured moduli would be impossible: E' has to stay below 9 K / 2, where
        Poisson's ratio is -1 / 4.
    """
    if data.kind == "G":
        return data
    stiffest = float(data.storage.max())
    if stiffest > 4.5 * bulk_modulus:
        raise InvalidInput(
            f"the bulk modulus is {bulk_modulus:g} MPa, but must be at least {stiffest / 4.5:.4g} MPa, since the "
            f"storage modulus in {data.source} reaches {stiffest:.4g} MPa; rubber has about 2000 MPa"
        )
    young = data.storage + 1j * data.loss
    shear = 3.0 * bulk_modulus * young / (9.0 * bulk_modulus - young)
    return replace(data, kind="G", storage=shear.real, loss=shear.imag)


def series(fit: Fit) -> tuple[float, tuple[float, ...], tuple[float, ...]]:
    """Return modulus at rest, moduli of the branches, MPa, and their times, s, of a fit, to six digits.

    Branches that no sliding excites have relaxed, or never relax: cold glasses are shifted by dozens of decades.
    """
    kept = (fit.times > _SHORTEST) & (fit.times < _LONGEST) & (fit.moduli > 0.0)
    static = rounded(fit.static + math.fsum(fit.moduli[fit.times >= _LONGEST]))
    return static, tuple(map(rounded, fit.moduli[kept])), tuple(map(rounded, fit.times[kept]))


def rounded(value: float) -> float:
    """Return a number to the digits of a fit that do not hang on round-off."""
    return float(f"{value:.{_DIGITS}g}")


def rubber(fit: Fit, name: str, poissons_ratio: float = POISSONS_RATIO, bulk_modulus: float | None = None) -> Material:
    """Return the rubber at the reference temperature.

    Parameters
    ----------
    fit : Fit
    name : str
        A word of letters, digits, - and _.
    poissons_ratio : float
        Poisson's ratio, which is then constant: the bulk modulus relaxes in proportion.
    bulk_modulus : float, optional
        Constant bulk modulus, MPa, instead; the fit is of shear moduli then.

    Raises
    ------
    InvalidInput
        For data without a static modulus, and for values that no rubber can have.
    """
    static, moduli, times = series(fit)
    total = static + math.fsum(moduli)
    share = static / total
    if share < _LEAST_SHARE:
        raise InvalidInput(
            f"{fit.data.source} shows no plateau at low frequencies, so that the rubber would carry no load at rest: "
            "measure slower or warmer, or give --static-modulus"
        )
    which = "long_term" if share >= _SMALL_SHARE else "instantaneous"
    modulus = static if which == "long_term" else total
    if bulk_modulus is None:
        young = modulus if fit.data.kind == "E" else 2.0 * (1.0 + poissons_ratio) * modulus
    else:
        young = 9.0 * bulk_modulus * modulus / (3.0 * bulk_modulus + modulus)
        poissons_ratio = (3.0 * bulk_modulus - 2.0 * modulus) / (2.0 * (3.0 * bulk_modulus + modulus))
    return Material(
        name=name,
        youngs_modulus=young,
        poissons_ratio=poissons_ratio,
        shear_fractions=tuple(each / total for each in moduli),
        relaxation_times=times,
        moduli=which,
        bulk="elastic" if bulk_modulus is not None else "proportional",
    )


def shifted(fit: Fit, material: Material) -> ShiftedRubber:
    """Return the rubber with its shift factors.

    Parameters
    ----------
    fit : Fit
    material : Material
        That of the fit.

    Raises
    ------
    InvalidInput
        For a master curve, which has none.
    """
    shift = fit.shift()
    if shift is None:
        raise InvalidInput(f"{fit.data.source} is a master curve: it has no shift factors")
    return ShiftedRubber(material, shift)


def config_entry(material: Material) -> dict[str, Any]:
    """Return a rubber as the value of a key under ``rubbers`` in a config.

    Parameters
    ----------
    material : Material
    """
    digits = SIGNIFICANT_DIGITS
    return {
        "youngs_modulus": float(f"{material.youngs_modulus:.{digits}g}"),
        "poissons_ratio": float(f"{material.poissons_ratio:.{digits}g}"),
        "shear_fractions": list(material.shear_fractions),
        "relaxation_times": list(material.relaxation_times),
        "moduli": material.moduli,
        "bulk": material.bulk,
        "density": material.density,
    }
