"""rubfric: friction of viscoelastic rubber sliding on rough roads, by finite elements and an energy method.

Three lines answer for one scene::

    import rubfric

    campaign = rubfric.load("config/config.yaml")
    result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=5))

Names are imported when they are first used, so that ``import rubfric`` costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "BrokenResult": "errors",
    "Campaign": "config.campaign",
    "InvalidInput": "errors",
    "Material": "rubber.material",
    "NotConverged": "errors",
    "Numerics": "scene.numerics",
    "RubfricError": "errors",
    "Scene": "scene.scene",
    "SineScale": "road.sine",
    "Procedure": "scene.procedure",
    "load": "config.campaign",
    "march": "marching",
    "simulate": "simulation",
    "write": "results.dataset",
}

__all__ = ["__version__", *sorted(_HOMES)]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'rubfric' has no attribute {name!r}")
    return getattr(import_module(f"rubfric.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return list(__all__)
