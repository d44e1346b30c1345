"""The page itself: one file of HTML that needs no server and no network."""

from __future__ import annotations

import json
from typing import Any

from markupsafe import Markup
from plotly.offline import get_plotlyjs

from rubfric.pages.explorer.pictures import deflated
from rubfric.pages.render import assets, render


def page(payload: dict[str, Any], home: str | None = None) -> str:
    """Return the page of a campaign.

    Parameters
    ----------
    payload : dict
        As from ``rubfric.pages.explorer.data.payload``, or ``together`` of several temperatures.
    home : str, optional
        Where the page of all results is, relative to this one.
    """
    about = payload.get("pages", [payload])[0]["about"]
    return render(
        "explorer/template.html",
        title=f"Friction of rubber {about['rubber']} on road {about['road']}",
        home=home,
        lead="Every scene of a campaign: its friction, its deformed block, its numbers.",
        library=deflated(get_plotlyjs().encode()),
        payload=Markup(_embedded(payload)),
        scripts=[path.name for path in assets("explorer") if path.suffix == ".js"],
    )


def _embedded(payload: dict[str, Any]) -> str:
    """Return JSON in which no name can end the script element: HTML recognises no ``<`` inside of it."""
    text = json.dumps(payload, allow_nan=False, separators=(",", ":"), ensure_ascii=True)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
