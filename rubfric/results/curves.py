"""The table of friction over speed: every point of every curve, of the grid or added."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from rubfric.results.curve import Curve
from rubfric.results.scales import AXES, TOTAL
from rubfric.results.selection import RUBBER_ERROR
from rubfric.results.temperature import COLUMN

# Of all points: which curve they are on, whether they were added, and how a total was obtained.
CURVE, POINT, WAY = "curve", "point", "way"
GRID, ADDED = "grid", "added"
FRICTION, ERROR = "friction_coefficient", "friction_coefficient_error"
WORDS = ("rubber", "road", CURVE, POINT, WAY, "kind", "note")


def scale_name(scale: int | str) -> str:
    """Return how the curves of a scale are named."""
    return f"scale {scale}"


def points_of(table: pd.DataFrame) -> pd.DataFrame:
    """Return speed, pressure, friction with its whole error and the way of each row of a table.

    Parameters
    ----------
    table : pandas.DataFrame
        Of a scale, as from ``rubfric.results.tables.scale_table``, or of totals.
    """
    axes = [*AXES, *([COLUMN] if COLUMN in table else [])]
    if TOTAL[0] in table:
        return table[[*axes, *TOTAL, WAY]].rename(columns=dict(zip(TOTAL, (FRICTION, ERROR), strict=True)))
    error = table[ERROR] + (table[RUBBER_ERROR].fillna(0.0) if RUBBER_ERROR in table else 0.0)
    return table[[*axes, FRICTION]].assign(**{ERROR: error, WAY: ""})


def curve_of(table: pd.DataFrame) -> Curve | None:
    """Return the curve through the rows of a table, all at one pressure and temperature.

    Parameters
    ----------
    table : pandas.DataFrame
        As for ``points_of``, or as from it.
    """
    points = table if POINT in table else points_of(table)
    return Curve.known(*(points[name].to_numpy(dtype=np.float64) for name in (AXES[0], FRICTION, ERROR)))


def curve_table(
    tables: Mapping[str, pd.DataFrame], added: Mapping[str, list[pd.DataFrame]], aspect: float
) -> pd.DataFrame:
    """Return every point of every curve: by curve, temperature where there are several, pressure and speed.

    Parameters
    ----------
    tables : mapping of str to pandas.DataFrame
        Those of the grid by the name of the curve, as for ``points_of``.
    added : mapping
        Those of the added speeds, likewise; may lack curves.
    aspect : float
        Height over width of the blocks; rows of others are left out.
    """
    found = []
    for name, table in tables.items():
        rows = table[np.isclose(table["aspect"], aspect, rtol=1e-5)] if "aspect" in table else table
        parts = [(GRID, rows), *((ADDED, one) for one in added.get(name, ()) if len(one))]
        points = pd.concat([points_of(one).assign(**{POINT: kind}) for kind, one in parts])
        axes = [axis for axis in (COLUMN, AXES[1], AXES[0]) if axis in points]
        points.insert(0, CURVE, name)
        found.append(points.dropna(subset=FRICTION).sort_values(axes))
    return pd.concat(found, ignore_index=True)


def curves_in(points: pd.DataFrame) -> Iterator[tuple[dict[str, Any], pd.DataFrame]]:
    """Yield each curve of a table: its name, pressure and temperature by column, and its points."""
    axes = [CURVE, *(axis for axis in (COLUMN, AXES[1]) if axis in points)]
    for place, rows in points.groupby(axes, sort=False):
        yield dict(zip(axes, place, strict=True)), rows
