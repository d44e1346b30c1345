from __future__ import annotations

from typing import Any

import pandas as pd
import pytest

from rubfric.errors import InvalidInput
from rubfric.figures.columns import check_columns

GOOD = {"name": ["a", "b"], "error": [0.1, float("nan")], "count": [1, 2]}


def test_good_table_passes() -> None:
    check_columns(pd.DataFrame(GOOD), "table", ("name",), ("error", "count"))
    check_columns(pd.DataFrame(GOOD | {"error": [-0.1, 0.1]}), "table", ("name",), ("count",), signed=("error",))


@pytest.mark.parametrize(
    ("changed", "complaint"),
    [
        ({"name": ["a", None]}, r"^the column name of the table has gaps, but must name something in every row$"),
        ({"error": ["0.1", "off"]}, r"^the column error of the table is of \w+, but must be numbers$"),
        ({"error": [True, False]}, r"^the column error of the table is of bool, but must be numbers$"),
        ({"error": [0.1, -1e-9]}, r"^the column error of the table has a number below 0, but none may be negative$"),
    ],
)
def test_bad_values_are_refused(changed: dict[str, Any], complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        check_columns(pd.DataFrame(GOOD | changed), "table", ("name",), ("error", "count"))


def test_what_is_absent_is_named() -> None:
    with pytest.raises(InvalidInput, match=r"^the table lacks the column rung, cost$"):
        check_columns(pd.DataFrame(GOOD), "table", ("name", "rung"), ("error", "cost"))
    with pytest.raises(InvalidInput, match=r"^the table lacks the column reference$"):
        check_columns(pd.DataFrame(GOOD), "table", (), (), signed=("reference",))
    with pytest.raises(InvalidInput, match=r"^the table has 0 rows, but must have at least one$"):
        check_columns(pd.DataFrame(GOOD).iloc[:0], "table", ("name",), ("error",))
