"""Write the page of all results."""

import os
from typing import Any

from rubfric.pages.index import Linked, index_page
from rubfric.pages.render import write_page
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table
from rubfric.runner.findings import told_apart, verdicts


def main(
    output: str,
    totals: str,
    claims: str,
    ranking: str,
    groups: dict[str, list[tuple[str, dict[str, str]]]],
    **about: Any,
) -> None:
    """Write the page.

    Parameters
    ----------
    output, totals, claims, ranking : str
        Paths of the page (HTML), and of the tables of totals, claims and comparisons (CSV), of which the last two may
        be empty.
    groups : dict
        By heading: words, and paths by kind of file. What is not there, of those that no job makes, is left out.
    **about
        The other arguments of ``rubfric.pages.index.index_page``.
    """
    said = [
        *([f"claims of the paper: {verdicts(claims)}"] if claims else []),
        *([f"which grips more: {told_apart(ranking)}"] if ranking else []),
    ]
    linked = {
        name: [Linked(words, files) for words, files in those if all(map(os.path.exists, files.values()))]
        for name, those in groups.items()
    }
    folder, table = os.path.dirname(output), read_table(totals, WORDS)
    write_page(index_page(folder, totals=table, answers=said, groups=linked, **about), output)
