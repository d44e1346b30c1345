"""A config read and checked: the rubber, the road, and every scene that a campaign consists of.

Light on purpose: the workflow reads it before any job starts, so nothing of the mechanics is imported here.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from itertools import chain, product
from typing import TYPE_CHECKING, Any

import rubfric
from rubfric import checks
from rubfric.config.areal_road import ArealEntry
from rubfric.config.default import over_default
from rubfric.config.entries import gathered, names
from rubfric.config.fitting import fitted_rubber
from rubfric.config.measured import MeasuredRubber
from rubfric.config.measured_road import MeasuredRoad, Survey, surveyed
from rubfric.config.models import (
    AspectStudy,
    ClaimsChoice,
    Config,
    FigureChoice,
    TransientChoice,
    wavenumber,
)
from rubfric.config.multiscale import Multiscale
from rubfric.config.overlay import EXTRAS, overlaid
from rubfric.config.plausibility import check_area, check_plausible
from rubfric.config.references import (
    figures_of,
    march_of,
    numerics_of,
    read_whole,
    readings_of,
    rig_of,
    scale_number,
    study_of,
)
from rubfric.config.rig import RigChoice
from rubfric.config.temperature import check_temperatures, rubber_at, rubber_of, shown_temperature
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.fitted import FittedRubber
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift
from rubfric.rules import Choice
from rubfric.scene.areal import ArealScene
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import ALL, Scene

if TYPE_CHECKING:  # heavy
    import xarray as xr


def _span(values: tuple[float, ...]) -> str:
    """Return the first and the last of ascending numbers, or the only one."""
    return " to ".join(dict.fromkeys(checks.written(value) for value in (values[0], values[-1])))


def _rubber_of(
    name: str, entry: Any, kept: str | os.PathLike[str] | None, temperatures: tuple[float, ...]
) -> tuple[FittedRubber | None, Material, Shift | None]:
    """Return a rubber that is known at the temperatures of the grid: its fit, if it was measured, itself, its shift."""
    fitted = fitted_rubber(name, entry, kept) if isinstance(entry, MeasuredRubber) else None
    material, shift = (fitted.material, fitted.shift) if fitted else rubber_of(name, entry.given())
    check_temperatures(material, shift, temperatures)
    return fitted, material, shift


def _road_of(name: str, entry: Any) -> tuple[Survey | None, tuple[SineScale, ...], tuple[float, ...]]:
    """Return what is made of a measured profile, if the road is one, and the scales and phases of the road."""
    if isinstance(entry, MeasuredRoad):
        survey = surveyed(name, entry)
        return survey, tuple(SineScale(*scale) for scale in survey.scales), (0.0,) * len(survey.scales)
    scales = [dict(scale) for scale in entry]
    sines = tuple(SineScale(scale["amplitude"], wavenumber(scale)) for scale in scales)
    return None, sines, tuple(scale["phase"] for scale in scales)


@dataclass(frozen=True)
class Campaign:
    """All that a config asks for.

    Attributes
    ----------
    results : str
        Folder of the outputs.
    material : Material
        The rubber in use; with shift factors, at their reference temperature.
    road_name : str
        Name of the road in use.
    road : tuple of SineScale
        Its scales, from coarse to fine.
    phases : tuple of float
        Phase of each, rad; it matters only where all of them are taken at once.
    plane : {"stress", "strain"}
        Plane stress or plane strain.
    kinematics : {"small", "finite", "auto"}
        Small strain, finite strain, or what each scene needs.
    multiscale : Multiscale
        How the friction of the whole road is obtained.
    velocities : tuple of float
        mm/s, ascending.
    pressures : tuple of float
        MPa, ascending.
    aspect : float
        Height over width of the grid's blocks.
    aspect_study : AspectStudy or None
        None where there is none; so for the following.
    transient : TransientChoice or None
    figures : FigureChoice
        What the figures show, out of the grid.
    rig : RigChoice or None
    claims : ClaimsChoice or None
    numerics : Numerics
    presets : dict of str to Numerics
        Every preset, by name.
    fitted : FittedRubber or None
        The rubber where it was fitted to measured moduli, with its shift factors and what the measurement leaves open.
    survey : Survey or None
        The road where its profile was measured.
    shift : Shift or None
        The rubber's shift factors.
    refine : float or None
        Share of friction to which its curves over speed are to be known between the velocities; None adds no speeds.
    temperatures : tuple of float
        degC, ascending; none where the rubber is simulated as it is given.
    areal_roads : dict of str to ArealEntry
        Roads that are surfaces, by name.
    areal : tuple of str
        Those that are slid over at every speed and pressure.
    others : tuple of Campaign
        Of every other pair where the config has several rubbers or roads, the grid alone; this is the first rubber on
        the first road.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load()
    >>> campaign.material.name, len(campaign.road), campaign.aspect
    ('zhou2019', 4, 0.75)
    >>> campaign.scene(scale="all", velocity=100, pressure=0.5, kinematics="small").name
    'all_v100_p0.5_aspect0.75_stress'
    """

    results: str
    material: Material
    road_name: str
    road: tuple[SineScale, ...]
    phases: tuple[float, ...]
    plane: str
    kinematics: str
    multiscale: Multiscale
    velocities: tuple[float, ...]
    pressures: tuple[float, ...]
    aspect: float
    aspect_study: AspectStudy | None
    transient: TransientChoice | None
    figures: FigureChoice
    rig: RigChoice | None
    claims: ClaimsChoice | None
    numerics: Numerics
    presets: dict[str, Numerics]
    fitted: FittedRubber | None = None
    survey: Survey | None = None
    shift: Shift | None = None
    refine: float | None = None
    temperatures: tuple[float, ...] = ()
    others: tuple[Campaign, ...] = ()
    areal_roads: dict[str, ArealEntry] = field(default_factory=dict)
    areal: tuple[str, ...] = ()

    def __repr__(self) -> str:
        others = f"; the first of {len(self.pairs)} pairs of rubber and road" if self.others else ""
        return f"<Campaign: {self.words().rstrip('.')}; results in {self.results}{others}>"

    @classmethod
    def from_config(cls, config: Mapping[str, Any], kept: str | os.PathLike[str] | None = None) -> Campaign:
        """Check a config whole and read it; rubbers that were measured are fitted, roads analysed.

        Parameters
        ----------
        config : mapping
        kept : path-like, optional
            Folder in which the fit of a measured rubber is kept from run to run.

        Raises
        ------
        InvalidInput
            A sentence on everything that is wrong.
        """
        given = read_whole(config)
        warm = given.grid.temperatures
        rubbers = gathered(lambda name: _rubber_of(name, given.rubbers[name], kept, warm), names(given.rubber))
        roads = gathered(lambda name: _road_of(name, given.roads[name]), names(given.road))
        pairs = product(rubbers, zip(names(given.road), roads, strict=True))
        first, *others = gathered(lambda pair: cls._of(given, pair[0], *pair[1]), pairs)
        none = dict.fromkeys(("aspect_study", "transient", "rig", "claims"))
        return replace(first, others=tuple(replace(one, **none) for one in others)) if others else first

    @classmethod
    def _of(cls, given: Config, rubber: Any, road_name: str, road_parts: Any) -> Campaign:
        """Return the campaign of one rubber, as from ``_rubber_of``, on one road, as from ``_road_of``."""
        fitted, material, shift = rubber
        survey, road, phases = road_parts
        numerics, presets = numerics_of(given)
        figures, temperatures = figures_of(given.figures, given.grid), given.grid.temperatures
        shown = shown_temperature(figures.temperature, temperatures, shift)
        campaign = cls(
            results=given.results,
            material=material,
            areal_roads={name: road for name, road in given.roads.items() if isinstance(road, ArealEntry)},
            areal=given.areal,
            road_name=road_name,
            road=road,
            phases=phases,
            plane=given.plane,
            kinematics=given.kinematics,
            multiscale=Multiscale(
                # The windows of a profile are what no model of its sines stands for.
                "direct" if survey and survey.windows and given.multiscale == "auto" else given.multiscale,
                given.multiscale_preset,
                given.phases.draws,
                given.phases.seed,
            ),
            velocities=given.grid.velocities,
            pressures=given.grid.pressures,
            aspect=given.grid.aspect,
            aspect_study=study_of(given.aspect_study, given.grid),
            transient=march_of(given.transient, given.grid),
            figures=figures.model_copy(update={"temperature": shown}),
            rig=rig_of(given.rig, given.grid),
            claims=given.claims,
            numerics=numerics,
            presets=presets,
            fitted=fitted,
            survey=survey,
            shift=shift,
            refine=given.grid.refine,
            temperatures=temperatures,
        )
        _ = campaign.whole_roads  # refuses a road without a period
        gathered(lambda name: campaign.areal_roads[name].road(name), campaign.areal)  # refuses scans that are no road
        return campaign

    def scene(
        self,
        scale: int | str,
        velocity: float,
        pressure: float,
        aspect: float | None = None,
        plane: str | None = None,
        kinematics: str | None = None,
        preset: str | None = None,
        accuracy: float | None = None,
        temperature: float | None = None,
    ) -> Scene:
        """Return any scene of this rubber on this road, in the grid or not.

        Parameters
        ----------
        scale : int or "all"
            1 for the coarsest scale of the road; or all scales at once.
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
        temperature : float, optional
            degC, of a rubber with shift factors; where the grid has temperatures, that of the figures by default.
        """
        whole = scale == ALL
        index = ALL if whole else scale_number("scale", scale, len(self.road))
        numerics = self.presets[Choice(words=self.presets).check("preset", preset)] if preset else self.numerics
        warm = self.figures.temperature if temperature is None else checks.number("temperature", temperature)
        return Scene(
            scale=index,
            road=self.whole_road if whole else self.road[int(index) - 1],
            velocity=velocity,
            pressure=pressure,
            aspect=self.aspect if aspect is None else aspect,
            material=self.material if warm is None else rubber_at(self.material, self.shift, warm),
            plane=self.plane if plane is None else plane,
            kinematics=self.kinematics if kinematics is None else kinematics,
            numerics=numerics if accuracy is None else replace(numerics, accuracy=accuracy),
            temperature=warm,
            measured=self.fitted.at(warm)[1] if self.fitted else None,
        )

    @property
    def pairs(self) -> dict[tuple[str, str], Campaign]:
        """The campaign of every rubber on every road, by their names; the first is this one."""
        return {(one.material.name, one.road_name): one for one in (self, *self.others)}

    def at(self, temperature: float | None) -> Campaign:
        """Return the campaign at one temperature (degC) only; itself for None, a rubber as it is given."""
        if temperature is None:
            return self
        figures = self.figures.model_copy(update={"temperature": temperature})
        return replace(self, temperatures=(temperature,), figures=figures)

    @cached_property
    def by_temperature(self) -> dict[float | None, Campaign]:
        """The campaign at each of its temperatures (degC); itself, under None, where it has none."""
        return {one: self.at(one) for one in self.temperatures or (None,)}

    @cached_property
    def whole_road(self) -> WaveRoad:
        """All scales of the road at once; InvalidInput where they have no common period."""
        return WaveRoad(*self._waves)

    @property
    def _waves(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        """Amplitudes, wavenumbers and phases of the scales."""
        amplitudes, wavenumbers = zip(*((scale.amplitude, scale.wavenumber) for scale in self.road), strict=True)
        return amplitudes, wavenumbers, self.phases

    @cached_property
    def whole_roads(self) -> dict[str, WaveRoad]:
        """The whole road as it is simulated, or nothing.

        Under no name; or random phases under ``drawN/``, or windows of a measured profile under ``windowN/``.
        """
        if self.survey and self.survey.windows and self.multiscale.simulated:
            return {f"window{number}/": one for number, one in enumerate(self.survey.windows, 1)}
        return self.multiscale.roads(self.road_name, *self._waves)

    def whole_scenes(self) -> dict[str, Scene]:
        """Return every scene of the whole road by name; of several roads, by ``drawN/`` or ``windowN/`` and name."""
        grid = product(self.temperatures or (None,), self.velocities, self.pressures)
        preset = self.multiscale.preset
        scenes = [
            self.scene(ALL, velocity, pressure, preset=preset, temperature=temperature)
            for temperature, velocity, pressure in grid
            if self.whole_roads
        ]
        if self.survey and self.survey.windows:
            aspect = float(f"{self.survey.block_height / self.survey.windows[0].wavelength:.6g}")
            scenes = [replace(scene, road=self.survey.windows[0], aspect=aspect) for scene in scenes]
        roads = self.whole_roads.items()
        return {draw + scene.name: replace(scene, road=road) for draw, road in roads for scene in scenes}

    def areal_scenes(self) -> dict[str, ArealScene]:
        """Return every scene on an areal road by ``road/name``."""
        scenes: dict[str, ArealScene] = {}
        grid = product(self.areal, self.temperatures or (None,), self.pressures, self.velocities)
        for name, temperature, pressure, velocity in grid:
            scene = self.areal_scene(name, velocity, pressure, temperature)
            scenes[f"{name}/{scene.name}"] = scene
        return scenes

    def areal_scans(self) -> dict[str, dict[str, Any]]:
        """Return how each areal road that is a scan is read: arguments of ``rubfric.profile.areal.scanned_road``."""
        scans = {name: self.areal_roads[name].areal.scan for name in self.areal}
        return {name: scan.options() for name, scan in scans.items() if scan}

    def areal_scene(self, road: str, velocity: float, pressure: float, temperature: float | None = None) -> ArealScene:
        """Return a scene on an areal road.

        Parameters
        ----------
        road : str
            Its name.
        velocity : float
            mm/s.
        pressure : float
            MPa.
        temperature : float, optional
            degC, of a rubber with shift factors; where the grid has temperatures, that of the figures by default.
        """
        warm = self.figures.temperature if temperature is None else checks.number("temperature", temperature)
        material = self.material if warm is None else rubber_at(self.material, self.shift, warm)
        entry = self.areal_roads[road]
        about: Any = {"direction": entry.direction, "numerics": entry.numerics, "temperature": warm}
        return ArealScene(entry.road(road), velocity, pressure, material, **about)

    def whole_parameters(self) -> dict[str, Any]:
        """Return what the total over the scales depends on besides results, as plain values.

        Those of ``rubfric.results.whole_road.WholeRoad``. Scales without a common period, of which no whole road is
        simulated, are judged by the nearest that have one, windows of a profile by its sines. Of several temperatures
        that of the figures counts.
        """
        shown = self.figures.temperature
        windows = len(self.survey.windows) if self.survey and self.multiscale.simulated else 0
        roads = (() if windows else self.whole_roads.values()) or [WaveRoad.nearest(*self._waves)]
        height = self.aspect * max(road.wavelength for road in roads)
        more = {"windows": windows} if windows else {}
        return more | {
            "way": self.multiscale.way,
            "accuracy": self.presets[self.multiscale.preset].accuracy,
            "material": asdict(self.material if shown is None else rubber_at(self.material, self.shift, shown)),
            "plane": self.plane,
            "kinematics": self.kinematics,
            "aspect": self.aspect,
            "height": self.survey.block_height if self.survey and windows else height,
            "roads": [asdict(road) for road in roads],
        }

    @property
    def scales(self) -> range:
        """Numbers of the road's scales, from 1."""
        return range(1, len(self.road) + 1)

    def scenes(self) -> dict[str, Scene]:
        """Return every scene of the grid and of the aspect study, each once, by name."""
        return {scene.name: scene for scene in self._all_scenes()}

    def _all_scenes(self) -> Iterator[Scene]:
        grid = product(self.temperatures or (None,), self.scales, self.velocities, self.pressures)
        for temperature, scale, velocity, pressure in grid:
            yield self.scene(scale, velocity, pressure, temperature=temperature)
        study = self.aspect_study
        if study is None:
            return
        for scale, velocity, pressure, aspect in product(study.scales, self.velocities, study.pressures, study.aspects):
            yield self.scene(scale, velocity, pressure, aspect)

    def reading(self, name: str) -> Campaign:
        """Return the campaign in another reading of the paper, one of those under ``claims.readings``."""
        readings = readings_of(self.claims)
        other = readings[Choice(words=readings).check("reading", name)]
        material = other.rubber(self.material)
        return replace(
            self,
            material=material,
            fitted=self.fitted if material == self.material else None,  # no longer the rubber that was fitted
            plane=other.plane or self.plane,
            kinematics=other.kinematics or self.kinematics,
            numerics=self.presets[self.claims.preset] if self.claims else self.numerics,
        )

    def run(
        self,
        velocities: float | Sequence[float] | None = None,
        pressures: float | Sequence[float] | None = None,
        temperatures: float | Sequence[float] | None = None,
        jobs: int | None = None,
        progress: bool | Callable[[str], None] = True,
    ) -> xr.Dataset:
        """Return the friction of the whole road with its errors and that of every scale: ``rubfric.run`` of this.

        Parameters
        ----------
        velocities, pressures, temperatures : float or sequence of float, optional
            mm/s, nominal MPa and degC; by default the grid's.
        jobs : int, optional
            How many scenes at a time; as many as there are cores by default.
        progress : bool or callable
            Whether to say how far it is; or what takes a line on it.
        """
        return rubfric.run(self, velocities, pressures, temperatures, jobs, progress)  # loads the mechanics only now

    def words(self) -> str:
        """Return in a sentence what is run: rubber, road, plane, kinematics, grid and accuracy."""
        rubber, numerics = self.material, self.numerics
        warm = f", {_span(self.temperatures)} degC" if self.temperatures else ""
        return (
            f"Rubber {rubber.name} ({rubber.moduli.replace('_', '-')} modulus, {rubber.bulk} bulk) on road "
            f"{self.road_name}, plane {self.plane}, {self.kinematics} kinematics: {len(self.road)} "
            f"scale{'s' if len(self.road) > 1 else ''}, {_span(self.velocities)} mm/s, {_span(self.pressures)} "
            f"MPa{warm}; friction to {100.0 * numerics.accuracy:g} %."
        )

    def marches(self) -> dict[str, Scene]:
        """Return the scenes that are marched in time, by name."""
        chosen = self.transient
        if chosen is None:
            return {}
        scenes = (self.scene(chosen.scale, velocity, chosen.pressure) for velocity in chosen.velocities)
        return {scene.name: scene for scene in scenes}

    def procedure(self) -> dict[str, Any]:
        """Return the arguments of the ``rubfric.scene.procedure.Procedure`` by which scenes are marched."""
        return (self.transient or TransientChoice()).procedure()

    def unlikely(self) -> list[str]:
        """Return what is unlikely of rubber, road and grid, with the unit that may have been meant.

        Raises
        ------
        InvalidInput
            For what cannot be meant.
        """
        if self.rig:
            check_area("rig.virtual.area", self.rig.virtual.area)

        def found(one: Campaign) -> list[str]:
            warm = {at: rubber_at(one.material, one.shift, at) for at in one.temperatures}
            where = f"road {one.road_name}" if self.others else "the road"
            return check_plausible(one.material, one.road, one.velocities, one.pressures, warm, where)

        return list(dict.fromkeys(chain(*gathered(found, self.pairs.values()))))

    def choices(self) -> dict[str, Any]:
        """Return, as a config has them, folder of the results, rubber, road, and what depends on the grid."""
        sections = {name: getattr(self, name) for name in EXTRAS}
        about = {"results": self.results, "rubber": self.material.name, "road": self.road_name}
        plain = about | {name: one and one.model_dump() for name, one in sections.items()}
        if self.figures.temperature is None:
            del plain["figures"]["temperature"]
        return plain

    def field_scenes(self) -> dict[str, Scene]:
        """Return the scenes whose fields are drawn, by name; pressure by pressure."""
        chosen = self.figures.fields
        scenes = (
            self.scene(chosen.scale, velocity, pressure)
            for pressure, velocity in product(chosen.pressures, chosen.velocities)
        )
        return {scene.name: scene for scene in scenes}


def load(*configs: str | os.PathLike[str] | Mapping[str, Any]) -> Campaign:
    """Read one or more configs, each laid over the ones before, and check the whole.

    A first one that is not complete is laid over the paper's campaign, which the package holds: ``load("mine.yaml")``
    and ``load({"plane": "strain"})`` need the changes only, and ``load()`` is the paper's.

    Parameters
    ----------
    *configs : path-like or mapping
        YAML files, or what such a file holds, as a dict.

    Raises
    ------
    InvalidInput
        For a file that is no YAML, a config that is wrong, or numbers far from any rubber, road or load.
    FileNotFoundError
        For a missing file.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load({"plane": "strain", "grid": {"velocities": [1, 10], "pressures": [0.2]}})
    >>> campaign.plane, campaign.velocities, len(campaign.road)
    ('strain', (1.0, 10.0), 4)
    """
    campaign = Campaign.from_config(overlaid(over_default(*configs), Config.model_fields))
    campaign.unlikely()
    return campaign
