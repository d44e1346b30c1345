"""One scene from the shell: ``rubfric simulate``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import rubfric
from rubfric import campaign as campaigns
from rubfric.errors import RubfricError
from rubfric.material import PLANES

_EXAMPLE = """\
example:
  rubfric simulate --scale 1 --velocity 100 --pressure 5 --aspect 0.75
  rubfric simulate --scale 4 --velocity 1000 --pressure 0.5 --plane strain --output scene.nc

The rubber, the road and the numerics come from a config, by default config/config.yaml.
For whole campaigns run snakemake in the project's folder.
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; return 0, 1 where the scene has no result, or 2 where the input is wrong."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if not hasattr(options, "run"):
        parser.print_help()
        return 0
    try:
        return int(options.run(options))
    except (ValueError, FileNotFoundError) as error:
        print(f"rubfric: {error}", file=sys.stderr)
        return 2
    except (RubfricError, OSError) as error:
        print(f"rubfric: {error}", file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rubfric",
        description="Friction of viscoelastic rubber sliding on a rough road.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"rubfric {rubfric.__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    simulate = commands.add_parser(
        "simulate",
        help="slide one block over one scale of the road and print its friction",
        description="Slide a rubber block, one wavelength wide, steadily over one scale of the road.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    simulate.add_argument("--scale", type=int, required=True, help="scale of the road, 1 being the coarsest")
    simulate.add_argument("--velocity", type=float, required=True, metavar="V", help="sliding speed, mm/s")
    simulate.add_argument("--pressure", type=float, required=True, metavar="P", help="nominal pressure, MPa")
    simulate.add_argument(
        "--aspect", type=float, metavar="R", help="height of the block over its width (default: the config's)"
    )
    simulate.add_argument("--plane", choices=PLANES, help="plane stress or plane strain (default: the config's)")
    simulate.add_argument(
        "--config",
        action="append",
        type=Path,
        metavar="FILE",
        help="YAML config with the rubber and the road; give more to lay one over the other",
    )
    simulate.add_argument("--output", type=Path, metavar="FILE", help="write fields and scalars to this netCDF file")
    simulate.set_defaults(run=_simulate)
    return parser


def _simulate(options: argparse.Namespace) -> int:
    campaign = campaigns.load(*(options.config or [default_config()]))
    scene = campaign.scene(options.scale, options.velocity, options.pressure, options.aspect, options.plane)
    from rubfric.simulation import simulate  # heavy: only once the input is known to be right

    result = simulate(scene)
    if options.output:
        from rubfric.dataset import write

        write(result, options.output)
    from rubfric.summary import summary

    print(summary(result))
    if options.output:
        print(f"\nWritten to {options.output}")
    return 0


def default_config() -> Path:
    """Return config/config.yaml of the working folder, or that of the project which the package belongs to."""
    here = Path("config/config.yaml")
    if here.exists():
        return here
    project = Path(__file__).resolve().parents[1] / here
    if project.exists():
        return project
    raise FileNotFoundError("there is no config/config.yaml here: run in the project's folder, or give --config FILE")


if __name__ == "__main__":
    sys.exit(main())
