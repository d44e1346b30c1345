"""The shell: one scene on an areal road by ``rubfric simulate --road``."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rubfric.checks import number
from rubfric.config.campaign import Campaign
from rubfric.config.temperature import rubber_at
from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealRoad
from rubfric.scene.areal import ArealNumerics, ArealScene

if TYPE_CHECKING:
    import xarray as xr

# What a scene on ridges has, and one on a surface has not.
_OF_RIDGES = ("scale", "plane", "kinematics", "preset")


def add_areal(command: argparse.ArgumentParser) -> None:
    """Add the arguments of areal roads."""
    command.add_argument(
        "--road",
        metavar="NAME",
        help="an areal road in place of --scale: one of the config's, or the file of an areal scan (.sdf)",
    )
    command.add_argument(
        "--direction", type=float, metavar="D", help="of sliding over an areal road, degrees from x (default: 0)"
    )
    command.add_argument(
        "--nodes", type=int, metavar="N", help="most nodes along an areal road's longer period (default: 1024)"
    )
    command.add_argument(
        "--cut-off", type=float, metavar="L", help="shortest wavelength kept of an areal scan, mm (default: all)"
    )


def slide(campaign: Campaign, options: argparse.Namespace) -> int:
    """Slide over an areal road, print what was found, and write it; return the exit status.

    Parameters
    ----------
    campaign : Campaign
        With the rubber.
    options : argparse.Namespace
    """
    for name in _OF_RIDGES:
        if getattr(options, name) is not None:
            raise InvalidInput(f"--{name} is given, but does not go with --road, which names an areal road")
    if options.output and options.output.is_dir():
        raise InvalidInput(f"--output is the folder {options.output}, but must be a file")
    scene = _scene(campaign, options)
    from rubfric.areal_simulation import simulate_areal  # heavy: only once the input is known to be right
    from rubfric.results.dataset import write

    result = simulate_areal(scene)
    print(summary(result))
    if options.output:
        write(result, options.output)
        print(f"\nWritten to {options.output}")
    return 0


def _scene(campaign: Campaign, options: argparse.Namespace) -> ArealScene:
    warm = campaign.figures.temperature if options.temperature is None else options.temperature
    warm = None if warm is None else number("temperature", warm)
    entry = campaign.areal_roads.get(options.road)
    numerics = _told({"accuracy": options.accuracy, "nodes_max": options.nodes})
    turned = entry.direction if entry and options.direction is None else options.direction
    given = {"direction": turned, "aspect": options.aspect}
    return ArealScene(
        _road(campaign, options),
        options.velocity,
        options.pressure,
        campaign.material if warm is None else rubber_at(campaign.material, campaign.shift, warm),
        numerics=replace(entry.numerics if entry else ArealNumerics(), **numerics),
        temperature=warm,
        **_told(given),
    )


def _told(options: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _road(campaign: Campaign, options: argparse.Namespace) -> ArealRoad:
    name, roads = options.road, campaign.areal_roads
    if name in roads:
        if options.cut_off is not None:
            raise InvalidInput(f"--cut-off is for areal scans; change that of {name} in the config")
        return roads[name].road(name)
    if not Path(name).is_file():
        listed = f", one of {', '.join(roads)}," if roads else " (it has none)"
        raise InvalidInput(f"--road is {name!r}, but must be an areal road of the config{listed} or the file of a scan")
    from rubfric.profile.areal import scanned_road

    return scanned_road(name, cut_off=options.cut_off)


def summary(result: xr.Dataset) -> str:
    """Return what a result says, in a few lines."""
    value = {str(name): float(one) for name, one in result.data_vars.items() if one.ndim == 0}
    nodes, friction = result.contact_pressure.shape, value["friction_coefficient"]
    lines = [
        f"{result.attrs['scene']} ({result.attrs['rubber']}, small strain, {nodes[1]} x {nodes[0]} nodes)",
        f"friction coefficient {friction:.4g}, estimated error {value['friction_error']:.2g}",
        f"force across the direction of sliding over the load {value['friction_across']:.2g}",
        f"contact area {value['contact_fraction']:.2%} of the nominal",
        f"Persson's theory: friction {value['persson_friction']:.4g} (S = 1), {value['persson_friction_reduced']:.4g} "
        f"(gamma = 1/2), contact {value['persson_contact_fraction']:.2%}",
        f"road: rms height {value['rms_height']:.4g} mm, rms slope {value['rms_slope']:.3g}",
        *(f"note: {line}" for line in result.attrs["warnings"].splitlines()),
    ]
    return "\n".join(lines)
