"""What friction may depend on: every number of rubber, road, block and load, and scenes in which one is changed.

A parameter x is changed along a coordinate t, in which x is smooth and stays admissible: ln x for most; -ln(1 - 2 nu)
for Poisson's ratio, so that the rubber is less compressible by the same factor; temperature by 10 (exp(t) - 1) kelvin,
which changes relaxation times about as much as t changes others.

A branch is changed by its modulus G_i = g_i G_0. What is held is the modulus that the rubber is given by. Where that
is the long-term one, it and the moduli of all other branches are held; where it is the instantaneous one, all shear
moduli are then scaled such that their sum G_0 is what it was. An elastic bulk modulus is held in either case.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.rubber.shift import KELVIN, Shift, ShiftedRubber
from rubfric.scene.scene import Scene

# Kelvins by which temperature is changed for each unit of exp(t) - 1.
_KELVINS = 10.0
# Of a road of more waves, such as a measured profile, amplitudes are changed all together.
_MOST_WAVES = 24


def _proportional(value: float, t: float) -> float:
    return value * math.exp(t)


@dataclass(frozen=True)
class Parameter:
    """A number that friction depends on; it can be pickled, for workers.

    Attributes
    ----------
    name : str
        Its symbol: ``E``, ``nu``, ``g_1``, ``tau_1``, ``a_1``, ``lambda``, ``aspect``, ``p``, ``v`` or ``T``.
    words : str
        What it is.
    unit : str
    value : float
        What it is in the scene, in ``unit``.
    change : callable
        Takes a scene and t; returns it changed; InvalidInput where there is none.
    at : callable
        Takes ``value`` and t; returns the value at t.
    slope : float
        d ln x / dt at t = 0, dimensionless; of the temperature x is that in kelvin.
    """

    name: str
    words: str
    unit: str
    value: float
    change: Callable[[Scene, float], Scene]
    at: Callable[[float, float], float] = _proportional
    slope: float = 1.0


def parameters(scene: Scene, rubber: ShiftedRubber | None = None) -> list[Parameter]:
    """Return all that the friction of a scene depends on.

    Parameters
    ----------
    scene : Scene
    rubber : ShiftedRubber, optional
        The rubber at any temperature, of a scene that has one.
    """
    material = scene.material
    found = [
        Parameter(
            "E", "Young's modulus, with all moduli", "MPa", material.youngs_modulus, partial(_of_rubber, _stiffer)
        ),
        _poissons_ratio(material.poissons_ratio),
    ]
    for place, fraction in enumerate(material.shear_fractions):
        changed = partial(_of_rubber, partial(with_branch, branch=place))
        found.append(Parameter(f"g_{place + 1}", f"modulus of branch {place + 1}", "", fraction, changed))
    for place, time in enumerate(material.relaxation_times):
        changed = partial(_of_rubber, partial(_with_time, branch=place))
        found.append(Parameter(f"tau_{place + 1}", f"relaxation time of branch {place + 1}", "s", time, changed))
    found += _of_road(scene.road)
    found += [
        Parameter(
            "aspect", "height of the block over the wavelength", "", scene.aspect, partial(_multiplied, "aspect")
        ),
        Parameter("p", "nominal pressure", "MPa", scene.pressure, partial(_multiplied, "pressure")),
        Parameter("v", "sliding speed", "mm/s", scene.velocity, partial(_multiplied, "velocity")),
    ]
    return found + ([_temperature(scene.temperature, rubber)] if rubber and scene.temperature is not None else [])


def with_branch(material: Material, factor: float, branch: int) -> Material:
    """Return a rubber of which the modulus of one branch is multiplied; what is held is said above.

    Parameters
    ----------
    material : Material
    factor : float
    branch : int
        From 0.
    """
    given = material.shear_fractions
    total = 1.0 + (factor - 1.0) * given[branch]  # of all shear moduli over what it was
    fractions = tuple((factor if place == branch else 1.0) * one / total for place, one in enumerate(given))
    return replace(material, shear_fractions=fractions)


def _with_time(material: Material, factor: float, branch: int) -> Material:
    times = tuple(factor * time if place == branch else time for place, time in enumerate(material.relaxation_times))
    return replace(material, relaxation_times=times)


def _stiffer(material: Material, factor: float) -> Material:
    return replace(material, youngs_modulus=factor * material.youngs_modulus)


def _of_rubber(change: Callable[[Material, float], Material], scene: Scene, t: float) -> Scene:
    return replace(scene, material=change(scene.material, math.exp(t)))


def _multiplied(name: str, scene: Scene, t: float) -> Scene:
    """Return a scene of which one number, given by its name, is multiplied."""
    return replace(scene, **{name: getattr(scene, name) * math.exp(t)})


def _poissons_ratio(given: float) -> Parameter:
    """Return Poisson's ratio, of which 1 - 2 nu is changed: it is what the bulk modulus goes with."""
    slope = (1.0 - 2.0 * given) / (2.0 * given) if given else math.inf
    words = "Poisson's ratio, changed by its 1 - 2 nu"
    return Parameter("nu", words, "", given, _less_compressible, _ratio_at, slope)


def _ratio_at(value: float, t: float) -> float:
    return 0.5 * (1.0 - (1.0 - 2.0 * value) * math.exp(-t))


def _less_compressible(scene: Scene, t: float) -> Scene:
    material = scene.material
    return replace(scene, material=replace(material, poissons_ratio=_ratio_at(material.poissons_ratio, t)))


def _temperature(given: float, rubber: ShiftedRubber) -> Parameter:
    slope = _KELVINS / (given + KELVIN)
    return Parameter("T", "temperature", "degC", given, partial(_warmer, rubber.shift, given), _temperature_at, slope)


def _temperature_at(value: float, t: float) -> float:
    return value + _KELVINS * math.expm1(t)


def _warmer(shift: Shift, given: float, scene: Scene, t: float) -> Scene:
    """Return a scene at another temperature: relaxation times go with a_T, moduli with b_T."""
    before = given if scene.temperature is None else scene.temperature
    after, material = _temperature_at(before, t), scene.material
    slower = 10.0 ** (shift.log_factor(after) - shift.log_factor(before))
    stiffer = shift.modulus_factor(after) / shift.modulus_factor(before)
    times = tuple(slower * time for time in material.relaxation_times)
    warm = replace(material, youngs_modulus=stiffer * material.youngs_modulus, relaxation_times=times)
    return replace(scene, material=warm, temperature=after)


def _of_road(road: SineScale | WaveRoad) -> Iterator[Parameter]:
    """Yield what a road is made of.

    Waves of one period cannot change their lengths one by one: only all of them together.
    """
    if isinstance(road, SineScale):
        yield Parameter("a", "amplitude", "mm", road.amplitude, partial(_raised, wave=None))
        yield Parameter("lambda", "wavelength", "mm", road.wavelength, _stretched)
        return
    count = len(road.amplitudes)
    if count > _MOST_WAVES:
        words = f"amplitudes of all {count} waves; the largest"
        yield Parameter("a", words, "mm", max(road.amplitudes), partial(_raised, wave=None))
    else:
        for wave, amplitude in enumerate(road.amplitudes):
            words = f"amplitude of scale {wave + 1}"
            yield Parameter(f"a_{wave + 1}", words, "mm", amplitude, partial(_raised, wave=wave))
    yield Parameter("lambda", "wavelengths of all scales; the coarsest", "mm", road.wavelength, _stretched)


def _raised(scene: Scene, t: float, wave: int | None) -> Scene:
    """Return a scene with one of its amplitudes multiplied, or all."""
    road, factor = scene.road, math.exp(t)
    if isinstance(road, SineScale):
        return replace(scene, road=replace(road, amplitude=factor * road.amplitude))
    heights = tuple(factor * one if wave in (None, place) else one for place, one in enumerate(road.amplitudes))
    return replace(scene, road=replace(road, amplitudes=heights))


def _stretched(scene: Scene, t: float) -> Scene:
    road, factor = scene.road, math.exp(-t)
    if isinstance(road, SineScale):
        return replace(scene, road=replace(road, wavenumber=factor * road.wavenumber))
    return replace(scene, road=replace(road, wavenumbers=tuple(factor * one for one in road.wavenumbers)))
