"""How a page is made: a template and a stylesheet, rendered into one file of HTML that needs nothing else.

Light until a page is rendered, since the workflow asks for ``assets`` before any job.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rubfric.files import whole

if TYPE_CHECKING:
    from jinja2 import Environment

_FOLDER = Path(__file__).resolve().parent
_EXPLORER = (
    "template.html",
    "explorer.css",
    "words.js",
    "look.js",
    "packed.js",
    "tables.js",
    "warnings.js",
    "blocks.js",
    "charts.js",
    "whole.js",
    "roads.js",
    "compare.js",
    "temperatures.js",
    "play.js",
    "scene.js",
    "saved.js",
    "controls.js",
    "explorer.js",
)
# What each page is made of beside its code; scripts in the order in which the browser reads them.
_ASSETS = {
    "table": ("page.html", "page.css", "table.html", "cells.html"),
    "claims": ("page.html", "page.css", "claims.html"),
    "index": ("page.html", "page.css", "index.html"),
    "rubber": ("page.html", "page.css", "findings.html", "rubber.html"),
    "road": ("page.html", "page.css", "findings.html", "road.html"),
    "slide": ("page.html", "page.css", "findings.html", "slide.html"),
    "areal": ("page.html", "page.css", "areal.html", "cells.html", "areal.css", "areal.js"),
    "explorer": tuple(f"explorer/{name}" for name in _EXPLORER),
}


def assets(page: str) -> tuple[Path, ...]:
    """Return the templates, styles and scripts of a page, ``table``, ``claims``, ``road``, ``explorer`` and so on."""
    return tuple(_FOLDER / name for name in _ASSETS[page])


def render(template: str, **values: Any) -> str:
    """Return a page.

    Parameters
    ----------
    template : str
        Path of the template below the folder of this module.
    **values
        What the template shows. Text is escaped; ``asset(name)`` in a template gives a file as it is.
    """
    return _environment().get_template(template).render(values)


def sentence(words: str) -> str:
    """Return words as a sentence."""
    return f"{words[:1].upper()}{words[1:]}."


def write_page(page: str, path: str | os.PathLike[str]) -> None:
    """Write a page completely or not at all.

    Parameters
    ----------
    page : str
        The page as HTML.
    path : path-like
        The file; missing folders are made.
    """
    with whole(path) as part:
        part.write_text(page, encoding="utf-8")


@cache
def _environment() -> Environment:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    made = Environment(
        loader=FileSystemLoader(_FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.globals["asset"] = lambda name: Markup((_FOLDER / name).read_text(encoding="utf-8"))
    return made
