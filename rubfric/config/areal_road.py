"""Areal roads of the config, over which one scene slides at a time: self-affine surfaces, and waves with directions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import create_model, model_validator

from rubfric.config.entries import Entry, keys
from rubfric.errors import InvalidInput
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine
from rubfric.rules import HERE, rules
from rubfric.scene.areal import ArealNumerics

_KINDS = ("self_affine", "waves")


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


class ArealChoice(Entry):
    """A surface: self-affine, or waves."""

    self_affine: SelfAffineChoice | None = None
    waves: WavesChoice | None = None

    @model_validator(mode="after")
    def _one(self) -> ArealChoice:
        given = [name for name in _KINDS if getattr(self, name) is not None]
        if len(given) != 1:
            raise InvalidInput(f"{HERE} must have one of {' and '.join(_KINDS)}")
        return self


class ArealEntry(Entry):
    """A road that is a surface; one scene slides over it by ``rubfric simulate --road NAME``."""

    areal: ArealChoice
    accuracy: Annotated[float, rules(ArealNumerics)["accuracy"]] = ArealNumerics.accuracy
    nodes_max: Annotated[int, rules(ArealNumerics)["nodes_max"]] = ArealNumerics.nodes_max

    @property
    def numerics(self) -> ArealNumerics:
        """How finely scenes on it are solved."""
        return ArealNumerics(accuracy=self.accuracy, nodes_max=self.nodes_max)

    def road(self) -> SelfAffine | ArealWaves:
        """Return the surface."""
        return next(one for one in (self.areal.self_affine, self.areal.waves) if one).road()


def is_areal(given: Any) -> bool:
    """Return whether an entry of the roads is a surface."""
    return isinstance(given, ArealEntry) or (isinstance(given, Mapping) and "areal" in given)
