"""Rubbers from the shell: ``rubfric rubber fit`` measured moduli, ``read`` and ``write`` finite-element decks."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from rubfric import checks
from rubfric.commands.configs import add_configs, warn
from rubfric.config import campaign as campaigns
from rubfric.config.models import Config
from rubfric.config.overlay import overlaid, read_yaml
from rubfric.config.temperature import rubber_at
from rubfric.decks.deck import UNITS
from rubfric.errors import InvalidInput
from rubfric.files import whole
from rubfric.outputs import check_output, name_of
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber
from rubfric.rules import Number

if TYPE_CHECKING:  # heavy
    from rubfric.dma.bootstrap import Bands
    from rubfric.dma.result import Fit

_FIT = """\
examples:
  rubfric rubber fit dma.csv
  rubfric rubber fit dma.csv --reference-temperature 25 --law wlf --vertical entropic --name tread --output tread.yaml
  rubfric rubber fit dma.csv --columns dma.yaml --modulus E --bulk-modulus 2000

dma.csv holds frequency, temperature and two of storage modulus, loss modulus, complex modulus, tan delta and phase,
with units in the headings or in the row below them. dma.yaml may say:
  columns: {frequency: f, temperature: T, storage: Speicher, loss: Verlust}   # where they are not recognised
  units: {frequency: Hz, temperature: degC, storage: MPa, loss: MPa}          # where the file does not say
  modulus: E                 # or G
  decimal: comma             # or point
  separator: semicolon       # or tab, comma, space
docs/rubber.md has the rest.
"""
_READ = """\
examples:
  rubfric rubber read deck.inp --units MPa,s
  rubfric rubber read material.k --units GPa,ms --material 3 --name tread --output tread.yaml
  rubfric rubber write --config tread.yaml --rubber tread --code ansys --output tread.mac

docs/rubber.md says what is read and written.
"""
_COLUMNS = ("columns", "units", "modulus", "decimal", "separator")
_CODES = ("abaqus", "ansys", "lsdyna")
# The first line of a config that these commands write, as UNITS is in that of a deck: such a file may be written anew.
_OURS = "# Written by rubfric rubber"


def add_rubber(commands: Any, configs: Callable[[list[Path]], list[Path]]) -> None:
    """Add the command ``rubber`` with its own commands to the command line.

    Parameters
    ----------
    commands : argparse's sub-parsers
    configs : callable
        Returns the configs to lay over one another, given those of ``--config``.
    """
    rubber = commands.add_parser(
        "rubber",
        help="fit a rubber to measured moduli, read or write one as a deck",
        description="Rubbers from measured moduli, and from and as finite-element decks.",
    )
    own = rubber.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_fit(own)
    raw = argparse.RawDescriptionHelpFormatter
    read = own.add_parser(
        "read",
        help="read a rubber from a finite-element deck",
        description="Read a rubber from a finite-element deck, as a config to lay over others.",
        epilog=_READ,
        formatter_class=raw,
    )
    read.add_argument("deck", metavar="DECK", help="deck of Abaqus, Ansys or LS-DYNA with a Prony series")
    read.add_argument("--code", choices=_CODES, help="the deck's code (default: found out)")
    read.add_argument("--units", metavar="STRESS,TIME", help="the deck's units, MPa,s say; lengths are mm")
    read.add_argument("--material", metavar="NAME", help="name or number of the material, where there are several")
    read.add_argument("--name", help="name of the rubber (default: that of the file)")
    for name, what in (
        ("youngs-modulus", "instantaneous Young's modulus, MPa, where the deck has no elastic constants"),
        ("poissons-ratio", "Poisson's ratio, where the deck has none or 0.5"),
        ("static-modulus", "Young's modulus at rest, MPa, where the shares add up to 1 by rounding"),
    ):
        read.add_argument(f"--{name}", type=float, metavar="X", help=what)
    read.add_argument("--output", "-o", type=Path, metavar="FILE", help="write the entry to this YAML file")
    read.set_defaults(run=_read)
    write = own.add_parser(
        "write",
        help="write a rubber as a finite-element deck",
        description="Write one of the config's rubbers as a finite-element deck, in MPa, mm and s.",
        epilog=_READ,
        formatter_class=raw,
    )
    write.add_argument("--code", choices=_CODES, required=True, help="the deck's code")
    write.add_argument("--rubber", metavar="NAME", help="one of the config's rubbers (default: the one chosen there)")
    add_configs(write)
    write.add_argument(
        "--temperature",
        type=float,
        metavar="T",
        help="the rubber at this temperature, degC, by its shift factors (default: at their reference; an Abaqus deck "
        "has those of WLF)",
    )
    write.add_argument("--output", "-o", type=Path, metavar="FILE", help="write the deck to this file")
    write.set_defaults(run=_write, configs=configs)


def _add_fit(own: Any) -> None:
    fit = own.add_parser(
        "fit",
        help="fit a Prony series and shift factors to measured moduli",
        description="Fit a Prony series and shift factors to moduli measured at several temperatures (DMA).",
        epilog=_FIT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    fit.add_argument("file", metavar="FILE", help="measured moduli as text (CSV)")
    fit.add_argument("--columns", metavar="YAML", help="what the columns are; see below")
    fit.add_argument("--modulus", choices=("E", "G"), help="Young's or shear moduli, where the headings do not say")
    fit.add_argument("--master", action="store_true", help="the file is a master curve, without temperatures")
    fit.add_argument("--isotherm", type=float, default=1.0, metavar="K", help="spread of one isotherm, K (default: 1)")
    fit.add_argument("--reference-temperature", type=float, metavar="T", help="degC (default: 20, where measured)")
    fit.add_argument(
        "--law", choices=("auto", "wlf", "arrhenius", "free"), default="auto", help="law of shifting (default: auto)"
    )
    fit.add_argument(
        "--vertical", choices=("none", "entropic", "free"), default="none", help="vertical shift b_T (default: none)"
    )
    fit.add_argument("--static-modulus", type=float, metavar="X", help="modulus at rest, MPa (default: fitted)")
    fit.add_argument(
        "--branches-per-decade", type=float, metavar="N", help="evenly spaced (default: as many as the data justify)"
    )
    bulk = fit.add_mutually_exclusive_group()
    bulk.add_argument("--poissons-ratio", type=float, default=0.49, metavar="X", help="constant (default: 0.49)")
    bulk.add_argument("--bulk-modulus", type=float, metavar="K", help="constant bulk modulus, MPa, instead")
    fit.add_argument("--samples", type=int, default=200, metavar="N", help="bootstrap samples (default: 200)")
    fit.add_argument("--seed", type=int, default=1, metavar="N", help="seed of the bootstrap (default: 1)")
    fit.add_argument("--name", help="name of the rubber (default: that of the file)")
    fit.add_argument("--output", "-o", type=Path, metavar="FILE", help="YAML file (default: rubber_NAME.yaml)")
    fit.set_defaults(run=_fit)


def _fit(options: argparse.Namespace) -> int:
    name = name_of(options.name, options.file)
    output = options.output or Path(f"rubber_{name}.yaml")
    page = output.with_suffix(".html")
    check_output(output, "rubber", (_OURS, UNITS))
    for key, least, most in (
        *(("isotherm", 1e-3, 20.0), ("branches_per_decade", 0.2, 20.0), ("samples", 20, 10000)),
        *(("bulk_modulus", 1.0, 1e6), ("static_modulus", 1e-4, 1e5)),
    ):
        if getattr(options, key) is not None:
            Number(low=least, high=most).check(f"--{key.replace('_', '-')}", getattr(options, key))
    said = _columns(options.columns)
    from rubfric.dma.bootstrap import bootstrap  # heavy: only once the input is known to be right
    from rubfric.dma.fitted import Bulk, Reading, fit_file
    from rubfric.dma.result import Options

    reading = Reading(
        **said | {"modulus": options.modulus or said.get("modulus")}, master=options.master, isotherm=options.isotherm
    )
    found, material = fit_file(
        options.file,
        name,
        reading,
        Options(
            options.reference_temperature,
            options.law,
            options.vertical,
            options.static_modulus,
            options.branches_per_decade,
            options.samples,
            options.seed,
        ),
        Bulk(options.poissons_ratio, options.bulk_modulus),
    )
    lines = write_fit(found, material, bootstrap(found), output, f"fit from {options.file}")
    print("\n".join([*lines, "", f"Written to {output} and {page}"]))
    return 0


def write_fit(found: Fit, material: Material, bands: Bands, output: Path, how: str, home: str = "") -> list[str]:
    """Write a fitted rubber as a config, and its page beside it; return what was found, a line each.

    Parameters
    ----------
    found : Fit
    material : Material
        That of the fit.
    bands : Bands
        Fits of resampled data.
    output : Path
        The config; the page has the suffix ``.html`` instead.
    how : str
        How the rubber was found, for the config's first line.
    home : str
        Link of the page to that of all results; none where it is empty.
    """
    from rubfric.pages.render import sentence, write_page
    from rubfric.pages.rubber import results, rubber_page

    rows = [
        " ".join(filter(None, (f"{label}:", value, band and f"(95 %: {band})")))
        for label, value, band in results(found, bands)
    ]
    words = [sentence(each) for each in (*found.warnings, *found.data.notes)]
    text = _yaml(material, how, [*rows, *words], found.shift())
    with whole(output) as part:
        part.write_text(text, encoding="utf-8")
    write_page(rubber_page(found, bands, material.name, text, home), output.with_suffix(".html"))
    return [*rows, *words]


def _read(options: argparse.Namespace) -> int:
    from rubfric.decks.deck import rubber
    from rubfric.decks.files import read_deck

    name = name_of(options.name, options.deck)
    deck = read_deck(options.deck, options.code, options.units, options.material)
    material = rubber(deck, name, options.youngs_modulus, options.poissons_ratio, options.static_modulus)
    notes = [f"{note[:1].upper()}{note[1:]}." for note in deck.notes]
    text = _yaml(material, f"read from {options.deck}", notes, deck.shift)
    _put(text, options.output)
    return 0


def _write(options: argparse.Namespace) -> int:
    from rubfric.decks.files import write_deck

    given = overlaid(options.configs(options.config or []), Config.model_fields)
    if options.rubber is not None:
        rubbers = given.get("rubbers")
        names = [str(name) for name in rubbers] if isinstance(rubbers, dict) else []
        if options.rubber not in names:
            hint = checks.suggestion(options.rubber, names)
            raise InvalidInput(f"--rubber is {options.rubber!r}, but the config has {', '.join(names)}{hint}")
        given = given | {"rubber": options.rubber}
    campaign = campaigns.Campaign.from_config(given)
    if options.rubber is None:
        warn(campaign)
    shift, rubber = campaign.shift, campaign.material
    if options.temperature is not None:
        rubber = rubber_at(rubber, shift, options.temperature)
    elif options.code == "abaqus" and shift and (shift.law, shift.vertical) == ("wlf", "none"):
        _put(write_deck(options.code, ShiftedRubber(rubber, shift)), options.output)
        return 0
    _put(write_deck(options.code, rubber), options.output)
    return 0


def _put(text: str, output: Path | None) -> None:
    if output is None:
        print(text, end="")
        return
    check_output(output, "rubber", (_OURS, UNITS))
    with whole(output) as part:
        part.write_text(text, encoding="utf-8")
    print(f"Written to {output}")


def _columns(path: str | None) -> dict[str, Any]:
    """Return what the YAML file of --columns says."""
    if path is None:
        return {}
    given = dict(checks.known_keys(path, read_yaml(path), _COLUMNS))
    for key, allowed in (("modulus", ("E", "G")), ("decimal", ("point", "comma"))):
        if key in given and given[key] not in allowed:
            raise InvalidInput(f"{key} in {path} is {checks.shown(given[key])}, but must be {' or '.join(allowed)}")
    separators = ("tab", "semicolon", "comma", "space")
    if given.get("separator", "tab") not in separators:
        shown = checks.shown(given["separator"])
        raise InvalidInput(f"separator in {path} is {shown}, but must be one of {', '.join(separators)}")
    from rubfric.dma.headings import QUANTITIES

    for key in ("columns", "units"):
        held = checks.known_keys(f"{key} in {path}", given.get(key, {}), QUANTITIES)
        given[key] = {name: str(value) for name, value in held.items()}
    return given


def _shift_entry(shift: Shift | None) -> dict[str, Any]:
    """Return the key ``shift`` of a rubber in the config, without what its law has no use for."""
    if shift is None:
        return {}
    held = {one.name: value for one in fields(shift) if (value := getattr(shift, one.name)) not in (None, ())}
    return {"shift": {name: list(value) if isinstance(value, tuple) else value for name, value in held.items()}}


def _yaml(material: Material, how: str, lines: list[str], shift: Shift | None) -> str:
    """Return a config with one rubber, and comments above it."""
    from rubfric.dma.entry import config_entry

    body = {"rubber": material.name, "rubbers": {material.name: config_entry(material) | _shift_entry(shift)}}
    comments = "".join(f"# {line}\n" for line in lines)
    dumped = yaml.safe_dump(body, sort_keys=False, default_flow_style=None, width=110)
    return f"{_OURS}, {how}. Lay it over config/config.yaml: snakemake --configfile FILE\n{comments}{dumped}"
