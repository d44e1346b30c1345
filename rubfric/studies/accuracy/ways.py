"""The ways from scales to the total against their cost: the knob ``multiscale``, on scenes of the whole road.

Each total is compared with the converged friction of all waves at once, and has the whole of its estimated error. A
total of single scales costs their scenes and the estimate of their coupling, without which nothing of its error is
known; the direct one costs one scene.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import pandas as pd

from rubfric.errors import NotConverged
from rubfric.mechanics.theory.coupling import WAYS, Coupling, estimate
from rubfric.road.sine import SineScale
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy.converged import converge
from rubfric.studies.accuracy.cost import measure
from rubfric.studies.accuracy.ladder import gather, measure_steady

KNOB, DIRECT = "multiscale", "direct"
# Of the scenes of single scales: added up, and the most of them.
_ADDED, _MOST = (
    ("friction_coefficient", "estimate", "seconds", "iterations", "krylov"),
    ("memory_MB", "columns", "rows"),
)


def single_scales(scene: Scene) -> list[Scene]:
    """Return the scenes of the scales of a whole road, each on a block as high in its own wavelengths."""
    waves = scene.road.waves
    sines = zip(waves.amplitudes.tolist(), waves.wavenumbers.tolist(), strict=True)
    return [dataclasses.replace(scene, scale=number, road=SineScale(*sine)) for number, sine in enumerate(sines, 1)]


def measure_ways(name: str, scene: Scene) -> pd.DataFrame:
    """Measure the total of a whole road by every way, its numerics as in the scene.

    Parameters
    ----------
    name : str
        What the scene is called in the table.
    scene : Scene
        Of all scales.

    Returns
    -------
    pandas.DataFrame
        As from ``rubfric.studies.accuracy.ladder.measure_ladder``. The columns and rows of a total of single scales
        are the most of any of them; its ``estimate`` adds their errors and what their coupling may change.
    """
    reference = converge(scene)
    singles = [measure_steady(single) for single in single_scales(scene)]
    try:
        cost = measure(lambda: _coupling(scene))
    except NotConverged as error:
        models = [{"note": str(error)}] * len(WAYS)
    else:
        models = [_total(singles, way, cost.result, cost.seconds) for way in WAYS]
    rows = [*zip(WAYS, models, strict=True), (DIRECT, measure_steady(scene))]
    return gather(name, scene, reference, [{"knob": KNOB, "rung": way} | row for way, row in rows])


def _coupling(scene: Scene) -> Coupling:
    """Estimate the coupling anew, whatever is cached."""
    about = (scene.velocity, scene.pressure, scene.height, scene.plane, scene.kinematics)
    return estimate.__wrapped__(scene.material, scene.road, *about)


def _total(singles: list[dict[str, Any]], way: str, coupling: Coupling, seconds: float) -> dict[str, Any]:
    """Return the row of a total of single scales; only the reason where one of them was refused."""
    refused = [row["note"] for row in singles if "friction_coefficient" not in row]
    if refused:
        return {"note": "; ".join(refused)}
    added = {name: sum(row[name] for row in singles) for name in _ADDED}
    total = coupling.total(way, added["friction_coefficient"])
    share = total / added["friction_coefficient"] if added["friction_coefficient"] else 1.0
    return (
        added
        | {name: max(row[name] for row in singles) for name in _MOST}
        | {"friction_coefficient": total, "seconds": added["seconds"] + seconds}
        | {"estimate": abs(share) * added["estimate"] + coupling.error(way) * abs(total)}
        | {"kinematics": " and ".join(sorted({row["kinematics"] for row in singles}))}
    )
