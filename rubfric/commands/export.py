"""Friction for other programs: ``rubfric export`` writes that of a campaign for Abaqus, Ansys, as CSV or netCDF."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rubfric.decks.friction import FrictionPoint, write_abaqus, write_ansys
from rubfric.errors import InvalidInput
from rubfric.files import whole
from rubfric.outputs import check_output
from rubfric.rules import Integer

if TYPE_CHECKING:  # heavy
    import pandas as pd

_FORMATS = ("abaqus", "ansys", "csv", "netcdf")
# Speeds in a decade by default: straight lines between them are about 1 % off a curve of friction.
_PER_DECADE = 10
_EXAMPLE = """\
examples:
  rubfric export results --to abaqus -o friction.inp
  rubfric export results --to ansys --material 4 -o friction.mac
  rubfric export results --to csv --temperature 20
  rubfric export results/totals/soft/street/friction_total.csv --to netcdf -o friction.nc
  rubfric export results --to abaqus --per-decade 30 -o friction.inp

docs/export.md says what the files hold, and what codes do between and beyond the points.
"""
# What the first line of a file has that this command may write anew; netCDF files have the mark of HDF5.
_OURS = "Written by rubfric export"


def add_export(commands: Any) -> None:
    """Add the command ``export`` to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    """
    command = commands.add_parser(
        "export",
        help="write the friction of a campaign for Abaqus, Ansys, a spreadsheet, or as netCDF",
        description="Write the friction of the whole road over slip speed, pressure and temperature, with its errors.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    command.add_argument(
        "results", metavar="RESULTS", help="folder of a campaign's results, or a table: friction_total.csv"
    )
    command.add_argument("--to", choices=_FORMATS, required=True, help="what to write")
    command.add_argument("--temperature", type=float, metavar="T", help="take one of several temperatures, degC")
    command.add_argument(
        "--per-decade",
        type=int,
        metavar="N",
        help="add speeds until a decade has N, on a monotone curve over the logarithm of speed (default: 10 for Abaqus "
        "and Ansys, which interpolate linearly in speed; else 0, none)",
    )
    command.add_argument(
        "--material", type=int, metavar="N", help="number of the material of contact in Ansys (default: 1)"
    )
    command.add_argument("--output", "-o", type=Path, metavar="FILE", help="write to this file (default: print)")
    command.set_defaults(run=_export)


def _export(options: argparse.Namespace) -> int:
    decks = options.to in ("abaqus", "ansys")
    wanted = options.per_decade if options.per_decade is not None else _PER_DECADE if decks else 0
    per_decade = Integer(low=0, high=1000).check("--per-decade", wanted)
    if options.material is not None and options.to != "ansys":
        raise InvalidInput(f"--material numbers a material of Ansys: leave it out with --to {options.to}")
    material = Integer(low=1).check("--material", 1 if options.material is None else options.material)
    if options.output:
        check_output(options.output, "table", (_OURS, "HDF"))
    elif options.to == "netcdf":
        raise InvalidInput("--output is missing: netCDF cannot be printed")
    from rubfric.results.lookup import lookup_dataset, lookup_table, notes  # heavy
    from rubfric.results.totals_file import read_totals

    source = read_totals(options.results)
    if source.note:
        print(f"rubfric: {source.note}", file=sys.stderr)
    table = lookup_table(source.table, options.temperature, per_decade)
    if options.to == "netcdf":
        from rubfric.results.dataset import write

        write(lookup_dataset(table, source.about), options.output)
    else:
        about = [f"{_OURS}: friction of the whole road", *source.about, *notes(table)]
        if options.to == "csv":
            text = "".join(f"# {line}\n" for line in about) + table.to_csv(index=False, float_format="%.6g")
        elif options.to == "abaqus":
            text = write_abaqus(points(table), source.name, about)
        else:
            text = write_ansys(points(table), material, about)
        if not options.output:
            print(text, end="")
            return 0
        with whole(options.output) as part:
            part.write_text(text, encoding="utf-8")
    print(f"{len(table)} points written to {options.output}")
    return 0


def points(table: pd.DataFrame) -> list[FrictionPoint]:
    """Return the points of a lookup table as decks have them: friction below zero, within its error, as zero.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.lookup.lookup_table``.
    """
    found = []
    for row in table.to_dict("records"):
        friction = row["friction_total"]
        below = f"; {friction:.3g}, which its error allows, is written as 0" if friction < 0.0 else ""
        found.append(
            FrictionPoint(
                max(friction, 0.0),
                row["velocity_mm_per_s"],
                row["pressure_MPa"],
                row.get("temperature_degC"),
                f"+- {row['friction_total_error']:.2g}, {row['way']}{below}",
            )
        )
    return found
