"""Checks of the columns of a table that is drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from pandas.api.types import is_bool_dtype, is_numeric_dtype

from rubfric.errors import InvalidInput


def check_columns(
    table: pd.DataFrame, name: str, words: Sequence[str], numbers: Sequence[str], signed: Sequence[str] = ()
) -> None:
    """Raise InvalidInput unless a table has rows, columns of words without gaps, and columns of numbers.

    Parameters
    ----------
    table : pandas.DataFrame
    name : str
        What the table is called in the message.
    words, numbers, signed : sequence of str
        Columns; in both kinds of numbers NaN is allowed, negative numbers in ``signed`` only.
    """
    lacking = [column for column in (*words, *numbers, *signed) if column not in table]
    if lacking:
        raise InvalidInput(f"the {name} lacks the column {', '.join(lacking)}")
    if table.empty:
        raise InvalidInput(f"the {name} has 0 rows, but must have at least one")
    for column in words:
        if table[column].isna().any():
            raise InvalidInput(f"the column {column} of the {name} has gaps, but must name something in every row")
    for column in (*numbers, *signed):
        if not is_numeric_dtype(table[column]) or is_bool_dtype(table[column]):
            raise InvalidInput(f"the column {column} of the {name} is of {table[column].dtype}, but must be numbers")
    for column in numbers:
        if (table[column].to_numpy(dtype=np.float64) < 0.0).any():
            raise InvalidInput(f"the column {column} of the {name} has a number below 0, but none may be negative")
