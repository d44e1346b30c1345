"""Try some cases of the matrix of stability, each in a process of its own, and write what became of them."""

from typing import Any

import pandas as pd

from rubfric.results.tables import write_table
from rubfric.studies.stability.cases import Case
from rubfric.studies.stability.report import row
from rubfric.studies.stability.trial import confined


def main(output: str, cases: list[dict[str, Any]]) -> None:
    """Try ``cases``, each the parameters of a ``Case``, and write one row for each to the CSV file ``output``."""
    rows = []
    for parameters in cases:
        case = Case(**parameters)
        trial = confined(case)
        print(f"{trial.outcome} in {trial.seconds:.1f} s: {case.name} {trial.reason}", flush=True)
        rows.append(row(case, trial))
    write_table(pd.DataFrame(rows), output)
