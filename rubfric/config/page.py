"""The page on the config, config/README.md: every key with its meaning, unit, bounds and default.

It is made of the schema, which describes the keys, and of config/config.yaml, which holds the defaults:
``python -m rubfric.config.page`` writes it anew.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import yaml

from rubfric.files import whole

ROOT = Path(__file__).resolve().parents[2]
PAGE, CONFIG = ROOT / "config" / "README.md", ROOT / "config" / "config.yaml"
SCHEMA = ROOT / "workflow" / "schemas" / "config.schema.yaml"

_UNITS = re.compile(r"[,;] (dimensionless|mm/s|MPa|1/mm|t/mm³|mm²|mm|kg|Hz|N|s)(?=[,;.])")
_HEAD = "| key | meaning | unit | allowed | default |\n|---|---|---|---|---|\n"
_NOTHING = "–"
_INTRODUCTION = """\
# The config

*Written by `make docs` out of [the schema](../workflow/schemas/config.schema.yaml) and [config.yaml](config.yaml); edit
those.*

[config.yaml](config.yaml) holds the paper's campaign, every key with its default. Edit it, or write only what shall
differ into a file of your own, which is laid over it:

```sh
snakemake -j2 --configfile mine.yaml
```

[minimal.yaml](minimal.yaml) is such a file, of a campaign that runs in under a minute. Mappings are merged key by key,
anything else is replaced. Numbers may be written in any way that YAML takes for a number: `1.0e-3`, not `1e-3`, which
it takes for text. A wrong config is refused before any job starts, in one sentence that names the key, the value and
what is allowed.

Below, `*` stands for a name of your choice and `[]` for every entry of a list.
"""


@dataclass(frozen=True)
class Key:
    """One key of the config: its dotted name, meaning, unit, what is allowed, and its default."""

    name: str
    meaning: str
    unit: str
    allowed: str
    default: str

    @property
    def row(self) -> str:
        """The key's row of a Markdown table."""
        cells = (f"`{self.name}`", self.meaning, self.unit, self.allowed, self.default)
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def keys(schema: Mapping[str, Any], config: Mapping[str, Any]) -> Iterator[Key]:
    """Yield every key that holds a value, in the order of the schema.

    Parameters
    ----------
    schema : mapping
        A closed JSON schema with a description for each key; units stand in the descriptions.
    config : mapping
        A complete config, for the defaults.
    """
    for key in _below(schema, schema, config, ""):
        from_preset = key.name.startswith("numerics.") and key.default == _NOTHING
        yield replace(key, default="the preset's") if from_preset else key


def page(schema: Mapping[str, Any], config: Mapping[str, Any]) -> str:
    """Return the page as Markdown: the keys without keys of their own first, then a section for each of the others."""
    found = list(keys(schema, config))
    top = [key for key in found if "." not in key.name]
    parts = [_INTRODUCTION, "## What is run\n", _HEAD + "\n".join(key.row for key in top) + "\n"]
    for name, node in schema["properties"].items():
        rows = [key.row for key in found if key.name.startswith(f"{name}.")]
        if rows:
            parts += [f"## {name}\n", f"{node['description']}\n", _HEAD + "\n".join(rows) + "\n"]
    return "\n".join(parts)


def _below(schema: Mapping[str, Any], node: Mapping[str, Any], values: Any, at: str) -> Iterator[Key]:
    """Yield the keys below a node of the schema whose values of the config are given, by name where names are free."""
    for name, below in node.get("properties", {}).items():
        whole_node = _resolved(schema, below)
        inner = _inner(values, name)
        if "properties" in whole_node:
            yield from _below(schema, whole_node, inner, f"{at}{name}.")
        elif isinstance(whole_node.get("additionalProperties"), Mapping):
            entry = _resolved(schema, whole_node["additionalProperties"])
            items = _resolved(schema, entry.get("items", entry))
            mark = "[]" if "items" in entry else ""
            yield from _below(schema, items, _Named(inner), f"{at}{name}.*{mark}.")
        else:
            optional = "" if name in node.get("required", ()) else "; may be left out"
            yield _key(f"{at}{name}", whole_node, inner, optional)


class _Named(dict[str, Any]):
    """The entries of a mapping whose names are free."""


def _inner(values: Any, name: str) -> Any:
    """Return the value of a key; of several named entries the value in each, lists being gone through."""
    if not isinstance(values, _Named):
        return values.get(name)
    told: dict[str, Any] = {}
    for entry, value in values.items():
        found = [item.get(name) for item in value] if isinstance(value, list) else value.get(name)
        if found is not None:
            told[entry] = found
    return _Named(told)


def _key(name: str, node: Mapping[str, Any], value: Any, optional: str) -> Key:
    description = " ".join(node["description"].split())
    unit = _UNITS.search(description)
    return Key(
        name=name,
        meaning=_UNITS.sub("", description, count=1),
        unit=unit[1] if unit else _NOTHING,
        allowed=_allowed(node) + optional,
        default=_default(value),
    )


def _default(value: Any) -> str:
    if isinstance(value, _Named):
        return "; ".join(f"{name}: {_default(inner)}" for name, inner in value.items()) or _NOTHING
    if isinstance(value, list):
        return ", ".join(_written(item) for item in value) or "none"
    return _NOTHING if value is None else f"`{_written(value)}`"


def _allowed(node: Mapping[str, Any]) -> str:
    """Return in words what a node of the schema, whole, allows."""
    if "enum" in node:
        return " or ".join(f"`{_written(word)}`" for word in node["enum"])
    if node.get("type") == "array":
        few = f"at least {node['minItems']}" if node.get("minItems") else "any number of them"
        alike = ", no two alike" if node.get("uniqueItems") else ""
        return f"list, {few}{alike}; each a {_allowed(node['items'])}"
    if isinstance(node.get("type"), list):
        return " or ".join("`null`" if kind == "null" else _allowed({**node, "type": kind}) for kind in node["type"])
    if node.get("type") == "string":
        letters = "word of letters, digits, `-` and `_`" if "pattern" in node else "text"
        return letters + (f", at most {node['maxLength']} long" if "maxLength" in node else "")
    kind = {"integer": "whole number", "number": "number"}[str(node.get("type"))]
    multiple = f", a multiple of {node['multipleOf']}" if "multipleOf" in node else ""
    return f"{kind}{_range(node)}{multiple}"


def _range(node: Mapping[str, Any]) -> str:
    low, high = node.get("minimum"), node.get("maximum")
    above, below = node.get("exclusiveMinimum"), node.get("exclusiveMaximum")
    if above is not None and below is not None:
        return f" between {_written(above)} and {_written(below)}, both excluded"
    if low is not None and high is not None:
        return f" from {_written(low)} to {_written(high)}"
    return f" of at least {_written(low)}" if low is not None else ""


def _resolved(schema: Mapping[str, Any], node: Mapping[str, Any]) -> dict[str, Any]:
    """Return a node with what its reference, and that of its items, points at."""
    merged = dict(node)
    if "$ref" in merged:
        merged = dict(_resolved(schema, schema["$defs"][merged.pop("$ref").rpartition("/")[2]])) | merged
    if isinstance(merged.get("items"), Mapping):
        merged["items"] = _resolved(schema, merged["items"])
    return merged


def _written(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    # YAML takes 1e-06 for text.
    mantissa, letter, exponent = f"{value:.10g}".partition("e")
    return f"{mantissa}{'' if '.' in mantissa else '.0'}e{int(exponent):+d}" if letter else mantissa


def main() -> None:
    """Write config/README.md anew."""
    schema, config = (yaml.safe_load(path.read_text(encoding="utf-8")) for path in (SCHEMA, CONFIG))
    with whole(PAGE) as part:
        part.write_text(page(schema, config), encoding="utf-8")


if __name__ == "__main__":
    main()
