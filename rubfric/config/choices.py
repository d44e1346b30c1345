"""What a config chooses out of its campaign: a study of ratios, marches in time, and what the figures show."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput

# What a march begins with: pressing in time, infinitely slow pressing, or steady sliding.
STARTS = ("pressed", "relaxed", "steady")
# Most columns of cells, most steps in a wavelength, and most steps of a march, whose records fill a gigabyte then.
MOST_COLUMNS, MOST_STEPS_PER_WAVELENGTH, MOST_STEPS = 2**20, 2**16, 10**7


@dataclass(frozen=True)
class AspectStudy:
    """Height-to-width ratios to compare, at some scales and pressures (MPa) and all velocities of the grid."""

    aspects: tuple[float, ...]
    scales: tuple[int, ...]
    pressures: tuple[float, ...]


@dataclass(frozen=True)
class FigureChoice:
    """What the figures show: the pressure of the total, and the scenes whose fields are drawn (MPa, mm/s)."""

    total_pressure: float
    scale: int
    velocities: tuple[float, ...]
    pressures: tuple[float, ...]


@dataclass(frozen=True)
class TransientChoice:
    """The marches in time: a scale, speeds (mm/s) and a pressure (MPa), and how they are marched.

    The rest is as in ``rubfric.scene.procedure.Procedure``.
    """

    scale: int
    velocities: tuple[float, ...]
    pressure: float
    start: str
    columns: int
    steps_per_wavelength: int
    wavelengths: int
    saturation: float

    def procedure(self) -> dict[str, Any]:
        """Return the arguments of a ``rubfric.scene.procedure.Procedure``."""
        return {name: value for name, value in asdict(self).items() if name not in ("scale", "velocities", "pressure")}


def scale_number(key: str, value: Any, scales: int) -> int:
    """Return the number of one of the road's scales."""
    number = checks.whole(key, value, 1)
    if number > scales:
        raise InvalidInput(f"{key} is {number}, but must be one of the road's scales, 1 to {scales}")
    return number


def read_aspect_study(entry: Any, scales: int) -> AspectStudy:
    """Read and check the key ``aspect_study`` of a config for a road of so many scales."""
    keys = tuple(field.name for field in fields(AspectStudy))
    checks.known_keys("aspect_study", entry, keys, keys)
    numbers = checks.grid("aspect_study.scales", entry["scales"])
    return AspectStudy(
        aspects=checks.grid("aspect_study.aspects", entry["aspects"]),
        scales=tuple(scale_number("aspect_study.scales", number, scales) for number in numbers),
        pressures=checks.grid("aspect_study.pressures", entry["pressures"], "MPa"),
    )


def read_figures(entry: Any, scales: int, velocities: tuple[float, ...], pressures: tuple[float, ...]) -> FigureChoice:
    """Read and check the key ``figures`` of a config against its grid."""
    checks.known_keys("figures", entry, ("total_pressure", "fields"), ("total_pressure", "fields"))
    keys = ("scale", "velocities", "pressures")
    chosen = checks.known_keys("figures.fields", entry["fields"], keys, keys)
    total = checks.positive("figures.total_pressure", entry["total_pressure"], "MPa")
    speeds = checks.grid("figures.fields.velocities", chosen["velocities"], "mm/s")
    loads = checks.grid("figures.fields.pressures", chosen["pressures"], "MPa")
    _subset("figures.total_pressure", (total,), "grid.pressures", pressures)
    _subset("figures.fields.pressures", loads, "grid.pressures", pressures)
    _subset("figures.fields.velocities", speeds, "grid.velocities", velocities)
    return FigureChoice(total, scale_number("figures.fields.scale", chosen["scale"], scales), speeds, loads)


def _subset(key: str, values: tuple[float, ...], whole: str, allowed: tuple[float, ...]) -> None:
    for value in values:
        if value not in allowed:
            known = ", ".join(checks.written(number) for number in allowed)
            raise InvalidInput(f"{key} has {checks.written(value)}, but must be chosen from {whole}: {known}")


def read_transient(entry: Any, scales: int) -> TransientChoice:
    """Read and check the key ``transient`` of a config."""
    keys = tuple(field.name for field in fields(TransientChoice))
    checks.known_keys("transient", entry, keys, keys)
    saturation = checks.at_least("transient.saturation", entry["saturation"], 1e-6)
    steps = checks.whole("transient.steps_per_wavelength", entry["steps_per_wavelength"], 4, MOST_STEPS_PER_WAVELENGTH)
    return TransientChoice(
        scale=scale_number("transient.scale", entry["scale"], scales),
        velocities=checks.grid("transient.velocities", entry["velocities"], "mm/s"),
        pressure=checks.positive("transient.pressure", entry["pressure"], "MPa"),
        start=checks.one_of("transient.start", entry["start"], STARTS),
        columns=checks.multiple("transient.columns", entry["columns"], 8, MOST_COLUMNS),
        steps_per_wavelength=steps,
        wavelengths=checks.whole("transient.wavelengths", entry["wavelengths"], 1, MOST_STEPS // steps),
        saturation=checks.at_most("transient.saturation", saturation, 0.5),
    )
