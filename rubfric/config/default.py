"""The config over which others are laid: the paper's campaign, kept in the package."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rubfric.config.models import Config
from rubfric.config.overlay import read_yaml

# In the project a link to config/config.yaml, in an installed package the file itself.
PAPER = Path(__file__).resolve().with_name("default.yaml")
_LOCAL = Path("config/config.yaml")


def over_default(*configs: str | os.PathLike[str] | Mapping[str, Any]) -> list[Any]:
    """Return configs to lay over one another, the paper's before them where the first is not complete."""
    if not configs:
        return [PAPER]
    first = configs[0] if isinstance(configs[0], Mapping) else read_yaml(configs[0])
    return [*([PAPER] if isinstance(first, Mapping) and not _complete(first) else []), *configs]


def layers(given: Mapping[str, Any], above: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the configs of a run of the workflow, each laid over the ones before.

    Parameters
    ----------
    given : mapping
        The config of the run, or of a module. One that is complete takes the place of those it would be laid over.
    above : mapping
        What was given on the command line of the run, which the config of a module may hold already.
    """
    if not _complete(given):
        return [*map(read_yaml, base_configs()), given]
    return [given, above] if _holds(given, above) else [given]


def _holds(config: Any, above: Any) -> bool:
    if isinstance(config, Mapping) and isinstance(above, Mapping):
        return all(key in config and _holds(config[key], value) for key, value in above.items())
    return bool(config == above)


def base_configs() -> list[Path]:
    """Return the configs that others are laid over.

    They are config/config.yaml of the working folder where it is complete, else the paper's, with that file over it. A
    file of that name which has none of a config's keys belongs to something else and is left alone.
    """
    if not _LOCAL.is_file() or _LOCAL.resolve() == PAPER.resolve():
        return [PAPER]
    held = read_yaml(_LOCAL)
    if not isinstance(held, Mapping) or not set(Config.model_fields) & set(held):
        return [PAPER]
    return [_LOCAL] if _complete(held) else [PAPER, _LOCAL]


def _complete(config: Mapping[str, Any]) -> bool:
    """Return whether a config has every key that no default stands for."""
    return all(name in config for name, field in Config.model_fields.items() if field.is_required())
