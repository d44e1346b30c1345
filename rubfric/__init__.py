"""rubfric: friction of viscoelastic rubber sliding on rough roads, by finite elements and an energy method.

Three lines answer for one scene::

    import rubfric

    campaign = rubfric.load()
    result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=5))

and one for the friction of the whole road, on all cores::

    friction = campaign.run()

Names, ``rubfric.plot`` too, are imported when they are first used, so that ``import rubfric`` costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # for editors and type checkers, which do not run __getattr__
    from rubfric import plot as plot
    from rubfric.areal_simulation import simulate_areal
    from rubfric.config.campaign import Campaign, load
    from rubfric.errors import BrokenResult, InvalidInput, NotConverged, NotWritten, RubfricError
    from rubfric.marching import march
    from rubfric.results.dataset import write
    from rubfric.road.areal_scan import ScannedRoad
    from rubfric.road.areal_waves import ArealWaves
    from rubfric.road.self_affine import SelfAffine
    from rubfric.road.sine import SineScale
    from rubfric.road.waves import WaveRoad
    from rubfric.rubber.material import Material
    from rubfric.scene.areal import ArealNumerics, ArealScene
    from rubfric.scene.numerics import Numerics
    from rubfric.scene.procedure import Procedure
    from rubfric.scene.scene import Scene
    from rubfric.simulation import simulate
    from rubfric.studies.sensitivity.study import sensitivity
    from rubfric.total_simulation import friction, run

__version__ = "0.1.0"

_HOMES = {
    "ArealNumerics": "scene.areal",
    "ArealScene": "scene.areal",
    "ArealWaves": "road.areal_waves",
    "BrokenResult": "errors",
    "Campaign": "config.campaign",
    "InvalidInput": "errors",
    "Material": "rubber.material",
    "NotConverged": "errors",
    "NotWritten": "errors",
    "Numerics": "scene.numerics",
    "RubfricError": "errors",
    "Scene": "scene.scene",
    "Procedure": "scene.procedure",
    "ScannedRoad": "road.areal_scan",
    "SelfAffine": "road.self_affine",
    "SineScale": "road.sine",
    "WaveRoad": "road.waves",
    "friction": "total_simulation",
    "load": "config.campaign",
    "march": "marching",
    "run": "total_simulation",
    "sensitivity": "studies.sensitivity.study",
    "simulate": "simulation",
    "simulate_areal": "areal_simulation",
    "write": "results.dataset",
}

__all__ = [
    "ArealNumerics",
    "ArealScene",
    "ArealWaves",
    "BrokenResult",
    "Campaign",
    "InvalidInput",
    "Material",
    "NotConverged",
    "NotWritten",
    "Numerics",
    "Procedure",
    "RubfricError",
    "ScannedRoad",
    "Scene",
    "SelfAffine",
    "SineScale",
    "WaveRoad",
    "__version__",
    "friction",
    "load",
    "march",
    "run",
    "sensitivity",
    "simulate",
    "simulate_areal",
    "write",
]


def __getattr__(name: str) -> Any:
    if name == "plot":
        return import_module("rubfric.plot")
    if name not in _HOMES:
        raise AttributeError(f"module 'rubfric' has no attribute {name!r}")
    return getattr(import_module(f"rubfric.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return list(__all__)
