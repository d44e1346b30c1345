"""Areal roads of the config: self-affine surfaces, waves with directions, and areal scans."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import create_model, model_validator

from rubfric.config.entries import Entry, keys
from rubfric.config.measured_road import FORMS
from rubfric.config.place import Place, digest_of
from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealRoad
from rubfric.road.areal_scan import BLEND, ScannedRoad
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine
from rubfric.rules import HERE, Choice, Integer, Number, rules
from rubfric.scene.areal import NODES_PER_WAVE, ArealNumerics

_KINDS = ("self_affine", "waves", "scan")


def _sound(entry: Any) -> Any:
    """Refuse a surface whose entries do not go together."""
    try:
        entry.road()
    except InvalidInput as error:
        raise InvalidInput(*(_here(fault) for fault in error.faults)) from None
    return entry


def _here(fault: str) -> str:
    """Return what a road says of itself, as said of the entry that it is read from."""
    return f"{HERE}{fault.removeprefix('road')}" if fault.startswith("road") else fault.replace("the road", HERE, 1)


class _SurfaceEntry(Entry):
    def road(self) -> SelfAffine | ArealWaves:
        """Return the surface."""
        kind = SelfAffine if "hurst" in type(self).model_fields else ArealWaves
        found: SelfAffine | ArealWaves = kind(**self.model_dump())
        return found


if TYPE_CHECKING:
    SelfAffineChoice = _SurfaceEntry
    WavesChoice = _SurfaceEntry
else:
    SelfAffineChoice = create_model(
        "SelfAffineChoice",
        __base__=_SurfaceEntry,
        __doc__="A self-affine surface; of rms_slope and rms_height one is given.",
        __validators__={"_sound": model_validator(mode="after")(_sound)},
        **keys(SelfAffine, rules(SelfAffine), {"roll_off": None, "rms_slope": None, "rms_height": None, "seed": 1}),
    )
    WavesChoice = create_model(
        "WavesChoice",
        __base__=_SurfaceEntry,
        __doc__="Waves with directions.",
        __validators__={"_sound": model_validator(mode="after")(_sound)},
        **keys(ArealWaves, rules(ArealWaves)),
    )


class ScanChoice(Entry):
    """An areal scan; it is read before anything is simulated."""

    file: Annotated[
        str,
        Place(
            "File of the areal scan, ISO 25178-71 (.sdf), or another that the extra topography reads; a relative path "
            "counts from the folder of the config that has it."
        ),
    ]
    cut_off: Annotated[float | None, Number("Shortest wavelength kept; without, all waves.", "mm", 1e-9, 1e6)] = None
    form: Annotated[str, Choice("What is removed: the mean, a plane, or a paraboloid.", FORMS)] = "tilt"
    blend: Annotated[float, Number("Share of the window over which its ends are blended.", low=0.0, high=0.5)] = BLEND

    def options(self) -> dict[str, Any]:
        """Return arguments of ``rubfric.profile.areal.scanned_road`` as plain values."""
        made = {"degree": FORMS.index(self.form), "blend": self.blend, "cut_off": self.cut_off}
        return {"path": self.file} | made


class ArealChoice(Entry):
    """A surface: self-affine, waves, or a scan."""

    self_affine: SelfAffineChoice | None = None
    waves: WavesChoice | None = None
    scan: ScanChoice | None = None

    @model_validator(mode="after")
    def _one(self) -> ArealChoice:
        given = [name for name in _KINDS if getattr(self, name) is not None]
        if len(given) != 1:
            raise InvalidInput(f"{HERE} must have one of self_affine, waves and scan")
        return self


class ArealEntry(Entry):
    """A road that is a surface; see ``areal``, and ``rubfric simulate --road NAME``."""

    areal: ArealChoice
    accuracy: Annotated[float, rules(ArealNumerics)["accuracy"]] = ArealNumerics.accuracy
    nodes_max: Annotated[int, rules(ArealNumerics)["nodes_max"]] = ArealNumerics.nodes_max

    direction: Annotated[float, Number("Direction of sliding, degrees from x towards y.", "degrees", -360.0, 360.0)] = (
        0.0
    )

    profiles: Annotated[
        int,
        Integer(
            "Profiles of it along the direction of sliding, if that is 0, 90, 180 or 270 degrees, that the plane model "
            "slides over to compare; none with 0.",
            0,
            1000,
        ),
    ] = 16

    @property
    def numerics(self) -> ArealNumerics:
        """How finely scenes on it are solved."""
        return ArealNumerics(accuracy=self.accuracy, nodes_max=self.nodes_max)

    def road(self, name: str) -> ArealRoad:
        """Return the surface; the same scan and options are read once in a process.

        Parameters
        ----------
        name : str
            Of the road.

        Raises
        ------
        InvalidInput
            For a scan that is missing, cannot be read or is none, or with waves shorter than the nodes resolve.
        """
        given = next(one for one in (self.areal.self_affine, self.areal.waves, self.areal.scan) if one)
        if isinstance(given, ScanChoice):
            return _read(f"roads.{name}", self, given, digest_of(f"roads.{name}.areal.scan.file", given.file))
        found: SelfAffine | ArealWaves = given.road()
        return found


@lru_cache(maxsize=16)
def _read(key: str, entry: ArealEntry, scan: ScanChoice, digest: str) -> ScannedRoad:
    """Return the scan of a file of this digest."""
    del digest
    from rubfric.profile.areal import scanned_road  # heavy: only where a scan is read

    try:
        road = scanned_road(**scan.options())
    except InvalidInput as error:
        raise InvalidInput(*(f"{key}.areal.scan: {fault}" for fault in error.faults)) from error
    shortest = scan.cut_off or road.shortest
    most = shortest * entry.nodes_max / NODES_PER_WAVE
    if max(road.periods) > most * (1.0 + 1e-9):
        least = NODES_PER_WAVE * max(road.periods) / entry.nodes_max
        way = "is missing" if scan.cut_off is None else f"is {scan.cut_off:g} mm"
        raise InvalidInput(
            f"{key}.areal.scan.cut_off {way}, but must be at least {least:.4g} mm: nodes_max, {entry.nodes_max}, "
            f"leaves {NODES_PER_WAVE} nodes for a wave of that length on a window of {max(road.periods):.4g} mm; or "
            "raise nodes_max"
        )
    return road


def is_areal(given: Any) -> bool:
    """Return whether an entry of the roads is a surface."""
    return isinstance(given, ArealEntry) or (isinstance(given, Mapping) and "areal" in given)
