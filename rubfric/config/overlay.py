"""Configs in YAML files, laid over one another."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

from rubfric import checks
from rubfric.errors import InvalidInput

# What the YAML reader raises: dates such as 2019-99-99 and tags that do not fit give errors of Python's own.
_NO_YAML = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError, RecursionError)


def overlaid(paths: Iterable[str | os.PathLike[str]], keys: Iterable[str]) -> dict[str, Any]:
    """Read one or more YAML files, each laid over the ones before.

    Parameters
    ----------
    paths : iterable of path-like
    keys : iterable of str
        What such a file may hold, for the message.

    Raises
    ------
    InvalidInput
        For no file, and for a file that is no YAML or no mapping.
    FileNotFoundError
        For a missing file.
    """
    merged: dict[str, Any] | None = None
    for path in paths:
        try:
            entry = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
        except _NO_YAML as error:
            raise InvalidInput(f"{os.fspath(path)} is not valid YAML: {' '.join(str(error).split())}") from error
        if not isinstance(entry, Mapping):
            raise InvalidInput(
                f"{os.fspath(path)} holds {checks.shown(entry)}, but must hold the keys {', '.join(keys)}"
            )
        merged = _overlay(merged or {}, entry)
    if merged is None:
        raise InvalidInput("no config was given: name at least one file")
    return merged


def _overlay(base: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Merge two configs as Snakemake does: mappings key by key, anything else is replaced."""
    merged = dict(base)
    for key, value in above.items():
        nested = isinstance(value, Mapping) and isinstance(merged.get(key), Mapping)
        merged[key] = _overlay(merged[key], value) if nested else value
    return merged
