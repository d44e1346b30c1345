"""A table as a page for the browser: one HTML file that needs nothing else."""

from __future__ import annotations

import html
import math
import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from rubfric.files import whole

_DIGITS = 4
# How headings end: what the page writes for it.
_UNITS = {"_mm_per_s": "mm/s", "_MPa": "MPa", "_mm": "mm", "_s": "s", "_MB": "MB"}
_STYLE = """
body { font: 13px/1.45 system-ui, sans-serif; color: #1f2933; margin: 1.25rem; }
h1 { font-size: 1.25rem; font-weight: 600; margin: 0 0 .25rem; }
p { max-width: 46rem; margin: 0 0 1rem; color: #52606d; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th { position: sticky; top: 0; background: #fff; font-weight: 600; vertical-align: bottom; text-align: right;
     max-width: 7.5rem; padding: .35rem .5rem; box-shadow: 0 1px #1f2933; }
td { text-align: right; padding: .2rem .5rem; border-bottom: 1px solid #e4e7eb; white-space: nowrap; }
tr:hover td { background: #f0f4f8; }
tr.group td { border-top: 2px solid #9aa5b1; }
small { font-weight: 400; color: #7b8794; }
@media print { th { position: static; } body { margin: 0; } }
"""


def table_page(table: pd.DataFrame, title: str, words: str, group: str | None = None) -> str:
    """Return a page with a title, a sentence or two, and a table.

    Parameters
    ----------
    table : pandas.DataFrame
        Units stand at the end of its headings: ``velocity_mm_per_s``.
    title, words : str
        Plain text.
    group : str, optional
        A column; a line is drawn where its value changes.
    """
    rows: list[str] = []
    before = None
    for row in table.to_dict("records"):
        value = row.get(group) if group else None
        kind = ' class="group"' if rows and value != before else ""
        rows.append(f"<tr{kind}>{''.join(f'<td>{_shown(cell)}</td>' for cell in row.values())}</tr>")
        before = value
    return (
        f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{html.escape(title)}</title>\n'
        f"<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{html.escape(title)}</h1>\n<p>{html.escape(words)}</p>\n"
        f"<table>\n<thead><tr>{''.join(f'<th>{_heading(str(name))}</th>' for name in table.columns)}</tr></thead>\n"
        "<tbody>\n" + "\n".join(rows) + "\n</tbody>\n</table>\n</body>\n</html>\n"
    )


def write_page(page: str, path: str | os.PathLike[str]) -> None:
    """Write a page, whole or not at all."""
    with whole(path) as part:
        Path(part).write_text(page, encoding="utf-8")


def _heading(name: str) -> str:
    unit = next((ending for ending in _UNITS if name.endswith(ending)), "")
    told = re.sub(r"_", " ", name.removesuffix(unit)).replace("poissons", "Poisson's")
    return html.escape(told) + (f"<br><small>{_UNITS[unit]}</small>" if unit else "")


def _shown(cell: Any) -> str:
    """Return a value as the page shows it; a gap is empty."""
    if isinstance(cell, float):
        if math.isnan(cell):
            return ""
        plain = cell == 0.0 or 1e-4 <= abs(cell) < 1e7
        return np.format_float_positional(cell, _DIGITS, fractional=False, trim="-") if plain else f"{cell:.{_DIGITS}g}"
    return html.escape(str(cell))
