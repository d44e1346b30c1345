"""Which files of the package a module is made of: what a result depends on, found in its import statements."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


@cache
def sources(*modules: str) -> tuple[Path, ...]:
    """Return the package's files that importing ``modules`` runs, sorted; absolute paths.

    Imports inside functions count. The package's own ``__init__`` imports nothing and never counts.

    Parameters
    ----------
    *modules : str
        Dotted names such as ``rubfric.simulation``.

    Raises
    ------
    ModuleNotFoundError
        For a name that is no module of the package.
    """
    found: set[Path] = set()
    waiting = [_file(module) for module in modules]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        waiting.extend(_imported(path))
    return tuple(sorted(found))


def _file(module: str) -> Path:
    path = _find(module)
    if path is None:
        raise ModuleNotFoundError(f"{module} is no module of rubfric", name=module)
    return path


def _find(module: str) -> Path | None:
    """Return the file of a module of the package; None for any other name, and for the package itself."""
    first, *rest = module.split(".")
    if first != _PACKAGE.name or not rest:
        return None
    base = _PACKAGE.joinpath(*rest)
    candidates = (base.with_suffix(".py"), base / "__init__.py")
    return next((path for path in candidates if path.is_file()), None)


def _imported(path: Path) -> list[Path]:
    names: list[str] = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            # "from rubfric import dataset" names a module, "from rubfric.energy import evaluate" does not.
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for found in map(_find, names) if found is not None]
