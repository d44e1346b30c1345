"""Try some cases of the matrix of stability, each in a process of its own, and write their outcomes."""

from typing import Any

import pandas as pd

from rubfric.results.tables import write_table
from rubfric.studies.stability.cases import Case
from rubfric.studies.stability.report import row
from rubfric.studies.stability.trial import confined


def main(output: str, cases: list[dict[str, Any]]) -> None:
    """Try the cases and write one row for each.

    Parameters
    ----------
    output : str
        Path of the table (CSV).
    cases : list of dict
        Parameters of each ``Case``.
    """
    rows = []
    for parameters in cases:
        case = Case(**parameters)
        trial = confined(case)
        print(f"{trial.outcome} in {trial.seconds:.1f} s: {case.name} {trial.reason}", flush=True)
        rows.append(row(case, trial))
    write_table(pd.DataFrame(rows), output)
