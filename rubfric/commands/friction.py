"""The answer from the shell: ``rubfric friction`` of the whole road."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rubfric
from rubfric.checks import written
from rubfric.commands.configs import add_configs, warn
from rubfric.commands.lists import add_points
from rubfric.commands.tables import aligned, with_nulls
from rubfric.config import campaign as campaigns
from rubfric.config.pairs import never_covered
from rubfric.config.plausibility import check_plausible
from rubfric.config.temperature import rubber_at

if TYPE_CHECKING:  # heavy
    import pandas as pd

    from rubfric.config.campaign import Campaign

_EXAMPLE = """\
examples:
  rubfric friction --config mine.yaml
  rubfric friction --config mine.yaml --velocity 1,10,100 --pressure 0.2,1
  rubfric friction --config mine.yaml --velocity 100 --pressure 0.3 --temperature 0,20,60 --csv > friction.csv

Speeds, pressures and temperatures are those of the config's grid by default. Scenes are solved side by side, and kept
in the folder .cache of the config's results: what is known there, or from snakemake, is not solved again.
"""
# Columns of the table that are printed, and their headings.
_AXES = {"velocity_mm_per_s": "mm/s", "pressure_MPa": "MPa", "temperature_degC": "degC"}
_NUMBERS = {
    "friction_total": "friction",
    "friction_total_error": "error",
    "friction_numerical_error": "numerics",
    "friction_coupling_error": "coupling",
    "friction_road_error": "road",
    "friction_rubber_error": "rubber",
}
_SCALE = "friction_scale_"


def add_friction(commands: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    """Add the command ``friction`` to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    configs : callable
        Returns the configs to lay over one another, given those of ``--config``.
    """
    command = commands.add_parser(
        "friction",
        help="print the friction of the whole road over speed and pressure, with its errors",
        description="Print the friction of the whole road, what its error is made of, and every scale's share.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_configs(command)
    add_points(command, "velocity", "pressure", "temperature", default="the grid's")
    form = command.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print JSON, for scripts")
    form.add_argument("--csv", action="store_true", help="print CSV with the columns of tables/friction_total.csv")
    command.add_argument(
        "--jobs", "-j", type=int, metavar="N", help="scenes to solve at a time (default: as many as there are cores)"
    )
    command.add_argument("--quiet", "-q", action="store_true", help="do not say how far it is")
    command.set_defaults(run=_friction, configs=configs)


def _friction(options: argparse.Namespace) -> int:
    campaign = campaigns.load(*options.configs(options.config or []))
    points = [getattr(options, name) for name in ("velocity", "pressure", "temperature")]
    from rubfric.total_simulation import at_points, friction  # heavy: only once the config is known to be right

    asked = at_points(campaign, *points)
    warm = {one: rubber_at(asked.material, asked.shift, one) for one in asked.temperatures}
    warn(campaign, check_plausible(asked.material, asked.road, asked.velocities, asked.pressures, warm))
    table = friction(asked, jobs=options.jobs, progress=not options.quiet)
    if options.csv:
        print(table.to_csv(index=False, float_format="%.6g"), end="")
    else:
        print(as_json(asked, table) if options.json else as_text(asked, table))
    return 0


def as_text(campaign: Campaign, table: pd.DataFrame) -> str:
    """Return a table of totals as it is printed.

    Parameters
    ----------
    campaign : Campaign
        On the grid of the table.
    table : pandas.DataFrame
        As from ``rubfric.total_simulation.friction``.
    """
    shares = _shares(table)
    heads = {name: head for name, head in (_AXES | _NUMBERS).items() if name in table and table[name].notna().any()}
    rows = [[*heads.values(), "way", *(f"scale {name.removeprefix(_SCALE)}" for name in shares)]]
    for (_, row), share in zip(table.iterrows(), shares.to_numpy(), strict=True):
        cells = [written(row[name]) if name in _AXES else _number(row[name]) for name in heads]
        rows.append([*cells, row["way"], *("-" if math.isnan(one) else f"{one:.1%}" for one in share)])
    notes = table.loc[table["note"] != "", ["way", "note"]].value_counts(sort=False)
    about = [f"{way}, {count} of {len(table)} points: {note}" for (way, note), count in notes.items()]
    if warned := int((table["warnings"] > 0).sum()):
        about.append(f"{warned} of {len(table)} points rest on scenes that carry a warning: column warnings of --csv")
    return "\n".join(
        [
            campaign.words(),
            "",
            *aligned(rows),
            "",
            *about,
            "error: absolute, the sum of the parts beside it; scale 1, ...: shares of the sum over the scales",
            f"no error covers: {'; '.join(never_covered(campaign))}",
        ]
    )


def _shares(table: pd.DataFrame) -> pd.DataFrame:
    """Return every scale's share of the sum over the scales; NaN where that is zero or not known."""
    total = table["friction_sum"]
    return table.filter(regex=f"^{_SCALE}").div(total.where(total != 0.0), axis=0)


def _number(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.4g}"


def as_json(campaign: Campaign, table: pd.DataFrame) -> str:
    """Return a table of totals as JSON: what it is of, and a row for each point, with null for what is not known.

    Parameters
    ----------
    campaign : Campaign
        On the grid of the table.
    table : pandas.DataFrame
        As from ``rubfric.total_simulation.friction``.
    """
    rows = [
        with_nulls(row) | {"shares": [*with_nulls(share).values()]}
        for row, share in zip(table.to_dict("records"), _shares(table).to_dict("records"), strict=True)
    ]
    about = {
        "program": f"rubfric {rubfric.__version__}",
        "rubber": campaign.material.name,
        "road": campaign.road_name,
        "plane": campaign.plane,
        "kinematics": campaign.kinematics,
        "multiscale": campaign.multiscale.way,
        "not_covered": never_covered(campaign),
    }
    return json.dumps(about | {"rows": rows}, indent=2)
