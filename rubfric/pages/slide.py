"""The page of friction on a measured road: over speed and over the cutoff, with the errors of road and numerics."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator

import pandas as pd

from rubfric.figures.road_friction import draw
from rubfric.figures.style import png
from rubfric.pages.render import render, sentence
from rubfric.pages.table import table_page
from rubfric.results.carriers import carried
from rubfric.results.road_friction import POINT, WAYS

_CAPTIONS = {
    "friction over speed": "Friction and real contact: mean over windows; the band is the standard error of the mean, "
    "and of friction the numerical error too. Dotted: Persson's theory on the same windows.",
    "friction over the cutoff": "What finer waves add. Solid: slid over the profile itself. Dashed: the finer waves by "
    "Persson's theory, a model.",
}
# Share of friction that the finest waves add, from which on finer ones matter.
_STILL = 0.1
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


def slide_page(table: pd.DataFrame, name: str, lead: str, csv: str = "", home: str = "") -> str:
    """Return the page.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.results.road_friction.tabulate`` returns it.
    name : str
        Of the road.
    lead : str
        What slid over it.
    csv, home : str
        Links to the table as CSV and to the page of all results; none where ``home`` is empty.
    """
    figures = [
        (key, _CAPTIONS[key], base64.b64encode(png(figure)).decode("ascii")) for key, figure in draw(table).items()
    ]
    bands = list(carried(table))
    return render(
        "slide.html",
        title=f"Friction on {name}",
        lead=lead,
        csv=csv,
        home=home,
        warnings=list(_warnings(table)),
        figures=figures,
        double=tuple(_CAPTIONS),
        bands=[name for name, _ in bands[0][2]] if bands else [],
        shares=[
            [f"{velocity:g}", f"{pressure:g}", *(f"{share:.0%}" for _, share in parts), finer]
            for pressure, velocity, parts, finer in bands
        ],
        sines=list(_beside(table)),
        headings=_HEADINGS,
        rows=[_cells(row) for _, row in table.iterrows()],
    )


def study_page(table: pd.DataFrame, name: str, lead: str) -> str:
    """Return the page of what windows, blending and the height of the block do to friction.

    Parameters
    ----------
    table : pandas.DataFrame
        As ``rubfric.studies.windows.vary`` returns it.
    name : str
        Of the road.
    lead : str
        What slid over it.
    """
    first = ["window_mm", "blend", "block_height_mm"]
    rest = [column for column in table.columns if column not in (*first, "way", "cutoff_mm", "note")]
    cutoff = table["cutoff_mm"].iloc[0]
    words = f"{lead} Waves of {cutoff:g} mm and longer."
    return table_page(table[[*first, *rest]], f"Windows and block on {name}", words)


def _warnings(table: pd.DataFrame) -> Iterator[str]:
    direct = table[table["way"] == "direct"]
    refused = int(direct["refused"].sum())
    if refused:
        reason = next(note for note in direct["note"] if note)
        yield sentence(
            f"{refused} scenes were refused: means there are over fewer windows, not to be compared with others; "
            f"the first: {reason}"
        )
    grown = {}
    for place, rows in direct[~(direct["refused"] > 0)].groupby(list(POINT)):
        friction = rows.sort_values("cutoff_mm")["friction_coefficient"].to_numpy()
        if len(friction) > 1:
            grown[place] = friction[0] / friction[1] - 1.0
    still = {place: more for place, more in grown.items() if more > _STILL}
    if still:
        (pressure, velocity), most = max(still.items(), key=lambda item: item[1])
        yield sentence(
            f"at {len(still)} of {len(grown)} points the finest waves still add more than a tenth to friction, at most "
            f"{most:.0%}, at {velocity:g} mm/s and {pressure:g} MPa: it is not that of the road there yet, and finer "
            "waves would add more"
        )


def _beside(table: pd.DataFrame) -> Iterator[list[str]]:
    """Yield speed, pressure, direct friction, and how far off it sines and Persson's theory are, where sines are."""
    direct = (
        table[table["way"] == "direct"].sort_values("cutoff_mm").drop_duplicates(list(POINT)).set_index(list(POINT))
    )
    sines = table[table["way"].isin(["sines", "sum"])]
    for point, rows in sines.groupby(list(POINT)):
        row, found = direct.loc[point], rows.set_index("way")["friction_coefficient"]
        friction = row["friction_coefficient"]
        if math.isfinite(friction) and friction:
            others = (found.get("sines", math.nan), found.get("sum", math.nan), row["friction_persson"])
            off = ["" if math.isnan(one) else f"{one:.3g} ({one / friction - 1.0:+.0%})" for one in others]
            error = row["friction_numerical_error"] + (
                0.0 if math.isnan(row["friction_road_error"]) else row["friction_road_error"]
            )
            yield [f"{point[1]:g}", f"{point[0]:g}", f"{friction:.3g} ± {error:.2g}", *off]


def _cells(row: pd.Series) -> list[str]:
    exact = row["way"] == "direct"
    numbers = ("friction_coefficient", "friction_numerical_error", "friction_road_error", "friction_scatter")
    cells = [f"{row[key]:g}" for key in ("velocity_mm_per_s", "pressure_MPa", "cutoff_mm")]
    for key in (*numbers, "contact_fraction", "friction_persson", "contact_persson"):
        cells.append("" if math.isnan(row[key]) else f"{row[key]:.3g}")
    return [*cells, f"{row['windows']:.0f}" if exact else WAYS[row["way"]]]
