"""Results as pictures, for notebooks and scripts: figures of matplotlib that show themselves, without pyplot."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from rubfric.config.campaign import Campaign
from rubfric.errors import InvalidInput
from rubfric.figures import fig4, panels, style
from rubfric.figures import sensitivity as tornado
from rubfric.figures.bands import band_handle, draw_band, upper
from rubfric.figures.peaks import mark_peak, peak_handles
from rubfric.figures.scaling import scale_friction, scale_speeds
from rubfric.figures.totals import totals
from rubfric.results import answer
from rubfric.results.scales import AXES
from rubfric.results.selection import written
from rubfric.results.temperature import COLUMN, rows_at
from rubfric.results.totals_file import read_totals
from rubfric.studies.sensitivity.result import Sensitivities

# Height of a panel, inches; of so many panels each is wide enough for ticks between decades.
_HEIGHT, _WIDE = 2.7, 2


class Picture(Figure):
    """A figure that shows itself in a notebook, though pyplot does not know it."""

    def _repr_png_(self) -> bytes:
        return style.png(self)


def block(*results: xr.Dataset) -> Figure:
    """Draw the deformed block of a scene on its road, coloured by strain-energy density, or those of several scenes.

    Parameters
    ----------
    *results : xarray.Dataset
        As from ``rubfric.simulate``; several of one scale and height-to-width ratio, at every pressure and speed, make
        a row per pressure and a column per speed.

    Returns
    -------
    matplotlib.figure.Figure
        In finite strain the block as it is deformed; in small strain with its lower face where the contact puts it. The
        share of the nominal area in contact stands below it.

    Raises
    ------
    InvalidInput
        For what is no result of a scene, and results that do not fill a grid.

    Examples
    --------
    >>> import rubfric.plot
    >>> figure = rubfric.plot.block(rubfric.simulate(rubfric.load().scene(scale=1, velocity=100, pressure=0.5)))
    >>> figure.savefig("block.png")  # doctest: +SKIP
    """
    return _shown(fig4.draw(results))


@style.applied()
def friction(
    results: Campaign | xr.Dataset | pd.DataFrame | str | os.PathLike[str],
    pressures: Sequence[float] | None = None,
    temperatures: Sequence[float] | None = None,
    ax: Axes | None = None,
) -> Figure:
    """Draw the friction of the whole road over sliding speed with its errors: a line a pressure, a panel a temperature.

    Parameters
    ----------
    results : Campaign, xarray.Dataset, pandas.DataFrame or path-like
        What ``rubfric.run`` or ``rubfric.friction`` has returned; a folder of results, or a table of totals; or a
        campaign, which is run, where that has not been done.
    pressures : sequence of float, optional
        Nominal, MPa; all by default.
    temperatures : sequence of float, optional
        degC; all by default.
    ax : matplotlib.axes.Axes, optional
        Where to draw one temperature, in a figure of your own.

    Returns
    -------
    matplotlib.figure.Figure
        Bands are the whole errors. A ring marks the largest of a line, where it lies between others.

    Raises
    ------
    InvalidInput
        For a pressure or temperature that the results have not, no friction, and several temperatures in one ``ax``.

    Examples
    --------
    >>> import rubfric.plot
    >>> campaign = rubfric.load({"multiscale": "sum", "kinematics": "small"})
    >>> result = campaign.run([1, 10, 100], [0.5], progress=False)
    >>> rubfric.plot.friction(result).savefig("friction.png")  # doctest: +SKIP
    """
    table = _table(results)
    if table.empty:
        raise InvalidInput("the table of totals has no row, so there is nothing to draw")
    warm: Sequence[float | None] = temperatures or (sorted(set(table[COLUMN])) if COLUMN in table else [None])
    tables = [rows_at(table, one) for one in warm]
    chosen = pressures or sorted({pressure for one in tables for pressure in one[AXES[1]]})
    if ax is not None and len(tables) > 1:
        raise InvalidInput(f"there are {len(tables)} temperatures, but one ax shows only one: choose with temperatures")
    figure, axes = (None, [ax]) if ax is not None else panels.arrange(len(tables), height=_HEIGHT)
    looks = style.lines(len(chosen))
    highest = [
        _draw(panel, one, pressure, look)
        for panel, one in zip(axes, tables, strict=True)
        for pressure, look in zip(chosen, looks, strict=True)
    ]
    speeds = table[AXES[0]].to_numpy(dtype=np.float64)
    for panel in axes:
        scale_speeds(panel, speeds)
        if len(axes) > _WIDE and speeds.max() >= 10.0 * speeds.min():
            panel.xaxis.set_major_locator(LogLocator(10.0))  # decades only
        scale_friction(panel, np.concatenate(highest))
    if len(tables) > 1:
        panels.entitle(axes, [f"{written(float(one))} \N{DEGREE SIGN}C" for one in warm if one is not None])
    handles = panels.line_handles([f"{written(pressure)} MPa" for pressure in chosen], looks)
    handles += [band_handle("Error"), *peak_handles(*axes)]
    words = ("Sliding speed (mm/s)", "Friction coefficient")
    if figure is None:
        axes[0].set(xlabel=words[0], ylabel=words[1])
        axes[0].legend(handles=handles)
        return cast(Figure, axes[0].get_figure(root=True))
    panels.label(axes, *words)
    panels.legend_beside(figure, handles, "Nominal pressure")
    return _shown(figure)


def sensitivity(found: Sensitivities) -> Figure:
    """Draw what each number of rubber, road, block and load does to friction: a bar each, the longest on top.

    Parameters
    ----------
    found : Sensitivities
        As from ``rubfric.sensitivity``.

    Raises
    ------
    InvalidInput
        Where no change of friction is known.

    Examples
    --------
    >>> import rubfric.plot
    >>> found = rubfric.sensitivity(rubfric.load({"kinematics": "small"}), 100, 0.5, scale=1, only=["E", "g_2"])
    >>> figure = rubfric.plot.sensitivity(found)
    >>> figure.savefig("tornado.png")  # doctest: +SKIP
    """
    return _shown(tornado.draw(found.table, found.change, found.title))


def _draw(panel: Axes, table: pd.DataFrame, pressure: float, look: dict[str, Any]) -> Any:
    """Draw the totals at one pressure (MPa), open where they are in another way than most; return their upper edges."""
    found = totals(table, pressure)
    draw_band(panel, found.speeds, found.total, found.error, look["color"])
    panel.plot(found.speeds, found.total, **look)
    mark_peak(panel, found.speeds, found.total, look["color"])
    return upper(found.total, found.error)


def _table(results: Campaign | xr.Dataset | pd.DataFrame | str | os.PathLike[str]) -> pd.DataFrame:
    if isinstance(results, Campaign):
        results = results.run()
    if isinstance(results, xr.Dataset):
        if "friction_total" not in results:
            raise InvalidInput("the dataset has no friction_total: give what rubfric.run has returned")
        return answer.table(results)
    return results if isinstance(results, pd.DataFrame) else read_totals(Path(results)).table


def _shown(figure: Figure) -> Figure:
    """Return a figure as one that shows itself."""
    figure.__class__ = Picture
    return figure
