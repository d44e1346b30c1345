"""Roads from the shell: ``rubfric road read`` makes an entry of the config and a page from a measured profile."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import yaml

from rubfric.columns.format import DECIMALS, SEPARATORS
from rubfric.files import whole
from rubfric.outputs import check_output, name_of
from rubfric.rules import Integer, Number

_READ = """\
examples:
  rubfric road read street.csv --name street
  rubfric road read heights.txt --spacing 0.0375 --unit um --window 60 --cutoff 0.5
  rubfric road read scan.sdf --line 12 --direction y

street.csv holds distance and height, with units in the headings; empty heights are gaps. docs/road.md has the rest.
"""
# The first line of a config that this command writes: such a file may be written anew.
_OURS = "# Written by rubfric road"
# option: unit, least, most
_NUMBERS = {
    "spacing": ("mm", 1e-9, 1e6),
    "longest_gap": ("mm", 0.0, 1e4),
    "window": ("mm", 1e-9, 1e9),
    "cutoff": ("mm", 1e-9, 1e9),
    "blend": ("", 0.0, 0.5),
}


def add_road(commands: Any) -> None:
    """Add the command ``road`` with its own commands to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    """
    road = commands.add_parser("road", help="read a measured road profile", description="Roads from measured profiles.")
    own = road.add_subparsers(title="commands", metavar="COMMAND", required=True)
    read = own.add_parser(
        "read",
        help="read, clean and analyse a measured profile",
        description="Read, clean and analyse a measured profile: an entry of the config, and a page.",
        epilog=_READ,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    read.add_argument("file", metavar="FILE", help="text (CSV), ISO 25178-71 (.sdf), or an instrument's own format")
    read.add_argument("--unit", metavar="U", help="unit of distances and heights, or both, mm,um say")
    read.add_argument("--spacing", type=float, metavar="X", help="of heights alone, mm")
    read.add_argument("--distance", metavar="NAME", help="heading of the distances, or their column from 1")
    read.add_argument("--height", metavar="NAME", help="heading of the heights, or their column from 1")
    read.add_argument("--separator", choices=SEPARATORS, help="of columns (default: found out)")
    read.add_argument("--decimal", choices=DECIMALS, help="mark of decimals (default: found out)")
    read.add_argument("--line", type=int, metavar="N", help="line of an areal scan, from 1 (default: the middle one)")
    read.add_argument("--direction", choices=("x", "y"), default="x", help="of the lines of a scan (default: x)")
    read.add_argument(
        "--longest-gap", type=float, default=5.0, metavar="X", help="gaps up to this are bridged, mm (default: 5)"
    )
    read.add_argument(
        "--form",
        choices=_FORMS,
        default="tilt",
        help="what is subtracted: mean, tilt, or tilt and bow (default: tilt)",
    )
    read.add_argument("--keep-ends", action="store_true", help="flat ends are road, not plates")
    read.add_argument("--window", type=float, metavar="X", help="length of a window, mm (default: 40, where it fits)")
    read.add_argument(
        "--blend", type=float, default=0.1, metavar="X", help="share of it that is blended (default: 0.1)"
    )
    read.add_argument("--cutoff", type=float, metavar="X", help="shortest wavelength kept, mm (default: found out)")
    read.add_argument("--scales", type=int, default=4, metavar="N", help="number of sines (default: 4)")
    read.add_argument("--name", help="name of the road (default: that of the file)")
    read.add_argument("--output", "-o", type=Path, metavar="FILE", help="YAML file (default: road_NAME.yaml)")
    read.set_defaults(run=_read)


_FORMS = {"mean": 0, "tilt": 1, "bow": 2}


def _read(options: argparse.Namespace) -> int:
    name = name_of(options.name, options.file)
    output = options.output or Path(f"road_{name}.yaml")
    check_output(output, "road", (_OURS,))
    for key, (unit, least, most) in _NUMBERS.items():
        if getattr(options, key) is not None:
            Number("", unit, least, most).check(f"--{key.replace('_', '-')}", getattr(options, key))
    Integer("", 1, 12).check("--scales", options.scales)
    from rubfric.columns.format import Format  # heavy: only once the input is known to be right
    from rubfric.pages.render import sentence, write_page
    from rubfric.pages.road import lost, results, road_page
    from rubfric.profile.analysis import analyse
    from rubfric.profile.cleaning import clean
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
    cleaned = clean(read(options.file, said), options.longest_gap, _FORMS[options.form], options.keep_ends)
    found = analyse(cleaned, options.window, options.cutoff, options.scales, options.blend)
    rows = [f"{label}: {value}" for label, value in (*cleaned.removed, *results(found))]
    words = [sentence(each) for each in (*found.warnings(), *cleaned.measured.notes, lost(found))]
    text = _yaml(name, options.file, [*rows, *words], found.sines)
    with whole(output) as part:
        part.write_text(text, encoding="utf-8")
    page = output.with_suffix(".html")
    write_page(road_page(found, name, text), page)
    print("\n".join([*rows, *words, "", f"Written to {output} and {page}"]))
    return 0


def _yaml(name: str, path: str, lines: list[str], road: Any) -> str:
    """Return a config with one road, and comments above it."""
    scales = [
        {"amplitude": amplitude, "wavenumber": wavenumber}
        for amplitude, wavenumber in zip(road.amplitudes, road.wavenumbers, strict=True)
    ]
    dumped = yaml.safe_dump(
        {"road": name, "roads": {name: scales}}, sort_keys=False, default_flow_style=None, width=110
    )
    comments = "".join(f"# {line}\n" for line in lines)
    head = f"{_OURS} read, from {path}. Lay it over config/config.yaml: snakemake --configfile FILE"
    return f"{head}\n{comments}{dumped}"
