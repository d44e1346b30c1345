"""Every key of a config, defined once: its meaning, unit and bounds, and its default where it may be left out.

The models say which keys there are; the rule at each key says what its value may be. What a scene consists of is
defined by its own classes (``Numerics``, ``Procedure``, ``Material``, ``SineScale``), whose rules are taken from there.
``rubfric.config.page`` exports the JSON schema and config/README.md; defaults are in config/config.yaml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import MISSING, fields, replace
from difflib import get_close_matches
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import Discriminator, Tag, create_model, model_validator

from rubfric.config.areal_road import ArealEntry, is_areal
from rubfric.config.entries import Catalogue, Entry, Named, Scales, grid_values, keys
from rubfric.config.measured import MeasuredRubber
from rubfric.config.measured_road import MeasuredRoad
from rubfric.config.multiscale import WAYS
from rubfric.config.place import Place
from rubfric.config.rig import RigChoice
from rubfric.config.temperature import ShiftChoice, rubber_of
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.rubber.material import BULK, MODULI, PLANES, Material
from rubfric.rubber.shift import degrees
from rubfric.rules import HERE, Choice, Integer, Items, Number, Word, rules
from rubfric.scene.numerics import PRESET_KEYS, Numerics
from rubfric.scene.procedure import Procedure, check_wavelengths
from rubfric.scene.scene import KINEMATICS

# The name under which the campaign itself is judged, beside its readings.
AS_CONFIGURED = "campaign"


class Grid(Entry):
    """Every scale of the road is run at every one of these velocities and pressures."""

    velocities: Annotated[tuple[float, ...], grid_values("Sliding speeds.", "mm/s")]
    pressures: Annotated[tuple[float, ...], grid_values("Nominal pressures on the top of the block.", "MPa")]
    aspect: Annotated[float, Number("Height of the block over its width, which is one wavelength.")]
    temperatures: Annotated[
        tuple[float, ...],
        Items("Temperatures of a rubber with shift factors; none for the rubber as it is given.", degrees(), least=0),
    ] = ()
    refine: Annotated[
        float | None,
        Number(
            "Add speeds where friction over speed is not known to this share of itself between the grid's, by the "
            "estimated error of interpolation: on every scale and on the whole road, at every pressure and temperature "
            "and the aspect of the grid, for the first rubber on the first road. None are added where it is left out.",
            low=0.001,
            high=0.2,
        ),
    ] = None

    @model_validator(mode="after")
    def _between(self) -> Self:
        if self.refine is not None and len(self.velocities) < 2:
            raise InvalidInput(
                f"{HERE}.refine is {self.refine:g}, but {HERE}.velocities has one speed: give two at least, for others "
                "to be added between them"
            )
        return self


class PhasesChoice(Entry):
    """Phases of the waves where all scales are taken at once: those given at the scales, or random ones."""

    draws: Annotated[
        int,
        Integer("Number of random sets of phases, over which friction is averaged; 0 for those at the scales.", 0, 999),
    ]
    seed: Annotated[int, Integer("Seed of the random phases.", 0, 2**31)]


class AspectStudy(Entry):
    """Height-to-width ratios to compare, at the velocities of the grid."""

    aspects: Annotated[tuple[float, ...], grid_values("Height-to-width ratios.")]
    scales: Annotated[
        tuple[int, ...], Items("Numbers of the scales of the road to study, 1 being the first under roads.", Integer())
    ] = (1,)
    pressures: Annotated[tuple[float, ...], grid_values("Nominal pressures of the study.", "MPa")] = ()


class TransientChoice(Entry):
    """Press and slide in time, for Fig. 5, at the aspect of the grid."""

    scale: Annotated[int, Integer("Number of the scale.")] = 1
    velocities: Annotated[tuple[float, ...], grid_values("Sliding speeds.", "mm/s")] = ()
    pressure: Annotated[float, Number("Nominal pressure.", "MPa")] = 0.0
    start: Annotated[str, rules(Procedure)["start"]] = "pressed"
    columns: Annotated[int, rules(Procedure)["columns"]] = 64
    steps_per_wavelength: Annotated[int, rules(Procedure)["steps_per_wavelength"]] = 64
    wavelengths: Annotated[int, rules(Procedure)["wavelengths"]] = 12
    saturation: Annotated[float, replace(rules(Procedure)["saturation"], low=1e-6, high=0.5)] = 0.01

    @model_validator(mode="after")
    def _steps(self) -> Self:
        check_wavelengths(f"{HERE}.wavelengths", self.wavelengths, self.steps_per_wavelength)
        return self

    def procedure(self) -> dict[str, Any]:
        """Return the arguments of a ``rubfric.scene.procedure.Procedure``."""
        return self.model_dump(exclude={"scale", "velocities", "pressure"})


class Fields(Entry):
    """Scenes whose fields are drawn, Figs 2 and 4."""

    scale: Annotated[int, Integer("Number of the scale.")] = 1
    velocities: Annotated[tuple[float, ...], grid_values("Sliding speeds, out of the grid's.", "mm/s")] = ()
    pressures: Annotated[tuple[float, ...], grid_values("Nominal pressures, out of the grid's.", "MPa")] = ()


class FigureChoice(Entry):
    """What the figures show, out of the grid."""

    total_pressure: Annotated[
        float, Number("Nominal pressure of Fig. 7, the total over the scales; one of the grid's.", "MPa")
    ] = 0.0
    temperature: Annotated[
        float | None,
        degrees(
            "Temperature of the figures that show one, of claims, aspect study, marches and virtual rig; one of the "
            "grid's, and the nearest to the rubber's reference where none is given."
        ),
    ] = None
    fields: Fields = Fields()


class Reading(Entry):
    """What a reading changes of the campaign; what is left out is not changed."""

    plane: Annotated[str | None, Choice("Plane stress or plane strain.", PLANES)] = None
    kinematics: Annotated[str | None, Choice("Small strain, finite strain, or auto.", KINEMATICS)] = None
    moduli: Annotated[
        str | None,
        Choice("Whether the rubber's Young's modulus is of the relaxed or of the instantaneous rubber.", MODULI),
    ] = None
    bulk: Annotated[
        str | None, Choice("Whether its bulk modulus is constant or relaxes as the shear modulus does.", BULK)
    ] = None

    def rubber(self, material: Material) -> Material:
        """Return a rubber as this reading has it."""
        return replace(material, **self.model_dump(include={"moduli", "bulk"}, exclude_none=True))


class ClaimsChoice(Entry):
    """How the paper's claims are judged, and other readings of what the paper leaves open."""

    difference: Annotated[
        float,
        Number(
            "Relative difference up to which two values are called equal, and beyond which they are called different.",
            low=0.001,
            high=0.5,
        ),
    ]
    preset: Annotated[str, Named("Name of the entry under presets with which other readings are simulated.")]
    compare: Annotated[
        tuple[str, ...],
        Items(
            "Names of the readings that are simulated and judged beside the campaign.",
            Word(),
            least=0,
            ascending=False,
        ),
    ]
    readings: Annotated[
        dict[str, Reading],
        Catalogue(
            "Other readings of the paper, by name; each is judged by the whole grid and aspect study.",
            0,
            AS_CONFIGURED,
        ),
    ]


_WAVE = ("wavenumber", "wavelength")


def wavenumber(scale: Mapping[str, Any]) -> float:
    """Return the wavenumber of a scale, rad/mm, which has that or a wavelength, mm."""
    return float(scale["wavenumber"] or 2.0 * math.pi / scale["wavelength"])


def _one_wave(scale: Any) -> Any:
    """Refuse a scale without a wavelength, or with two."""
    given = [name for name in _WAVE if name in scale.model_fields_set]
    if not given:
        raise InvalidInput(f"{HERE} lacks the key 'wavenumber' (2 pi / wavelength, rad/mm), or 'wavelength' (mm)")
    if len(given) == 2:
        raise InvalidInput(f"{HERE} has both wavenumber and wavelength, but must have one: the former is 2 pi / latter")
    return scale


class _RubberEntry(Entry):
    """A rubber, whose bulk modulus has no spectrum of its own."""

    @classmethod
    def unknown(cls, name: Any) -> str:
        """Return what to say of a key that there is not; of k_i, what there is for the bulk modulus."""
        said = super().unknown(name)
        if not isinstance(name, str) or not any(word in name.lower() for word in ("bulk", "k_i", "kappa")):
            return said
        said = said if said.endswith(")") else f"{said} (did you mean bulk?)"
        return f"{said}: the bulk modulus is elastic (k_i = 0) or proportional to the shear modulus (k_i = g_i)"


def _sound(rubber: Any) -> Any:
    """Refuse a rubber whose entries do not go together."""
    try:
        rubber_of("x", rubber.given())
    except InvalidInput as error:
        raise InvalidInput(*(fault.replace("rubbers.x.", f"{HERE}.") for fault in error.faults)) from None
    return rubber


def _kind_of_road(given: Any) -> str:
    """Return the tag of a road: areal, measured by a key of it or one that is misspelt, or a list of scales."""
    if is_areal(given):
        return f"{HERE}areal"
    keys = given if isinstance(given, Mapping) else ()
    measured = isinstance(given, MeasuredRoad) or any(
        get_close_matches(str(key), MeasuredRoad.model_fields) for key in keys if key not in Scale.model_fields
    )
    return f"{HERE}{'measured' if measured else 'scales'}"


def _kind_of_rubber(given: Any) -> str:
    """Return the tag of a rubber that is measured, by its key or one that is misspelt, or of one that is given."""
    keys = given if isinstance(given, Mapping) else ()
    measured = isinstance(given, MeasuredRubber) or any(get_close_matches(str(key), ["measurements"]) for key in keys)
    return f"{HERE}{'measured' if measured else 'given'}"


if TYPE_CHECKING:  # made of the dataclasses below
    NumericsChoice = Entry
    Preset = Entry
    Rubber = Entry
    Scale = Entry
else:
    NumericsChoice = create_model(
        "NumericsChoice",
        __base__=Entry,
        __doc__="Accuracy and resolution: a preset, and whatever of a preset's keys shall differ from it. The program "
        "chooses each scene's kinematics and mesh by these rules.",
        preset=(Annotated[str, Named("Name of an entry under presets.")], ...),
        **keys(Numerics, [name for name in rules(Numerics) if name not in PRESET_KEYS]),
        **keys(Numerics, PRESET_KEYS, dict.fromkeys(PRESET_KEYS)),
    )
    Preset = create_model(
        "Preset",
        __base__=Entry,
        __doc__="An accuracy, with the first mesh on which to look for it.",
        **keys(Numerics, PRESET_KEYS),
    )
    Rubber = create_model(
        "Rubber",
        __base__=_RubberEntry,
        __doc__="A linear viscoelastic rubber, a spring and any number of Maxwell elements.",
        **keys(
            Material,
            [name for name in rules(Material) if name != "name"],
            {one.name: one.default for one in fields(Material) if one.default is not MISSING},
        ),
        shift=(ShiftChoice | None, None),
        __validators__={"_sound": model_validator(mode="after")(_sound)},
    )
    Scale = create_model(
        "Scale",
        __base__=Entry,
        __doc__="A scale of a road.",
        __validators__={"_wave": model_validator(mode="after")(_one_wave)},
        **keys(SineScale, ["amplitude"]),
        wavenumber=(
            Annotated[
                Any, Number("Wavenumber, 2 pi over the wavelength (radians per mm); one of the two is given.", "1/mm")
            ],
            None,
        ),
        wavelength=(
            Annotated[Any, Number("Wavelength, in place of the wavenumber, 2 pi over it.", "mm")],
            None,
        ),
        phase=(
            Annotated[float, Number("Phase; it matters where all scales are taken at once.", "rad", -1e6, 1e6)],
            0.0,
        ),
    )
    Scale.model_config["json_schema_extra"] = {"oneOf": [{"required": [name]} for name in _WAVE]}


class Config(Entry):
    """A campaign of sliding simulations. Numbers are canonical to twelve digits; lists may come in any order."""

    results: Annotated[str, Place("Folder of all outputs, created where it is missing.", "folder")]
    rubber: Annotated[
        Any,
        Named(
            "Name of the rubber in use, one of those under rubbers; or several, which are compared on every road: all "
            "other tables and figures are of the first.",
            several=True,
        ),
    ]
    road: Annotated[
        Any, Named("Name of the road in use, one of those under roads; or several, likewise.", several=True)
    ]
    areal: Annotated[
        tuple[str, ...],
        Items(
            "Areal roads, by their names under roads, that are slid over at every speed and pressure of the grid, in "
            "small strain and beside the road in use.",
            Word(),
            least=0,
            ascending=False,
        ),
    ] = ()
    plane: Annotated[str, Choice("Plane stress (the paper's CPS4R) or plane strain.", PLANES)]
    kinematics: Annotated[
        str,
        Choice(
            "Small strain, finite strain, or auto, which takes small strain for scenes where it is accurate enough.",
            KINEMATICS,
        ),
    ]
    multiscale: Annotated[
        str,
        Choice(
            "How the friction of the whole road is obtained: the sum over its scales (the paper), that sum corrected "
            "for what coupling does in small strain, a cascade of pressures from scale to scale, Persson's theory, all "
            "scales at once (direct, minutes a scene where much of the road is in contact), or auto: the cheapest that "
            "is accurate enough, and the corrected sum where that would take minutes.",
            WAYS,
        ),
    ]
    multiscale_preset: Annotated[str, Named("Name of the entry under presets with which the whole road is simulated.")]
    phases: PhasesChoice
    grid: Grid
    aspect_study: AspectStudy | None = None
    transient: TransientChoice | None = None
    figures: FigureChoice | None = None
    rig: RigChoice | None = None
    claims: ClaimsChoice | None = None
    numerics: NumericsChoice
    presets: Annotated[
        dict[str, Preset],
        Catalogue("Accuracies with the first mesh on which to look for them, by name."),
    ]
    rubbers: Annotated[
        dict[
            str,
            Annotated[
                Annotated[Rubber, Tag(f"{HERE}given")] | Annotated[MeasuredRubber, Tag(f"{HERE}measured")],
                Discriminator(_kind_of_rubber),
            ],
        ],
        Catalogue("Rubbers by name: by their Prony series, or by the file of measured moduli that it is fitted to."),
    ]
    roads: Annotated[
        dict[
            str,
            Annotated[
                Annotated[
                    list[Scale],
                    Scales("Scales of a road, from coarse to fine; scale 1 is the first."),
                    Tag(f"{HERE}scales"),
                ]
                | Annotated[MeasuredRoad, Tag(f"{HERE}measured")]
                | Annotated[ArealEntry, Tag(f"{HERE}areal")],
                Discriminator(_kind_of_road),
            ],
        ],
        Catalogue("Roads by name: by their scales, by the file of a measured profile, or areal."),
    ]
