"""Figure 12: the friction of the whole road at several temperatures, over speed and over the speed times a_T."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterMathtext, LogLocator

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.bands import draw_band, explain_bands, upper
from rubfric.figures.scaling import plain, scale_friction, scale_speeds
from rubfric.figures.totals import totals
from rubfric.results.selection import written
from rubfric.results.temperature import rows_at

_HEIGHT = 2.4


@style.applied()
def draw(
    table: pd.DataFrame, pressure: float, factors: Mapping[float, tuple[float, float]], reference: float
) -> Figure:
    """Draw the total against speed, a line per temperature, and the same points as a master curve.

    Parameters
    ----------
    table : pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.
    pressure : float
        Nominal, MPa.
    factors : mapping of float to tuple of float
        Shift factors a_T and b_T, dimensionless, by temperature, degC.
    reference : float
        Temperature at which both are 1, degC.

    Returns
    -------
    matplotlib.figure.Figure
        Bands and bars are the whole errors of the totals. With b_T = 1 friction depends on a_T v alone, so that the
        points of the second panel are on one curve; else each is at another pressure over b_T, as the note says.

    Raises
    ------
    InvalidInput
        For a table without a column, the pressure, a temperature, or any friction.
    """
    found = {one: totals(rows_at(table, one), pressure) for one in sorted(factors)}
    total, error = (np.concatenate([getattr(one, name) for one in found.values()]) for name in ("total", "error"))
    if not np.isfinite(total).any():
        raise InvalidInput("the table of totals has no friction at this pressure, so there is nothing to draw")
    figure = Figure(figsize=(style.DOUBLE_COLUMN, _HEIGHT), layout="constrained")
    axes = list(figure.subplots(1, 2, sharey=True))
    looks = style.lines(len(found))
    reduced = {one: factors[one][0] * each.speeds for one, each in found.items()}
    for (one, each), look in zip(found.items(), looks, strict=True):
        draw_band(axes[0], each.speeds, each.total, each.error, look["color"])
        axes[0].plot(each.speeds, each.total, **look)
        spread = np.nan_to_num(each.error, nan=0.0)
        axes[1].errorbar(reduced[one], each.total, yerr=spread, **look | {"linestyle": "none"}, elinewidth=0.8)
    scale_speeds(axes[0], np.concatenate([one.speeds for one in found.values()]))
    scale_speeds(axes[1], np.concatenate(list(reduced.values())))
    axes[1].xaxis.set_major_locator(LogLocator(10.0, numticks=8))
    axes[1].xaxis.set_major_formatter(LogFormatterMathtext())
    scale_friction(axes[0], upper(total, error))
    panels.entitle(axes, ["At each temperature", f"Shifted to {plain(reference)} °C"])
    axes[0].set_xlabel("Sliding speed $v$ (mm/s)")
    axes[1].set_xlabel("Reduced speed $a_T v$ (mm/s)")
    axes[0].set_ylabel("Friction coefficient")
    handles = panels.line_handles([plain(one) for one in found], looks)
    title = f"Temperature (°C),\nat {written(pressure)} MPa"
    panels.legend_beside(figure, [*handles, *explain_bands(figure, axes[0], total, error)], title)
    moduli = [factors[one][1] for one in found]
    if any(modulus != 1.0 for modulus in moduli):
        note = f"Moduli are multiplied by $b_T$, {min(moduli):.3g} to {max(moduli):.3g}: friction is one curve at equal"
        panels.write_note(figure, [f"{note} pressure over $b_T$, and these are at {written(pressure)} MPa."])
    return figure
