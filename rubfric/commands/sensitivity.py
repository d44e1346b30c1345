"""What to change in compound, road or load: ``rubfric sensitivity`` of the whole road or one of its scales."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rubfric
from rubfric.checks import decimals
from rubfric.commands.configs import add_configs, warn
from rubfric.commands.lists import add_points
from rubfric.commands.tables import aligned, with_nulls
from rubfric.config import campaign as campaigns
from rubfric.config.plausibility import check_plausible
from rubfric.errors import InvalidInput
from rubfric.rules import Number
from rubfric.scene.scene import ALL

if TYPE_CHECKING:  # heavy
    import pandas as pd

    from rubfric.studies.sensitivity.result import Sensitivities

_EXAMPLE = """\
examples:
  rubfric sensitivity --config mine.yaml
  rubfric sensitivity --config mine.yaml --velocity 1,10,100 --pressure 0.3 --csv > sensitivity.csv
  rubfric sensitivity --scale 1 --velocity 100 --pressure 0.5 --only E,tau_2,g_2
  rubfric sensitivity --scale 1 --kinematics small --sobol 256
  rubfric sensitivity --velocity 100 --pressure 0.5 -o tornado.pdf -o tornado.png

The speed and pressure are by default those in the middle of the config's grid. docs/sensitivity.md says what is held
while a number is changed, and what the errors cover.
"""


def add_sensitivity(commands: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    """Add the command ``sensitivity`` to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    configs : callable
        Returns the configs to lay over one another, given those of ``--config``.
    """
    command = commands.add_parser(
        "sensitivity",
        help="print how much each number of rubber, road, block and load moves friction",
        description="Print how much each number of rubber, road, block and load moves friction, the largest first.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_configs(command)
    add_points(command, "velocity", "pressure", default="the middle")
    command.add_argument("--temperature", type=float, metavar="T", help="of a rubber with shift factors, degC")
    command.add_argument(
        "--scale", default=ALL, metavar="N", help="scale of the road, 1 being the coarsest (default: all at once)"
    )
    command.add_argument(
        "--range", default="10%", metavar="R", help="by how much each number is changed, 0.1%% to 30%% (default: 10%%)"
    )
    command.add_argument("--only", metavar="X,...", help="only these: E,nu,g_1,tau_1,a_1,lambda,aspect,p,v,T")
    command.add_argument(
        "--sobol", type=int, default=0, metavar="N", help="Sobol' indices too, of N (parameters + 2) scenes; 64, say"
    )
    command.add_argument("--kinematics", help="small or finite strain, or auto (default: the config's)")
    command.add_argument("--preset", metavar="NAME", help="one of the config's presets")
    command.add_argument("--accuracy", type=float, metavar="A", help="relative accuracy of friction, 0.01 say")
    command.add_argument(
        "--output", "-o", action="append", type=Path, metavar="FILE", help="draw them, .pdf or .png; may be given again"
    )
    form = command.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print JSON, for scripts")
    form.add_argument("--csv", action="store_true", help="print CSV, a row for each number, speed and pressure")
    command.set_defaults(run=_sensitivity, configs=configs)


def _sensitivity(options: argparse.Namespace) -> int:
    given = [
        *options.configs(options.config or []),
        *([{"kinematics": options.kinematics}] if options.kinematics else []),
    ]
    campaign = campaigns.load(*given)
    if options.scale != ALL and not options.scale.isdecimal():
        raise InvalidInput(f"--scale is {options.scale!r}, but must be the number of a scale, or {ALL}")
    scale = ALL if options.scale == ALL else int(options.scale)
    speeds: list[Any] = [Number(unit="mm/s").check("velocity", one) for one in options.velocity or ()]
    loads: list[Any] = [Number(unit="MPa").check("pressure", one) for one in options.pressure or ()]
    points = list(product(speeds or [None], loads or [None]))
    change = _share(options.range)
    if options.only == "":
        raise InvalidInput("--only is empty, but must name numbers with commas between, E,g_1 say")
    if options.output and len(points) > 1:
        raise InvalidInput(f"--output draws one speed and pressure, but {len(points)} are given: leave one")
    for path in options.output or []:
        if path.suffix not in (".pdf", ".png"):
            raise InvalidInput(f"--output is {path}, but its name must end in .pdf or .png")
    grid = speeds or campaign.velocities, loads or campaign.pressures
    warn(campaign, check_plausible(campaign.material, campaign.road, *grid))
    from rubfric.studies.sensitivity.study import sensitivity  # heavy: only once the config is known to be right

    found = [
        sensitivity(
            campaign,
            velocity,
            pressure,
            options.temperature,
            scale,
            change=change,
            only=options.only.split(",") if options.only else (),
            sobol=options.sobol,
            preset=options.preset,
            accuracy=options.accuracy,
            progress=lambda line: print(f"rubfric: {line}", file=sys.stderr, flush=True),
        )
        for velocity, pressure in points
    ]
    if options.csv:
        print(as_csv(found), end="")
    else:
        print(as_json(found) if options.json else "\n\n".join(as_text(one) for one in found))
    if options.output:
        from rubfric.figures.sensitivity import draw
        from rubfric.figures.style import save

        save(draw(found[0].table, found[0].change, found[0].title), *options.output)
        print(f"rubfric: drawn to {', '.join(map(str, options.output))}", file=sys.stderr)
    return 0


def _share(text: str) -> float:
    try:
        share = float(text.removesuffix("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        raise InvalidInput(f"--range is {text!r}, but must be a share, 10% or 0.1 say") from None
    return Number(low=0.001, high=0.3).check("--range", share)


def as_text(found: Sensitivities) -> str:
    """Return sensitivities as they are printed: a table, sentences, and what the sums say."""
    share = f"{100.0 * found.change:g} %"
    held = "instantaneous" if found.scene.material.moduli == "instantaneous" else "long-term"
    head = [
        f"Rubber {found.scene.material.name}, {found.title} ({found.kinematics} strain)",
        f"g_i: modulus of the branch; the {held} modulus is held, and {_others(held)}",
        *found.notes,
    ]
    sums = [f"{one.sum} = {one.residual:.2g} ± {one.error:.1g}, exactly 0: {one.why}" for one in found.identities]
    noted = found.table[found.table["note"] != ""].to_dict("records")
    refused = [f"{row['parameter']} has no sensitivity: {row['note']}" for row in noted]
    parts = [head, _columns(found.table, share), found.sentences(), sums, refused]
    if found.sobol is not None:
        about = f"Sobol' indices within ± {share} of every number, first and total order, with 95 % intervals:"
        parts.append([about, *_indices(found.sobol)])
    return "\n\n".join("\n".join(part) for part in parts if part)


def _others(held: str) -> str:
    return "the moduli of the other branches" if held == "long-term" else "the ratios of the others to one another"


def _columns(table: pd.DataFrame, share: str) -> list[str]:
    from rubfric.studies.sensitivity.result import signed

    rows = [["x", "value", "unit", "d ln mu / d ln x", "error", "changed to", f"friction, {share} more"]]
    for row in table.to_dict("records"):
        sensitivity, change = _with_error(row["sensitivity"], row["sensitivity_error"]), row["friction_change"]
        error = row["friction_change_error"]
        size = "-" if math.isnan(change) else signed(change, error)
        there = "-" if math.isnan(row["changed_to"]) else f"{row['changed_to']:.4g}"
        rows.append([row["parameter"], f"{row['value']:.4g}", row["unit"], *sensitivity, there, size])
    return aligned(rows)


def _indices(table: pd.DataFrame) -> list[str]:
    rows = []
    for row in table.to_dict("records"):
        cells = (
            f"{row[name]:.3f} ({row[f'{name}_low']:.3f} to {row[f'{name}_high']:.3f})"
            for name in ("first_order", "total_order")
        )
        rows.append([row["parameter"], *cells])
    return aligned(rows)


def _with_error(value: float, error: float) -> tuple[str, str]:
    if math.isnan(value):
        return "-", "-"
    places = min(max(0, decimals(error, 2)), 6) if 0.0 < error < math.inf else 3
    return f"{value:+.{places}f}", f"{error:.{places}f}"


def _point(found: Sensitivities) -> dict[str, Any]:
    scene = found.scene
    warm = {} if scene.temperature is None else {"temperature_degC": scene.temperature}
    return {"scale": scene.scale, "velocity_mm_per_s": scene.velocity, "pressure_MPa": scene.pressure} | warm


def as_json(found: list[Sensitivities]) -> str:
    """Return sensitivities as JSON, with null for what is not known."""
    points = [
        _point(one)
        | {
            "friction": one.friction,
            "friction_error": one.friction_error,
            "kinematics": one.kinematics,
            "change": one.change,
            "rows": [with_nulls(row) for row in one.table.to_dict("records")],
            "identities": [vars(identity) for identity in one.identities],
            "sobol": None if one.sobol is None else [with_nulls(row) for row in one.sobol.to_dict("records")],
            "notes": [*one.notes],
            "sentences": one.sentences(),
        }
        for one in found
    ]
    about = {"program": f"rubfric {rubfric.__version__}", "rubber": found[0].scene.material.name}
    return json.dumps(about | {"held": found[0].scene.material.moduli, "points": points}, indent=2)


def as_csv(found: list[Sensitivities]) -> str:
    """Return sensitivities as CSV: a row for each number of each speed and pressure, Sobol' indices beside it."""
    import pandas as pd

    parts = []
    for one in found:
        table = one.table if one.sobol is None else one.table.merge(one.sobol, on="parameter", how="left")
        for place, (name, value) in enumerate((_point(one) | {"friction": one.friction}).items()):
            table.insert(place, name, value) if name not in table else None
        parts.append(table)
    return str(pd.concat(parts).to_csv(index=False, float_format="%.6g"))
