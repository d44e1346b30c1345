"""What a config refers to in other parts of itself: names, scales of the road, values of the grid, presets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rubfric import checks
from rubfric.config.areal_road import ArealEntry
from rubfric.config.entries import names
from rubfric.config.measured import MeasuredRubber
from rubfric.config.measured_road import MeasuredRoad
from rubfric.config.models import (
    AspectStudy,
    ClaimsChoice,
    Config,
    Fields,
    FigureChoice,
    Grid,
    TransientChoice,
)
from rubfric.config.rig import RigChoice
from rubfric.config.temperature import check_temperatures, rubber_of
from rubfric.errors import InvalidInput
from rubfric.rules import Choice, Integer
from rubfric.scene.numerics import PRESET_KEYS, Numerics


def scale_number(key: str, value: Any, scales: int) -> int:
    """Return the number of one of the road's scales.

    Parameters
    ----------
    key : str
    value : int
        1 for the coarsest.
    scales : int
        How many there are.
    """
    number = Integer().check(key, value)
    if number > scales:
        raise InvalidInput(f"{key} is {number}, but must be one of the road's scales, 1 to {scales}")
    return number


def read_whole(config: Any) -> Config:
    """Check a config whole and read it.

    Raises
    ------
    InvalidInput
        A sentence on everything that is wrong.
    """
    try:
        given = Config.read("", config)
        sections, found = {name: getattr(given, name) for name in Config.model_fields}, []
    except InvalidInput as error:
        sections, found = Config.sound_sections(config), list(error.faults)
    found += references(sections)
    if found:
        raise InvalidInput(*found)
    return given


def references(sections: Mapping[str, Any]) -> list[str]:
    """Return a sentence on every entry that refers to what there is not.

    Parameters
    ----------
    sections : mapping
        The sections of a config that are right by themselves, by name; what refers to others is not looked at.
    """
    found: list[str] = []

    def look(check: Any, *arguments: Any) -> None:
        try:
            check(*arguments)
        except InvalidInput as error:
            found.extend(error.faults)

    for name, catalogue in (("rubber", "rubbers"), ("road", "roads"), ("multiscale_preset", "presets")):
        if {name, catalogue} <= set(sections):
            given, keyed = sections[name], [(name, sections[name])]
            if catalogue != "presets" and isinstance(given, tuple):
                keyed = [(f"{name}[{place}]", one) for place, one in enumerate(given)]
            for key, one in keyed:
                look(Choice(words=sections[catalogue]).check, key, one)
    presets, claims = sections.get("presets"), sections.get("claims")
    if presets and "numerics" in sections:
        look(_numerics, sections["numerics"], presets)
    if claims:
        if presets:
            look(Choice(words=presets).check, "claims.preset", claims.preset)
        for name in claims.compare:
            look(Choice(words=claims.readings).check, "claims.compare", name)
    if "roads" in sections:
        surfaces = [name for name, road in sections["roads"].items() if isinstance(road, ArealEntry)]
        for place, one in enumerate(sections.get("areal", ())):
            look(Choice(words=surfaces).check, f"areal[{place}]", one)
    known = _known(sections, "road", "roads")
    areal = [name for name in known if isinstance(sections["roads"][name], ArealEntry)]
    found += [
        f"road is {name}, an areal road, but must be one of scales or of a profile: over an areal road one scene "
        f"slides at a time, by   rubfric simulate --road {name}"
        for name in areal
    ]
    known = () if areal else known
    if known:  # what has a number of a scale is made of the first road
        for key, number in _scales(sections):
            road = sections["roads"][known[0]]
            look(scale_number, key, number, road.scales if isinstance(road, MeasuredRoad) else len(road))
        for road in known if "phases" in sections else ():
            look(_phases, road, sections["roads"], sections["phases"].draws)
    for rubber in _known(sections, "rubber", "rubbers") if "grid" in sections else ():
        entry = sections["rubbers"][rubber]
        if not isinstance(entry, MeasuredRubber):  # of which the fit tells how far the shift factors reach
            look(check_temperatures, *rubber_of(rubber, entry.given()), sections["grid"].temperatures)
    if sections.get("grid") and sections.get("figures"):
        look(_on_grid, sections["grid"], sections["figures"])
    return found


def _phases(name: str, roads: Mapping[str, Any], draws: int) -> None:
    """Windows of a measured profile have the phases that they have."""
    road = roads[name]
    if isinstance(road, MeasuredRoad) and road.windows and draws:
        raise InvalidInput(
            f"phases.draws is {draws}, but must be 0 where roads.{name} has windows, which are several roads already: "
            "without windows its sines have random phases"
        )


def _known(sections: Mapping[str, Any], name: str, catalogue: str) -> tuple[str, ...]:
    """Return the names that a key has; none where one of them is no entry of its catalogue."""
    given, entries = names(sections.get(name, ())), sections.get(catalogue, {})
    return given if all(isinstance(one, str) and one in entries for one in given) else ()


def _scales(sections: Mapping[str, Any]) -> list[tuple[str, int]]:
    study, march, figures = (sections.get(name) for name in ("aspect_study", "transient", "figures"))
    return [
        *([("transient.scale", march.scale)] if march else []),
        *([("figures.fields.scale", figures.fields.scale)] if figures else []),
        *(("aspect_study.scales", number) for number in (study.scales if study else ())),
    ]


def _on_grid(grid: Grid, figures: FigureChoice) -> None:
    chosen = (
        ("figures.total_pressure", (figures.total_pressure,) if figures.total_pressure else (), "pressures"),
        ("figures.temperature", () if figures.temperature is None else (figures.temperature,), "temperatures"),
        ("figures.fields.pressures", figures.fields.pressures, "pressures"),
        ("figures.fields.velocities", figures.fields.velocities, "velocities"),
    )
    faults = []
    for key, values, axis in chosen:
        allowed = getattr(grid, axis)
        others = ", ".join(checks.written(value) for value in values if value not in allowed)
        if others:
            known = ", ".join(map(checks.written, allowed)) or "it has none"
            faults.append(f"{key} has {others}, but must be chosen from grid.{axis}: {known}")
    if faults:
        raise InvalidInput(*faults)


def spread(values: Sequence[float], most: int) -> tuple[float, ...]:
    """Return at most so many of some values, evenly from the first to the last.

    Parameters
    ----------
    values : sequence of float
    most : int
    """
    last = len(values) - 1
    places = {round(last * place / max(most - 1, 1)) for place in range(most)}
    return tuple(values[place] for place in sorted(places))


def study_of(given: AspectStudy | None, grid: Grid) -> AspectStudy | None:
    """Return the study of aspects, at the lowest and highest pressure of the grid where it has none.

    Parameters
    ----------
    given : AspectStudy or None
        None where there is none.
    grid : Grid
        From which missing speeds and pressures are taken.
    """
    return given and given.model_copy(update={"pressures": given.pressures or spread(grid.pressures, 2)})


def march_of(given: TransientChoice | None, grid: Grid) -> TransientChoice | None:
    """Return what is marched, at four speeds of the grid and its middle pressure where it has none.

    Parameters
    ----------
    given : TransientChoice or None
        None where there is none.
    grid : Grid
        From which missing speeds and pressures are taken.
    """
    middle = grid.pressures[(len(grid.pressures) - 1) // 2]
    return given and given.model_copy(
        update={"velocities": given.velocities or spread(grid.velocities, 4), "pressure": given.pressure or middle}
    )


def figures_of(given: FigureChoice | None, grid: Grid) -> FigureChoice:
    """Return what the figures show: the highest pressure, fields at four speeds and three pressures by default.

    Parameters
    ----------
    given : FigureChoice or None
        None for the default of everything.
    grid : Grid
        From which missing speeds and pressures are taken.
    """
    chosen = given or FigureChoice()
    fields = Fields(
        scale=chosen.fields.scale,
        velocities=chosen.fields.velocities or spread(grid.velocities, 4),
        pressures=chosen.fields.pressures or spread(grid.pressures, 3),
    )
    return chosen.model_copy(update={"total_pressure": chosen.total_pressure or grid.pressures[-1], "fields": fields})


def rig_of(given: RigChoice | None, grid: Grid) -> RigChoice | None:
    """Return the test rig, whose figure shows three pressures and four speeds of the grid by default.

    Parameters
    ----------
    given : RigChoice or None
        None where there is none.
    grid : Grid
        From which missing speeds and pressures are taken.
    """
    return given and given.model_copy(
        update={
            "pressures": given.pressures or spread(grid.pressures, 3),
            "speeds": given.speeds or spread(grid.velocities, 4),
        }
    )


def readings_of(claims: ClaimsChoice | None) -> Mapping[str, Any]:
    """Return the other readings of the paper, by name; none where its claims are not judged."""
    return claims.readings if claims else {}


def numerics_of(given: Config) -> tuple[Numerics, dict[str, Numerics]]:
    """Return the preset in use with what is laid over it, and every preset with nothing laid over.

    A bound on columns below those that a preset begins with concerns the preset in use only.
    """
    return _numerics(given.numerics, given.presets)


def _numerics(chosen: Any, entries: Mapping[str, Any]) -> tuple[Numerics, dict[str, Numerics]]:
    own = chosen.given()
    preset = Choice(words=entries).check("numerics.preset", own.pop("preset"))
    rest = {name: value for name, value in own.items() if name not in PRESET_KEYS}
    presets = {}
    for name, entry in ((name, entry.given()) for name, entry in entries.items()):
        most = max(rest["columns_max"], entry["columns_min"], entry["finite_columns_min"])
        presets[name] = Numerics(**entry | rest | {"columns_max": most})
    return Numerics(**entries[preset].given() | own), presets
