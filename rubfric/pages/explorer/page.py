"""The page itself: one file of HTML that needs no server and no network."""

from __future__ import annotations

import html
import json
import os
from string import Template
from typing import Any

from plotly.offline import get_plotlyjs

from rubfric.files import whole
from rubfric.pages.explorer.assets import SCRIPTS, STYLE, TEMPLATE


def page(payload: dict[str, Any]) -> str:
    """Return the page that shows a payload (``rubfric.pages.explorer.data.payload``)."""
    template = Template(TEMPLATE.read_text(encoding="utf-8"))
    about = payload["about"]
    return template.substitute(
        title=html.escape(f"Friction of rubber {about['rubber']} on road {about['road']}"),
        style=STYLE.read_text(encoding="utf-8"),
        library=get_plotlyjs(),
        payload=_embedded(payload),
        script="\n".join(path.read_text(encoding="utf-8") for path in SCRIPTS),
    )


def write_page(payload: dict[str, Any], path: str | os.PathLike[str]) -> None:
    """Write the page of a payload, whole or not at all."""
    with whole(path) as part:
        part.write_text(page(payload), encoding="utf-8")


def _embedded(payload: dict[str, Any]) -> str:
    """Return JSON that no name in it can end: HTML knows no ``<`` inside of it."""
    text = json.dumps(payload, allow_nan=False, separators=(",", ":"), ensure_ascii=True)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
