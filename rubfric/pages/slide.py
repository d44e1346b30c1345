"""The page of friction on a measured road: over speed and over the cutoff, with the errors of road and numerics."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator

import pandas as pd

from rubfric.figures.road_friction import draw
from rubfric.figures.style import png
from rubfric.pages.render import render, sentence
from rubfric.studies.windows import WAYS

_CAPTIONS = {
    "friction over speed": "Mean over the windows; the band is the standard error of the mean and the numerical error.",
    "friction over the cutoff": "What finer waves add. Solid: slid over the profile itself. Dashed: the finer waves by "
    "Persson's theory, a model.",
}
_HEADINGS = (
    *(
        "Speed (mm/s)",
        "Pressure (MPa)",
        "Cutoff (mm)",
        "Friction",
        "Error: numerical",
        "Error: road",
        "Scatter of windows",
    ),
    *("Contact", "Persson's theory: friction", "contact", "Windows"),
)


def slide_page(table: pd.DataFrame, name: str, lead: str) -> str:
    """Return the page.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.studies.windows.slide`` returns it.
    name : str
        Of the road.
    lead : str
        What slid over it.
    """
    figures = [
        (key, _CAPTIONS[key], base64.b64encode(png(figure)).decode("ascii")) for key, figure in draw(table).items()
    ]
    return render(
        "slide.html",
        title=f"Friction on {name}",
        lead=lead,
        warnings=list(_warnings(table)),
        figures=figures,
        headings=_HEADINGS,
        rows=[_cells(row) for _, row in table.iterrows()],
    )


def _warnings(table: pd.DataFrame) -> Iterator[str]:
    direct = table[table["way"] == "direct"]
    refused = int(direct["refused"].sum())
    if refused:
        reason = next(note for note in direct["note"] if note)
        yield sentence(
            f"{refused} scenes were refused: means there are over fewer windows, not to be compared with others; "
            f"the first: {reason}"
        )
    for place, rows in direct.groupby(["pressure_MPa", "velocity_mm_per_s"]):
        friction = rows.sort_values("cutoff_mm")["friction_coefficient"].to_numpy()
        if len(friction) > 1 and friction[0] > 1.1 * friction[1]:
            yield sentence(
                f"at {place[1]:g} mm/s and {place[0]:g} MPa the finest waves add {friction[0] / friction[1] - 1.0:.0%} "
                "to friction: it is not that of the road yet, and finer waves would add more"
            )


def _cells(row: pd.Series) -> list[str]:
    exact = row["way"] == "direct"
    numbers = ("friction_coefficient", "friction_numerical_error", "friction_road_error", "friction_scatter")
    cells = [f"{row[key]:g}" for key in ("velocity_mm_per_s", "pressure_MPa", "cutoff_mm")]
    for key in (*numbers, "contact_fraction", "friction_persson", "contact_persson"):
        cells.append("" if math.isnan(row[key]) else f"{row[key]:.3g}")
    return [*cells, f"{row['windows']:.0f}" if exact else WAYS[row["way"]]]
