"""Write the friction of every rubber on every road, and which of two grips more."""

import os

from rubfric.files import mark as leave
from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.comparison import comparison_table, headlines, ranking_table
from rubfric.results.pair import read_pair
from rubfric.results.tables import write_table

_TABLES = ("comparison", "ranking")
_INTERVALS = (
    "Intervals are of 95 %. That of a difference adds the squares of its parts: numerics, the coupling of the scales, "
    "the data of the rubbers, and the road, which for two rubbers on one road is the scatter of their difference from "
    "window to window. Each verdict is right in 95 % of cases by itself: of a hundred comparisons of equals about five "
    "find a difference. No error covers what the last column names, nor the finite-strain law."
)


def main(outputs: dict[str, str], pairs: list[tuple[str, str, str, str, list[str]]], mark: str) -> None:
    """Write both tables, each as CSV and as a page.

    Parameters
    ----------
    outputs : dict
        Paths of ``comparisoncsv``, ``comparisonhtml``, ``rankingcsv`` and ``rankinghtml``.
    pairs : list
        Rubber, road, path of the table of its friction, what its scenes are known by, and what its errors leave out.
    mark : str
        Path of an empty file whose name represents all scenes; it takes the place of such files beside it.
    """
    tables = {(rubber, road): read_pair(path, collected) for rubber, road, path, collected, _ in pairs}
    without = {(rubber, road): names for rubber, road, *_, names in pairs}
    compared, ranked = comparison_table(tables, without), ranking_table(tables, without)
    write_table(compared, outputs["comparisoncsv"])
    write_table(ranked, outputs["rankingcsv"])
    words = "Friction of the whole road. The error of a total is the sum of its parts. "
    beside = {name: {"csv": os.path.basename(outputs[f"{name}csv"]), "home": "../index.html"} for name in _TABLES}
    title = "Friction of every rubber on every road"
    page = table_page(compared, title, words + _INTERVALS, "rubber", **beside["comparison"])
    write_page(page, outputs["comparisonhtml"])
    said = "; ".join(headlines(ranked.to_dict("records")))
    details = ["compared", "on", "first", "second", "friction_first", "friction_second", "verdict"]
    ranked.insert(ranked.columns.get_loc("compared"), "verdict_in_words", ranked.pop("words"))
    page = table_page(
        ranked.drop(columns=details),
        "Which grips more",
        f"At all speeds and loads: {said}. {_INTERVALS}",
        group="pressure_MPa",
        **beside["ranking"],
    )
    write_page(page, outputs["rankinghtml"])
    leave(mark)
