"""Accuracy against cost: one scene on a ladder of every knob, each rung compared with the scene's reference friction.

The knobs are turned one at a time, from the mesh of fineness 1 without further refinement:

- ``mesh``: nodes in contact, columns and rows together; ``surface`` the first two alone, ``rows`` and ``first_row``
  the grading towards the road;
- ``element``: in plane strain, dilatation point by point, or by its mean over each cell;
- ``kinematics``: small strain, finite strain, or what the scene needs;
- ``folding``: the share of the accuracy that leaving out Prony branches may use;
- ``tolerance`` of the solver in finite strain;
- ``steps`` per wavelength, marched in time from steady sliding; ``wavelengths`` pressed and slid;
- ``multiscale``, on scenes of the whole road: the way from its scales to the total (``rubfric.studies.accuracy.ways``);
- ``start``: a target accuracy, and the fineness of the first mesh from which it is reached: presets are chosen among
  these (``rubfric.studies.accuracy.presets``).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pandas as pd

from rubfric.errors import InvalidInput, NotConverged
from rubfric.marching import march
from rubfric.mechanics.march.result import Transient
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.scene.numerics import fineness
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve
from rubfric.studies.accuracy.converged import Converged, converge
from rubfric.studies.accuracy.cost import measure

# Target accuracies, and the fineness of the first meshes tried for each.
STARTS = {0.05: (0.25, 0.35, 0.5), 0.01: (0.35, 0.5, 0.7, 1.0), 0.002: (0.5, 0.7, 1.0, 1.4)}
_MESHES = (0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0)
_SURFACES = (0.25, 0.5, 1.0, 2.0)
_GROWTHS = (1.6, 1.4, 1.2, 1.1, 1.05)
_FIRST_ROWS = (4.0, 2.0, 1.0, 0.5)
_FOLDING = (1.0, 0.1, 0.01, 0.0)
_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-6, 1e-8)
_STEPS = (8, 16, 32, 64)
_WAVELENGTHS, _WAVELENGTH_STEPS = (1, 2, 4, 8), 32
# Marches are measured where at most this number of columns suffices, on half of them.
_MARCH_COLUMNS = 128
# Repetitions of a rung for its time: until this time is spent, s, or this number of times.
_SECONDS, _TIMES = 0.5, 3


@dataclass(frozen=True)
class Rung:
    """One setting of one knob.

    Attributes
    ----------
    knob, rung : str
        Names of the knob and of its setting.
    scene : Scene
        With that setting.
    """

    knob: str
    rung: str
    scene: Scene


def rungs(scene: Scene) -> Iterator[Rung]:
    """Yield every rung of every knob of steady sliding for a scene, each knob from coarse to fine."""
    base = dataclasses.replace(scene.numerics, **fineness(1.0), refinements=0)

    def rung(knob: str, name: str, kinematics: str = scene.kinematics, **numerics: Any) -> Rung:
        changed = dataclasses.replace(base, **numerics)
        return Rung(knob, name, dataclasses.replace(scene, kinematics=kinematics, numerics=changed))

    refinements = scene.numerics.refinements
    for accuracy, starts in STARTS.items():
        for start in starts:
            yield rung(
                "start", f"{accuracy:g} from {start:g}", accuracy=accuracy, refinements=refinements, **fineness(start)
            )
    for value in _MESHES:
        yield rung("mesh", f"{value:g}", **fineness(value))
    for value in _SURFACES:
        yield rung("surface", f"{value:g}", **fineness(value) | {"row_growth": base.row_growth})
    for value in _GROWTHS:
        yield rung("rows", f"{value:g}", row_growth=value)
    for value in _FIRST_ROWS:
        yield rung("first_row", f"{value:g}", first_row=value)
    for word in ("pointwise", "mean") if scene.plane == "strain" else ():  # nothing locks in plane stress
        yield rung("element", word, dilatation=word)
    for word in ("small", "auto", "finite"):
        yield rung("kinematics", word, kinematics=word)
    for value in _FOLDING:
        yield rung("folding", f"{value:g}", folding=value)
    for value in _TOLERANCES:
        yield rung("tolerance", f"{value:g}", tolerance=value)


def measure_ladder(name: str, scene: Scene) -> pd.DataFrame:
    """Measure every rung of a scene; whatever no knob turns is as in the numerics of the scene.

    Parameters
    ----------
    name : str
        What the scene is called in the table.
    scene : Scene

    Returns
    -------
    pandas.DataFrame
        Columns scene, velocity (mm/s), pressure (MPa), knob, rung, friction_coefficient, reference, reference_error
        (absolute), error and estimate (relative to the reference), seconds, iterations,
        krylov, memory_MB, columns, rows, meshes, kinematics, plane, note.
    """
    reference = converge(scene)
    measured: dict[Scene, dict[str, Any]] = {}  # several knobs share a rung
    found: list[dict[str, Any]] = []
    for rung in rungs(scene):
        if rung.scene not in measured:
            measured[rung.scene] = _steady(rung.scene)
        found.append({"knob": rung.knob, "rung": rung.rung} | measured[rung.scene])
    standard = next(row for row in found if (row["knob"], row["rung"]) == ("mesh", "1"))
    if standard.get("columns", math.inf) <= _MARCH_COLUMNS:  # none where it was refused
        found += _marches(scene, int(standard["columns"]) // 16 * 8)
    return gather(name, scene, reference, found)


def _steady(scene: Scene) -> dict[str, Any]:
    """Return the row of a scene; without its estimate in small strain, which is no error to the finite reference."""
    row = measure_steady(scene)
    if scene.kinematics == "small" and "estimate" in row:
        row |= {"estimate": float("nan"), "note": "estimates are to small strain where it is asked for"}
    return row


def measure_steady(scene: Scene) -> dict[str, Any]:
    """Return the friction of a scene, its estimated error (absolute) and its cost: a row of the ladder, or its note."""

    def compute() -> SteadySolution:
        solution = solve(scene)
        evaluate(solution)
        return solution

    try:
        cost = measure(compute, _SECONDS, _TIMES)
    except NotConverged as error:
        return {"note": str(error)}
    solution = cost.result
    return {
        "friction_coefficient": solution.friction.stress_power,
        "estimate": friction_error(solution),
        "seconds": cost.seconds,
        "iterations": solution.iterations,
        "krylov": solution.krylov,
        "memory_MB": cost.memory,
        "columns": solution.block.columns,
        "rows": solution.block.rows,
        "meshes": len(solution.meshes),
        "kinematics": solution.decision.kinematics,
        "note": "",
    }


def _marches(scene: Scene, columns: int) -> Iterator[dict[str, Any]]:
    """Yield the rungs of the knobs of marching: steps per wavelength, and wavelengths slid."""
    scene = dataclasses.replace(scene, numerics=dataclasses.replace(scene.numerics, **fineness(1.0)))
    for steps in _STEPS:
        procedure = Procedure(
            start="steady", columns=columns, steps_per_wavelength=steps, wavelengths=2, until_saturated=False
        )
        yield from _march("steps", {f"{steps}": 2}, scene, procedure)
    procedure = Procedure(
        columns=columns,
        steps_per_wavelength=_WAVELENGTH_STEPS,
        wavelengths=_WAVELENGTHS[-1],
        until_saturated=False,
    )
    yield from _march("wavelengths", {f"{number}": number for number in _WAVELENGTHS}, scene, procedure)


def _march(knob: str, slid: dict[str, int], scene: Scene, procedure: Procedure) -> Iterator[dict[str, Any]]:
    """Yield one rung for every number of wavelengths slid, from one march."""
    try:
        cost = measure(lambda: march(scene, procedure))
    except (InvalidInput, NotConverged) as error:
        yield from ({"knob": knob, "rung": rung, "note": str(error)} for rung in slid)
        return
    found: Transient = cost.result
    means = found.means()
    steps = len(found.records["time"])
    for rung, number in slid.items():
        done = steps - (procedure.wavelengths - number) * procedure.steps_per_wavelength
        yield {
            "knob": knob,
            "rung": rung,
            "friction_coefficient": float(means[number - 1]),
            "seconds": found.seconds * done / steps,
            "iterations": int(found.records["iterations"][:done].sum()),
            "krylov": int(found.records["krylov"][:done].sum()),
            "memory_MB": cost.memory,
            "columns": found.block.columns,
            "rows": found.block.rows,
            "kinematics": found.kinematics,
            "note": f"on a mesh of fineness 0.5; {procedure.steps_per_wavelength} steps per wavelength",
        }


COLUMNS = (
    *("scene", "velocity", "pressure", "knob", "rung", "friction_coefficient"),
    *("reference", "reference_error", "error", "estimate"),
    *("seconds", "iterations", "krylov", "memory_MB", "columns", "rows", "meshes", "kinematics", "plane"),
    "note",
)


def gather(name: str, scene: Scene, reference: Converged, found: list[dict[str, Any]]) -> pd.DataFrame:
    """Return measured rungs as a table with errors relative to the reference.

    Parameters
    ----------
    name, scene
        As for ``measure_ladder``.
    reference : Converged
    found : list of dict
        Of each rung: ``knob``, ``rung`` and what ``measure_steady`` returns.
    """
    table = pd.DataFrame(found).reindex(columns=list(COLUMNS))
    table["scene"], table["plane"] = name, scene.plane
    table["velocity"], table["pressure"] = scene.velocity, scene.pressure
    table["reference"], table["reference_error"] = reference.friction, reference.error
    table["error"] = (table["friction_coefficient"] - reference.friction).abs() / abs(reference.friction)
    table["estimate"] /= abs(reference.friction)
    table["note"] = table["note"].fillna("")
    return table
