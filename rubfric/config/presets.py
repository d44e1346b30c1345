"""Numerics by name: presets of accuracy and first mesh, and what a config lays over one of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.scene.scene import Numerics

# What a preset sets; the rest of Numerics stands under the key numerics itself.
PRESET_KEYS = ("accuracy", "contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min", "row_growth")


# The mesh of fineness 1: others have so many times as many nodes and columns, and rows that grow so much slower.
_NODES, _FINITE_NODES, _COLUMNS, _FINITE_COLUMNS, _GROWTH = 64, 32, 256, 128, 0.1


def fineness(value: float) -> dict[str, Any]:
    """Return what ``PRESET_KEYS`` say of the first mesh at some fineness, 0.5 being that of the preset ``standard``."""

    def columns(number: int) -> int:
        return max(8, 8 * round(number * value / 8))

    return {
        "contact_nodes": round(_NODES * value),
        "finite_contact_nodes": round(_FINITE_NODES * value),
        "columns_min": columns(_COLUMNS),
        "finite_columns_min": columns(_FINITE_COLUMNS),
        "row_growth": float(f"{1.0 + _GROWTH / value:.4g}"),
    }


def read_numerics(entry: Any, presets: Any) -> tuple[Numerics, dict[str, Numerics]]:
    """Read and check the keys ``numerics`` and ``presets`` of a config.

    Parameters
    ----------
    entry : mapping
        ``preset``, every field of ``Numerics`` that is none of a preset's, and any of those laid over it.
    presets : mapping
        Presets by name, each with ``PRESET_KEYS``.

    Returns
    -------
    chosen : Numerics
        The preset in use, with what is laid over it.
    every : dict of str to Numerics
        All presets, with nothing laid over.

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
    every = {
        name: _checked(f"presets.{name}", _enough_columns(rest | dict(preset))) for name, preset in presets.items()
    }
    return Numerics(**{**presets[chosen], **given}), every


def _enough_columns(values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a preset's values with at least the columns that it begins with: a bound concerns the preset in use."""
    counts = [values[name] for name in ("columns_min", "finite_columns_min", "columns_max")]
    if any(isinstance(count, bool) or not isinstance(count, int) for count in counts):
        return values
    return {**values, "columns_max": max(counts)}


def _checked(at: str, values: Mapping[str, Any]) -> Numerics:
    """Return a preset; InvalidInput has its name in the message."""
    try:
        return Numerics(**values)
    except InvalidInput as error:
        text = str(error)
        name = text.removeprefix("numerics.").split()[0].split("[")[0]
        raise InvalidInput(text.replace("numerics", at, 1) if name in PRESET_KEYS else text) from error
