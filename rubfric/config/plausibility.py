"""Numbers that are far from any rubber, road or load: slips of units, found before any job.

What cannot be meant is refused; what is only unlikely is said, and run. The bounds leave room beyond every rubber, from
gels to glasses, and beyond every road.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.rubber.shift import KELVIN

# MPa: stiffer than steel, and than any solid; relaxed rubber from gels to cured resins; the glass of a rubber.
_STIFFEST, _NO_SOLID, _RELAXED, _GLASS = 1e5, 1e6, (1e-2, 200.0), 2e4
# s: three centuries, a year, and what no molecule is faster than.
_CENTURIES, _YEAR, _MOLECULE = 1e10, 3.15e7, 1e-15
# Slopes, dimensionless: of 84 degrees, of 72 degrees, and of a mirror; mm: 0.1 micrometres.
_CLIFF, _STEEP, _FLAT, _FINEST = 10.0, 3.0, 1e-3, 1e-4
# degC: above it rubber decomposes. MPa: ten times what a tyre or a sealing ring meets. Loss factor of an elastic solid.
# mm²: a square of 0.3 mm.
_HOT, _HEAVY, _LOSSLESS, _SMALLEST_AREA = 250.0, 50.0, 1e-3, 0.1
# What may be wrong where a rubber at a temperature loses nothing, or is elastic at the highest speeds.
_OF_SHIFTED = ("are its shift factors right?", "its series has none so fast")


def check_plausible(
    material: Material,
    road: Sequence[SineScale],
    velocities: Sequence[float],
    pressures: Sequence[float],
    warm: Mapping[float, Material] | None = None,
    where: str = "the road",
) -> list[str]:
    """Return what is unlikely, in a sentence each that names the unit that may have been meant.

    Parameters
    ----------
    material : Material
    road : sequence of SineScale
        The scales, from coarse to fine.
    velocities : sequence of float
        mm/s.
    pressures : sequence of float
        MPa.
    warm : mapping of float to Material, optional
        The rubber at each temperature, degC, at which it is simulated; by default as it is given.
    where : str
        What sentences call the road.

    Raises
    ------
    InvalidInput
        For what cannot be meant.
    """
    refused: list[str] = []
    unlikely: list[str] = []
    moduli = _moduli(material)
    loads = [] if moduli else _loads(material, pressures)  # of another modulus they say nothing
    for found in (moduli, _times(material), _heights(road, where), loads):
        for cannot_be, sentence in found:
            (refused if cannot_be else unlikely).append(sentence)
    if refused:
        raise InvalidInput(*refused)
    unlikely += [
        f"the temperature {one:g} degC is above that of any rubber in use: is it in K, {one - KELVIN:.6g} degC?"
        for one in warm or ()
        if one > _HOT
    ]
    rubbers = {f"{material.name} at {one:g} degC": each for one, each in (warm or {}).items()}
    for name, rubber in rubbers.items():
        unlikely += _losses(name, rubber, road, velocities, where, _OF_SHIFTED)
    return unlikely if warm else [*unlikely, *_losses(material.name, material, road, velocities, where)]


def check_area(key: str, area: float) -> float:
    """Return the nominal area of a rubber on a rig, mm²; InvalidInput for one so small that it must be in m².

    Parameters
    ----------
    key : str
    area : float
        mm².
    """
    if area < _SMALLEST_AREA:
        raise InvalidInput(
            f"{key} is {area:g} mm², a square of {math.sqrt(area):.1g} mm, but must be at least {_SMALLEST_AREA:g} "
            f"mm²: it is probably in m², {1e6 * area:g} mm²"
        )
    return area


def _moduli(material: Material) -> list[tuple[bool, str]]:
    at, given = f"rubbers.{material.name}.youngs_modulus", material.youngs_modulus
    if given >= _STIFFEST:
        return [
            (
                True,
                f"{at} is {given:g} MPa, but must be below {_STIFFEST:g} MPa, since steel has {2.1e5:g} MPa: it is "
                f"probably in Pa, {given / 1e6:.6g} MPa",
            )
        ]
    relaxed, glass = 3.0 * material.long_term_shear_modulus, 3.0 * material.instantaneous_shear_modulus
    share = material.long_term_fraction
    rounded = (
        f"rubbers.{material.name}.shear_fractions leave a share of {share:.2g} that never relaxes, so that the "
        f"instantaneous modulus is {glass:.3g} MPa, above that of any glass: either they were normalised to 1 without "
        "the long-term modulus, which belongs into the sum, or youngs_modulus is the instantaneous one (moduli: "
        "instantaneous)"
    )
    found = [(glass >= _NO_SOLID, rounded)] if glass > _GLASS else []
    if relaxed > _RELAXED[1]:
        other = "" if material.moduli == "instantaneous" else ", or the instantaneous modulus (moduli: instantaneous)"
        found.append(
            (
                False,
                f"{at} makes a relaxed modulus of {relaxed:.3g} MPa, above that of any rubber: is it in kPa{other}?",
            )
        )
    elif relaxed < _RELAXED[0]:
        other = ", or the relaxed modulus (moduli: long_term)" if material.moduli == "instantaneous" else ""
        found.append(
            (False, f"{at} makes a relaxed modulus of {relaxed:.3g} MPa, that of a soft gel: is it in GPa{other}?")
        )
    return found


def _times(material: Material) -> list[tuple[bool, str]]:
    found = []
    for place, time in enumerate(material.relaxation_times):
        at = f"rubbers.{material.name}.relaxation_times[{place}] is {time:g} s"
        if time > _CENTURIES:
            found.append((True, f"{at}, {time / _YEAR:.0g} years, but must be below {_CENTURIES:g} s: in ns or µs?"))
        elif time > _YEAR:
            found.append((False, f"{at}, {time / _YEAR:.1g} years: times are in seconds"))
        elif time < _MOLECULE:
            found.append((False, f"{at}, shorter than any motion of molecules: times are in seconds"))
    return found


def _heights(road: Sequence[SineScale], where: str) -> list[tuple[bool, str]]:
    found = []
    for number, scale in enumerate(road, 1):
        slope, amplitude, length = scale.steepest_slope, scale.amplitude, scale.wavelength
        at = f"scale {number} of {where}, amplitude {amplitude:.4g} mm and wavelength {length:.4g} mm,"
        if slope > _STEEP:
            bound = f"but must be below {_CLIFF:g}" if slope > _CLIFF else "steeper than any road"
            unit = (
                f"is the wavenumber per m, {scale.wavenumber / 1e3:.4g} rad/mm?"
                if length < _FINEST * 10.0
                else f"is the amplitude in µm, {amplitude / 1e3:.4g} mm?"
            )
            found.append((slope > _CLIFF, f"{at} has the slope {slope:.3g}, {bound}: {unit}"))
        elif 0.0 < slope < _FLAT:
            unit = f"in m, {1e3 * amplitude:.4g} mm" if length < 1e3 else "right, and the wavelength in µm"
            found.append((False, f"{at} has the slope {slope:.1g}, that of a mirror: is the amplitude {unit}?"))
        elif 0.0 < amplitude < _FINEST or length < _FINEST:
            found.append((False, f"{at} is finer than 0.1 µm: lengths are in mm, wavenumbers in rad/mm, not per m"))
    return found


def _loads(material: Material, pressures: Sequence[float]) -> list[tuple[bool, str]]:
    bulk = material.long_term_bulk_modulus
    # A foam is softer in bulk than in tension.
    most = max(bulk, 9.0 * material.long_term_shear_modulus)
    found = []
    for pressure in pressures:
        unit = ("Pa", 1e6) if pressure > 1e4 else ("kPa", 1e3)
        meant = f"is it in {unit[0]}, {pressure / unit[1]:g} MPa?"
        if pressure > most:
            found.append(
                (
                    True,
                    f"the pressure {pressure:g} MPa is above the bulk modulus of rubber {material.name}, but must be "
                    f"below {most:.3g} MPa: {meant}",
                )
            )
        elif pressure > _HEAVY:
            found.append((False, f"the pressure {pressure:g} MPa is far above that of any tyre: {meant}"))
    return found


def _losses(
    name: str,
    material: Material,
    road: Sequence[SineScale],
    velocities: Sequence[float],
    where: str,
    why: tuple[str, str] = ("are relaxation_times in s?", "is it in ms?"),
) -> list[str]:
    """Say where the rubber is elastic at the frequencies that the road excites, and why that may be."""
    if not material.relaxation_times:
        return []
    low, high = min(scale.wavenumber for scale in road), max(scale.wavenumber for scale in road)
    frequencies = np.geomspace(low * min(velocities), high * max(velocities), 64)
    shear = material.complex_shear_modulus(frequencies)
    shortest = min(material.relaxation_times)
    excited = f"{where} excites it at {frequencies[0]:.2g} to {frequencies[-1]:.2g} rad/s"
    if float((shear.imag / shear.real).max()) < _LOSSLESS:
        return [
            f"rubber {name} dissipates next to nothing, since {excited}, and relaxes within {shortest:.2g} to "
            f"{max(material.relaxation_times):.2g} s: {why[0]}"
        ]
    if shortest * frequencies[-1] > 10.0:
        return [
            f"rubber {name} is elastic at the highest speeds: {excited}, and its shortest relaxation time is "
            f"{shortest:.2g} s: {why[1]}"
        ]
    return []
