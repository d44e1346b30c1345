"""Render equations as MathML when pages are built: no script, no font and no network when they are read."""

from __future__ import annotations

import html
import re
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging

_LOGGER = logging.getLogger(__name__)
# Two digits after a fraction are its two parts, which the converter takes for one number.
_DIGITS = (re.compile(r"(\\[td]?frac)(\d)(\d)"), r"\1{\2}{\3}")
# Spaces that TeX makes and MathML does not: after and before a function, and none beside the bars of a modulus.
_SPACE = '<mspace width="0.17em"/>'
_SPACING = (
    (re.compile(r"(&ApplyFunction;</mo>)(?!\s*<mo)"), rf"\1{_SPACE}"),
    (re.compile(r"(</m(?:i|n|sub|sup|row)>)(\s*<mi[^>]*>\w+</mi>\s*<mo>&ApplyFunction;)"), rf"\1{_SPACE}\2"),
    (re.compile(r"<mo([^>]*)>\|</mo>"), r'<mo\1 lspace="0" rspace="0">|</mo>'),
)


def mathml(equation: str, block: bool) -> str:
    """Return an equation in TeX as MathML; MathError where it cannot be converted."""
    pattern, parts = _DIGITS
    found = str(tex2mathml(pattern.sub(parts, equation), as_block=block))
    for pattern, spaced in _SPACING:
        found = pattern.sub(spaced, found)
    return found


def _render(node: nodes.Element, block: bool) -> str:
    """Return the MathML of a node; what cannot be converted is a warning, and shown as it is written."""
    try:
        return mathml(node.astext(), block)
    except MathError as error:
        _LOGGER.warning("equation is no MathML: %s: %s", error, node.astext(), location=node)
        return f"<code>{html.escape(node.astext())}</code>"


def _inline(writer: Any, node: nodes.Element) -> None:
    writer.body.append(_render(node, block=False))
    raise nodes.SkipNode


def _block(writer: Any, node: nodes.Element) -> None:
    writer.body.append(
        writer.starttag(node, "div", CLASS="math", tabindex="0") + _render(node, block=True) + "</div>\n"
    )
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Register the renderer; ``html_math_renderer = "mathml"`` chooses it."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
