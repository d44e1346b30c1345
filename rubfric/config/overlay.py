"""Configs in YAML files, laid over one another."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import yaml

from rubfric.checks import shown
from rubfric.errors import InvalidInput

# A config that gives one of these runs a campaign of its own,
OWN = frozenset(("rubber", "rubbers", "road", "roads", "grid"))
# and of these sections those that it gives; listed are the keys that follow from the grid where they are left out.
EXTRAS = {
    "aspect_study": ("scales", "pressures"),
    "transient": ("scale", "velocities", "pressure"),
    "figures": ("total_pressure", "temperature", "fields"),
    "rig": ("pressures", "speeds"),
    "claims": (),
}
# The catalogues whose entries may be files of what was measured, and the keys that lead to the file.
_MEASURED = (("rubbers", "measurements"), ("roads", "profile"), ("roads", "areal", "scan", "file"))
# As many values as a file may hold, what its aliases stand for counted where they stand.
_MOST_VALUES = 100_000
# What the YAML reader raises: dates such as 2019-99-99 and tags that do not fit give errors of Python's own.
_NO_YAML = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError, RecursionError)


def read_yaml(path: str | os.PathLike[str]) -> Any:
    """Return what a YAML file holds; files of measured rubbers in it count from the folder of the YAML file.

    Raises
    ------
    InvalidInput
        For a file that is no YAML, that has a key twice in one mapping, where YAML would keep the last, or whose
        aliases stand for more values than any config has.
    FileNotFoundError
        For a missing file.
    """
    try:
        loader = yaml.SafeLoader(Path(path).read_text(encoding="utf-8-sig"))
        tree = loader.get_single_node()
        wrong = "" if tree is None else _key_given_twice(tree) or _too_many_values(tree)
        held = None if tree is None or wrong else loader.construct_document(tree)
    except UnicodeDecodeError as error:
        raise InvalidInput(f"{os.fspath(path)} is not valid YAML: {_no_text(error)}") from error
    except RecursionError as error:
        raise InvalidInput(f"{os.fspath(path)} is not valid YAML: lists or mappings are nested too deeply") from error
    except IsADirectoryError as error:
        raise InvalidInput(f"{os.fspath(path)} is a folder, but must be a file in YAML") from error
    except _NO_YAML as error:
        raise InvalidInput(f"{os.fspath(path)} is not valid YAML: {' '.join(str(error).split())}") from error
    if wrong:
        raise InvalidInput(f"{os.fspath(path)} {wrong}")
    return _beside(held, Path(path).parent, lambda given, beside, way: beside)


def placed(config: Any, paths: Iterable[str | os.PathLike[str]]) -> Any:
    """Return a config that another program has read from YAML files, with files of what was measured as from there.

    Parameters
    ----------
    config : mapping
    paths : iterable of path-like
        The files, each laid over the ones before.
    """
    for path in reversed([*paths]):
        written = read_yaml(path)

        def found(given: str, beside: str, way: tuple[str, ...], written: Any = written) -> str:
            catalogue, *keys = way
            held = [_at(entry, keys) for entry in _catalogue(written, catalogue).values()]
            return beside if beside in held else given

        config = _beside(config, Path(path).parent, found)
    return config


def _catalogue(config: Any, name: str) -> Mapping[str, Any]:
    entries = config.get(name) if isinstance(config, Mapping) else None
    return entries if isinstance(entries, Mapping) else {}


def _beside(config: Any, folder: Path, choose: Callable[[str, str, tuple[str, ...]], str]) -> Any:
    """Return a config in which the files of what was measured are chosen, given as they are and as in a folder."""
    for way in _MEASURED:
        catalogue, *keys = way
        entries = dict(_catalogue(config, catalogue))
        for name, entry in entries.items():
            given = _at(entry, keys)
            if isinstance(given, str) and given and given[0] not in "~$/" and not os.path.isabs(given):
                entries[name] = _with(entry, keys, choose(given, _from_here(folder / given), way))
        config = {**config, catalogue: entries} if entries else config
    return config


def _at(entry: Any, keys: Iterable[str]) -> Any:
    """Return what some keys lead to, one below the other; None where they lead nowhere."""
    for key in keys:
        entry = entry.get(key) if isinstance(entry, Mapping) else None
    return entry


def _with(entry: Mapping[str, Any], keys: list[str], value: str) -> dict[str, Any]:
    """Return an entry in which some keys lead to another value."""
    key, *below = keys
    return {**entry, key: _with(entry[key], below, value) if below else value}


def _no_text(error: UnicodeDecodeError) -> str:
    """Say which byte of a file is no UTF-8, where, and what to do."""
    line = error.object.count(b"\n", 0, error.start) + 1
    return (
        f"it is not in UTF-8, since line {line} has the byte 0x{error.object[error.start]:02x}; save it as UTF-8, in "
        "most editors under 'save as' and 'encoding'"
    )


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


def _too_many_values(tree: yaml.Node) -> str:
    """Return what to say of a file that holds too many values once its aliases are filled in, or nothing."""
    known: dict[int, int] = {}

    def count(node: yaml.Node) -> int:
        if isinstance(node, yaml.CollectionNode):
            if id(node) not in known:
                known[id(node)] = _MOST_VALUES + 1  # an alias inside of what it stands for has no end
                inside = node.value if isinstance(node, yaml.SequenceNode) else [value for _, value in node.value]
                known[id(node)] = sum(map(count, inside))
            return known[id(node)]
        return 1

    if count(tree) <= _MOST_VALUES:
        return ""
    return f"holds more than {_MOST_VALUES} values once its aliases (*name) are filled in; write out what you mean"


def as_typed(config: Any, given: Any) -> Any:
    """Return a config whose entries from Snakemake's command line are the numbers that they were written as.

    What is nested there, ``--config 'grid={"aspect": 0.5}'``, arrives as text.

    Parameters
    ----------
    config : mapping
        The whole config.
    given : mapping
        What the command line gave, as Snakemake read it.
    """
    if isinstance(config, Mapping) and isinstance(given, Mapping):
        return {key: as_typed(value, given[key]) if key in given else value for key, value in config.items()}
    return _typed(given) if config == given else config


def _typed(value: Any) -> Any:
    if isinstance(value, list):
        return [_typed(item) for item in value]
    if not isinstance(value, str):
        return value
    for kind in (int, float):
        with suppress(ValueError):
            return kind(value)
    return {"null": None, "~": None, "true": True, "false": False}.get(value.lower(), value)


def overlaid(configs: Iterable[str | os.PathLike[str] | Mapping[str, Any]], keys: Iterable[str]) -> dict[str, Any]:
    """Read one or more configs, each laid over the ones before.

    Parameters
    ----------
    configs : iterable of path-like or mapping
        YAML files, or what such a file holds.
    keys : iterable of str
        What such a file may hold, for the message.

    Raises
    ------
    InvalidInput
        For no file, and for a file that is no YAML, has a key twice, or is no mapping.
    FileNotFoundError
        For a missing file.
    """
    entries: list[Mapping[str, Any]] = []
    for config in configs:
        entry = config if isinstance(config, Mapping) else read_yaml(config)
        if not isinstance(entry, Mapping):
            held = "nothing" if entry is None else shown(entry)
            raise InvalidInput(f"{config} holds {held}, but must hold the keys {', '.join(keys)}")
        entries.append(entry)
    if not entries:
        raise InvalidInput("no config was given: name at least one file")
    above: dict[str, Any] = {}
    for entry in entries[1:]:
        above = _overlay(above, entry)
    return own_campaign(_overlay(entries[0], above), above)


def own_campaign(merged: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Return a config without what the config below adds to the grid, where the one above has a rubber, road or grid.

    What it names itself of those sections stays, and takes from below what it leaves out, except for the speeds, loads
    and scales: they belong to the grid below.

    Parameters
    ----------
    merged : mapping
        The config above laid over the one below.
    above : mapping
    """
    if not OWN & set(above):
        return dict(merged)
    kept: dict[str, Any] = {}
    for section, following in EXTRAS.items():
        own, both = above.get(section), merged.get(section)
        if isinstance(own, Mapping) and isinstance(both, Mapping):
            kept[section] = {key: value for key, value in both.items() if key not in following}
            kept[section] |= {key: value for key, value in own.items() if key in following}
        else:
            kept[section] = own
    return {**merged, **kept}


def _from_here(path: Path) -> str:
    """Return a path as from the working folder where it is below that, so that the folder may be moved."""
    found = os.path.abspath(path)
    here = os.path.relpath(found)
    return found if here.startswith(os.pardir) else here


def _overlay(base: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Merge two configs as Snakemake does: mappings key by key, anything else is replaced."""
    merged = dict(base)
    for key, value in above.items():
        nested = isinstance(value, Mapping) and isinstance(merged.get(key), Mapping)
        merged[key] = _overlay(merged[key], value) if nested else value
    return merged
