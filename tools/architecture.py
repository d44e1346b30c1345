"""The picture of the architecture, docs/architecture.svg: the floors of the package, and the way of one scene.

It is drawn from the floors that the tests hold the imports to: ``python tests/unit/architecture.py`` draws it anew.
"""

from __future__ import annotations

import html
from pathlib import Path

from test_floors import FLOORS

PICTURE = Path(__file__).resolve().parents[1] / "docs" / "architecture.svg"
# The lowest floor of each storey, by one of its modules.
STOREYS = {
    "errors": "sentences and files",
    "material": "rubber, road, a scene",
    "folding": "cells, stresses, the block",
    "strain": "contact and solvers",
    "smallenergy": "energies and results",
    "ladder": "many scenes: sums, tables",
    "figures": "figures",
    "campaign": "config, workflow, shell",
}
# One scene, from the config to the page: the module, and what it does.
WAY = {
    "campaign": "reads the config, checks it, and names every scene",
    "scene": "holds all that a result depends on; its name is that of the file",
    "jobs": "runs it in a process of its own, forked warm",
    "simulation": "leads it from here to its result",
    "kinematics": "decides between small and finite strain",
    "steady": "solves steady sliding, or says why it could not",
    "refinement": "takes finer meshes until the estimated error is small enough",
    "continuation": "comes to hard scenes by way of easier ones",
    "slidingcontact": "finds where rubber and road touch",
    "block": "is the mesh and its stiffness",
    "energy": "gets friction by three routes",
    "dataset": "writes the file, with units, errors and warnings",
    "collection": "gathers all scenes",
    "tables": "writes them down",
    "figures": "draws them",
}
_INK, _PALE, _LINE, _ACCENT = "#1f2933", "#52606d", "#cbd2d9", "#7b2d8b"
_LEFT, _ROW, _LETTER, _PAD, _GAP, _TOP = 212, 27, 6.65, 7, 10, 92
# The legend stands at the right of the longest floor.
_LONGEST = max(sum(_LETTER * len(module) + 2 * _PAD + _GAP for module in modules) for modules in FLOORS)
_LEGEND = round(_LEFT + _LONGEST + 40)
_WIDTH = _LEGEND + 400


def picture() -> str:
    """Return the picture as SVG."""
    numbers = {module: number for number, module in enumerate(WAY, 1)}
    height = _TOP + _ROW * len(FLOORS) + 24
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height}" width="{_WIDTH}" height="{height}"'
        ' role="img" aria-labelledby="title" font-family="DejaVu Sans, Verdana, sans-serif">',
        '<title id="title">The floors of rubfric, and the way of one scene through them</title>',
        f'<rect width="{_WIDTH}" height="{height}" fill="#fff"/>',
        _text(24, 38, "The floors of rubfric, and the way of one scene", 19, _INK, "font-weight='600'"),
        _text(24, 62, "A module imports only from the floors below its own; a test holds it to that.", 12.5, _PALE),
        *_storeys(),
    ]
    for place, modules in enumerate(FLOORS):
        parts += _floor(_top(place), sorted(modules), numbers)
    return "\n".join([*parts, *_legend(), "</svg>"]) + "\n"


def _top(place: int) -> int:
    """Return where a floor begins, from above."""
    return _TOP + _ROW * (len(FLOORS) - 1 - place)


def _place(module: str) -> int:
    return next(place for place, modules in enumerate(FLOORS) if module in modules)


def _storeys() -> list[str]:
    """Draw the storeys: a pale ground under every other, and their names."""
    bottoms = [_place(module) for module in STOREYS]
    tops = [*bottoms[1:], len(FLOORS)]
    parts = []
    for number, (name, low, high) in enumerate(zip(STOREYS.values(), bottoms, tops, strict=True)):
        y, height = _top(high - 1), _ROW * (high - low)
        fill = "#f5f7fa" if number % 2 else "#fff"
        parts.append(f'<rect x="16" y="{y}" width="{_LEGEND - 40}" height="{height}" fill="{fill}"/>')
        parts.append(_text(24, y + height / 2 + 4, name, 12, _PALE))
    return parts


def _floor(y: int, modules: list[str], numbers: dict[str, int]) -> list[str]:
    """Draw the modules of one floor; those on the way carry their number."""
    parts, x = [], float(_LEFT)
    for module in modules:
        width = _LETTER * len(module) + 2 * _PAD
        number = numbers.get(module)
        fill, stroke = ("#f3e8f5", _ACCENT) if number else ("#fff", _LINE)
        parts.append(
            f'<rect x="{x:.1f}" y="{y + 3}" width="{width:.1f}" height="{_ROW - 6}" rx="4" fill="{fill}"'
            f' stroke="{stroke}"/>'
        )
        mono = "font-family='DejaVu Sans Mono, monospace'"
        parts.append(_text(x + _PAD, y + _ROW / 2 + 4, module, 11, _INK, f"{mono} textLength='{width - 2 * _PAD:.1f}'"))
        if number:
            parts += _badge(x + width, y + 4, number)
        x += width + _GAP
    return parts


def _badge(x: float, y: float, number: int) -> list[str]:
    return [
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="8" fill="{_ACCENT}"/>',
        _text(x, y + 3.4, str(number), 9.5, "#fff", "text-anchor='middle' font-weight='600'"),
    ]


def _legend() -> list[str]:
    """Tell the way, step by step, at the right."""
    parts = [_text(_LEGEND, _TOP + 16, "The way of one scene", 14, _INK, "font-weight='600'")]
    for number, (module, words) in enumerate(WAY.items(), 1):
        y = _TOP + 12 + 46 * number
        parts += _badge(_LEGEND + 8, y, number)
        parts.append(_text(_LEGEND + 26, y + 4, module, 12, _INK, "font-family='DejaVu Sans Mono, monospace'"))
        parts.append(_text(_LEGEND + 26, y + 20, words, 10.5, _PALE))
    return parts


def _text(x: float, y: float, words: str, size: float, fill: str, more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{fill}" {more}>{html.escape(words)}</text>'


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8")
