"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def markdown_table(rows: Iterable[Sequence[object]], *, numeric: bool = False) -> str:
    """Return a table in GitHub's Markdown, without a line break at its end.

    Parameters
    ----------
    rows : iterable of sequences
        Cells, row by row, the headings first; a ``|`` in them is escaped.
    numeric : bool
        Whether all columns but the first are aligned to the right.
    """
    header, *body = ([str(cell).replace("|", "\\|") for cell in row] for row in rows)
    rule = ["---", *["---:" if numeric else "---"] * (len(header) - 1)]
    return "\n".join("| " + " | ".join(line) + " |" for line in (header, rule, *body))
