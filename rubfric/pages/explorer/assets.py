"""The files that the page is made of, beside what is computed; light, since the workflow reads it before any job."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).resolve().parent
TEMPLATE, STYLE = _FOLDER / "template.html", _FOLDER / "explorer.css"
# In the order in which the browser reads them.
SCRIPTS = tuple(_FOLDER / f"{name}.js" for name in ("words", "tables", "blocks", "charts", "explorer"))


def assets() -> tuple[Path, ...]:
    """Return all of them."""
    return (TEMPLATE, STYLE, *SCRIPTS)
