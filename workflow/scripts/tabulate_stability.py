"""Join the batches of the matrix of stability in one table, and describe the outcome."""

from pathlib import Path

import pandas as pd

from rubfric.files import whole
from rubfric.results.tables import read_table, write_table
from rubfric.studies.stability.cases import cases
from rubfric.studies.stability.report import page as described


def main(table: str, page: str, batches: list[str]) -> None:
    """Write the table, in the order of the matrix, and the page.

    Parameters
    ----------
    table, page : str
        Paths of the table (CSV) and of the page (Markdown).
    batches : list of str
        Paths of the batches (CSV).
    """
    joined = pd.concat([read_table(batch, ("case", "reason")) for batch in batches]).set_index("case")
    joined = joined.loc[[case.name for case in cases()]].reset_index()
    write_table(joined, table)
    with whole(page) as part:
        Path(part).write_text(described(joined), encoding="utf-8")
    print(joined["outcome"].value_counts().to_string())
