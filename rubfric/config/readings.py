"""How the paper's claims are judged, and other readings of what the paper leaves open, from the config."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.rubber.material import BULK, MODULI, PLANES, Material
from rubfric.scene.scene import KINEMATICS

# What a reading may change, and to what.
_CHOICES: dict[str, Iterable[str]] = {"plane": PLANES, "kinematics": KINEMATICS, "moduli": MODULI, "bulk": BULK}
# The name under which the campaign itself is judged.
AS_CONFIGURED = "campaign"


@dataclass(frozen=True)
class Reading:
    """What a reading of the paper changes of a campaign; None leaves it.

    Attributes
    ----------
    plane : {"stress", "strain"}, optional
    kinematics : {"small", "finite", "auto"}, optional
    moduli : {"long_term", "instantaneous"}, optional
        How the rubber's Young's modulus is read.
    bulk : {"elastic", "proportional"}, optional
        How its bulk modulus relaxes.
    """

    plane: str | None = None
    kinematics: str | None = None
    moduli: str | None = None
    bulk: str | None = None

    def rubber(self, material: Material) -> Material:
        """Return a rubber as this reading has it."""
        changes = {name: value for name in ("moduli", "bulk") if (value := getattr(self, name)) is not None}
        return replace(material, **changes)


@dataclass(frozen=True)
class ClaimsChoice:
    """How claims are judged.

    Attributes
    ----------
    difference : float
        Relative difference up to which two values are called equal, 0.001 to 0.5.
    preset : str
        The preset with which other readings are simulated.
    compare : tuple of str
        The readings that are simulated.
    readings : dict of str to Reading
        All that may be, by name.
    """

    difference: float
    preset: str
    compare: tuple[str, ...]
    readings: dict[str, Reading]


def read_claims(entry: Any, presets: Iterable[str]) -> ClaimsChoice:
    """Read and check the key ``claims`` of a config whose presets have these names."""
    keys = tuple(one.name for one in fields(ClaimsChoice))
    checks.known_keys("claims", entry, keys, keys)
    readings = entry["readings"]
    if not isinstance(readings, Mapping):
        raise InvalidInput(
            f"claims.readings is {checks.shown(readings)}, but must hold readings by name, or {{}} for none"
        )
    compare = entry["compare"]
    if not isinstance(compare, list):
        raise InvalidInput(f"claims.compare is {checks.shown(compare)}, but must be a list of names, or [] for none")
    known = {_name(name): _read(name, changes) for name, changes in readings.items()}
    difference = checks.at_least("claims.difference", entry["difference"], 0.001)
    return ClaimsChoice(
        difference=checks.at_most("claims.difference", difference, 0.5),
        preset=checks.one_of("claims.preset", entry["preset"], presets),
        compare=tuple(dict.fromkeys(checks.one_of("claims.compare", name, known) for name in compare)),
        readings=known,
    )


def _name(name: Any) -> str:
    if checks.text("name in claims.readings", name) == AS_CONFIGURED:
        raise InvalidInput(f"claims.readings has {name!r}, which stands for the campaign itself; give another name")
    return str(name)


def _read(name: str, entry: Any) -> Reading:
    checks.known_keys(f"claims.readings.{name}", entry, _CHOICES)
    return Reading(**{key: checks.one_of(f"claims.readings.{name}.{key}", entry[key], _CHOICES[key]) for key in entry})
