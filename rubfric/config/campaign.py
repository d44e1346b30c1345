"""A config read and checked: the rubber, the road, and every scene that a campaign consists of.

Light on purpose: the workflow reads it before any job starts, so nothing of the mechanics is imported here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from rubfric import checks
from rubfric.config.choices import (
    AspectStudy,
    FigureChoice,
    TransientChoice,
    read_aspect_study,
    read_figures,
    read_transient,
    scale_number,
)
from rubfric.config.overlay import overlaid
from rubfric.config.presets import read_numerics
from rubfric.config.readings import ClaimsChoice, read_claims
from rubfric.config.rigchoice import RigChoice, read_rig
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale, scales_from_config
from rubfric.rubber.material import PLANES, Material
from rubfric.scene.scene import KINEMATICS, Numerics, Scene

_KEYS = (
    *("results", "rubber", "road", "plane", "kinematics"),
    *("grid", "aspect_study", "transient", "figures", "rig", "claims", "numerics", "presets", "rubbers", "roads"),
)
# Systems allow 4096 letters or fewer for a path and 255 for each name in it; the outputs take their share.
_LONGEST_PATH, _LONGEST_NAME = 1000, 255


@dataclass(frozen=True)
class Campaign:
    """All that a config asks for.

    Attributes
    ----------
    results : str
        Folder of the outputs.
    material : Material
        The rubber in use.
    road_name : str
        Name of the road in use.
    road : tuple of SineScale
        Its scales, from coarse to fine.
    plane : {"stress", "strain"}
        Plane stress or plane strain.
    kinematics : {"small", "finite", "auto"}
        Small strain, finite strain, or what each scene needs.
    velocities : tuple of float
        mm/s, ascending.
    pressures : tuple of float
        MPa, ascending.
    aspect : float
        Height over width of the grid's blocks.
    aspect_study : AspectStudy
    transient : TransientChoice
    figures : FigureChoice
    rig : RigChoice
    claims : ClaimsChoice
    numerics : Numerics
    presets : dict of str to Numerics
        Every preset, by name.
    """

    results: str
    material: Material
    road_name: str
    road: tuple[SineScale, ...]
    plane: str
    kinematics: str
    velocities: tuple[float, ...]
    pressures: tuple[float, ...]
    aspect: float
    aspect_study: AspectStudy
    transient: TransientChoice
    figures: FigureChoice
    rig: RigChoice
    claims: ClaimsChoice
    numerics: Numerics
    presets: dict[str, Numerics]

    @classmethod
    def from_config(cls, config: Mapping[str, Any]) -> Campaign:
        """Check a config whole and read it; InvalidInput says in one sentence what is wrong with it."""
        checks.known_keys("config", config, _KEYS, _KEYS)
        materials = {name: Material.from_config(name, entry) for name, entry in _catalogue(config, "rubbers").items()}
        roads = {name: scales_from_config(name, entry) for name, entry in _catalogue(config, "roads").items()}
        road = roads[checks.one_of("road", config["road"], roads)]
        keys = ("velocities", "pressures", "aspect")
        grid = checks.known_keys("grid", config["grid"], keys, keys)
        velocities = checks.grid("grid.velocities", grid["velocities"], "mm/s")
        pressures = checks.grid("grid.pressures", grid["pressures"], "MPa")
        numerics, presets = read_numerics(config["numerics"], config["presets"])
        return cls(
            results=_folder(config["results"]),
            material=materials[checks.one_of("rubber", config["rubber"], materials)],
            road_name=config["road"],
            road=road,
            plane=checks.one_of("plane", config["plane"], PLANES),
            kinematics=checks.one_of("kinematics", config["kinematics"], KINEMATICS),
            velocities=velocities,
            pressures=pressures,
            aspect=checks.positive("grid.aspect", grid["aspect"]),
            aspect_study=read_aspect_study(config["aspect_study"], len(road)),
            transient=read_transient(config["transient"], len(road)),
            figures=read_figures(config["figures"], len(road), velocities, pressures),
            rig=read_rig(config["rig"]),
            claims=read_claims(config["claims"], presets),
            numerics=numerics,
            presets=presets,
        )

    def scene(
        self,
        scale: int,
        velocity: float,
        pressure: float,
        aspect: float | None = None,
        plane: str | None = None,
        kinematics: str | None = None,
        preset: str | None = None,
        accuracy: float | None = None,
    ) -> Scene:
        """Return any scene of this rubber on this road, in the grid or not.

        Parameters
        ----------
        scale : int
            1 for the coarsest scale of the road.
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        aspect : float, optional
            Height over width; the grid's by default.
        plane : {"stress", "strain"}, optional
            The config's by default.
        kinematics : {"small", "finite", "auto"}, optional
            The config's by default.
        preset : str, optional
            One of the config's presets, instead of its numerics.
        accuracy : float, optional
            Relative accuracy of friction, instead of that of the preset or of the numerics.
        """
        index = scale_number("scale", scale, len(self.road))
        numerics = self.presets[checks.one_of("preset", preset, self.presets)] if preset else self.numerics
        return Scene(
            scale=index,
            road=self.road[index - 1],
            velocity=velocity,
            pressure=pressure,
            aspect=self.aspect if aspect is None else aspect,
            material=self.material,
            plane=self.plane if plane is None else plane,
            kinematics=self.kinematics if kinematics is None else kinematics,
            numerics=numerics if accuracy is None else replace(numerics, accuracy=accuracy),
        )

    @property
    def scales(self) -> range:
        """Numbers of the road's scales, from 1."""
        return range(1, len(self.road) + 1)

    def scenes(self) -> dict[str, Scene]:
        """Return every scene of the grid and of the aspect study, each once, by name."""
        return {scene.name: scene for scene in self._all_scenes()}

    def _all_scenes(self) -> Iterator[Scene]:
        for scale, velocity, pressure in product(self.scales, self.velocities, self.pressures):
            yield self.scene(scale, velocity, pressure)
        study = self.aspect_study
        for scale, velocity, pressure, aspect in product(study.scales, self.velocities, study.pressures, study.aspects):
            yield self.scene(scale, velocity, pressure, aspect)

    def reading(self, name: str) -> Campaign:
        """Return the campaign in another reading of the paper, one of those under ``claims.readings``."""
        other = self.claims.readings[checks.one_of("reading", name, self.claims.readings)]
        return replace(
            self,
            material=other.rubber(self.material),
            plane=other.plane or self.plane,
            kinematics=other.kinematics or self.kinematics,
            numerics=self.presets[self.claims.preset],
        )

    def words(self) -> str:
        """Return in a sentence what is run: rubber, road, plane, kinematics, grid and accuracy."""
        rubber, numerics = self.material, self.numerics
        return (
            f"Rubber {rubber.name} ({rubber.moduli.replace('_', '-')} modulus, {rubber.bulk} bulk) on road "
            f"{self.road_name}, plane {self.plane}, {self.kinematics} kinematics: {len(self.road)} scales, "
            f"{checks.written(self.velocities[0])} to {checks.written(self.velocities[-1])} mm/s, "
            f"{checks.written(self.pressures[0])} to {checks.written(self.pressures[-1])} MPa; friction to "
            f"{100.0 * numerics.accuracy:g} %."
        )

    def marches(self) -> dict[str, Scene]:
        """Return the scenes that are marched in time, by name."""
        chosen = self.transient
        scenes = (self.scene(chosen.scale, velocity, chosen.pressure) for velocity in chosen.velocities)
        return {scene.name: scene for scene in scenes}

    def field_scenes(self) -> dict[str, Scene]:
        """Return the scenes whose fields are drawn, by name; pressure by pressure."""
        chosen = self.figures
        scenes = (
            self.scene(chosen.scale, velocity, pressure)
            for pressure, velocity in product(chosen.pressures, chosen.velocities)
        )
        return {scene.name: scene for scene in scenes}


def load(*paths: str | os.PathLike[str]) -> Campaign:
    """Read one or more YAML configs, each laid over the ones before, and check the whole.

    The first must be complete; ``load("config/config.yaml", "mine.yaml")`` needs only the changes in mine.yaml.

    Raises
    ------
    InvalidInput
        For a file that is no YAML, or a config that is wrong.
    FileNotFoundError
        For a missing file.
    """
    return Campaign.from_config(overlaid(paths, _KEYS))


def _catalogue(config: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    entries = config[key]
    if not isinstance(entries, Mapping) or not entries:
        raise InvalidInput(f"{key} is {checks.shown(entries)}, but must hold at least one entry by name")
    for name in entries:
        checks.text(f"name in {key}", name)
    return entries


def _folder(value: Any) -> str:
    if not isinstance(value, str) or not value.strip() or not value.isprintable() or set(value) & set("{}"):
        raise InvalidInput(f"results is {checks.shown(value)}, but must be the path of a folder, without braces")
    if len(os.fsencode(value)) > _LONGEST_PATH or max(map(len, os.fsencode(value).split(b"/"))) > _LONGEST_NAME:
        raise InvalidInput(
            f"results is {checks.shown(value)}, but must be a path of at most {_LONGEST_PATH} letters, "
            f"{_LONGEST_NAME} in each name"
        )
    return value.rstrip("/") or "/"
