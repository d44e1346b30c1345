"""A rubber of the config whose moduli were measured: what the file is, and how it is fitted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any

from pydantic import model_validator

from rubfric import checks
from rubfric.config.entries import Entry
from rubfric.config.place import Place
from rubfric.errors import InvalidInput
from rubfric.rubber.material import COLDEST, HOTTEST, Material
from rubfric.rules import HERE, Choice, Integer, Number, Rule, rules

_QUANTITIES = ("frequency", "temperature", "storage", "loss", "complex", "tan_delta", "phase")


@dataclass(frozen=True)
class Texts(Rule):
    """Texts by the name of a measured quantity."""

    def check(self, key: str, value: Any) -> dict[str, str]:
        """Return the texts."""
        held = checks.known_keys(key, value, _QUANTITIES)
        return {name: str(text) for name, text in held.items()}

    def _schema(self) -> dict[str, Any]:
        return {"type": "object", "propertyNames": {"enum": list(_QUANTITIES)}}


class MeasuredRubber(Entry):
    """A rubber whose moduli were measured at several temperatures (DMA); it is fitted before anything is simulated."""

    measurements: Annotated[
        str, Place("File of measured moduli; a relative path counts from the folder of the config that has it.")
    ]
    reference_temperature: Annotated[
        float | None,
        Number("Temperature at which it slides; without, 20 where that was measured.", "degC", COLDEST, HOTTEST),
    ] = None
    law: Annotated[
        str,
        Choice(
            "Law of the shift factors; auto takes the one that holds.",
            ("auto", "wlf", "arrhenius", "free"),
        ),
    ] = "auto"
    vertical: Annotated[
        str, Choice("Vertical shift: b_T = 1, T over T_ref in K, or free.", ("none", "entropic", "free"))
    ] = "none"
    static_modulus: Annotated[
        float | None, Number("Modulus at rest, of the measured kind; without, it is fitted.", "MPa", 1e-4, 1e5)
    ] = None
    branches_per_decade: Annotated[
        float | None, Number("Maxwell elements a decade; without, as many as the data justify.", low=0.2, high=20.0)
    ] = None
    poissons_ratio: Annotated[
        float, replace(rules(Material)["poissons_ratio"], about="Poisson's ratio, which is constant.")
    ] = 0.49
    bulk_modulus: Annotated[
        float | None, Number("Constant bulk modulus, in place of a constant Poisson's ratio.", "MPa", 1.0, 1e6)
    ] = None
    density: Annotated[float, rules(Material)["density"]] = 1.1e-9
    uncertainty: Annotated[
        int,
        Integer(
            "Bootstrap samples of the fit that are propagated to friction, for its error from the rubber's data; 0 for "
            "none.",
            0,
            500,
            10,
        ),
    ] = 0
    seed: Annotated[int, Integer("Seed of the bootstrap.", 0, 2**31)] = 1
    modulus: Annotated[
        str | None, Choice("Whether moduli are Young's or shear moduli, where the file does not say.", ("E", "G"))
    ] = None
    columns: Annotated[dict[str, str] | None, Texts("Headings of the columns, where they are not recognised.")] = None
    units: Annotated[dict[str, str] | None, Texts("Units of the columns, where the file does not say.")] = None
    decimal: Annotated[str | None, Choice("Decimal mark, where it is not recognised.", ("point", "comma"))] = None
    separator: Annotated[
        str | None,
        Choice("What separates columns, where it is not recognised.", ("tab", "semicolon", "comma", "space")),
    ] = None
    isotherm: Annotated[float, Number("Temperatures within which rows are one isotherm.", "K", 1e-3, 20.0)] = 1.0
    data: Annotated[
        str, Choice("Moduli at several temperatures, or a master curve without any.", ("isotherms", "master"))
    ] = "isotherms"

    @classmethod
    def unknown(cls, name: Any) -> str:
        """Return what to say of a key that there is not; of those of a rubber without measurements, why not."""
        if name in (*rules(Material), "shift"):
            return f"{HERE} has both measurements and {name}, but {name} follows from the measurements: leave one out"
        return super().unknown(name)

    @model_validator(mode="after")
    def _one_bulk(self) -> MeasuredRubber:
        if {"bulk_modulus", "poissons_ratio"} <= self.model_fields_set and self.bulk_modulus is not None:
            raise InvalidInput(
                f"{HERE} has both poissons_ratio and bulk_modulus, but must have one: the other is constant"
            )
        return self
