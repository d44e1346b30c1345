"""How much each number of rubber, road, block and load moves the friction of a scene: ``rubfric.sensitivity``."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import pandas as pd

from rubfric.checks import suggestion
from rubfric.config.campaign import Campaign
from rubfric.errors import InvalidInput, NotConverged
from rubfric.rubber.shift import ShiftedRubber
from rubfric.rules import Integer, Number
from rubfric.scene.scene import ALL, Scene
from rubfric.studies.sensitivity.differences import Base, Difference, difference, errors, solved
from rubfric.studies.sensitivity.parameters import Parameter, parameters
from rubfric.studies.sensitivity.result import Sensitivities, identities
from rubfric.studies.sensitivity.sharing import shared
from rubfric.studies.sensitivity.sobol import indices
from rubfric.total_simulation import at_points

# By how much a parameter is changed where nothing else is asked for.
CHANGE = 0.1


def sensitivity(
    campaign: Campaign,
    velocity: float | None = None,
    pressure: float | None = None,
    temperature: float | None = None,
    scale: int | str = ALL,
    *,
    change: float = CHANGE,
    only: Sequence[str] = (),
    sobol: int = 0,
    preset: str | None = None,
    accuracy: float | None = None,
    progress: Callable[[str], None] = lambda line: None,
    jobs: int | None = None,
) -> Sensitivities:
    """Return by how much each number of rubber, road, block and load moves friction at one speed and pressure.

    Parameters
    ----------
    campaign : Campaign
        As from ``rubfric.load``.
    velocity : float, optional
        mm/s; by default that in the middle of the grid, as for the pressure.
    pressure : float, optional
        MPa.
    temperature : float, optional
        degC, of a rubber with shift factors; then it is a parameter too.
    scale : int or "all"
        One scale of the road, or all at once: the first of several draws or windows.
    change : float
        By how much a parameter is changed, relative; temperature by 10 times as many kelvin, and 1 - 2 nu of
        Poisson's ratio.
    only : sequence of str
        Symbols of parameters; all by default.
    sobol : int
        N, a power of 2, for Sobol' indices from N (parameters + 2) more scenes; 0 for none.
    preset : str, optional
        One of the config's presets; by default that of the whole road, or the config's numerics for a scale.
    accuracy : float, optional
        Relative accuracy of friction, instead of that of the preset.
    progress : callable, optional
        Takes lines on what is done and what it costs.
    jobs : int, optional
        Most processes to share long work among; as many as there are cores by default.

    Raises
    ------
    InvalidInput
        For what the campaign has not, and where friction is zero within its error.
    NotConverged
        Where the scene itself has no solution; a changed one without leaves a note in the table.

    Examples
    --------
    >>> import rubfric
    >>> found = rubfric.sensitivity(rubfric.load({"kinematics": "small"}), 100, 0.5, scale=1, only=["p", "E"])
    >>> found.table.set_index("parameter")["sensitivity"].round(1).to_dict()
    {'E': -0.3, 'p': 0.3}
    """
    change = Number(low=0.001, high=0.3).check("change", change)
    if sobol:
        sobol = Integer(low=8, high=2**16).check("sobol", sobol)
        if sobol & (sobol - 1):
            raise InvalidInput(f"sobol is {sobol}, but must be a power of 2: {2 ** (sobol.bit_length() - 1)} for one")
    scene = scene_of(campaign, velocity, pressure, temperature, scale, preset, accuracy)
    rubber = ShiftedRubber(campaign.material, campaign.shift) if campaign.shift else None
    chosen = _chosen(parameters(scene, rubber), only)
    base = solved(scene)
    fine, coarse = base.cells
    named = "1 parameter" if len(chosen) == 1 else f"{len(chosen)} parameters"
    counted = f"{named}: {2 * len(chosen)} scenes on {fine:,} cells, {4 * len(chosen)} on {coarse:,}"
    progress(counted + (f", and {sobol * (len(chosen) + 2)} for Sobol' indices" if sobol else ""))
    found, notes = _differences(base, chosen, math.log1p(change), progress, jobs)
    table = _table(base, chosen, found, notes)
    indexed: pd.DataFrame | None = None
    said: list[str] = []
    if scale == ALL and len(campaign.whole_roads) > 1:
        said.append(f"of the first of {len(campaign.whole_roads)} roads: draws of phases, or windows of a profile")
    if sobol:
        moving = [one for one in chosen if one.name in found]
        indexed, stood_in = indices(base, moving, [*found.values()], change, sobol, progress=progress, jobs=jobs)
        said += stood_in
    return Sensitivities(
        base.scene,
        base.friction,
        base.error,
        base.fine.decision.kinematics,
        change,
        table,
        () if only else identities(table),
        indexed,
        tuple(said),
    )


def scene_of(
    campaign: Campaign,
    velocity: float | None,
    pressure: float | None,
    temperature: float | None,
    scale: int | str,
    preset: str | None,
    accuracy: float | None,
) -> Scene:
    """Return the scene whose sensitivities are asked for: arguments as those of ``sensitivity``.

    Raises
    ------
    InvalidInput
    """
    speeds, loads = campaign.velocities, campaign.pressures
    velocity = speeds[(len(speeds) - 1) // 2] if velocity is None else velocity
    pressure = loads[(len(loads) - 1) // 2] if pressure is None else pressure
    warm = None if temperature is None else [temperature]
    if scale != ALL:
        return campaign.scene(scale, velocity, pressure, preset=preset, accuracy=accuracy, temperature=temperature)
    asked = at_points(campaign, [velocity], [pressure], warm)
    preset = preset or campaign.multiscale.preset
    plain = asked.scene(ALL, velocity, pressure, preset=preset, accuracy=accuracy, temperature=temperature)
    first = next(iter(asked.whole_scenes().values()), plain)
    return replace(plain, road=first.road, aspect=first.aspect)


def _chosen(known: Sequence[Parameter], only: Sequence[str]) -> list[Parameter]:
    names = [one.name for one in known]
    for name in only:
        if name not in names:
            raise InvalidInput(
                f"the parameter {name!r} is unknown; this scene has {', '.join(names)}{suggestion(name, names)}"
            )
    return [one for one in known if not only or one.name in only]


class _Task(NamedTuple):
    """A derivative to be found, perhaps in another process."""

    base: Base
    parameter: Parameter
    step: float


def _differences(
    base: Base,
    chosen: Sequence[Parameter],
    step: float,
    progress: Callable[[str], None],
    jobs: int | None,
) -> tuple[dict[str, Difference], dict[str, str]]:
    """Return the derivatives along all parameters, and why there is none along some.

    What would take long is shared among workers.
    """
    tasks = [_Task(base, one, step) for one in chosen]
    names = [one.name for one in chosen]
    answers: dict[str, Difference | str] = {}
    began = time.monotonic()
    for place, answer in shared(_answer, tasks, jobs, names):
        answers[names[place]] = answer
        count = len(answers)
        left = (time.monotonic() - began) / count * (len(tasks) - count)
        progress(f"solved {6 * count} of {6 * len(tasks)} scenes, {names[place]}; about {left:.0f} s left")
    in_order = {name: answers[name] for name in names}
    found = {name: answer for name, answer in in_order.items() if isinstance(answer, Difference)}
    return found, {name: answer for name, answer in in_order.items() if isinstance(answer, str)}


def _answer(task: _Task) -> Difference | str:
    """Return a derivative, or why there is none."""
    one = task.parameter
    try:
        if one.value == 0.0 and one.at(0.0, task.step) == 0.0:
            raise InvalidInput(f"{one.name} is 0: no share of it makes a change")
        return difference(task.base, one, task.step)
    except (InvalidInput, NotConverged) as reason:
        return str(reason)


def _table(
    base: Base, chosen: Sequence[Parameter], found: Mapping[str, Difference], notes: Mapping[str, str]
) -> pd.DataFrame:
    known = list(found.values())
    error = dict(zip(found, errors(base, known), strict=True)) if known else {}
    rows = []
    for one in chosen:
        row: dict[str, Any] = {"parameter": one.name, "words": one.words, "unit": one.unit, "value": one.value}
        of = found.get(one.name)
        row |= {
            "sensitivity": of.derivative / one.slope if of else math.nan,
            "sensitivity_error": error[one.name] / one.slope if of else math.nan,
            "changed_to": one.at(one.value, of.step) if of else math.nan,
            "friction_change": math.expm1(of.raised) if of else math.nan,
            "friction_change_error": math.exp(of.raised) * of.step * error[one.name] if of else math.nan,
            "note": notes.get(one.name, ""),
        }
        row["sensitivity_error"] = abs(row["sensitivity_error"])
        rows.append(row)
    return pd.DataFrame(rows).sort_values("friction_change", key=abs, ascending=False, ignore_index=True)
