"""The config over which others are laid: the paper's campaign, kept in the package."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rubfric.config.models import Config
from rubfric.config.overlay import read_yaml

# In the project a link to config/config.yaml, in an installed package the file itself.
PAPER = Path(__file__).resolve().with_name("default.yaml")
_LOCAL = Path("config/config.yaml")


def base_configs() -> list[Path]:
    """Return the configs that others are laid over.

    They are config/config.yaml of the working folder where it is complete, else the paper's, with that file over it. A
    file of that name which has none of a config's keys belongs to something else and is left alone.
    """
    if not _LOCAL.is_file() or _LOCAL.resolve() == PAPER.resolve():
        return [PAPER]
    held, keys = read_yaml(_LOCAL), set(Config.model_fields)
    if not isinstance(held, Mapping) or not keys & set(held):
        return [PAPER]
    return [_LOCAL] if keys <= set(held) else [PAPER, _LOCAL]
