"""Write every point of the curves of friction over speed, and their peaks."""

import os

from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.curves import WORDS, curve_table
from rubfric.results.limits import MOST
from rubfric.results.peaks import peak_table
from rubfric.results.tables import read_table, write_table


def main(
    curves: str,
    peaks: str,
    page: str,
    tables: dict[str, str],
    added: dict[str, list[str]],
    aspect: float,
    about: tuple[str, str],
    accuracy: float | None,
) -> None:
    """Write both tables, and the peaks as a page.

    Parameters
    ----------
    curves, peaks, page : str
        Paths of the points and of the peaks (CSV), and of the latter as HTML.
    tables : dict
        Paths of the tables of scales and of totals (CSV), by the name of the curve.
    added : dict
        Those of the added speeds, likewise.
    aspect : float
        Height over width of the blocks.
    about : tuple of str
        Names of rubber and road.
    accuracy : float or None
        To which speeds were added; None where none were.
    """
    words = [*WORDS, "refused"]
    points = curve_table(
        {name: read_table(path, words) for name, path in tables.items()},
        {name: [read_table(path, words) for path in paths] for name, paths in added.items()},
        aspect,
    )
    found = peak_table(points, *about, accuracy)
    write_table(points, curves)
    write_table(found, peaks)
    how = (
        f"Speeds were added where friction was not known to {100.0 * accuracy:g} % of itself between the grid's, "
        f"{MOST} to a curve at most."
        if accuracy
        else "No speeds were added to the grid's; grid.refine adds them where friction is not known between them."
    )
    note = (
        "The highest friction over speed on every scale, and on the whole road, with its error: that of the points and "
        f"that of a spline between them, log over log. {how} At any speed between low and high of the peak friction "
        "may be as high as there, by these errors. Half: the speeds beside the peak at which friction has fallen to "
        "half of it. The interpolation error is the largest between two points, a share of friction."
    )
    title = f"Friction of rubber {about[0]} on road {about[1]}: peaks"
    shown = found.drop(columns=["rubber", "road"])  # in the title
    beside = {"csv": os.path.basename(peaks), "home": "../index.html"}
    write_page(table_page(shown, title, note, "curve", **beside), page)
