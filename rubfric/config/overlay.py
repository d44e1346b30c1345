"""Configs in YAML files, laid over one another."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

from rubfric.checks import shown
from rubfric.errors import InvalidInput

# What the YAML reader raises: dates such as 2019-99-99 and tags that do not fit give errors of Python's own.
_NO_YAML = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError, RecursionError)


def read_yaml(path: str | os.PathLike[str]) -> Any:
    """Return what a YAML file holds.

    Raises
    ------
    InvalidInput
        For a file that is no YAML, or that has a key twice in one mapping, where YAML would keep the last.
    FileNotFoundError
        For a missing file.
    """
    try:
        loader = yaml.SafeLoader(Path(path).read_text(encoding="utf-8-sig"))
        tree = loader.get_single_node()
        twice = _key_given_twice(tree)
        held = None if tree is None or twice else loader.construct_document(tree)
    except RecursionError as error:
        raise InvalidInput(f"{os.fspath(path)} is not valid YAML: lists or mappings are nested too deeply") from error
    except (*_NO_YAML, IsADirectoryError) as error:
        raise InvalidInput(f"{os.fspath(path)} is not valid YAML: {' '.join(str(error).split())}") from error
    if twice:
        raise InvalidInput(f"{os.fspath(path)} {twice}")
    return held


def _key_given_twice(tree: yaml.Node | None) -> str:
    """Return what to say of the first key that a mapping has twice, or nothing."""
    waiting, seen = [("", tree)], set()
    while waiting:
        at, node = waiting.pop()
        if id(node) in seen or not isinstance(node, yaml.CollectionNode):
            continue
        seen.add(id(node))
        if isinstance(node, yaml.SequenceNode):
            waiting += [(f"{at}[{place}]", item) for place, item in reversed([*enumerate(node.value)])]
            continue
        lines: dict[tuple[str, str], int] = {}
        dot = at and f"{at}."
        for key, _ in node.value:
            same, line = (key.tag, str(key.value)), key.start_mark.line + 1
            if same in lines:
                return f"has the key {shown(dot + str(key.value))} twice, in lines {lines[same]} and {line}; keep one"
            lines[same] = line
        waiting += [(f"{dot}{key.value}", value) for key, value in reversed(node.value)]
    return ""


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
        For no file, and for a file that is no YAML, has a key twice, or is no mapping.
    FileNotFoundError
        For a missing file.
    """
    merged: dict[str, Any] | None = None
    for path in paths:
        entry = read_yaml(path)
        if not isinstance(entry, Mapping):
            raise InvalidInput(f"{os.fspath(path)} holds {shown(entry)}, but must hold the keys {', '.join(keys)}")
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
