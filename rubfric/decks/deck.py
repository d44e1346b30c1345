"""What a deck says of a rubber, whatever its code, and the rubber that it is."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, field

from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber

# Stress units in MPa and times in s, by name.
STRESS = {"MPa": 1.0, "Pa": 1e-6, "kPa": 1e-3, "GPa": 1e3, "psi": 6.894757293168e-3, "ksi": 6.894757293168}
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
# The line by which decks of our own say their units.
UNITS = "units: mm, s, N, MPa"
# Shares that add up to 1 within this do so by rounding.
_ROUNDED = 1e-6
# Bulk and shear terms are in proportion within this.
_SAME = 1e-6
# Young's modulus of rubber, MPa, beyond which the unit is likely to be another.
_STIFFEST = 1e5


@dataclass(frozen=True)
class Elastic:
    """Elastic constants: two of them, MPa.

    Attributes
    ----------
    shear, bulk : float
        G and K; K may be infinite.
    long_term : bool
        Whether they are the relaxed ones.
    """

    shear: float
    bulk: float
    long_term: bool

    @classmethod
    def from_young(cls, young: float, poisson: float, long_term: bool) -> Elastic:
        """Return the constants of E, MPa, and Poisson's ratio.

        Parameters
        ----------
        young, poisson : float
        long_term : bool
        """
        compressible = 3.0 * (1.0 - 2.0 * poisson)
        return cls(young / (2.0 * (1.0 + poisson)), young / compressible if compressible else math.inf, long_term)


@dataclass(frozen=True)
class Deck:
    """A rubber as a deck has it, in MPa and s.

    Attributes
    ----------
    source, name : str
        The file, and the material's name in it.
    elastic : Elastic, optional
        None where the deck has none.
    shear, bulk : tuple of float
        g_i and k_i, shares of the instantaneous moduli.
    times : tuple of float
        Relaxation times.
    density : float, optional
        t/mm³.
    shift : Shift, optional
    notes : tuple of str
        What the deck holds and the model does not.
    """

    source: str
    name: str
    elastic: Elastic | None
    shear: tuple[float, ...]
    bulk: tuple[float, ...]
    times: tuple[float, ...]
    density: float | None = None
    shift: Shift | None = None
    notes: tuple[str, ...] = field(default=())


def chosen(source: str, found: Collection[str], material: str | None) -> str:
    """Return the name of the material to read.

    Parameters
    ----------
    source : str
        The deck's name, for messages.
    found : collection of str
        Names of the viscoelastic materials in it, at least one.
    material : str, optional
        The one that the user names, in capitals or not; it may be left out where there is only one.

    Raises
    ------
    InvalidInput
        Where there are several, or none of that name.
    """
    names = ", ".join(found)
    if material is None and len(found) > 1:
        raise InvalidInput(f"{source} has {len(found)} viscoelastic materials, {names}: name one with --material")
    name = next((name for name in found if material is None or name.upper() == material.upper()), None)
    if name is None:
        raise InvalidInput(f"{source} has no viscoelastic material {material}; it has {names}")
    return name


def rubber(
    deck: Deck,
    name: str,
    youngs_modulus: float | None = None,
    poissons_ratio: float | None = None,
    static_modulus: float | None = None,
) -> Material:
    """Return the rubber that a deck describes.

    Parameters
    ----------
    deck : Deck
    name : str
        A word of letters, digits, - and _.
    youngs_modulus : float, optional
        Instantaneous Young's modulus, MPa, where the deck has no elastic constants.
    poissons_ratio : float, optional
        Of the deck's elastic constants, where it has none or an incompressible one.
    static_modulus : float, optional
        Young's modulus at rest, MPa, where the shares add up to 1 by rounding.

    Raises
    ------
    InvalidInput
        Where the deck holds what the model does not, or does not hold what the model needs.
    """
    elastic = _elastic(deck, youngs_modulus, poissons_ratio)
    shear, bulk, times = _combined(deck)
    proportional = any(bulk)
    if proportional and any(abs(k - g) > _SAME * max(map(abs, shear)) for g, k in zip(shear, bulk, strict=True)):
        raise InvalidInput(
            f"{deck.source} has bulk terms {_listed(bulk)} beside shear terms {_listed(shear)}, but here the bulk "
            "modulus is constant (all bulk terms 0) or relaxes as the shear modulus does (equal terms)"
        )
    young = 9.0 * elastic.bulk * elastic.shear / (3.0 * elastic.bulk + elastic.shear)
    poisson = (3.0 * elastic.bulk - 2.0 * elastic.shear) / (2.0 * (3.0 * elastic.bulk + elastic.shear))
    shear = _short_of_one(deck, shear, young, elastic.long_term, static_modulus)
    if young > _STIFFEST:
        raise InvalidInput(
            f"{deck.source} has a Young's modulus of {young:.4g} MPa, but "
            f"rubber has less than {_STIFFEST:g} MPa: name the units that the deck is in, Pa for one, with --units"
        )
    return Material(
        name=name,
        youngs_modulus=young,
        poissons_ratio=poisson,
        shear_fractions=shear,
        relaxation_times=times,
        moduli="long_term" if elastic.long_term else "instantaneous",
        bulk="proportional" if proportional else "elastic",
        **({} if deck.density is None else {"density": deck.density}),
    )


def _elastic(deck: Deck, young: float | None, poisson: float | None) -> Elastic:
    found = deck.elastic
    if found is None:
        if young is None or poisson is None:
            raise InvalidInput(
                f"{deck.source} has no elastic constants for {deck.name}: give its instantaneous Young's modulus and "
                "Poisson's ratio with --youngs-modulus and --poissons-ratio"
            )
        return Elastic.from_young(young, poisson, long_term=False)
    if young is not None:
        raise InvalidInput(f"{deck.source} has elastic constants for {deck.name}: leave --youngs-modulus out")
    if math.isinf(found.bulk):
        if poisson is None:
            raise InvalidInput(
                f"{deck.source} says that {deck.name} is incompressible, but the model needs a Poisson's ratio below "
                "0.5: give --poissons-ratio, 0.49 say"
            )
        return Elastic.from_young(2.0 * (1.0 + poisson) * found.shear, poisson, found.long_term)
    if poisson is not None:
        raise InvalidInput(f"{deck.source} has elastic constants for {deck.name}: leave --poissons-ratio out")
    return found


def _combined(deck: Deck) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
    """Return the terms, those of equal times as one and those without shares left out."""
    terms: dict[float, list[float]] = {}
    for g, k, time in zip(deck.shear, deck.bulk, deck.times, strict=True):
        if g < 0.0 or k < 0.0 or time <= 0.0:
            raise InvalidInput(
                f"{deck.source} has a term with shares {g:g} (shear) and {k:g} (bulk) and relaxation time {time:g} s, "
                "but shares must not be negative and times must be positive"
            )
        if g or k:
            own = terms.setdefault(time, [0.0, 0.0])
            own[0], own[1] = own[0] + g, own[1] + k
    return tuple(g for g, _ in terms.values()), tuple(k for _, k in terms.values()), tuple(terms)


def _short_of_one(
    deck: Deck, shear: tuple[float, ...], young: float, long_term: bool, static: float | None
) -> tuple[float, ...]:
    """Return the shares, scaled so that the rubber carries the given static modulus where they add up to 1."""
    total = math.fsum(shear)
    if total > 1.0 + _ROUNDED:
        raise InvalidInput(f"the shear terms in {deck.source} add up to {total:.7g}, but must stay below 1")
    if total < 1.0 - _ROUNDED:
        if static is not None:
            raise InvalidInput(
                f"the shear terms in {deck.source} add up to {total:.7g}, which leaves a static modulus: leave "
                "--static-modulus out"
            )
        return shear
    if long_term or static is None:
        way = "give its Young's modulus at rest with --static-modulus, or shares with more digits"
        if long_term:
            way = "write shares with more digits, or instantaneous moduli (MODULI=INSTANTANEOUS)"
        raise InvalidInput(
            f"the shear terms in {deck.source} add up to {total:.7g}, by rounding, so that {deck.name} would carry no "
            f"load at rest: {way}"
        )
    if not 0.0 < static < young:
        raise InvalidInput(
            f"--static-modulus is {static:g} MPa, but must lie between 0 and the instantaneous Young's modulus, "
            f"{young:.4g} MPa"
        )
    return tuple(g / total * (1.0 - static / young) for g in shear)


def _listed(values: tuple[float, ...]) -> str:
    shown = ", ".join(f"{value:g}" for value in values[:4])
    return shown + (", ..." if len(values) > 4 else "")


def unshifted(rubber: Material | ShiftedRubber, code: str) -> Material:
    """Return a rubber for a code whose decks are written without shift factors.

    Parameters
    ----------
    rubber : Material or ShiftedRubber
    code : str
        Name of the code, for the message.

    Raises
    ------
    InvalidInput
        For shift factors.
    """
    if isinstance(rubber, ShiftedRubber):
        raise InvalidInput(f"shift factors are not written to {code} decks: write the rubber at one temperature")
    return rubber


def instantaneous(material: Material) -> tuple[float, float]:
    """Return G and K at once, MPa, of a rubber, for the writers of decks."""
    return material.instantaneous_shear_modulus, material.long_term_bulk_modulus + float(
        material.branch_bulk_moduli.sum()
    )


def number(value: float, digits: int = 15) -> str:
    """Return a number as decks have it."""
    text = f"{value:.{digits}g}"
    return text if any(mark in text for mark in ".e") else f"{text}."
