"""Numerics by name: presets of accuracy and first mesh, and what a config lays over one of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.scene import MOST_COLUMNS, Numerics

# What a preset sets; the rest of Numerics stands under the key numerics itself.
PRESET_KEYS = ("accuracy", "contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min", "row_growth")


def read_numerics(entry: Any, presets: Any) -> Numerics:
    """Read and check the keys ``numerics`` and ``presets`` of a config.

    Parameters
    ----------
    entry : mapping
        ``preset``, every field of ``Numerics`` that is none of a preset's, and any of those laid over it.
    presets : mapping
        Presets by name, each with ``PRESET_KEYS``.

    Raises
    ------
    InvalidInput
        For a wrong key or value, in any of the presets too.
    """
    if not isinstance(presets, Mapping) or not presets:
        raise InvalidInput(f"presets is {presets!r}, but must hold at least one entry by name")
    own = tuple(field.name for field in fields(Numerics) if field.name not in PRESET_KEYS)
    given = dict(checks.known_keys("numerics", entry, ("preset", *own, *PRESET_KEYS), ("preset", *own)))
    chosen = checks.one_of("numerics.preset", given.pop("preset"), presets)
    for name, preset in presets.items():
        checks.known_keys(f"presets.{checks.text('name in presets', name)}", preset, PRESET_KEYS, PRESET_KEYS)
    rest = {name: given[name] for name in own}
    for name, preset in presets.items():  # a bound on columns concerns the one chosen
        _checked(f"presets.{name}.", rest | dict(preset) | {"columns_max": MOST_COLUMNS})
    return Numerics(**{**presets[chosen], **given})


def _checked(key: str, values: Mapping[str, Any]) -> None:
    """Raise InvalidInput where a preset is wrong, with its own name in the message."""
    try:
        Numerics(**values)
    except InvalidInput as error:
        text = str(error)
        name = text.removeprefix("numerics.").split()[0].split("[")[0]
        raise InvalidInput(text.replace("numerics.", key if name in PRESET_KEYS else "numerics.", 1)) from error
