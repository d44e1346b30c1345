"""Roads from the shell: ``rubfric road read`` a measured profile, and ``slide`` over it, window by window."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from rubfric.columns.format import DECIMALS, SEPARATORS, Format
from rubfric.commands.configs import add_configs, warn
from rubfric.commands.lists import Numbers
from rubfric.config import campaign as campaigns
from rubfric.errors import InvalidInput
from rubfric.files import whole
from rubfric.outputs import check_output, name_of
from rubfric.rubber.material import PLANES
from rubfric.rules import Integer, Number, Rule, rules
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import KINEMATICS, Scene

if TYPE_CHECKING:  # heavy
    from rubfric.profile.analysis import Analysis
    from rubfric.profile.cleaning import Cleaned

_READ = """\
examples:
  rubfric road read street.csv --name street
  rubfric road read heights.txt --spacing 0.0375 --unit um --window 60 --cutoff 0.5
  rubfric road read scan.sdf --line 12 --direction y

street.csv holds distance and height, with units in the headings; empty heights are gaps. docs/road.md has the rest.
"""
_SLIDE = """\
examples:
  rubfric road slide street.csv --velocity 1,10,100,1000 --pressure 0.3
  rubfric road slide street.csv --velocity 100 --pressure 0.1,0.3 --cutoff 2,1,0.5 --windows 4 --config tread.yaml
  rubfric road slide street.csv --velocity 100 --pressure 0.3 --cutoff 1 --window 40,20,80 --block-height 8,4,16

Friction is the mean over the windows, with its standard error beside the numerical one. Of several windows, blends or
block heights each is varied by itself, the others at their first, over the same stretch of road.
"""
# The first line of a config that this command writes: such a file may be written anew.
_OURS = "# Written by rubfric road"
_LENGTH = Number("", "mm", 1e-9, 1e6)
_READING = ("spacing", "longest_gap", "window", "blend")
_NUMBERS: dict[str, Rule] = {
    **dict.fromkeys(("spacing", "window", "cutoff", "block_height"), _LENGTH),
    "longest_gap": Number("", "mm", 0.0, 1e4),
    "blend": Number("", "", 0.0, 0.5),
    "scales": Integer("", 1, 12),
    "windows": Integer(),
    **{name: rules(Scene)[name] for name in ("velocity", "pressure")},
    "accuracy": rules(Numerics)["accuracy"],
}
# Of an option that takes several numbers.
_SEVERAL: dict[str, Any] = {"action": Numbers, "nargs": "+", "metavar": "X,..."}
_FORMS = {"mean": 0, "tilt": 1, "bow": 2}


def add_road(commands: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    """Add the command ``road`` with its own commands to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    configs : callable
        Returns the configs to lay over one another, given those of ``--config``.
    """
    road = commands.add_parser(
        "road",
        help="read a measured road profile, or slide over it",
        description="Roads from measured profiles.",
    )
    own = road.add_subparsers(title="commands", metavar="COMMAND", required=True)
    raw = argparse.RawDescriptionHelpFormatter
    read = own.add_parser(
        "read",
        help="read, clean and analyse a measured profile",
        description="Read, clean and analyse a measured profile: an entry of the config, and a page.",
        epilog=_READ,
        formatter_class=raw,
    )
    _add_reading(read, several=False)
    read.add_argument("--cutoff", type=float, metavar="X", help="shortest wavelength kept, mm (default: found out)")
    read.add_argument("--scales", type=int, default=4, metavar="N", help="number of sines (default: 4)")
    read.add_argument("--output", "-o", type=Path, metavar="FILE", help="YAML file (default: road_NAME.yaml)")
    read.set_defaults(run=_read)
    slide = own.add_parser(
        "slide",
        help="slide over the windows of a measured profile",
        description="Slide a rubber block over the windows of a measured profile: a table of friction, and a page.",
        epilog=_SLIDE,
        formatter_class=raw,
    )
    _add_reading(slide, several=True)
    for name, what in (("velocity", "sliding speeds, mm/s"), ("pressure", "nominal pressures, MPa")):
        slide.add_argument(f"--{name}", **_SEVERAL, required=True, help=what)
    slide.add_argument("--cutoff", **_SEVERAL, help="shortest wavelengths kept, mm (default: 4,2,1)")
    slide.add_argument("--windows", type=int, metavar="N", help="how many (default: 6, or as many as there are)")
    slide.add_argument("--scales", type=int, metavar="N", help="compare with so many sines (default: none)")
    slide.add_argument("--block-height", **_SEVERAL, default=[8.0], help="of the block, mm (default: 8)")
    slide.add_argument("--plane", choices=PLANES, help="plane stress or plane strain (default: the config's)")
    slide.add_argument("--kinematics", choices=KINEMATICS, help="small or finite strain (default: the config's)")
    slide.add_argument("--accuracy", type=float, metavar="A", help="relative accuracy (default: the config's)")
    add_configs(slide)
    slide.add_argument("--output", "-o", type=Path, metavar="FILE", help="table (default: friction_NAME.csv)")
    slide.set_defaults(run=_slide, configs=configs)


def _add_reading(command: argparse.ArgumentParser, several: bool) -> None:
    """Add the arguments that say how a profile is read, cleaned and cut into windows, of one or ``several`` kinds."""
    command.add_argument("file", metavar="FILE", help="text (CSV), ISO 25178-71 (.sdf), or an instrument's own format")
    command.add_argument("--unit", metavar="U", help="unit of distances and heights, or both, mm,um say")
    command.add_argument("--spacing", type=float, metavar="X", help="of heights alone, mm")
    command.add_argument("--distance", metavar="NAME", help="heading of the distances, or their column from 1")
    command.add_argument("--height", metavar="NAME", help="heading of the heights, or their column from 1")
    command.add_argument("--separator", choices=SEPARATORS, help="of columns (default: found out)")
    command.add_argument("--decimal", choices=DECIMALS, help="mark of decimals (default: found out)")
    command.add_argument(
        "--line", type=int, metavar="N", help="line of an areal scan, from 1 (default: the middle one)"
    )
    command.add_argument("--direction", choices=("x", "y"), default="x", help="of the lines of a scan (default: x)")
    command.add_argument(
        "--longest-gap", type=float, default=5.0, metavar="X", help="gaps up to this are bridged, mm (default: 5)"
    )
    command.add_argument(
        "--form",
        choices=_FORMS,
        default="tilt",
        help="what is subtracted: mean, tilt, or tilt and bow (default: tilt)",
    )
    command.add_argument("--keep-ends", action="store_true", help="flat ends are road, not plates")
    form = _SEVERAL if several else {"type": float, "metavar": "X"}
    command.add_argument("--window", **form, help="length of a window, mm (default: 40, where it fits)")
    blend = [0.1] if several else 0.1
    command.add_argument("--blend", **form, default=blend, help="share of it that is blended (default: 0.1)")
    command.add_argument("--name", help="name of the road (default: that of the file)")


def _check(options: argparse.Namespace, names: Sequence[str]) -> None:
    """Refuse numbers outside their bounds, of one option or a list."""
    for key in names:
        rule, given = _NUMBERS[key], getattr(options, key)
        for value in given if isinstance(given, list) else [given]:
            if value is not None:
                rule.check(f"--{key.replace('_', '-')}", value)


def _cleaned(options: argparse.Namespace) -> Cleaned:
    from rubfric.profile.cleaning import clean  # heavy: only once the input is known to be right
    from rubfric.profile.reading import Options, read

    units = tuple(word.strip() for word in options.unit.split(",")) if options.unit else ()
    said = Options(
        units,
        options.spacing,
        (options.distance, options.height),
        options.line,
        options.direction,
        Format(options.separator, options.decimal),
    )
    return clean(read(options.file, said), options.longest_gap, _FORMS[options.form], options.keep_ends)


def _read(options: argparse.Namespace) -> int:
    name = name_of(options.name, options.file)
    output = options.output or Path(f"road_{name}.yaml")
    check_output(output, "road", (_OURS,))
    _check(options, (*_READING, "cutoff", "scales"))
    from rubfric.profile.analysis import analyse

    found = analyse(_cleaned(options), options.window, options.cutoff, options.scales, options.blend)
    said = write_road(found, name, output, f"read from {options.file}")
    print("\n".join([*said, "", f"Written to {output} and {output.with_suffix('.html')}"]))
    return 0


def write_road(found: Analysis, name: str, output: Path, how: str, home: str = "") -> list[str]:
    """Write a measured road as a config of sines, with its page, and return what is to be said of it.

    Parameters
    ----------
    found : Analysis
    name : str
        Of the road.
    output : Path
        The config; the page has the suffix ``.html`` instead.
    how : str
        How the road was found, for the config's first line.
    home : str
        Link of the page to that of all results; none where it is empty.
    """
    from rubfric.pages.render import sentence, write_page
    from rubfric.pages.road import lost, results, road_page

    cleaned = found.cleaned
    rows = [f"{label}: {value}" for label, value in (*cleaned.removed, *results(found))]
    words = [sentence(each) for each in (*found.warnings(), *cleaned.measured.notes, lost(found))]
    text = _yaml(name, how, [*rows, *words], found.sines)
    with whole(output) as part:
        part.write_text(text, encoding="utf-8")
    write_page(road_page(found, name, text, home), output.with_suffix(".html"))
    return [*rows, *words]


def _slide(options: argparse.Namespace) -> int:
    name = name_of(options.name, options.file)
    output = options.output or Path(f"friction_{name}.csv")
    check_output(output, "table", ("velocity_mm_per_s,pressure_MPa,cutoff_mm",))
    _check(options, (*_READING, "cutoff", "velocity", "pressure", "windows", "scales", "block_height", "accuracy"))
    campaign = campaigns.load(*options.configs(options.config or []))
    from rubfric.pages.render import write_page
    from rubfric.pages.slide import slide_page, study_page
    from rubfric.profile.analysis import analyse
    from rubfric.results.road_friction import Block
    from rubfric.results.tables import write_table
    from rubfric.studies.windows import one_by_one, slide, vary

    cutoffs, cleaned = options.cutoff or [4.0, 2.0, 1.0], _cleaned(options)
    found = analyse(cleaned, options.window[0] if options.window else None, min(cutoffs), 1, options.blend[0])
    choices = one_by_one(options.window or [found.window], options.blend, options.block_height)
    if options.scales and len(choices) > 1:
        raise InvalidInput(
            "--scales is given with several of --window, --blend or --block-height, but sines need one of each"
        )
    numerics = campaign.numerics
    block = Block(
        campaign.material,
        choices[0].height,
        options.plane or campaign.plane,
        options.kinematics or campaign.kinematics,
        replace(numerics, accuracy=options.accuracy) if options.accuracy else numerics,
    )
    windows = options.windows or min(6, found.windows)
    warn(campaign)
    lead = (
        f"{campaign.material.name}, a block {block.height:g} mm high, plane {block.plane}, {block.kinematics} "
        f"kinematics, over {windows} windows of {found.window:g} mm of {options.file}"
    )
    print(lead, flush=True)
    points = (options.velocity, options.pressure)

    def said(line: str) -> None:
        print(line, flush=True)

    if len(choices) > 1:
        table = vary(cleaned, block, *points, min(cutoffs), windows, choices, said)
        made = study_page(table, name, f"{lead}, and others over the same stretch of road.")
    else:
        table = slide(found, block, *points, cutoffs, windows, options.scales or 0, said)
        made = slide_page(table, name, f"{lead}.")
    write_table(table, output)
    page = output.with_suffix(".html")
    write_page(made, page)
    print(f"\nWritten to {output} and {page}")
    return 0


def _yaml(name: str, how: str, lines: list[str], road: Any) -> str:
    """Return a config with one road, and comments above it."""
    scales = [
        {"amplitude": amplitude, "wavenumber": wavenumber}
        for amplitude, wavenumber in zip(road.amplitudes, road.wavenumbers, strict=True)
    ]
    dumped = yaml.safe_dump(
        {"road": name, "roads": {name: scales}}, sort_keys=False, default_flow_style=None, width=110
    )
    comments = "".join(f"# {line}\n" for line in lines)
    head = f"{_OURS}, {how}. Lay it over config/config.yaml: snakemake --configfile FILE"
    return f"{head}\n{comments}{dumped}"
