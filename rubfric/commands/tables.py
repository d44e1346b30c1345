"""Tables of several commands, on the terminal and as JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return a line for each row, headings first, columns right-aligned below one another."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]


def with_nulls(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return a row for JSON: None, which becomes null, for numbers that are not finite."""
    return {name: None if isinstance(one, float) and not math.isfinite(one) else one for name, one in row.items()}
