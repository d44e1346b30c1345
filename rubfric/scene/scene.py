"""One job: a scale of the road or all of them at once, a speed, a load, a block, a rubber, and its numerics."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from functools import lru_cache
from typing import Annotated, Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.fitted import Measured
from rubfric.rubber.material import PLANES, Material
from rubfric.rubber.shift import degrees
from rubfric.rules import Choice, Integer, Number, check_fields
from rubfric.scene.numerics import Numerics

KINEMATICS = ("small", "finite", "auto")
# The scale of a scene that slides over all scales at once.
ALL = "all"
# Height over width of a block, unless another is given: that of the paper's campaign.
ASPECT = 0.75
# What most scenes are without; it is left out of the parameters then.
_OPTIONAL = ("temperature", "measured")
# Fewest columns in the height of a block: cells much wider than it is high would lock.
COLUMNS_PER_HEIGHT = 8


@dataclass(frozen=True)
class ScaleOfScene(Integer):
    """The number of a scale, or the word for all scales at once."""

    def check(self, key: str, value: Any) -> Any:
        """Return the number, or the word."""
        if value == ALL:
            return value
        if isinstance(value, str):
            raise InvalidInput(f"{key} is {checks.shown(value)}, but must be the number of a scale, or {ALL}")
        return super().check(key, value)


@dataclass(frozen=True)
class Scene:
    """Everything that one sliding simulation depends on; hashable, and equal to its equals.

    Parameters
    ----------
    scale : int or "all"
        Number of the scale on its road, 1 being the coarsest; or all scales at once.
    road : SineScale or WaveRoad
        That scale, or the whole road. The block is one period of it wide.
    velocity : float
        Sliding speed v, mm/s.
    pressure : float
        Nominal pressure p on the top of the block, MPa.
    aspect : float
        Height of the block over the wavelength, that of the coarsest wave where there are many; the paper's by default.
    material : Material
        The rubber.
    plane : {"stress", "strain"}
        Plane stress (the paper's CPS4R) or plane strain.
    numerics : Numerics
        Accuracy and resolution.
    kinematics : {"small", "finite", "auto"}
        Small strain, finite strain, or small strain only where that is accurate enough.
    temperature : float, optional
        Of the rubber, degC; ``material`` is the rubber at it. None for a rubber that is known at one temperature only.
    measured : Measured, optional
        What the measurement leaves open of a rubber that was fitted to one.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load()
    >>> scene = rubfric.Scene(1, campaign.road[0], velocity=100, pressure=5, material=campaign.material)
    >>> scene == campaign.scene(scale=1, velocity=100, pressure=5)
    True
    >>> rubfric.Scene.from_parameters(scene.parameters()) == scene
    True
    """

    scale: Annotated[int | str, ScaleOfScene(high=10**6)]
    road: SineScale | WaveRoad
    velocity: Annotated[float, Number(unit="mm/s")]
    pressure: Annotated[float, Number(unit="MPa")]
    aspect: Annotated[float, Number()] = ASPECT
    material: Material = field(default_factory=lambda: _no_material())
    plane: Annotated[str, Choice(words=PLANES)] = "stress"
    numerics: Numerics = field(default_factory=Numerics)
    kinematics: Annotated[str, Choice(words=KINEMATICS)] = "auto"
    temperature: Annotated[float | None, degrees()] = None
    measured: Measured | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if isinstance(self.road, WaveRoad) != (self.scale == ALL):
            raise InvalidInput(f"scale is {self.scale}, but must be {ALL} on a road of many waves, and there only")
        flattest = COLUMNS_PER_HEIGHT / self.numerics.columns_max * self.road.period / self.road.wavelength
        if self.aspect < flattest:
            raise InvalidInput(
                f"aspect is {self.aspect:g}, but must be at least {flattest:.3g}: so flat a block needs more columns "
                f"of cells than numerics.columns_max, {self.numerics.columns_max}"
            )

    @property
    def name(self) -> str:
        """Canonical name: ``scale1_v100_p5_aspect0.75_stress``, or ``all_v100_...``; one scene, one name.

        With a temperature ``scale1_v100_p5_T20_aspect0.75_stress``.
        """
        scale = self.scale if self.scale == ALL else f"scale{self.scale}"
        velocity, pressure, aspect = (checks.written(value) for value in (self.velocity, self.pressure, self.aspect))
        warm = "" if self.temperature is None else f"_T{checks.written(self.temperature)}"
        return f"{scale}_v{velocity}_p{pressure}{warm}_aspect{aspect}_{self.plane}"

    def __repr__(self) -> str:
        warm = "" if self.temperature is None else f", {self.temperature:g} degC"
        return (
            f"<Scene {self.name}: {self.velocity:g} mm/s, {self.pressure:g} MPa{warm}, rubber {self.material.name}, "
            f"{self.kinematics} kinematics, friction to {100.0 * self.numerics.accuracy:g} %, {self.road!r}>"
        )

    @property
    def height(self) -> float:
        """H = aspect x wavelength, that of the coarsest wave, mm."""
        return self.aspect * self.road.wavelength

    def parameters(self) -> dict[str, Any]:
        """Return plain nested values (numbers, words, lists) that ``from_parameters`` reads back."""
        own = {each.name: getattr(self, each.name) for each in fields(self)}
        nested = ["road", "material", "numerics", *(["measured"] if self.measured else [])]
        own |= {name: _copied(_plain(own[name])) for name in nested}
        return {name: value for name, value in own.items() if name not in _OPTIONAL or value is not None}

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any]) -> Scene:
        """Build the scene that ``parameters`` describes; InvalidInput names what is wrong."""
        given = dict(_known("scene parameters", dict.fromkeys(_OPTIONAL) | dict(parameters), cls))
        kind = WaveRoad if given["scale"] == ALL else SineScale
        road = kind(**_known("road", given.pop("road"), kind))
        material = Material(**_known("material", given.pop("material"), Material))
        numerics = Numerics(**_known("numerics", given.pop("numerics"), Numerics))
        held = given.pop("measured")
        measured = held and Measured.from_parameters(held)
        return cls(road=road, material=material, numerics=numerics, measured=measured, **given)

    @property
    def digest(self) -> str:
        """SHA-256 of the parameters, for provenance."""
        return hashlib.sha256(json.dumps(self.parameters(), sort_keys=True).encode()).hexdigest()


def _no_material() -> Material:
    raise InvalidInput("the scene lacks its material: give a rubfric.Material")


@lru_cache(maxsize=256)
def _plain(part: SineScale | WaveRoad | Material | Numerics | Measured) -> dict[str, Any]:
    """Return the plain values of what thousands of scenes share; not to be changed."""
    return json.loads(json.dumps(asdict(part)))


def _copied(plain: dict[str, Any]) -> dict[str, Any]:
    return {name: value.copy() if isinstance(value, list) else value for name, value in plain.items()}


def _known(key: str, given: Any, kind: type) -> Mapping[str, Any]:
    names = [field.name for field in fields(kind)]
    return checks.known_keys(key, given, names, names)
