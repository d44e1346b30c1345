"""Draw docs/architecture.svg: the rooms of the package, layer upon layer, and the way of one scene through them.

The layers are those of pyproject.toml, which ``lint-imports`` checks; the modules in them are read from the package.
"""

from __future__ import annotations

import ast
import html
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

import grimp

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs" / "architecture.svg"
# One scene from the config to the page: the module, and what it does.
WAY = {
    "config.campaign": "reads the config, checks it, and names every scene",
    "scene.scene": "holds all values that a result depends on",
    "runner.jobs": "runs the scene in a separate process, forked warm",
    "simulation": "leads the scene from here to its result",
    "mechanics.theory.kinematics": "decides between small and finite strain",
    "mechanics.steady.refinement": "refines the mesh until the estimated error is small enough",
    "mechanics.block.block": "provides the mesh and its stiffness",
    "mechanics.block.contact": "finds where rubber and road touch",
    "mechanics.finite.continuation": "reaches hard scenes by way of easier ones",
    "mechanics.steady.energies": "compares friction by three routes",
    "results.dataset": "writes the file, with units, errors and warnings",
    "results.campaign": "collects all scenes",
    "figures.fig6": "draws them",
    "pages.claims": "sets them beside the claims of the paper",
}
# A colour for the rooms of each part of the story: line, ground.
_COLOURS = {
    "errors arrays checks checksums files markdown outputs progress rules sources streams workers": (
        "#7b8794",
        "#f5f7fa",
    ),
    "rubber road columns profile dma decks scene config": ("#0f766e", "#effaf8"),
    "mechanics": ("#332288", "#f3f1fb"),
    "results simulation areal_simulation areal_plane marching scene_jobs total_simulation curve_simulation": (
        "#1a6e8e",
        "#eef7fb",
    ),
    "rig studies figures plot": ("#a16207", "#fdf8ea"),
    "pages commands cli runner": ("#882255", "#fbf0f5"),
}
_INK, _PALE, _MARK = "#1f2933", "#52606d", "#b3261e"
_WIDTH, _LEFT, _LEGEND, _TOP = 1330, 48, 392, 84
_LETTER, _CHIP, _GAP, _PAD, _BETWEEN, _HEAD, _BAR, _STEP = 6.65, 22, 8, 11, 10, 30, 28, 4.0
_MONO = "font-family='DejaVu Sans Mono, monospace'"


@dataclass(frozen=True)
class Room:
    """A package, or a module, with its rooms in layers, the highest first, and what it is in words."""

    name: str
    words: str
    layers: tuple[tuple[Room, ...], ...] = ()

    @property
    def short(self) -> str:
        return self.name.rpartition(".")[2]

    @property
    def is_box(self) -> bool:
        """Whether it is drawn as a box: a package, or a module that is in none."""
        return bool(self.layers) or "." not in self.name


def rooms() -> Room:
    """Return the package as its contracts order it; where they say nothing, all modules are side by side."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    order = {
        container: contract["layers"]
        for contract in contracts
        if contract["type"] == "layers"
        for container in contract["containers"]
    }
    graph = grimp.build_graph("rubfric", cache_dir=None)

    def room(name: str) -> Room:
        below = sorted(graph.find_children(name), key=lambda child: (bool(graph.find_children(child)), child))
        if name in order:
            layers = [[f"{name}.{one}" for one in re.findall(r"\w+", layer)] for layer in order[name]]
            names = [there for layer in layers if (there := [one for one in layer if one in graph.modules])]
        else:
            names = [below] if below else []
        return Room(name.removeprefix("rubfric."), _words(name), tuple(tuple(map(room, layer)) for layer in names))

    return room("rubfric")


def _words(name: str) -> str:
    """Return the first sentence of a module's docstring."""
    place = ROOT.joinpath(*name.split("."))
    source = (place / "__init__.py" if place.is_dir() else place.with_suffix(".py")).read_text(encoding="utf-8")
    return (
        (ast.get_docstring(ast.parse(source)) or "")
        .partition("\n\n")[0]
        .replace("\n", " ")
        .replace("``", "")
        .rstrip(".")
    )


class Drawing:
    """Boxes and words, as SVG."""

    def __init__(self) -> None:
        self.parts: list[str] = []
        self.numbers = {module: number for number, module in enumerate(WAY, 1)}
        self.badges: list[str] = []

    def text(self, x: float, y: float, words: str, size: float, fill: str, more: str = "") -> None:
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{fill}" {more}>{html.escape(words)}</text>'
        )

    def box(
        self, x: float, y: float, width: float, height: float, fill: str, stroke: str, more: str = "rx='6'"
    ) -> None:
        place = f'x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"'
        self.parts.append(f'<rect {place} fill="{fill}" stroke="{stroke}" {more}/>')

    def badge(self, x: float, y: float, number: int) -> str:
        return (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="8.5" fill="{_MARK}" stroke="#fff"/>'
            f'<text x="{x:.1f}" y="{y + 3.5:.1f}" font-size="10" fill="#fff" text-anchor="middle" '
            f'font-weight="600">{number}</text>'
        )

    def chip(self, room: Room, x: float, y: float, width: float, stroke: str) -> None:
        """Draw a module."""
        self.box(x, y, width, _CHIP, "#fff", stroke, "rx='4' stroke-opacity='.45'")
        length = _LETTER * len(room.short)
        more = f"{_MONO} textLength='{length:.1f}'"
        self.text(x + (width - length) / 2, y + 15, room.short, 11, _INK, more)
        if room.name in self.numbers:
            self.badges.append(self.badge(x + width - 1, y + 1, self.numbers[room.name]))

    def room(self, room: Room, x: float, y: float, width: float, height: float | None = None) -> float:
        """Draw a room with all that is in it, top left at x and y, if it is given a height; return the one it needs."""
        stroke, ground = _colour(room.name)
        needed = float(_BAR)
        if room.layers:
            needed = _HEAD + _PAD + self.inside(room, x + _PAD, y + _HEAD, width - 2 * _PAD, draw=False)
        if height is not None:
            self.box(x, y, width, height, ground, stroke)
            self.text(x + _PAD, y + 19, room.short, 13, stroke, "font-weight='600'")
            beside = x + _PAD + 9.4 * len(room.short) + 8
            if beside + 6.0 * len(room.words) < x + width - _PAD:
                self.text(beside, y + 19, room.words, 10.5, _PALE)
            self.inside(room, x + _PAD, y + _HEAD, width - 2 * _PAD, draw=True)
        return needed

    def inside(self, room: Room, x: float, y: float, width: float, *, draw: bool) -> float:
        """Draw what is in a room, layer below layer; return the height of it all."""
        begin = y
        for layer in room.layers:
            boxes = [one for one in layer if one.is_box]
            chips = [one for one in layer if not one.is_box]
            if chips:
                y = self.flow(chips, x, y, width, draw=draw) + _GAP
            if boxes:
                y = self.beside(boxes, x, y, width, draw=draw) + _GAP
        return max(y - _GAP - begin, 0.0)

    def flow(self, chips: list[Room], x: float, y: float, width: float, *, draw: bool) -> float:
        """Draw modules in as many lines as they need; return where the last one ends."""
        at = x
        for one in chips:
            if at > x and at + _chip_width(one) > x + width + 0.01:  # whatever x rounds to
                at, y = x, y + _CHIP + _GAP
            if draw:
                self.chip(one, at, y, _chip_width(one), _colour(one.name)[0])
            at += _chip_width(one) + _GAP
        return y + _CHIP

    def beside(self, boxes: list[Room], x: float, y: float, width: float, *, draw: bool) -> float:
        """Draw rooms side by side, with widths that make the highest as low as can be; return where they end."""
        widths = [_narrowest(one) for one in boxes]
        spare = width - _BETWEEN * (len(boxes) - 1) - sum(widths)
        while spare > 0.0:
            heights = [
                self.room(one, x, y, wide) / (1.0 + 1e-6 * wide) for one, wide in zip(boxes, widths, strict=True)
            ]
            step = min(_STEP, spare)
            widths[heights.index(max(heights))] += step
            spare -= step
        height = max(self.room(one, x, y, wide) for one, wide in zip(boxes, widths, strict=True))
        for one, wide in zip(boxes, widths, strict=True):
            if draw:
                self.room(one, x, y, wide, height)
                if one.name in self.numbers:
                    self.badges.append(self.badge(x + wide - 2, y + 2, self.numbers[one.name]))
            x += wide + _BETWEEN
        return y + height


def picture() -> str:
    """Return the picture as SVG."""
    drawing, whole = Drawing(), rooms()
    height = _TOP + drawing.inside(whole, _LEFT, _TOP, _WIDTH - _LEFT - _LEGEND, draw=False) + 28
    height = max(height, _TOP + 24 + 46 * (len(WAY) + 1))
    drawing.box(0, 0, _WIDTH, height, "#fff", "none", "")
    drawing.text(24, 40, "The rooms of rubfric, and the way of one scene", 20, _INK, "font-weight='600'")
    words = "A module imports only from the rooms below its own, and rooms side by side do not import each other."
    drawing.text(24, 64, words, 12.5, _PALE)
    drawing.inside(whole, _LEFT, _TOP, _WIDTH - _LEFT - _LEGEND, draw=True)
    drawing.parts.append(
        f'<path d="M28 {_TOP + 4}V{height - 36}m-5 -9l5 9l5 -9" fill="none" stroke="{_PALE}" stroke-width="1.5"/>'
    )
    middle = (_TOP + height - 30) / 2
    drawing.text(18, middle, "imports", 12, _PALE, f"text-anchor='middle' transform='rotate(-90 18 {middle:.1f})'")
    _legend(drawing)
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height:.0f}" width="{_WIDTH}" '
        f'height="{height:.0f}" role="img" aria-labelledby="title" font-family="DejaVu Sans, Verdana, sans-serif">'
    )
    title = '<title id="title">The rooms of rubfric, and the way of one scene through them</title>'
    return "\n".join([head, title, *drawing.parts, *drawing.badges, "</svg>"]) + "\n"


def _legend(drawing: Drawing) -> None:
    """Describe the way, step by step, at the right."""
    x = _WIDTH - _LEGEND + 30
    drawing.text(x, _TOP + 16, "The way of one scene", 14, _INK, "font-weight='600'")
    for number, (module, words) in enumerate(WAY.items(), 1):
        y = _TOP + 4 + 46 * number
        drawing.badges.append(drawing.badge(x + 8, y, number))
        drawing.text(x + 26, y + 4, module, 11.5, _INK, _MONO)
        drawing.text(x + 26, y + 20, words, 10.5, _PALE)


def _colour(name: str) -> tuple[str, str]:
    top = name.partition(".")[0]
    return next(colours for names, colours in _COLOURS.items() if top in names.split())


def _chip_width(room: Room) -> float:
    return _LETTER * len(room.short) + 16


def _narrowest(room: Room) -> float:
    """Return the least width in which a room can be drawn."""
    widths = [9.0 * len(room.short)]
    for layer in room.layers:
        boxes = [_narrowest(one) for one in layer if one.is_box]
        widths += [_chip_width(one) for one in layer if not one.is_box]
        widths.append(sum(boxes) + _BETWEEN * max(len(boxes) - 1, 0))
    return max(widths) + 2 * _PAD


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8")
