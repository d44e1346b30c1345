"""What is exported from the models of the config: its JSON schema, for editors, and config/README.md, for readers.

``python -m rubfric.config.page`` writes both anew; defaults come from config/config.yaml.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args, get_origin

import yaml

from rubfric.config.entries import Entry
from rubfric.config.models import Config
from rubfric.files import whole

ROOT = Path(__file__).resolve().parents[2]
PAGE, CONFIG = ROOT / "config" / "README.md", ROOT / "config" / "config.yaml"
SCHEMA = ROOT / "workflow" / "schemas" / "config.schema.yaml"

_HEAD = "| key | meaning | unit | allowed | default |\n|---|---|---|---|---|\n"
_NOTHING = "–"
_MADE = "# Written by `make docs` out of rubfric/config/models.py."
_INTRODUCTION = """\
# The config

*Written by `make docs` out of [the models](../rubfric/config/models.py), as is
[the JSON schema](../workflow/schemas/config.schema.yaml), and of [config.yaml](config.yaml).*

[config.yaml](config.yaml) holds the paper's campaign, every key with its default. Edit it, or write only what shall
differ into a file of your own, which is laid over it:

```sh
snakemake -j2 --configfile mine.yaml
```

**A file that gives a rubber, road or grid of its own runs the grid only, and of `aspect_study`, `transient`, `rig` and
`claims`, which the paper adds, just those that it gives too.** Speeds, loads and scales that it does not choose for
them or for `figures` follow from the grid. `null` switches a section off: `claims: null`. `rubfric init mine.yaml`
writes such a file, with comments, to begin with.

[minimal.yaml](minimal.yaml) is another, of the paper's campaign in under a minute. Mappings are merged key by key,
anything else is replaced. Paths may hold `~` and environment variables. Numbers may be written in any way that YAML
takes for a number: `1.0e-3`, not `1e-3`, which it takes for text. A wrong config is refused before any job starts, with
a sentence for every fault that names the key, the value and what is allowed; so are a file that has a key twice, and
numbers that are far from any rubber, road or load (Young's modulus in Pa, amplitudes in µm), with the unit that was
probably meant.

Below, `*` stands for a name of your choice and `[]` for every entry of a list.
"""


def schema() -> dict[str, Any]:
    """Return the JSON schema of the config; the unit of a number is under the keyword ``unit``."""
    exported: dict[str, Any] = _plain(Config.model_json_schema())
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "Config of rubfric"} | exported


def page(config: dict[str, Any]) -> str:
    """Return the page as Markdown: the keys without keys of their own first, then a section for each of the others.

    Parameters
    ----------
    config : dict
        A complete config, for the defaults.
    """
    sections: dict[str, list[str]] = {"": []}
    for cells in _keys(Config, {"": config}, ""):
        top = cells[0].strip("`").partition(".")[0] if "." in cells[0] else ""
        sections.setdefault(top, []).append(f"| {' | '.join(cells)} |")
    parts = [_INTRODUCTION]
    for top, rows in sections.items():
        about = [f"## {top}\n", f"{_about(top)}\n"] if top else ["## What is run\n"]
        parts += [*about, _HEAD + "\n".join(rows) + "\n"]
    return "\n".join(parts)


def _keys(model: type[Entry], values: dict[str, Any], at: str) -> Iterator[tuple[str, ...]]:
    """Yield the cells of every key below a model that holds a value, given the config's entries there, by name."""
    for name, field in model.model_fields.items():
        models = _below(field.annotation)
        inner: Any = {
            label: [item[name] for item in entry] if isinstance(entry, list) else entry[name]
            for label, entry in values.items()
            if all(name in item for item in (entry if isinstance(entry, list) else [entry]))
        }
        for below, mark in models:
            held: dict[str, Any] = inner[""] if mark else inner
            if len(models) > 1:
                keys = set(below.model_fields)
                held = {label: entry for label, entry in held.items() if isinstance(entry, list) or set(entry) <= keys}
                held = {label: entry for label, entry in held.items() if isinstance(entry, list) == mark.endswith("]")}
            yield from _keys(below, held, f"{at}{name}{mark}.")
        if models:
            continue
        node = field.metadata[0].schema()
        unit = node.get("unit") or node.get("items", {}).get("unit") or _NOTHING
        optional = "" if field.is_required() else "; may be left out"
        optional += f", for {_otherwise(field.default, unit)}" if optional and field.default is not None else ""
        defaults = "; ".join(f"{label}: {_default(value)}".removeprefix(": ") for label, value in inner.items())
        missing = "the preset's" if at == "numerics." else _NOTHING
        yield f"`{at}{name}`", field.metadata[0].about, unit, _allowed(node) + optional, defaults or missing


def _below(annotation: Any) -> list[tuple[type[Entry], str]]:
    """Return the models of a key whose value has keys of its own, each with what stands for free names in between."""
    annotation = _given(annotation)
    if get_origin(annotation) is not dict:
        return [(annotation, "")] if isinstance(annotation, type) and issubclass(annotation, Entry) else []
    entry = get_args(annotation)[1]
    if isinstance(entry, type):
        return [(entry, ".*")] if issubclass(entry, Entry) else []
    kinds = [get_args(kind)[0] for kind in get_args(get_args(entry)[0])]
    return [(get_args(kind)[0], ".*[]") if get_origin(kind) is list else (kind, ".*") for kind in kinds]


def _about(name: str) -> str:
    field = Config.model_fields[name]
    if field.metadata:
        return str(field.metadata[0].about)
    what = "makes it follow from the grid" if name == "figures" else "switches it off"
    off = "" if field.is_required() else f" `{name}: null` {what}; so does a campaign of your own that leaves it out."
    return f"{_given(field.annotation).__doc__}{off}"


def _given(annotation: Any) -> Any:
    """Return the model of a key whose value may be null."""
    return get_args(annotation)[0] if type(None) in get_args(annotation) else annotation


def _otherwise(value: Any, unit: str) -> str:
    """Return a default; speeds and pressures that follow from the grid are zero or empty there."""
    if not value and unit in ("mm/s", "MPa"):
        return "some of the grid's"
    return _default(list(value) if isinstance(value, tuple) else value)


def _default(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(_written(item) for item in value) or "none"
    return _NOTHING if value is None else f"`{_written(value)}`"


def _allowed(node: dict[str, Any]) -> str:
    """Return in words what a node of the schema allows."""
    if "anyOf" in node:
        return ", or ".join(map(_allowed, node["anyOf"]))
    if "enum" in node:
        return " or ".join(f"`{word}`" for word in node["enum"])
    if node["type"] == "array":
        few = f"at least {node['minItems']}" if "minItems" in node else "any number of them"
        alike = ", no two alike" if node.get("uniqueItems") else ""
        return f"list, {few}{alike}; each a {_allowed(node['items'])}"
    if isinstance(node["type"], list):
        return f"{_allowed(node | {'type': node['type'][0]})} or `null`"
    if node["type"] == "string":
        letters = "word of letters, digits, `-` and `_`" if "pattern" in node else "text"
        return f"{letters}, at most {node['maxLength']} long"
    if node["type"] == "object":
        return f"text by name: {', '.join(node['propertyNames']['enum'])}"
    kind = {"integer": "whole number", "number": "number"}[node["type"]]
    multiple = f", a multiple of {node['multipleOf']}" if "multipleOf" in node else ""
    if "exclusiveMinimum" in node:
        low, high = node["exclusiveMinimum"], node["exclusiveMaximum"]
        return f"{kind} between {_written(low)} and {_written(high)}, both excluded"
    if "maximum" in node:
        return f"{kind} from {_written(node['minimum'])} to {_written(node['maximum'])}{multiple}"
    return f"{kind} of at least {_written(node['minimum'])}{multiple}"


def _plain(node: Any) -> Any:
    """Return a JSON schema without the titles that pydantic adds, and without defaults of None, which mean none."""
    if isinstance(node, list):
        return [_plain(item) for item in node]
    if not isinstance(node, dict):
        return node
    return {
        name: _plain(below) for name, below in node.items() if name != "title" and (name, below) != ("default", None)
    }


def _written(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    # YAML takes 1e-06 for text.
    mantissa, letter, exponent = f"{value:.10g}".partition("e")
    return f"{mantissa}{'' if '.' in mantissa else '.0'}e{int(exponent):+d}" if letter else mantissa


def main() -> None:
    """Write the JSON schema and config/README.md anew."""
    config = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
    written = yaml.safe_dump(schema(), sort_keys=False, allow_unicode=True, width=120, default_flow_style=None)
    for path, text in ((SCHEMA, f"{_MADE}\n{written}"), (PAGE, page(config))):
        with whole(path) as part:
            part.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
