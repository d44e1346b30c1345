"""Figures of friction on a measured road: over speed, and over the shortest wavelength kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from rubfric.figures.bands import draw_band
from rubfric.figures.scaling import plain, scale_speeds, tick_decades
from rubfric.figures.style import DOUBLE_COLUMN, applied, kinds

_HEIGHT = 2.75
# Contact fractions that differ by more than this factor have a logarithmic axis.
_DECADES = 20.0


def draw(table: pd.DataFrame) -> dict[str, Figure]:
    """Return the figures by name.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.
    """
    figures = {}
    if table["velocity_mm_per_s"].nunique() > 1:
        figures["friction over speed"] = over_speed(table)
    if table["cutoff_mm"].nunique() > 1:
        figures["friction over the cutoff"] = over_cutoff(table)
    return figures


def _errors(rows: pd.DataFrame) -> Any:
    return np.nan_to_num(rows["friction_road_error"].to_numpy()) + rows["friction_numerical_error"].to_numpy()


@applied()
def over_speed(table: pd.DataFrame) -> Figure:
    """Draw friction and contact over speed with the shortest cutoff, beside Persson's theory and sines.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.
    """
    direct = table[table["way"] == "direct"]
    finest = direct[direct["cutoff_mm"] == direct["cutoff_mm"].min()]
    figure = Figure(figsize=(DOUBLE_COLUMN, 1.15 * _HEIGHT), layout="constrained")
    panel, share = figure.subplots(1, 2)
    groups = list(finest.groupby("pressure_MPa"))
    for look, (pressure, rows) in zip(kinds(len(groups)), groups, strict=True):
        speeds, colour = rows["velocity_mm_per_s"].to_numpy(), look["color"]
        for axes, name, theory, errors in (
            (panel, "friction_coefficient", "friction_persson", _errors(rows)),
            (share, "contact_fraction", "contact_persson", rows["contact_road_error"].to_numpy()),
        ):
            values = rows[name].to_numpy()
            draw_band(axes, speeds, values, errors, colour)
            axes.plot(speeds, values, lw=0.9, label=f"{plain(pressure)} MPa", **look)
            axes.plot(speeds, rows[theory], ":", lw=0.9, color=colour)
            sines = table[(table["way"] == "sines") & (table["pressure_MPa"] == pressure)]
            axes.plot(sines["velocity_mm_per_s"], sines[name], "-.", lw=0.9, color=colour)
    panel.plot([], [], ":", color="0.3", lw=0.9, label="Persson's theory")
    if (table["way"] == "sines").any():
        panel.plot([], [], "-.", color="0.3", lw=0.9, label="Sines of the same spectrum")
    for axes, ordinate in ((panel, "Friction coefficient"), (share, "Contact fraction")):
        axes.set(xlabel="Sliding speed (mm/s)", ylabel=ordinate)
        scale_speeds(axes, finest["velocity_mm_per_s"].to_numpy())
    contact = finest[["contact_fraction", "contact_persson"]]
    if contact.max(axis=None) > _DECADES * contact.min(axis=None):
        share.set_yscale("log")
        tick_decades(share.yaxis, *share.get_ylim())
    else:
        share.set_ylim(bottom=0.0)
    panel.set_ylim(bottom=0.0)
    panel.set_title(f"Waves of {plain(finest['cutoff_mm'].iloc[0], 4)} mm and longer", loc="left")
    figure.legend(*panel.get_legend_handles_labels(), loc="outside lower center", handlelength=1.6, ncols=4)
    return figure


@applied()
def over_cutoff(table: pd.DataFrame) -> Figure:
    """Draw friction over the largest wavenumber that is kept, where there are several, and what a model adds.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.
    """
    figure = Figure(figsize=(DOUBLE_COLUMN, 1.25 * _HEIGHT), layout="constrained")
    panel = figure.subplots()
    table = table[table["way"].isin(["direct", "persson"])]
    places = table.groupby(["pressure_MPa", "velocity_mm_per_s"])
    groups = [(place, rows) for place, rows in places if (rows["way"] == "direct").sum() > 1] or list(places)
    table = pd.concat([rows for _, rows in groups])
    for look, ((pressure, speed), rows) in zip(kinds(len(groups)), groups, strict=True):
        waves = 2.0 * np.pi / rows["cutoff_mm"].to_numpy()
        friction, direct = rows["friction_coefficient"].to_numpy(), (rows["way"] == "direct").to_numpy()
        draw_band(panel, waves[direct], friction[direct], _errors(rows[direct]), look["color"])
        panel.plot(waves[direct], friction[direct], lw=0.9, label=f"{plain(speed)} mm/s, {plain(pressure)} MPa", **look)
        beyond = np.flatnonzero(~direct)
        if beyond.size:
            places = np.concatenate(([beyond[0] - 1], beyond))
            panel.plot(waves[places], friction[places], "--", lw=0.9, color=look["color"])
    if (table["way"] != "direct").any():
        panel.plot([], [], "--", color="0.3", lw=0.9, label="Finer waves by Persson's theory")
    panel.set(xscale="log", xlabel="Largest wavenumber kept (1/mm)", ylabel="Friction coefficient")
    panel.set_ylim(bottom=0.0)
    cutoffs = np.sort(table["cutoff_mm"].unique())
    panel.set_xticks(2.0 * np.pi / cutoffs, [f"{2.0 * np.pi / one:.3g}" for one in cutoffs])
    panel.minorticks_off()
    upper = panel.secondary_xaxis("top", functions=(_wavelength, _wavelength))
    upper.set_xticks(cutoffs, [plain(one, 4) for one in cutoffs])
    upper.minorticks_off()
    upper.set_xlabel("Shortest wavelength kept (mm)")
    figure.legend(*panel.get_legend_handles_labels(), loc="outside right upper", handlelength=1.6)
    return figure


def _wavelength(q: Any) -> Any:
    with np.errstate(divide="ignore"):
        return 2.0 * np.pi / np.asarray(q, dtype=float)
