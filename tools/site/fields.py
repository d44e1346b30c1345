"""Dataclasses that check themselves on their pages: each field's meaning, unit, bounds and default, from its rule."""

from __future__ import annotations

from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from rubfric.config.page import _allowed
from rubfric.rules import Rule, rules


def described(kind: type) -> list[str]:
    """Return the section "Parameters" of a numpy docstring, a line each; nothing where no field has a rule."""
    known = rules(kind)
    lines = ["Parameters", "----------"] if known else []
    for field in fields(kind):
        if field.name in known:
            lines += [f"{field.name}", f"    {_sentence(known[field.name], field.default)}"]
    return [*lines, ""] if lines else []


def _sentence(rule: Rule, default: Any) -> str:
    node = rule.schema()
    unit = node.get("unit") or node.get("items", {}).get("unit", "")
    parts = [f"Unit: {unit}."] if unit and unit != "dimensionless" else []
    parts.append(f"Allowed: {_allowed(node).replace('`', '``')}.")
    if default is not MISSING:
        parts.append(f"Default: ``{default}``.")
    return " ".join([rule.about, *parts]).strip()


def _process(_app: Any, what: str, _name: str, kind: Any, _options: Any, lines: list[str]) -> None:
    """Add the section to a docstring without one, before what it raises."""
    if what == "class" and is_dataclass(kind) and "Parameters" not in lines:
        ends = [number for number, line in enumerate(lines) if line in ("Raises", "Examples")]
        place = min(ends, default=len(lines))
        lines[place:place] = described(kind)


def setup(app: Any) -> dict[str, bool]:
    """Process docstrings before their sections are read."""
    app.connect("autodoc-process-docstring", _process, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
