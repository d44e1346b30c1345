"""The shell: one scene by ``rubfric simulate``, sliding steadily, or ``rubfric march``, step by step; the test rig."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import rubfric
from rubfric.commands.areal import add_areal, slide
from rubfric.commands.command_parser import CommandParser
from rubfric.commands.completion import SHELLS, PrintCompletion
from rubfric.commands.configs import add_configs, warn
from rubfric.commands.export import add_export
from rubfric.commands.friction import add_friction
from rubfric.commands.road import add_road
from rubfric.commands.rubber import add_rubber
from rubfric.commands.sensitivity import add_sensitivity
from rubfric.config import campaign as campaigns
from rubfric.config.begin import begin
from rubfric.config.default import base_configs
from rubfric.config.plausibility import check_plausible
from rubfric.errors import InvalidInput, NotWritten, RubfricError
from rubfric.outputs import no_file
from rubfric.rig.cli import add_rig
from rubfric.rubber.material import PLANES
from rubfric.scene.procedure import STARTS
from rubfric.scene.scene import ALL, KINEMATICS, Scene
from rubfric.streams import patient_output

_EXAMPLE = """\
example:
  rubfric simulate --scale 1 --velocity 100 --pressure 5 --aspect 0.75
  rubfric simulate --scale 1 --velocity 100 --pressure 5 --accuracy 0.002
  rubfric simulate --scale 4 --velocity 1000 --pressure 0.5 --plane strain --output scene.nc
  rubfric simulate --scale 1 --velocity 100 --pressure 5 --temperature 60 --config mine.yaml
  rubfric simulate --scale all --velocity 100 --pressure 5 --kinematics small
  rubfric simulate --road runway --velocity 100 --pressure 0.3 --config mine.yaml --output areal.nc
  rubfric march --scale 1 --velocity 100 --pressure 0.5 --wavelengths 10 --output march.nc
  rubfric friction --config mine.yaml --velocity 1,10,100 --pressure 0.2,1
  rubfric sensitivity --config mine.yaml --velocity 100 --pressure 0.3
  rubfric export results --to abaqus --output friction.inp
  rubfric init mine.yaml

The rubber, the road and the numerics are the paper's, or those of config/config.yaml in the working folder, with what
--config lays over them. For whole campaigns run snakemake in the project's folder.

exit status: 0 done, also where nobody reads the output to its end; 1 no result, since a scene did not converge, a file
is damaged, or nothing could be written; 2 wrong input; 130 interrupted
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the command line and return the exit status, which the help explains."""
    try:
        with patient_output():
            return _run(arguments)
    except NotWritten as error:
        print(f"rubfric: {error}", file=sys.stderr)
        return 1


def _run(arguments: list[str] | None) -> int:
    parser = _parser()
    try:
        options = parser.parse_args(arguments)
        if not hasattr(options, "run"):
            parser.print_help()
            return 0
        return int(options.run(options))
    except (InvalidInput, FileNotFoundError) as error:
        print(f"rubfric: {_sentence(error)}", file=sys.stderr)
        return 2
    except (RubfricError, OSError) as error:
        print(f"rubfric: {_sentence(error)}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("rubfric: interrupted", file=sys.stderr)
        return 130


def _sentence(error: Exception) -> str:
    """Return what to print of an error; of one of the system, what it has to say of its file."""
    if not isinstance(error, OSError) or not error.filename or not error.strerror:
        return str(error)
    path = Path(os.fsdecode(error.filename))
    if isinstance(error, FileNotFoundError):
        return no_file(path)
    return f"{path} cannot be read or written ({error.strerror})"


def _parser() -> argparse.ArgumentParser:
    parser = CommandParser(
        prog="rubfric",
        description="Friction of viscoelastic rubber sliding on a rough road.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"rubfric {rubfric.__version__}")
    parser.add_argument(
        "--print-completion",
        action=PrintCompletion,
        choices=SHELLS,
        metavar="SHELL",
        help=f"print the script that completes commands, options and files in a shell: {', '.join(SHELLS)}",
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    simulate = commands.add_parser(
        "simulate",
        help="slide one block over one scale of the road, or all at once, and print its friction",
        description="Slide a rubber block, one period of the road wide, steadily over one scale of it or all at once.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_scene(simulate, required=False)
    add_areal(simulate)
    simulate.set_defaults(run=_simulate)
    march = commands.add_parser(
        "march",
        help="press one block and slide it step by step until its friction has settled",
        description="Press a rubber block onto a scale of the road, or all at once, and slide it step by step in time.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_scene(march)
    march.add_argument("--start", choices=STARTS, help="what to begin with (default: the config's)")
    for name, what in (
        ("columns", "columns of cells along one wavelength, a multiple of 8"),
        ("steps-per-wavelength", "steps of time in which the road goes past by a wavelength"),
        ("wavelengths", "wavelengths to slide at most"),
    ):
        march.add_argument(f"--{name}", type=int, metavar="N", help=f"{what} (default: the config's)")
    march.add_argument(
        "--restart", type=Path, metavar="FILE", help="go on from this file where it exists, and leave the state in it"
    )
    march.set_defaults(run=_march)
    init = commands.add_parser(
        "init",
        help="write a config of your own rubber, road and grid to begin with",
        description="Write a config with comments and units, for snakemake -j2 --configfile FILE.",
    )
    init.add_argument("file", metavar="FILE", help="config to write, mine.yaml say; a file that exists is left alone")
    init.set_defaults(run=_init)
    add_friction(commands, _configs)
    add_sensitivity(commands, _configs)
    add_export(commands)
    add_rig(commands, _configs)
    add_rubber(commands, _configs)
    add_road(commands, _configs)
    return parser


def _scale(text: str) -> int | str:
    """Return the number of a scale, or the word for all of them."""
    if text != ALL and not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is neither the number of a scale nor {ALL!r}")
    return text if text == ALL else int(text)


def _add_scene(command: argparse.ArgumentParser, required: bool = True) -> None:
    """Add the arguments that name a scene, the configs it comes from, and the file to write.

    Parameters
    ----------
    command : argparse.ArgumentParser
    required : bool
        Whether there is no other road than one of scales.
    """
    command.add_argument(
        "--scale",
        type=_scale,
        required=required,
        metavar="N",
        help="scale of the road, 1 being the coarsest, or all for all scales at once",
    )
    command.add_argument("--velocity", type=float, required=True, metavar="V", help="sliding speed, mm/s")
    command.add_argument("--pressure", type=float, required=True, metavar="P", help="nominal pressure, MPa")
    command.add_argument(
        "--aspect", type=float, metavar="R", help="height of the block over its width (default: the config's)"
    )
    command.add_argument(
        "--temperature", type=float, metavar="T", help="of a rubber with shift factors, degC (default: the config's)"
    )
    command.add_argument("--plane", choices=PLANES, help="plane stress or plane strain (default: the config's)")
    command.add_argument(
        "--kinematics",
        choices=KINEMATICS,
        help="small or finite strain, or what the scene needs (default: the config's)",
    )
    command.add_argument("--preset", metavar="NAME", help="one of the config's presets, instead of its numerics")
    command.add_argument(
        "--accuracy", type=float, metavar="A", help="relative accuracy of friction, 0.01 say (default: the config's)"
    )
    add_configs(command)
    command.add_argument("--output", type=Path, metavar="FILE", help="write fields and scalars to this netCDF file")


def _read(options: argparse.Namespace) -> tuple[campaigns.Campaign, Scene]:
    """Return the campaign and the scene that the options name."""
    campaign = campaigns.load(*_configs(options.config or []))
    names = ("scale", "velocity", "pressure", "aspect", "plane", "kinematics", "preset", "accuracy", "temperature")
    scene = campaign.scene(**{name: getattr(options, name) for name in names})
    warm = None if scene.temperature is None else {scene.temperature: scene.material}
    warn(campaign, check_plausible(campaign.material, campaign.road, [scene.velocity], [scene.pressure], warm))
    if options.output and options.output.is_dir():
        raise InvalidInput(f"--output is the folder {options.output}, but must be a file")
    return campaign, scene


def _simulate(options: argparse.Namespace) -> int:
    if options.road is not None:
        return slide(campaigns.load(*_configs(options.config or [])), options)
    if options.scale is None:
        raise InvalidInput("--scale is missing: give the number of a scale, or all; or --road and an areal road")
    _, scene = _read(options)
    from rubfric.results.dataset import write  # heavy: only once the input is known to be right
    from rubfric.results.summary import summary
    from rubfric.simulation import simulate

    result = simulate(scene)
    print(summary(result))
    if options.output:
        write(result, options.output)
        print(f"\nWritten to {options.output}")
    return 0


def _march(options: argparse.Namespace) -> int:
    campaign, scene = _read(options)
    arguments = campaign.procedure()
    names = ("start", "columns", "steps_per_wavelength", "wavelengths")
    arguments |= {name: getattr(options, name) for name in names if getattr(options, name) is not None}
    from rubfric.marching import march
    from rubfric.results.dataset import write  # heavy: only once the input is known to be right
    from rubfric.results.march import build
    from rubfric.scene.procedure import Procedure
    from rubfric.simulation import simulate

    procedure = Procedure(**arguments)
    steady = float(simulate(scene)["friction_coefficient"])
    found = march(scene, procedure, progress=lambda line: print(line, flush=True), restart=options.restart)
    print(f"{found.saturation}\nsteady sliding, solved directly: {steady:.5g}")
    if options.output:
        write(build(found, steady), options.output)
        print(f"\nWritten to {options.output}")
    return 0


def _init(options: argparse.Namespace) -> int:
    begin(options.file)
    print(f"{options.file} is written: edit it, then run   snakemake -j2 --configfile {options.file}")
    return 0


def _configs(given: list[Path]) -> list[Path]:
    """Return the configs to lay over one another: those that all are laid over, then those given."""
    return [*base_configs(), *given]


if __name__ == "__main__":
    sys.exit(main())
