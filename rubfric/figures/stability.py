"""The map of stability: where scenes with extreme inputs converge, are refused, or fail."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from rubfric.errors import InvalidInput
from rubfric.figures.style import DOUBLE_COLUMN, applied

# Look of each outcome of a case; hatches distinguish them without colour.
_LOOKS: dict[str, dict[str, Any]] = {
    "converged": {"facecolor": "#2b7bba", "edgecolor": "white"},
    "converged, with a caution": {"facecolor": "#a9cfe8", "edgecolor": "white"},
    "refused, with a reason": {"facecolor": "#f7e3a1", "edgecolor": "#b08d2f", "hatch": "////"},
    "failed": {"facecolor": "#c1121f", "edgecolor": "black", "hatch": "xxxx"},
}
_AXES = {
    "velocity_mm_per_s": "Speed (mm/s)",
    "pressure_MPa": "Pressure (MPa)",
    "aspect": "Height-to-width ratio",
    "slope": "Slope of the road",
    "wavelength_mm": "Wavelength (mm)",
    "poissons_ratio": "Poisson's ratio",
    "waves": "Waves (left slow, right fast)",
    "rms": "RMS slope\n(below light)",
    "branches": "Prony branches",
    "relaxed_share": "Relaxed share",
}
# Panel of the table: title, abscissa, ordinate.
_ROWS = {
    "speed_pressure": ("Speed and pressure", "velocity_mm_per_s", "pressure_MPa"),
    "limits": ("One branch", "velocity_mm_per_s", "pressure_MPa"),
    "aspect_slope": ("Block and slope", "aspect", "slope"),
    "waves": ("Many waves", "waves", "slope"),
    "wavelength_speed": ("Wavelength", "wavelength_mm", "velocity_mm_per_s"),
    "poisson_pressure": ("Poisson's ratio", "poissons_ratio", "pressure_MPa"),
    "branches_share": ("Rubber", "branches", "relaxed_share"),
    "march_speed_pressure": ("In time", "velocity_mm_per_s", "pressure_MPa"),
    "march_branches_share": ("In time", "branches", "relaxed_share"),
}
_WAYS = [(plane, kinematics) for plane in ("stress", "strain") for kinematics in ("small", "finite")]
_CORNERS = [(motion, plane) for motion in ("steady", "march") for plane in ("stress", "strain")]
_HEIGHT = 11.0
# Labels are small, since squares are; of more values than this every other one is written.
_LABEL_SIZE, _MOST_LABELS = 6.0, 6


@applied()
def draw(table: pd.DataFrame) -> Figure:
    """Draw every panel of the matrix: one row each, planes and kinematics side by side, the corners last.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.studies.stability.report`` makes it: one row a case, with ``outcome`` and ``reason``.

    Raises
    ------
    InvalidInput
        Where the table holds no case of a panel.
    """
    table = table.assign(look=[_look(*pair) for pair in zip(table["outcome"], table["reason"].fillna(""), strict=True)])
    parts = {panel: table[table["panel"] == panel] for panel in _ROWS}
    heights = [
        max(3, parts[panel][ordinate].nunique()) * (2 if panel == "waves" else 1)
        for panel, (_, _, ordinate) in _ROWS.items()
    ]
    figure = Figure(figsize=(DOUBLE_COLUMN, _HEIGHT), layout="constrained")
    grid = figure.subplots(
        len(heights) + 1,
        len(_WAYS),
        squeeze=False,
        gridspec_kw={"height_ratios": [1.2 + rows for rows in (*heights, 6)]},
    )
    for axes, (panel, (title, abscissa, ordinate)) in zip(grid[:-1], _ROWS.items(), strict=True):
        _row(list(axes), parts[panel], panel, abscissa, ordinate)
        axes[0].set_ylabel(_AXES["rms" if panel == "waves" else ordinate])
        axes[-1].annotate(title, (1.03, 0.5), xycoords="axes fraction", rotation=-90, ha="left", va="center")
    for panel, (plane, kinematics) in zip(grid[0], _WAYS, strict=True):
        panel.set_title(f"Plane {plane}, {kinematics} strain")
    _corners(list(grid[-1]), table[table["panel"] == "corners"])
    seen = [
        Patch(label=f"{look.capitalize()} ({(table['look'] == look).sum()})", **style) for look, style in _LOOKS.items()
    ]
    figure.legend(handles=seen, loc="outside upper center", ncols=len(seen), title=f"{len(table)} cases")
    return figure


def _look(outcome: str, reason: str) -> str:
    if outcome == "converged":
        return "converged, with a caution" if reason else "converged"
    return "refused, with a reason" if outcome == "refused" else "failed"


def _row(axes: list[Axes], part: pd.DataFrame, name: str, abscissa: str, ordinate: str) -> None:
    """Draw the cases of one panel of the matrix, a square each; a quarter each where speed and load vary as well."""
    if part.empty:
        raise InvalidInput(f"the table of stability has no case of the panel {name}, so its map would be empty")
    across, upward = (sorted(part[column].unique()) for column in (abscissa, ordinate))
    held = {"velocity_mm_per_s", "pressure_MPa"} - {abscissa, ordinate}
    speeds, loads = (
        sorted(part[column].unique()) if column in held else [] for column in ("velocity_mm_per_s", "pressure_MPa")
    )
    wide, high = 1.0 / max(1, len(speeds)), 1.0 / max(1, len(loads))
    for panel, (plane, kinematics) in zip(axes, _WAYS, strict=True):
        for _, case in part[(part["plane"] == plane) & (part["kinematics"] == kinematics)].iterrows():
            x, y = across.index(case[abscissa]) - 0.5, upward.index(case[ordinate]) - 0.5
            x += wide * (speeds.index(case["velocity_mm_per_s"]) if speeds else 0)
            y += high * (loads.index(case["pressure_MPa"]) if loads else 0)
            panel.add_patch(Rectangle((x, y), wide, high, linewidth=0.6, **_LOOKS[case["look"]]))
        panel.set(xlim=(-0.5, len(across) - 0.5), ylim=(-0.5, len(upward) - 0.5))
        every = 2 if len(across) > _MOST_LABELS else 1
        panel.set_xticks(range(0, len(across), every), [_written(value) for value in across[::every]])
        panel.set_yticks(range(len(upward)), [_written(value) for value in upward] if panel is axes[0] else [])
        panel.tick_params(length=0.0, labelsize=_LABEL_SIZE)
        panel.set_xlabel(_AXES[abscissa])


def _corners(axes: list[Axes], part: pd.DataFrame) -> None:
    """Draw the corners where they lie in speed and pressure: their other parameters vary as well."""
    for panel, (motion, plane) in zip(axes, _CORNERS, strict=True):
        chosen = part[(part["motion"] == motion) & (part["plane"] == plane)]
        for look, style in _LOOKS.items():
            some = chosen[chosen["look"] == look]
            panel.scatter(
                some["velocity_mm_per_s"],
                some["pressure_MPa"],
                s=22.0,
                marker="X" if look == "failed" else "s",
                linewidth=0.5,
                clip_on=False,
                **{"facecolor": style["facecolor"], "edgecolor": "black", "hatch": style.get("hatch")},
            )
        panel.set(xscale="log", yscale="log", xlim=(1e-10, 1e10), ylim=(1e-7, 1e4), xlabel=_AXES["velocity_mm_per_s"])
        panel.set_xticks([1e-9, 1e-3, 1e3, 1e9])
        panel.set_yticks([1e-6, 1e-3, 1.0, 1e3], None if panel is axes[0] else [])
        panel.minorticks_off()
        panel.tick_params(labelsize=_LABEL_SIZE)
        panel.set_title(f"Plane {plane}, {'in time' if motion == 'march' else 'steady'}")
    axes[0].set_ylabel(_AXES["pressure_MPa"])
    axes[-1].annotate("Corners", (1.03, 0.5), xycoords="axes fraction", rotation=-90, ha="left", va="center")


def _written(value: float) -> str:
    """Return a number as powers of ten where it is one, and plainly otherwise."""
    if value > 0.0:
        power = math.log10(value)
        if abs(power - round(power)) < 1e-9 and not -2 <= round(power) <= 1:
            return f"$10^{{{round(power)}}}$"
    return f"{np.format_float_positional(value, trim='-')}"
