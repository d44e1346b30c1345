"""The package files that a result depends on, found in import statements, and a digest of them."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


@cache
def sources(*modules: str) -> tuple[Path, ...]:
    """Return the package's files that importing ``modules`` runs, sorted; absolute paths.

    Imports inside functions count. Files ``__init__.py`` do not: they hold a docstring only.

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


@cache
def code(*modules: str) -> str:
    """Return a digest of all ``sources(*modules)``, as they were when it was first asked for.

    Parameters
    ----------
    *modules : str
        Dotted names such as ``rubfric.simulation``.
    """
    lines = digests(sources(*modules))
    return hashlib.sha256("".join(lines).encode()).hexdigest()[:16]


def digests(paths: Iterable[Path]) -> list[str]:
    """Return the digests of files of the package, each with its path, in lines."""
    return [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(PACKAGE.parent)}\n" for path in paths]


def _file(module: str) -> Path:
    path = _find(module)
    if path is None:
        raise ModuleNotFoundError(f"{module} is not a module of rubfric", name=module)
    return path


def _find(module: str) -> Path | None:
    """Return the file of a module of the package; None for any other name, packages among them."""
    first, *rest = module.split(".")
    if first != PACKAGE.name or not rest:
        return None
    path = PACKAGE.joinpath(*rest).with_suffix(".py")
    return path if path.is_file() else None


@cache
def _imported(path: Path) -> list[Path]:
    names: list[str] = []
    for node in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            # "from rubfric import dataset" names a module, "from rubfric.simulation import evaluate" does not.
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for found in map(_find, names) if found is not None]


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements below a node; not their expressions, which are many and import nothing."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for statement in getattr(node, part, ()):
            yield statement
            yield from _statements(statement)
