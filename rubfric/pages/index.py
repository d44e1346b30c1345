"""The page of all results of a campaign: what it is, the friction of the whole road, and links to everything else."""

from __future__ import annotations

import datetime
import os
import struct
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import pandas as pd

import rubfric
from rubfric.checks import written
from rubfric.pages.render import render, sentence
from rubfric.pages.table import value_and_error
from rubfric.results.scales import AXES, TOTAL, WORDS
from rubfric.results.selection import WARNINGS
from rubfric.results.temperature import COLUMN, rows_at

# What there is to see in a figure, after a few words on what it shows.
_SEEN = {
    "fig1": "Where the lines of several ratios coincide, the block is high enough for its top not to matter.",
    "fig2": "Mean and range over the nodes of a row: near the road the range is what causes friction.",
    "fig3": "A line that is level from some ratio on says which ratio is enough.",
    "fig4": "Coloured by strain-energy density: fast rubber rides on crests, slow and pressed rubber fills the road.",
    "fig5": "Blocks that are pressed, then slid step by step, approach the steady sliding that is solved directly.",
    "fig6": "A panel for each scale, a line for each pressure; bands are the estimated errors.",
    "fig7": "The total with its error, and the sum over the scales with what each of them adds.",
    "fig8": "Its symbols are those of Fig. 9 and of the tables of the rig.",
    "fig9": "Simulated, with its error, and measured, with 95 % confidence.",
    "fig10": "All scales at once, and four models of how the scales act on one another.",
    "fig11": "One period of the road, and the spot about its highest crest.",
    "fig12": "Over speed, and over speed times the shift factor, which joins the temperatures.",
    "fig13": "With intervals of 95 %, and which of two grips more at each speed.",
    "areal": "Heights in grey, contact pressure in colour; friction beside Persson's theory.",
    "road": "With errors of numerics and of the road; what finer waves would add is a model, dashed.",
}


class Linked(NamedTuple):
    """Something to open: what it is in words, and its files by their kinds, such as ``page`` and ``CSV``."""

    words: str
    files: Mapping[str, str]


def index_page(
    folder: str | os.PathLike[str],
    title: str,
    totals: pd.DataFrame,
    understood: Sequence[str],
    answers: Sequence[str],
    figures: Mapping[str, str],
    groups: Mapping[str, Sequence[Linked]],
    temperature: float | None = None,
) -> str:
    """Return the page.

    Parameters
    ----------
    folder : path-like
        Of the results, in which the page is to be.
    title : str
        Of the campaign.
    totals : pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.
    understood, answers : sequence of str
        What was run, and what was found besides friction, a sentence each.
    figures : mapping of str to str
        By their names, what they show in a few words; each is ``figures/NAME.png`` and ``.pdf``.
    groups : mapping of str to sequence of Linked
        By heading: everything else, with paths from the working folder.
    temperature : float, optional
        The temperature shown, degC, of a table that has several.
    """
    table = rows_at(totals, temperature) if COLUMN in totals else totals
    now = datetime.datetime.now(datetime.UTC)
    made = f"Made by rubfric {rubfric.__version__} on {now.day} {now:%B %Y}, {now:%H:%M} UTC."
    base = Path(folder)
    return render(
        "index.html",
        title=title,
        made=made,
        facts=list(_facts(table)),
        friction=_friction(table),
        warned=bool((table[WARNINGS] > 0).any()),
        answers=[sentence(one.removesuffix(".")) for one in answers],
        understood=[sentence(one.removesuffix(".")) for one in understood],
        figures=[_figure(base, name, words) for name, words in figures.items()],
        groups={name: [_linked(base, one) for one in linked] for name, linked in groups.items() if linked},
        at="" if temperature is None else f" at {written(temperature)} °C",
    )


def _facts(table: pd.DataFrame) -> Iterable[tuple[str, str, str]]:
    """Yield the largest and the smallest friction and the largest error: what, value, and where."""
    friction, error = (table[name] for name in TOTAL)
    for what, place in (("highest", friction.idxmax()), ("lowest", friction.idxmin())):
        row = table.loc[place]
        yield f"{what} friction", value_and_error(row[TOTAL[0]], row[TOTAL[1]]), _where(row)
    share = (error / friction.abs())[friction != 0.0]
    if share.notna().any():
        yield "largest error", f"{100.0 * share.max():.2g} %", _where(table.loc[share.idxmax()])
    warned, refused = int((table[WARNINGS] > 0).sum()), int((table["refused"] > 0).sum())
    yield "with a warning", f"{warned} of {len(table)}", "points of speed and pressure"
    if refused:
        yield "refused", f"{refused} of {len(table)}", "points, where a model stands in for the whole road"


def _where(row: pd.Series) -> str:
    return f"at {written(row[AXES[0]])} mm/s, {written(row[AXES[1]])} MPa ({row[WORDS[0]]})"


def _friction(table: pd.DataFrame) -> dict[str, Any]:
    """Return friction with its error over speed and pressure, with a mark where a scene carries a warning."""
    pressures = sorted(set(table[AXES[1]]))
    found = {(row[AXES[0]], row[AXES[1]]): row for _, row in table.iterrows()}
    rows = [
        (written(speed), [_cell(found.get((speed, pressure))) for pressure in pressures])
        for speed in sorted(set(table[AXES[0]]))
    ]
    return {"pressures": [written(one) for one in pressures], "rows": rows}


def _cell(row: pd.Series | None) -> tuple[str, str, bool]:
    """Return friction, its error, and whether a scene carries a warning."""
    if row is None:
        return "", "", False
    value, _, error = value_and_error(row[TOTAL[0]], row[TOTAL[1]]).partition(" ± ")
    return value, error, bool(row[WARNINGS] > 0)


def _figure(base: Path, name: str, words: str) -> dict[str, Any]:
    """Return what the page shows of a figure."""
    number = name.removeprefix("fig")
    picture = base / "figures" / f"{name}.png"
    width, height = _size(picture)
    label = f"Fig. {number}" if number.isdigit() else ""
    return {
        "name": label,
        "words": sentence(words),
        "title": f"{label} {sentence(words)}".strip(),
        "seen": _SEEN.get(name) or _SEEN.get(name.partition("_")[0], ""),
        "png": _address(base, picture),
        "pdf": _address(base, picture.with_suffix(".pdf")),
        "width": width,
        "height": height,
        "id": name,
    }


def _size(path: Path) -> tuple[int, int]:
    """Return the width and the height of a picture, px, from the header of the PNG."""
    with path.open("rb") as stream:
        width, height = struct.unpack(">II", stream.read(24)[16:24])
    return width, height


def _linked(base: Path, one: Linked) -> dict[str, Any]:
    files = {kind: _address(base, Path(path)) for kind, path in one.files.items()}
    return {"words": one.words, "files": files}


def _address(base: Path, path: Path) -> str:
    """Return the relative address of a file, for links."""
    return quote(Path(os.path.relpath(path, base)).as_posix())
