"""The longest sheet of an Excel file (.xls), as analysers and loggers write it, as text."""

from __future__ import annotations

import importlib

from rubfric.errors import InvalidInput

MARK = b"\xd0\xcf\x11\xe0"


def sheet_text(path: str, content: bytes) -> str:
    """Return the sheet with most rows, its fields separated by tabs.

    Parameters
    ----------
    path : str
        Named in messages.
    content : bytes
        Of the file, which begins with `MARK`.

    Raises
    ------
    InvalidInput
        Without the extra ``xls``, and for a damaged file.
    """
    try:
        xlrd = importlib.import_module("xlrd")
    except ImportError:
        raise InvalidInput(
            f"{path} is an Excel file (.xls): install rubfric[xls], which reads it, or export the table as text (CSV)"
        ) from None
    try:
        sheets = xlrd.open_workbook(file_contents=content).sheets()
    except Exception as error:  # xlrd raises whatever a damaged file leads it to
        raise InvalidInput(f"{path} is no Excel file that xlrd can read ({error}): export the table as text") from None
    sheet = max(sheets, key=lambda one: one.nrows)
    rows = (sheet.row_values(row) for row in range(sheet.nrows))
    return "\n".join("\t".join(" ".join(str(value).split()) for value in row) for row in rows)
