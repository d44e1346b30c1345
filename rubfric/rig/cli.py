"""The test rig from the shell: ``rubfric rig reduce``, measured runs, and ``rubfric rig simulate``, a virtual one."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rubfric.config import campaign as campaigns
from rubfric.config.plausibility import check_area
from rubfric.config.rig import TRACTIONS, RigChoice, VirtualRig
from rubfric.errors import InvalidInput

_REDUCE = """\
examples:
  rubfric rig reduce run.csv --area 100
  rubfric rig reduce run1.csv run2.csv --columns rig.yaml --output points.csv --rejected rejected.csv

run.csv holds time, normal force, traction and displacement, with units in the headings. rig.yaml may say:
  columns: {time: Zeit, normal: Fz, traction: Fx, displacement: Weg}   # where they are not recognised
  units: {time: s, normal: kN, traction: N, displacement: mm}          # where the headings do not say
  area: 100                  # nominal area of the rubber, mm²
  normal: 50                 # N, where the load is a known weight and no column
  traction: rope             # sensor in the rope instead of at the rubber; then also
  sled_mass: 5               # kg
  bearing: {force: 0.5, coefficient: 0.005}   # N, and per normal force; or {file: unloaded.csv}
  tare: {from: 0, to: 1}     # s; or auto, none, or {normal: 1.2, traction: -0.3} in N
docs/rig.md has the rest.
"""
_SIMULATE = """\
examples:
  rubfric rig simulate --pressure 0.5 --weight 3 --output run.csv
  rubfric rig simulate --pressure 0.5 --speed 100 --output run.csv

Friction is that of the campaign's results, interpolated. The file says above its headings that it is simulated.
"""
# option of `simulate`: what it is; each replaces the config's rig.virtual.
_VIRTUAL = {
    "area": "nominal area of the rubber, mm²",
    "sled_mass": "mass of the sled, kg",
    "heaviest_weight": "heaviest weight that --speed may take, kg",
    "travel": "travel of the sled, mm",
    "bearing_force": "drag of the bearings, N",
    "bearing_coefficient": "drag of the bearings per normal force",
    "force_noise": "standard deviation of the noise of both forces, N",
    "displacement_noise": "standard deviation of the noise of the displacement, mm",
    "displacement_step": "step of the readings of the displacement, mm",
    "sampling": "samples per second, Hz",
}


def add_rig(commands: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    """Add the command ``rig`` with its own commands to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    configs : callable
        Returns the configs to lay over one another, given those of ``--config``.
    """
    rig = commands.add_parser(
        "rig",
        help="reduce measured runs of a test rig, or simulate one",
        description="Friction from measured runs of a test rig, and runs of a virtual one.",
    )
    own = rig.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_reduce(own)
    _add_simulate(own, configs)


def _add_reduce(own: Any) -> None:
    reduce = own.add_parser(
        "reduce",
        help="turn measured runs into friction over speed and pressure",
        description="Turn measured runs into points of friction over speed and pressure, with 95 % confidence.",
        epilog=_REDUCE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    reduce.add_argument("files", nargs="+", metavar="FILE", help="table of one run as text (CSV)")
    reduce.add_argument("--columns", metavar="YAML", help="what the columns are, and more; see below")
    reduce.add_argument(
        "--area", type=float, metavar="A", help="nominal area of the rubber, mm² (instead of the YAML's)"
    )
    reduce.add_argument(
        "--traction",
        choices=TRACTIONS,
        help="where the sensor of traction sits (instead of the YAML's; default: rubber)",
    )
    reduce.add_argument(
        "--normal", type=float, metavar="F", help="known constant normal force, N (instead of the YAML's)"
    )
    reduce.add_argument("--sled-mass", type=float, metavar="M", help="mass of the sled, kg (instead of the YAML's)")
    reduce.add_argument("--output", "-o", type=Path, metavar="FILE", help="write the points to this CSV file")
    reduce.add_argument("--rejected", type=Path, metavar="FILE", help="write the rejected windows to this CSV file")
    reduce.set_defaults(run=_reduce)


def _add_simulate(own: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    simulate = own.add_parser(
        "simulate",
        help="simulate a run of a virtual rig",
        description="Simulate the sled under a hanging weight, and what the sensors of the rig would record.",
        epilog=_SIMULATE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    simulate.add_argument("--pressure", type=float, required=True, metavar="P", help="nominal pressure, MPa")
    pulled = simulate.add_mutually_exclusive_group(required=True)
    pulled.add_argument("--weight", type=float, metavar="M", help="weight on the rope, kg")
    pulled.add_argument("--speed", type=float, metavar="V", help="speed to reach, mm/s: the program chooses the weight")
    simulate.add_argument("--output", "-o", type=Path, required=True, metavar="FILE", help="CSV file to write")
    simulate.add_argument("--scale", type=int, help="friction of this scale of the road alone (default: their sum)")
    simulate.add_argument(
        "--temperature",
        type=float,
        metavar="T",
        help="of the rubber, degC, out of the campaign's (default: the config's)",
    )
    simulate.add_argument(
        "--campaign",
        type=Path,
        metavar="FILE",
        help="results to take friction from (default: campaign.nc of the config)",
    )
    simulate.add_argument(
        "--config", action="append", type=Path, metavar="FILE", help="YAML config to lay over config/config.yaml"
    )
    simulate.add_argument(
        "--traction", choices=TRACTIONS, help="where the sensor of traction sits (default: the config's)"
    )
    for name, what in _VIRTUAL.items():
        flag = f"--{name.replace('_', '-')}"
        simulate.add_argument(flag, type=float, metavar="X", help=f"{what} (default: the config's)")
    simulate.add_argument("--seed", type=int, help="seed of the noise (default: the config's)")
    simulate.set_defaults(run=_simulate, configs=configs)


def _reduce(options: argparse.Namespace) -> int:
    from rubfric.results.tables import write_table
    from rubfric.rig.reduction import point_table, reduce_files, rejected_table
    from rubfric.rig.settings import read_settings
    from rubfric.rig.summary import summary

    above = {"area": options.area, "traction": options.traction, "sled_mass": options.sled_mass}
    above["normal"] = options.normal
    runs = reduce_files(options.files, read_settings(options.columns, **above))
    print(summary(runs))
    for path, table in ((options.output, point_table), (options.rejected, rejected_table)):
        if path:
            write_table(table(runs), path)
            print(f"\nWritten to {path}")
    return 0


def _simulate(options: argparse.Namespace) -> int:
    campaign = campaigns.load(*options.configs(options.config or []))
    virtual = _virtual((campaign.rig or RigChoice()).virtual, options)
    from rubfric.results.campaign import read
    from rubfric.results.friction_map import FrictionMap
    from rubfric.results.scales import WORDS
    from rubfric.results.tables import read_table
    from rubfric.results.temperature import rows_at
    from rubfric.rig.virtual import simulate

    warm = campaign.figures.temperature if options.temperature is None else options.temperature
    results = options.campaign or Path(campaign.results) / "campaign.nc"
    totals = results.parent / "tables" / "friction_total.csv"
    needed = totals if options.scale is None else results
    if not needed.is_file():
        raise FileNotFoundError(f"there is no {needed}: run snakemake first, or give --campaign FILE")
    if options.scale is None:
        friction = FrictionMap.from_totals(rows_at(read_table(totals, WORDS, signed=False), warm))
    else:
        friction = FrictionMap.from_campaign(read(results), campaign.aspect, options.scale, warm)
    print(simulate(friction, virtual, options.pressure, options.weight, options.speed, options.output))
    return 0


def _virtual(virtual: VirtualRig, options: argparse.Namespace) -> VirtualRig:
    """Return the config's virtual rig with what the options replace, checked as the config is."""
    given = {name: value for name in VirtualRig.model_fields if (value := getattr(options, name)) is not None}
    if options.output.is_dir():
        raise InvalidInput(f"--output is the folder {options.output}, but must be a file")
    rig = VirtualRig.read("rig.virtual", dict(virtual) | given)
    check_area("rig.virtual.area", rig.area)
    return rig
