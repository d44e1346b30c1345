"""Figures of friction on a measured road: over speed, and over the shortest wavelength kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from rubfric.figures.bands import draw_band
from rubfric.figures.style import COLUMN, applied, kinds

_HEIGHT = 2.75


@applied()
def draw(table: pd.DataFrame) -> dict[str, Figure]:
    """Return the figures by name.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.studies.windows.slide`` returns it.
    """
    figures = {}
    if table["velocity_mm_per_s"].nunique() > 1:
        figures["friction over speed"] = _over_speed(table)
    if table["cutoff_mm"].nunique() > 1:
        figures["friction over the cutoff"] = _over_cutoff(table)
    return figures


def _errors(rows: pd.DataFrame) -> Any:
    return np.nan_to_num(rows["friction_road_error"].to_numpy()) + rows["friction_numerical_error"].to_numpy()


def _over_speed(table: pd.DataFrame) -> Figure:
    direct = table[table["way"] == "direct"]
    finest = direct[direct["cutoff_mm"] == direct["cutoff_mm"].min()]
    figure = Figure(figsize=(COLUMN, _HEIGHT), layout="constrained")
    panel = figure.subplots()
    groups = list(finest.groupby("pressure_MPa"))
    for look, (pressure, rows) in zip(kinds(len(groups)), groups, strict=True):
        speeds, friction = rows["velocity_mm_per_s"].to_numpy(), rows["friction_coefficient"].to_numpy()
        draw_band(panel, speeds, friction, _errors(rows), look["color"])
        panel.plot(speeds, friction, lw=0.9, label=f"{pressure:g} MPa", **look)
        panel.plot(speeds, rows["friction_persson"], ":", lw=0.9, color=look["color"])
        sines = table[(table["way"] == "sines") & (table["pressure_MPa"] == pressure)]
        panel.plot(sines["velocity_mm_per_s"], sines["friction_coefficient"], "-.", lw=0.9, color=look["color"])
    if (table["way"] == "sines").any():
        panel.plot([], [], "-.", color="0.3", lw=0.9, label="sines of the same spectrum")
    panel.plot([], [], ":", color="0.3", lw=0.9, label="Persson's theory")
    panel.set(xscale="log", xlabel="sliding speed (mm/s)", ylabel="friction coefficient (-)")
    panel.set_ylim(bottom=0.0)
    panel.set_title(f"waves of {finest['cutoff_mm'].iloc[0]:g} mm and longer", loc="left")
    panel.legend(handlelength=1.6)
    return figure


def _over_cutoff(table: pd.DataFrame) -> Figure:
    figure = Figure(figsize=(COLUMN, 1.25 * _HEIGHT), layout="constrained")
    panel = figure.subplots()
    table = table[table["way"].isin(["direct", "persson"])]
    groups = list(table.groupby(["pressure_MPa", "velocity_mm_per_s"]))
    for look, ((pressure, speed), rows) in zip(kinds(len(groups)), groups, strict=True):
        waves = 2.0 * np.pi / rows["cutoff_mm"].to_numpy()
        friction, direct = rows["friction_coefficient"].to_numpy(), (rows["way"] == "direct").to_numpy()
        draw_band(panel, waves[direct], friction[direct], _errors(rows[direct]), look["color"])
        panel.plot(waves[direct], friction[direct], lw=0.9, label=f"{speed:g} mm/s, {pressure:g} MPa", **look)
        beyond = np.flatnonzero(~direct)
        if beyond.size:
            places = np.concatenate(([beyond[0] - 1], beyond))
            panel.plot(waves[places], friction[places], "--", lw=0.9, color=look["color"])
    if (table["way"] != "direct").any():
        panel.plot([], [], "--", color="0.3", lw=0.9, label="finer waves by Persson's theory")
    panel.set(xscale="log", xlabel="largest wavenumber kept (1/mm)", ylabel="friction coefficient (-)")
    panel.set_ylim(bottom=0.0)
    cutoffs = np.sort(table["cutoff_mm"].unique())
    panel.set_xticks(2.0 * np.pi / cutoffs, [f"{2.0 * np.pi / one:.3g}" for one in cutoffs])
    panel.minorticks_off()
    upper = panel.secondary_xaxis("top", functions=(_wavelength, _wavelength))
    upper.set_xticks(cutoffs, [f"{one:g}" for one in cutoffs])
    upper.minorticks_off()
    upper.set_xlabel("shortest wavelength kept (mm)")
    figure.legend(*panel.get_legend_handles_labels(), loc="outside lower center", handlelength=1.6, ncols=2)
    return figure


def _wavelength(q: Any) -> Any:
    with np.errstate(divide="ignore"):
        return 2.0 * np.pi / np.asarray(q, dtype=float)
